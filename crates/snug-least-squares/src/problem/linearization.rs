//! The local model of a problem, ½‖q + R d‖²: from J itself, or from JᵀJ where speed counts more.

use crate::error::EvaluationError;
use crate::matrix::{dot, solve_upper, triangularize, upper_times, upper_transposed_times};
use crate::problem::thresholds::{FACTORED_RANK_TOLERANCE, NORMAL_RANK_TOLERANCE};

/// The local model of a least-squares problem: ½‖r + J d‖² = ½‖q + R d‖² + constant.
///
/// R is upper triangular with RᵀR = JᵀJ, q = Qᵀr is the part of the residual that J can reach; n parameters.
#[derive(Debug, Clone)]
pub struct Linearization {
    pub(crate) cost: f64,
    /// n × n, column-major, upper triangle.
    pub(crate) factor: Vec<f64>,
    pub(crate) reachable: Vec<f64>,
    pub(crate) gradient: Vec<f64>,
    /// Singular values of the column-scaled R below this share of the largest are rounding.
    pub(crate) rank_tolerance: f64,
}

impl Linearization {
    /// Room for `parameter_count` parameters.
    pub fn new(parameter_count: usize) -> Self {
        Self {
            cost: 0.0,
            factor: vec![0.0; parameter_count * parameter_count],
            reachable: vec![0.0; parameter_count],
            gradient: vec![0.0; parameter_count],
            rank_tolerance: FACTORED_RANK_TOLERANCE,
        }
    }

    /// ½‖r‖².
    pub fn cost(&self) -> f64 {
        self.cost
    }

    /// Jᵀr, n entries.
    pub fn gradient(&self) -> &[f64] {
        &self.gradient
    }

    /// The step that minimises ½‖r + J step‖², by back-substitution; 0 along what is not determined.
    pub fn minimizer(&self) -> Vec<f64> {
        let mut step: Vec<f64> = self.reachable.iter().map(|q| -q).collect();
        solve_upper(&self.factor, self.reachable.len(), &mut step);
        step
    }

    /// By how much a step raises the cost as far as r and J tell: ½‖r + J step‖² − ½‖r‖².
    pub fn rise(&self, step: &[f64]) -> f64 {
        let mut reached = vec![0.0; step.len()];
        upper_times(&self.factor, step.len(), step, &mut reached);
        dot(&reached, &self.reachable) + 0.5 * dot(&reached, &reached)
    }

    /// Takes r (m) and J (m × n, column-major) and factors J by Householder reflections; both are overwritten.
    /// This keeps the full accuracy of J.
    ///
    /// # Errors
    /// [`EvaluationError::NotFinite`] when an entry is infinite or not a number.
    pub fn set_jacobian(
        &mut self,
        residual: &mut [f64],
        jacobian: &mut [f64],
    ) -> Result<(), EvaluationError> {
        let (rows, columns) = (residual.len(), self.reachable.len());
        self.cost = 0.5 * dot(residual, residual);
        triangularize(jacobian, residual, rows, columns);
        let kept = rows.min(columns);
        self.reachable.fill(0.0);
        self.reachable[..kept].copy_from_slice(&residual[..kept]);
        self.factor.fill(0.0);
        for (column, factor) in self.factor.chunks_exact_mut(columns.max(1)).enumerate() {
            let filled = (column + 1).min(kept);
            factor[..filled].copy_from_slice(&jacobian[column * rows..column * rows + filled]);
        }
        upper_transposed_times(&self.factor, columns, &self.reachable, &mut self.gradient);
        self.rank_tolerance = FACTORED_RANK_TOLERANCE;
        self.check()
    }

    /// Takes cost ½‖r‖², Jᵀr (n) and the upper triangle of JᵀJ (n × n, column-major): the fast way, good for a
    /// column-scaled condition of J up to about 1e6.
    ///
    /// # Errors
    /// [`EvaluationError::NotFinite`] when an entry is infinite or not a number.
    pub fn set_normal_equations(
        &mut self,
        cost: f64,
        gradient: &[f64],
        normal_matrix: &[f64],
    ) -> Result<(), EvaluationError> {
        self.cost = cost;
        self.gradient.copy_from_slice(gradient);
        self.factor.copy_from_slice(normal_matrix);
        self.factorize_normal_matrix();
        self.rank_tolerance = NORMAL_RANK_TOLERANCE;
        self.check()
    }

