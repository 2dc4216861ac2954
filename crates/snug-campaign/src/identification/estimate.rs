//! Identified values and what to check before believing them: intervals, how the fit ended, constraints, rank.

use crate::identification::interval::Interval;
use serde::{Deserialize, Serialize};

/// How an identification ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FitStatus {
    /// A local optimum strictly inside all constraints.
    Converged,
    /// A constrained optimum: at least one constraint is active (named in `Estimate::active_constraints`).
    ConvergedAtConstraint,
    /// The iteration limit came first; values are the best seen.
    IterationLimit,
    /// No further decrease was possible before the optimality test held; values are the best seen.
    Stalled,
    /// The data do not determine all free parameters (rank-deficient sensitivities).
    NotIdentifiable,
    /// The residual could not be evaluated (not finite) at the start.
    Failed,
}

/// One identified (or fixed) parameter; numbers in its unit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ParameterEstimate {
    /// Name with unit suffix.
    pub name: String,
    /// Unit as people write it.
    pub unit: String,
    /// Estimated or fixed value.
    pub value: f64,
    /// Standard error; `None` on an active bound, or when fixed at a value known exactly.
    pub standard_error: Option<f64>,
    /// 95 % interval; `None` on an active bound, or when fixed at a value known exactly.
    pub interval: Option<Interval>,
    /// Whether it was held fixed.
    pub fixed: bool,
}

/// How well the data determine the parameters together.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Identifiability {
    /// Numerical rank of the column-scaled sensitivities.
    pub rank: usize,
    /// Number of free parameters.
    pub free: usize,
    /// Condition number of the column-scaled sensitivities; no unit.
    pub condition: f64,
    /// The most correlated pair of free parameters and its correlation.
    pub strongest_correlation: Option<(String, String, f64)>,
}

/// The outcome of one identification.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// Every parameter of the model, in the model's order.
    pub parameters: Vec<ParameterEstimate>,
    /// Covariance of the free parameters, row-major, free × free, in the model's order; each entry in the product of
    /// its two parameters' units.
    pub covariance: Vec<f64>,
    /// How it ended.
    pub status: FitStatus,
    /// Names of the constraints active at the optimum.
    pub active_constraints: Vec<String>,
    /// Rank, condition and correlation.
    pub identifiability: Identifiability,
    /// Gauss–Newton iterations.
    pub iterations: usize,
    /// Evaluations of the residual, with or without sensitivities.
    pub evaluations: usize,
    /// Conic programs solved.
    pub conic_solves: usize,
}

impl Estimate {
    /// The value of the parameter called `name`, in its unit.
    pub fn value(&self, name: &str) -> Option<f64> {
        self.parameter(name).map(|parameter| parameter.value)
    }

    /// The parameter called `name`.
    pub fn parameter(&self, name: &str) -> Option<&ParameterEstimate> {
        self.parameters
            .iter()
            .find(|parameter| parameter.name == name)
    }
}
