//! Muscles and nerves. Times count from the torque's onset.

use super::HiddenEffect;
use crate::pulse::smooth_step;

/// A muscular effect with its numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MuscularLaw {
    /// F += k_r x(t − τ).
    StretchReflex {
        /// k_r \[N/m\].
        k_r_n_per_m: f64,
        /// τ \[s\].
        tau_s: f64,
    },
    /// F += F_v s((t − t_on)/t_rise).
    VoluntaryPush {
        /// F_v \[N\].
        f_n: f64,
        /// t_on \[s\].
        onset_s: f64,
        /// t_rise \[s\].
        rise_s: f64,
    },
    /// k becomes k (1 + r s((t − t_on)/t_rise)).
    CoContraction {
        /// r.
        rise_ratio: f64,
        /// t_on \[s\].
        onset_s: f64,
        /// t_rise \[s\].
        rise_s: f64,
    },
    /// k becomes k (1 + κ |T|).
    TorqueDependentStiffness {
        /// κ \[1/Nm\].
        kappa_per_nm: f64,
    },
}

impl MuscularLaw {
    /// `effect` at `strength`, if it is a muscular one.
    pub(super) fn of(effect: HiddenEffect, strength: f64) -> Option<Self> {
        Some(match effect {
            HiddenEffect::StretchReflex => Self::StretchReflex {
                k_r_n_per_m: 800.0 * strength,
                tau_s: 0.06,
            },
            HiddenEffect::VoluntaryPush => Self::VoluntaryPush {
                f_n: 15.0 * strength,
                onset_s: 0.08,
                rise_s: 0.05,
            },
            HiddenEffect::CoContraction => Self::CoContraction {
                rise_ratio: 0.8 * strength,
                onset_s: 0.07,
                rise_s: 0.06,
            },
            HiddenEffect::TorqueDependentStiffness => Self::TorqueDependentStiffness {
                kappa_per_nm: 0.03 * strength,
            },
            _ => return None,
        })
    }

    pub(super) fn values(&self) -> Vec<f64> {
        match *self {
            Self::StretchReflex { k_r_n_per_m, tau_s } => vec![k_r_n_per_m, tau_s],
            Self::VoluntaryPush {
                f_n,
                onset_s,
                rise_s,
            } => vec![f_n, onset_s, rise_s],
            Self::CoContraction {
                rise_ratio,
                onset_s,
                rise_s,
            } => vec![rise_ratio, onset_s, rise_s],
            Self::TorqueDependentStiffness { kappa_per_nm } => vec![kappa_per_nm],
        }
    }

    /// What the law adds to the hand force \[N\]; `past_x_m` gives x a delay ago.
    pub(crate) fn added_force_n(&self, since_onset_s: f64, past_x_m: impl Fn(f64) -> f64) -> f64 {
        match *self {
            Self::StretchReflex { k_r_n_per_m, tau_s } => k_r_n_per_m * past_x_m(tau_s),
            Self::VoluntaryPush {
                f_n,
                onset_s,
                rise_s,
            } => f_n * smooth_step((since_onset_s - onset_s) / rise_s),
            Self::CoContraction { .. } | Self::TorqueDependentStiffness { .. } => 0.0,
        }
    }

    /// By how much of itself the base stiffness grows.
    pub(crate) fn stiffness_growth_ratio(&self, since_onset_s: f64, torque_nm: f64) -> f64 {
        match *self {
            Self::CoContraction {
                rise_ratio,
                onset_s,
                rise_s,
            } => rise_ratio * smooth_step((since_onset_s - onset_s) / rise_s),
            Self::TorqueDependentStiffness { kappa_per_nm } => kappa_per_nm * torque_nm.abs(),
            Self::StretchReflex { .. } | Self::VoluntaryPush { .. } => 0.0,
        }
    }

    /// Where a derivative of the law's time course jumps, after the onset \[s\].
    pub(crate) fn knots_s(&self) -> Option<[f64; 2]> {
        match *self {
            Self::VoluntaryPush {
                onset_s, rise_s, ..
            }
            | Self::CoContraction {
                onset_s, rise_s, ..
            } => Some([onset_s, onset_s + rise_s]),
            _ => None,
        }
    }
}