    /// Cholesky by columns; a pivot that is rounding leaves a zero row and a zero in q: nothing is known along it.
    fn factorize_normal_matrix(&mut self) {
        let n = self.reachable.len();
        let rounding = 4.0 * (n as f64) * f64::EPSILON;
        for column in 0..n {
            let (done, rest) = self.factor.split_at_mut(column * n);
            let current = &mut rest[..n];
            for (row, finished) in done.chunks_exact(n).enumerate() {
                let inner = dot(&finished[..row], &current[..row]);
                current[row] = match finished[row] {
                    0.0 => 0.0,
                    pivot => (current[row] - inner) / pivot,
                };
            }
            let square = current[column];
            let left = square - dot(&current[..column], &current[..column]);
            current[column] = if left > rounding * square {
                left.sqrt()
            } else {
                // A NaN or infinity must survive until it is checked.
                if left.is_finite() { 0.0 } else { left }
            };
            current[column + 1..].fill(0.0);
            let known = dot(&current[..column], &self.reachable[..column]);
            self.reachable[column] = match current[column] {
                0.0 => 0.0,
                pivot => (self.gradient[column] - known) / pivot,
            };
        }
    }

    fn check(&self) -> Result<(), EvaluationError> {
        let finite = |values: &[f64]| values.iter().all(|value| value.is_finite());
        if self.cost.is_finite() && finite(&self.factor) && finite(&self.reachable) {
            Ok(())
        } else {
            Err(EvaluationError::NotFinite)
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    /// J = [1 2; 3 4; 5 6], r = (1, 0, -1): JᵀJ = [35 44; 44 56], Jᵀr = (-4, -4) by hand.
    const JACOBIAN: [f64; 6] = [1.0, 3.0, 5.0, 2.0, 4.0, 6.0];
    const RESIDUAL: [f64; 3] = [1.0, 0.0, -1.0];

    #[test]
    fn both_ways_give_the_same_quadratic_model() {
        let (mut factored, mut normal) = (Linearization::new(2), Linearization::new(2));
        factored
            .set_jacobian(&mut RESIDUAL.clone(), &mut JACOBIAN.clone())
            .unwrap();
        normal
            .set_normal_equations(1.0, &[-4.0, -4.0], &[35.0, 0.0, 44.0, 56.0])
            .unwrap();
        for model in [&factored, &normal] {
            let r = &model.factor;
            assert!((r[0] * r[0] - 35.0).abs() < 1e-12);
            assert!((r[0] * r[2] - 44.0).abs() < 1e-12);
            assert!((r[2] * r[2] + r[3] * r[3] - 56.0).abs() < 1e-12);
            assert!(
                (model.gradient[0] + 4.0).abs() < 1e-12 && (model.gradient[1] + 4.0).abs() < 1e-12
            );
            assert_eq!(model.cost, 1.0);
            // q in the range of J: ‖q‖² = gᵀ(JᵀJ)⁻¹g = 16·(56 − 88 + 35)/24 = 2.
            assert!((dot(&model.reachable, &model.reachable) - 2.0).abs() < 1e-11);
        }
    }

    #[test]
    fn dependent_columns_leave_a_zero_row() {
        let mut model = Linearization::new(2);
        model
            .set_normal_equations(0.5, &[1.0, 2.0], &[1.0, 0.0, 2.0, 4.0])
            .unwrap();
        assert_eq!(model.factor, [1.0, 0.0, 2.0, 0.0]);
        assert_eq!(model.reachable, [1.0, 0.0]);
    }

    #[test]
    fn what_is_not_finite_is_refused() {
        let mut model = Linearization::new(2);
        let mut residual = RESIDUAL;
        residual[1] = f64::NAN;
        let refused = Err(EvaluationError::NotFinite);
        assert_eq!(
            model.set_jacobian(&mut residual, &mut JACOBIAN.clone()),
            refused
        );
        let infinite = [f64::INFINITY, 0.0, 1.0, 1.0];
        assert_eq!(
            model.set_normal_equations(1.0, &[0.0; 2], &infinite),
            refused
        );
    }
}
