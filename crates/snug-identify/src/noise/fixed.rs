//! What is not known exactly of the fixed parameters, passed on to those that were identified beside them.

use crate::residual::tightening::TighteningResidual;
use snug_least_squares::matrix::dot;
use snug_least_squares::{Covariance, Fit, Residual};

impl TighteningResidual<'_> {
    /// Widens the covariance of `fit` by the standard errors σ_j of the fixed parameters, to first order:
    ///
    /// ```text
    /// C + Σ_j σ_j² g_j g_jᵀ,   g_j = −(JᵀJ)⁻¹ Jᵀ z_j,   z_j = ∂r/∂p_j (weighted as r)
    /// ```
    ///
    /// g_j is by how much the optimum moves with p_j. The fixed values count as found independently of this
    /// tightening's noise; where constraints are active, g_j stays on their tangent space.
    pub(crate) fn widen_by_fixed(&mut self, fit: &Fit, covariance: &mut Covariance) {
        let uncertain = self.uncertain();
        if uncertain.is_empty() {
            return;
        }
        let (m, n) = (self.residual_count(), self.parameter_count());
        let (mut residual, mut jacobian) = (vec![0.0; m], vec![0.0; m * n]);
        if self
            .evaluate(&fit.values, &mut residual, Some(&mut jacobian))
            .is_err()
        {
            return;
        }
        for (parameter, standard_error) in uncertain {
            let column = self.column_of(parameter);
            let gradient: Vec<f64> = jacobian
                .chunks_exact(m.max(1))
                .map(|free| dot(free, &column))
                .collect();
            let moved = fit.shift_for(&gradient);
            covariance.widen(&moved, standard_error);
        }
    }
}
