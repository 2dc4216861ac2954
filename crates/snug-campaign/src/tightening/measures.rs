//! How model and measurement of one tightening agree.

use serde::{Deserialize, Serialize};

/// Everything that is reported about how model and measurement agree. `None` where it does not apply.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct FitMeasures {
    /// 100 (1 − ‖y − ŷ‖ / ‖y − ȳ‖) of the displacement.
    pub fit_percent: Option<f64>,
    /// The same of the fitted output.
    pub fit_percent_fitted_output: Option<f64>,
    /// Root mean square of the whitened residual: 1 = nothing left but noise.
    pub error_over_noise: Option<f64>,
    /// Root-mean-square residual of the displacement \[rad\].
    pub rms_displacement_rad: Option<f64>,
    /// 100 (1 − mean|e| / mean|y|) of the explicit Euler displacement.
    pub euler_accuracy_percent: Option<f64>,
    /// √(k/m) / 2π of the hand–arm \[Hz\].
    pub natural_frequency_hz: Option<f64>,
    /// Lower end of its 95 % interval \[Hz\].
    pub natural_frequency_low_hz: Option<f64>,
    /// Upper end of its 95 % interval \[Hz\].
    pub natural_frequency_high_hz: Option<f64>,
    /// Damped frequency of tool and hand–arm together \[Hz\]; `None` when overdamped.
    pub damped_frequency_hz: Option<f64>,
    /// Lower end of its 95 % interval \[Hz\].
    pub damped_frequency_low_hz: Option<f64>,
    /// Upper end of its 95 % interval \[Hz\].
    pub damped_frequency_high_hz: Option<f64>,
    /// ζ of tool and hand–arm together: c l² / (2 √(k l² (I_n + m l²))).
    pub damping_ratio: Option<f64>,
    /// Lower end of its 95 % interval.
    pub damping_ratio_low: Option<f64>,
    /// Upper end of its 95 % interval.
    pub damping_ratio_high: Option<f64>,
    /// ζ as the thesis checks it, with the tool's mass: c / (2 √(k (m + m_n))).
    pub thesis_damping_ratio: Option<f64>,
    /// max |F1| \[N\].
    pub peak_force_f1_n: Option<f64>,
    /// max |F2| \[N\].
    pub peak_force_f2_n: Option<f64>,
    /// max |F3| \[N\].
    pub peak_force_f3_n: Option<f64>,
    /// max |F_op_J| \[N\].
    pub peak_grip_force_n: Option<f64>,
}
