//! Why a tightening cannot be identified.

use snug_campaign::Quantity;
use snug_least_squares::SolveError;
use thiserror::Error;

/// Why an identification could not even begin.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum IdentifyError {
    /// The tightening does not hold the quantity to be fitted.
    #[error("the recording holds no {quantity:?}, which is the fitted output")]
    MissingOutput {
        /// The fitted quantity.
        quantity: Quantity,
    },
    /// Fewer samples are scored than parameters are free.
    #[error(
        "{residuals} scored samples (after unscored_samples) cannot determine {parameters} parameters"
    )]
    TooShort {
        /// Scored samples.
        residuals: usize,
        /// Free parameters.
        parameters: usize,
    },
    /// The solver refuses the problem.
    #[error(transparent)]
    Solve(#[from] SolveError),
}
