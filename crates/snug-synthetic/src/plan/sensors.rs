//! Settings of the simulated sensors; what they do to the signals is `sensing.rs`.

use crate::random::noise::NoiseKind;
use serde::{Deserialize, Serialize};

/// From when on a constant sensor error (acceleration bias, torque offset) is there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum ZeroErrors {
    /// All the time: the quiet part shows it.
    #[default]
    WholeRecording,
    /// From the window's start on: the quiet part knows nothing of it.
    WindowOnly,
}

/// What the sensors add to the truth.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Sensors {
    /// Correlation of the acceleration's noise; default white. Torque and force noise are always white.
    pub noise: NoiseKind,
    /// Standard deviation of the acceleration's noise \[rad/s²\]; default 0.5.
    pub acceleration_noise_rad_per_s2: f64,
    /// Standard deviation of the torque's noise \[Nm\]; default 0.02.
    pub torque_noise_nm: f64,
    /// Standard deviation of the grip force's noise \[N\]; default 0.5.
    pub force_noise_n: f64,
    /// Nuisance: standard deviation of a constant acceleration bias per tightening \[rad/s²\]; default 0.
    pub bias_sd_rad_per_s2: f64,
    /// Nuisance: amplitude of the motor's vibration in the acceleration while torque acts \[rad/s²\]; default 0.
    pub vibration_rad_per_s2: f64,
    /// Whether samples are rounded as a converter does, to 2⁻⁵ rad/s², 2⁻⁸ Nm and 2⁻⁴ N; default no.
    pub quantised: bool,
    /// From when on constant sensor errors are there; default the whole recording.
    pub zero_errors: ZeroErrors,
}

impl Default for Sensors {
    fn default() -> Self {
        Self {
            noise: NoiseKind::White,
            acceleration_noise_rad_per_s2: 0.5,
            torque_noise_nm: 0.02,
            force_noise_n: 0.5,
            bias_sd_rad_per_s2: 0.0,
            vibration_rad_per_s2: 0.0,
            quantised: false,
            zero_errors: ZeroErrors::WholeRecording,
        }
    }
}
