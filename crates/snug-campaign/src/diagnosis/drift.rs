//! Dependence of m, c and k on what they should not depend on.

use crate::identification::interval::Interval;
use serde::{Deserialize, Serialize};

/// Dependence of one fitted parameter on something it should not depend on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Drift {
    /// `mass_kg`, `damping_kg_per_s` or `stiffness_n_per_m`.
    pub parameter: String,
    /// `peak_angle_rad`, `target_torque_nm`, `pulse_length_s`, `trial_number`, `peak_velocity_rad_per_s`.
    pub against: String,
    /// Relative change of the parameter over the range seen \[%\], within participants.
    pub change_percent: f64,
    /// 95 % interval of that change \[%\].
    pub interval_percent: Option<Interval>,
    /// p of the slope, within participants.
    pub p: Option<f64>,
    /// p adjusted over all drifts (Benjamini and Hochberg).
    pub p_adjusted: Option<f64>,
}
