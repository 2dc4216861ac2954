//! A problem as the solver sees it.

use crate::error::EvaluationError;
use crate::problem::linearization::Linearization;

/// A least-squares problem as the solver sees it: minimise ½‖r(p)‖² over p.
///
/// Implement [`Residual`](crate::Residual) and wrap it in [`DenseResidual`](crate::DenseResidual) for the accurate
/// general case; implement this trait when JᵀJ and Jᵀr can be accumulated in one pass without storing J.
pub trait LeastSquares {
    /// Number n of parameters.
    fn parameter_count(&self) -> usize;

    /// Number m of residuals.
    fn residual_count(&self) -> usize;

    /// ½‖r(p)‖².
    ///
    /// # Errors
    /// [`EvaluationError`] where the cost has no finite value; a trial step there is rejected, a start there fails.
    fn cost(&mut self, parameters: &[f64]) -> Result<f64, EvaluationError>;

    /// Fills `linearization` with cost, gradient and curvature at p.
    ///
    /// # Errors
    /// As [`LeastSquares::cost`].
    fn linearize(
        &mut self,
        parameters: &[f64],
        linearization: &mut Linearization,
    ) -> Result<(), EvaluationError>;

    /// Writes Jᵀ r″ at p into `second_derivative` (n), where r″ = d²r(p + t v)/dt² at t = 0 along the `direction` v.
    ///
    /// Fits that turn out hard follow curved valleys with it (geodesic acceleration, Transtrum & Sethna,
    /// arXiv:1201.5885). Optional: `Ok(false)`, the default, means it is not known, and the solver does without.
    ///
    /// # Errors
    /// [`EvaluationError`] where the residual has no finite value nearby in that direction.
    fn second_derivative(
        &mut self,
        _parameters: &[f64],
        _direction: &[f64],
        _bending: &mut [f64],
    ) -> Result<bool, EvaluationError> {
        Ok(false)
    }
}
