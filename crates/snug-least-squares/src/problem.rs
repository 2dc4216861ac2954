//! What is minimised: residuals, their linearisation, and least squares as the solver sees it.

pub(crate) mod difference_residual;
pub(crate) mod least_squares;
pub(crate) mod linearization;
pub(crate) mod residual;
pub(crate) mod thresholds;
