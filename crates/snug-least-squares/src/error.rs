//! Why a problem cannot be solved, and why a residual has no value.

use thiserror::Error;

/// Why a residual has no value at a point.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum EvaluationError {
    /// A residual, a sensitivity or the cost is infinite or not a number.
    #[error("the residual or its sensitivities are not finite")]
    NotFinite,
    /// The model has no meaning at this value of a parameter.
    #[error("parameter {parameter} = {value} is outside the model's domain")]
    OutsideDomain {
        /// Index of the parameter.
        parameter: usize,
        /// Its value.
        value: f64,
    },
}

/// Why a fit could not even begin.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SolveError {
    /// A vector has the wrong number of entries.
    #[error("{what} has {found} entries, the problem has {expected} parameters")]
    Dimension {
        /// Which vector.
        what: &'static str,
        /// Entries it must have.
        expected: usize,
        /// Entries it has.
        found: usize,
    },
    /// A starting value is infinite or not a number.
    #[error("starting value {value} of parameter {parameter} is not finite")]
    Start {
        /// Index of the parameter.
        parameter: usize,
        /// Its value.
        value: f64,
    },
    /// No starting point was given.
    #[error("no starting point was given")]
    NoStart,
    /// A minimum lies above its maximum.
    #[error("{name}: minimum {minimum} lies above maximum {maximum}")]
    EmptyBounds {
        /// Name of the parameter.
        name: String,
        /// Its minimum.
        minimum: f64,
        /// Its maximum.
        maximum: f64,
    },
    /// No point satisfies all constraints, or the projection onto them failed.
    #[error("no point was found that satisfies the constraints {names:?} together")]
    NoFeasiblePoint {
        /// Names of the constraints.
        names: Vec<String>,
    },
    /// A setting has a value that makes no sense.
    #[error("setting {name} = {value}: {allowed} is allowed")]
    Setting {
        /// Name of the field.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
}
