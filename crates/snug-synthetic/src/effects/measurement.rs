//! Sensors, their timing, and what stands wrong in the rig's description.

use super::HiddenEffect;
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// A measurement effect with its numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MeasurementLaw {
    /// The torque sensor reads T0 too much.
    TorqueOffset {
        /// T0 \[Nm\].
        offset_nm: f64,
    },
    /// The torque that acts at t was logged at t − d.
    TorqueDelay {
        /// d \[s\].
        delay_s: f64,
    },
    /// The logged torque y follows the acting torque: τ y' = T − y.
    TorqueLag {
        /// τ \[s\].
        tau_s: f64,
    },
    /// The measured acceleration y follows the true one: τ y' = α − y.
    AccelerationLag {
        /// τ \[s\].
        tau_s: f64,
    },
    /// a + b; each tightening has its own.
    AccelerationBias {
        /// b \[rad/s²\].
        bias_rad_per_s2: f64,
    },
    /// The tool already moves at the window's start; each tightening has its own.
    InitialMotion {
        /// θ0 \[rad\].
        theta0_rad: f64,
        /// ω0 \[rad/s\].
        omega0_rad_per_s: f64,
    },
    /// a + y0 from the window's start on: unlike a bias, the quiet part does not show it.
    OutputOffset {
        /// y0 \[rad/s²\].
        y0_rad_per_s2: f64,
    },
    /// a + ε ω².
    CentripetalCrosstalk {
        /// ε.
        epsilon: f64,
    },
    /// a + γ sin θ.
    GravityLeakage {
        /// γ \[rad/s²\].
        gamma_rad_per_s2: f64,
    },
    /// (1 + g) T is logged.
    TorqueGain {
        /// g.
        gain_error: f64,
    },
    /// The true lever arm is l (1 + e).
    LeverArmError {
        /// e.
        error_ratio: f64,
    },
}

impl MeasurementLaw {
    /// `effect` at `strength`, if it is a measurement one.
    pub(super) fn of(effect: HiddenEffect, strength: f64, rng: &mut ChaCha8Rng) -> Option<Self> {
        Some(match effect {
            HiddenEffect::TorqueOffset => Self::TorqueOffset {
                offset_nm: strength,
            },
            HiddenEffect::TorqueDelay => Self::TorqueDelay {
                delay_s: 0.004 * strength,
            },
            HiddenEffect::TorqueLag => Self::TorqueLag {
                tau_s: 0.006 * strength,
            },
            HiddenEffect::AccelerationLag => Self::AccelerationLag {
                tau_s: 0.006 * strength,
            },
            HiddenEffect::AccelerationBias => Self::AccelerationBias {
                bias_rad_per_s2: 0.3 * strength * signed(rng),
            },
            HiddenEffect::InitialMotion => Self::InitialMotion {
                theta0_rad: 0.004 * strength * signed(rng),
                omega0_rad_per_s: 0.15 * strength * signed(rng),
            },
            HiddenEffect::OutputOffset => Self::OutputOffset {
                y0_rad_per_s2: 0.5 * strength * signed(rng),
            },
            HiddenEffect::CentripetalCrosstalk => Self::CentripetalCrosstalk {
                epsilon: 0.8 * strength,
            },
            HiddenEffect::GravityLeakage => Self::GravityLeakage {
                gamma_rad_per_s2: 20.0 * strength,
            },
            HiddenEffect::TorqueGain => Self::TorqueGain {
                gain_error: 0.1 * strength,
            },
            HiddenEffect::LeverArmError => Self::LeverArmError {
                error_ratio: 0.05 * strength,
            },
            _ => return None,
        })
    }

    pub(super) fn values(&self) -> Vec<f64> {
        match *self {
            Self::TorqueOffset { offset_nm } => vec![offset_nm],
            Self::TorqueDelay { delay_s } => vec![delay_s],
            Self::TorqueLag { tau_s } | Self::AccelerationLag { tau_s } => vec![tau_s],
            Self::AccelerationBias { bias_rad_per_s2 } => vec![bias_rad_per_s2],
            Self::InitialMotion {
                theta0_rad,
                omega0_rad_per_s,
            } => vec![theta0_rad, omega0_rad_per_s],
            Self::OutputOffset { y0_rad_per_s2 } => vec![y0_rad_per_s2],
            Self::CentripetalCrosstalk { epsilon } => vec![epsilon],
            Self::GravityLeakage { gamma_rad_per_s2 } => vec![gamma_rad_per_s2],
            Self::TorqueGain { gain_error } => vec![gain_error],
            Self::LeverArmError { error_ratio } => vec![error_ratio],
        }
    }
}

/// About 1 in size with a spread of 0.2, either sign.
fn signed(rng: &mut ChaCha8Rng) -> f64 {
    let sign = if rng.random_bool(0.5) { 1.0 } else { -1.0 };
    let standard: f64 = StandardNormal.sample(rng);
    sign * (1.0 + 0.2 * standard)
}
