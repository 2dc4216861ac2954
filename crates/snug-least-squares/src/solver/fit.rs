//! How a fit ended: values, status, active constraints, work.

use crate::matrix::{add_scaled, dot};
use crate::uncertainty::identifiability::Identifiability;

/// How a fit ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Status {
    /// A local optimum at which no constraint presses.
    Converged,
    /// A local optimum on at least one constraint, which [`Fit::active`] names.
    ConvergedAtConstraint,
    /// The iteration limit came first; the values are the best seen.
    IterationLimit,
    /// No step decreases the cost, yet the optimality test does not hold; the values are the best seen.
    Stalled,
    /// The residual does not determine all parameters (rank-deficient sensitivities); [`Fit::identifiability`] says
    /// which depend on each other.
    NotIdentifiable,
    /// The residual has no finite value at the start; the values are the start.
    Failed,
}

impl Status {
    /// Whether the values are an optimum, inside the constraints or on them.
    pub fn is_converged(self) -> bool {
        matches!(self, Status::Converged | Status::ConvergedAtConstraint)
    }
}

/// A constraint on which the optimum lies.
#[derive(Debug, Clone, PartialEq)]
pub struct ActiveConstraint {
    /// Its name as given to [`Constraints`](crate::Constraints).
    pub name: String,
    /// Lagrange multiplier, at least 0: by how much ½‖r‖² falls per unit that the limit of a bound or linear inequality
    /// is moved; for a cone, of ‖(w, u − v)‖ ≤ u + v with u, v and w each divided by the size of u, v and √(u v).
    pub multiplier: f64,
}

/// How much work a fit was.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Work {
    /// Steps tried, accepted or rejected.
    pub iterations: usize,
    /// Evaluations of the cost alone, or of the second_derivative along a step.
    pub evaluations: usize,
    /// Evaluations of cost, gradient and curvature together.
    pub linearizations: usize,
    /// Conic programs solved by Clarabel.
    pub conic_solves: usize,
    /// Newton steps on active sets.
    pub polish_steps: usize,
}

impl Work {
    /// Adds the work of another fit.
    pub fn add(&mut self, other: &Work) {
        self.iterations += other.iterations;
        self.evaluations += other.evaluations;
        self.linearizations += other.linearizations;
        self.conic_solves += other.conic_solves;
        self.polish_steps += other.polish_steps;
    }
}

/// The outcome of a fit with n parameters and m residuals.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// The estimate, n entries. Bounds hold exactly, other constraints to rounding.
    pub values: Vec<f64>,
    /// ½‖r‖² there.
    pub cost: f64,
    /// m.
    pub residual_count: usize,
    /// How the fit ended.
    pub status: Status,
    /// The constraints the optimum presses on.
    pub active: Vec<ActiveConstraint>,
    /// Rank, condition, correlations.
    pub identifiability: Identifiability,
    /// Work done, all starting points together.
    pub work: Work,
    /// S, n × n column-major, with (JᵀJ)⁻¹ = S Sᵀ on the tangent space of the active constraints.
    pub(crate) covariance_root: Vec<f64>,
    /// Whether the residual determines the parameter and no active constraint blocks it.
    pub(crate) determined: Vec<bool>,
}

impl Fit {
    /// By how much the optimum moves, to first order, when something adds `gradient` to Jᵀr: −(JᵀJ)⁻¹ `gradient` on the
    /// tangent space of the active constraints.
    pub fn shift_for(&self, gradient: &[f64]) -> Vec<f64> {
        let mut shift = vec![0.0; self.values.len()];
        for root in self.covariance_root.chunks_exact(shift.len().max(1)) {
            add_scaled(&mut shift, -dot(root, gradient), root);
        }
        shift
    }

    /// Residual sum of squares ‖r‖².
    pub fn sum_of_squares(&self) -> f64 {
        2.0 * self.cost
    }

    /// m minus the number of directions that the residual determined.
    pub fn degrees_of_freedom(&self) -> usize {
        self.residual_count
            .saturating_sub(self.identifiability.rank)
    }
}
