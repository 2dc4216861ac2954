//! The error of a fit, its parameters accounted for.

/// √(Σ r² / (n − p)) of n weighted residuals to which p parameters were fitted; one residual at least counts.
pub(crate) fn error_beyond(squares: f64, residuals: usize, parameters: usize) -> f64 {
    let spare = residuals - parameters.min(residuals.saturating_sub(1));
    (squares / spare as f64).sqrt()
}
