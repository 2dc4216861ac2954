//! A residual that stores its Jacobian: the accurate general case.

use crate::error::EvaluationError;
use crate::matrix::{add_scaled, dot};
use crate::problem::least_squares::LeastSquares;
use crate::problem::linearization::Linearization;
use crate::problem::thresholds::PROBE_SHARE;

/// A residual r(p) = measured − simulated, weighted so that equal sizes mean equally unlikely.
pub trait Residual {
    /// Number m of residuals.
    fn residual_count(&self) -> usize;

    /// Number n of parameters.
    fn parameter_count(&self) -> usize;

    /// Writes r(p) into `residual` (m) and, where asked, J = ∂r/∂p into `jacobian` (m × n, column-major).
    ///
    /// # Errors
    /// [`EvaluationError`] where r(p) has no finite value. Non-finite entries are found by the caller as well.
    fn evaluate(
        &mut self,
        parameters: &[f64],
        residual: &mut [f64],
        jacobian: Option<&mut [f64]>,
    ) -> Result<(), EvaluationError>;
}

impl<R: Residual> Residual for &mut R {
    fn residual_count(&self) -> usize {
        R::residual_count(self)
    }

    fn parameter_count(&self) -> usize {
        R::parameter_count(self)
    }

    fn evaluate(
        &mut self,
        parameters: &[f64],
        residual: &mut [f64],
        jacobian: Option<&mut [f64]>,
    ) -> Result<(), EvaluationError> {
        R::evaluate(self, parameters, residual, jacobian)
    }
}

/// A [`Residual`] as a [`LeastSquares`] problem: J is stored and factored by Householder reflections.
#[derive(Debug, Clone)]
pub struct DenseResidual<R> {
    residual_function: R,
    residual: Vec<f64>,
    jacobian: Vec<f64>,
    /// The last two evaluations with J, the last one first: after a rejected step, the other is where a search stands and
    /// wants to know how its next step bends.
    known: [Evaluation; 2],
    ahead: Vec<f64>,
}

/// r and J at some parameters.
#[derive(Debug, Clone, Default)]
struct Evaluation {
    /// Empty before the first, and where r has no value.
    parameters: Vec<f64>,
    residual: Vec<f64>,
    jacobian: Vec<f64>,
}

/// Where a step's second_derivative is measured.
pub fn further_along(parameters: &[f64], direction: &[f64]) -> Vec<f64> {
    let mut further = parameters.to_vec();
    add_scaled(&mut further, PROBE_SHARE, direction);
    further
}

impl<R: Residual> DenseResidual<R> {
    /// Wraps `residual_function` and makes room for m residuals and the m × n matrix J.
    pub fn new(residual_function: R) -> Self {
        let (m, n) = (
            residual_function.residual_count(),
            residual_function.parameter_count(),
        );
        Self {
            residual_function,
            residual: vec![0.0; m],
            jacobian: vec![0.0; m * n],
            known: std::array::from_fn(|_| Evaluation {
                parameters: Vec::with_capacity(n),
                residual: vec![0.0; m],
                jacobian: vec![0.0; m * n],
            }),
            ahead: vec![0.0; m],
        }
    }

    /// The residual function itself.
    pub fn residual_function_mut(&mut self) -> &mut R {
        &mut self.residual_function
    }

    /// Gives the residual function back.
    pub fn into_inner(self) -> R {
        self.residual_function
    }

    /// Makes r and J at `parameters` the first that are known.
    fn evaluate(&mut self, parameters: &[f64]) -> Result<(), EvaluationError> {
        self.known.swap(0, 1);
        let now = &mut self.known[0];
        now.parameters.clear();
        self.residual_function
            .evaluate(parameters, &mut now.residual, Some(&mut now.jacobian))?;
        now.parameters.extend_from_slice(parameters);
        Ok(())
    }
}

impl<R: Residual> LeastSquares for DenseResidual<R> {
    fn parameter_count(&self) -> usize {
        self.residual_function.parameter_count()
    }

    fn residual_count(&self) -> usize {
        self.residual.len()
    }

    fn cost(&mut self, parameters: &[f64]) -> Result<f64, EvaluationError> {
        self.residual_function
            .evaluate(parameters, &mut self.residual, None)?;
        let cost = 0.5 * dot(&self.residual, &self.residual);
        if cost.is_finite() {
            Ok(cost)
        } else {
            Err(EvaluationError::NotFinite)
        }
    }

    fn linearize(
        &mut self,
        parameters: &[f64],
        linearization: &mut Linearization,
    ) -> Result<(), EvaluationError> {
        self.evaluate(parameters)?;
        self.residual.copy_from_slice(&self.known[0].residual);
        self.jacobian.copy_from_slice(&self.known[0].jacobian);
        linearization.set_jacobian(&mut self.residual, &mut self.jacobian)
    }

    /// r″ ≈ 2 ((r(p + h v) − r(p))/h − J v)/h with h = 0.1.
    fn second_derivative(
        &mut self,
        parameters: &[f64],
        direction: &[f64],
        second_derivative: &mut [f64],
    ) -> Result<bool, EvaluationError> {
        if !(self.known.iter()).any(|known| known.parameters == parameters) {
            self.evaluate(parameters)?;
        }
        let is_there = |known: &&Evaluation| known.parameters == parameters;
        let Some(here) = self.known.iter().find(is_there) else {
            return Err(EvaluationError::NotFinite);
        };
        let ahead = &mut self.ahead;
        let further = further_along(parameters, direction);
        self.residual_function.evaluate(&further, ahead, None)?;
        for (ahead, here) in ahead.iter_mut().zip(&here.residual) {
            *ahead = (*ahead - here) / PROBE_SHARE;
        }
        let columns = || here.jacobian.chunks_exact(self.residual.len().max(1));
        for (column, step) in columns().zip(direction) {
            add_scaled(ahead, -step, column);
        }
        for (second_derivative, column) in second_derivative.iter_mut().zip(columns()) {
            *second_derivative = 2.0 / PROBE_SHARE * dot(column, ahead);
        }
        match second_derivative.iter().all(|value| value.is_finite()) {
            true => Ok(true),
            false => Err(EvaluationError::NotFinite),
        }
    }
}
