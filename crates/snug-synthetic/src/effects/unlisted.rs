//! Laws that no catalogue lists: what is there to be called unlisted.

use super::HiddenEffect;
use super::mechanical::FRICTION_SPEED_M_PER_S;

/// Displacement over which the exponential spring stiffens \[m\].
const STIFFENING_M: f64 = 0.012;
/// Displacement at which the end stop is met \[m\].
const STOP_M: f64 = 0.007;

/// An unlisted law with its numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum UnlistedLaw {
    /// F += d x² v.
    X2vDamping {
        /// d \[N s/m³\].
        d_n_s_per_m3: f64,
    },
    /// F += d x v.
    XvDamping {
        /// d \[N s/m²\].
        d_n_s_per_m2: f64,
    },
    /// F += μ |x| tanh(v/v_s): friction that grows with displacement.
    PositionFriction {
        /// μ \[N/m\].
        mu_n_per_m: f64,
        /// v_s \[m/s\].
        v_s_m_per_s: f64,
    },
    /// F += d v³.
    CubicDamping {
        /// d \[N s³/m³\].
        d_n_s3_per_m3: f64,
    },
    /// F += k5 x⁵.
    QuinticStiffness {
        /// k5 \[N/m⁵\].
        k5_n_per_m5: f64,
    },
    /// F += f0 (e^{x/x0} − 1 − x/x0): tissue that stiffens as it is stretched.
    ExponentialStiffness {
        /// f0 \[N\].
        f0_n: f64,
        /// x0 \[m\].
        x0_m: f64,
    },
    /// F += k_s max(0, x − x_s): the grip meets something that gives way less.
    EndStop {
        /// k_s \[N/m\].
        k_s_n_per_m: f64,
        /// x_s \[m\].
        x_s_m: f64,
    },
}

impl UnlistedLaw {
    /// `effect` at `strength`, if it is an unlisted one.
    pub(super) fn of(effect: HiddenEffect, strength: f64) -> Option<Self> {
        Some(match effect {
            HiddenEffect::X2vDamping => Self::X2vDamping {
                d_n_s_per_m3: 4.4e5 * strength,
            },
            HiddenEffect::XvDamping => Self::XvDamping {
                d_n_s_per_m2: 6000.0 * strength,
            },
            HiddenEffect::PositionFriction => Self::PositionFriction {
                mu_n_per_m: 800.0 * strength,
                v_s_m_per_s: FRICTION_SPEED_M_PER_S,
            },
            HiddenEffect::CubicDamping => Self::CubicDamping {
                d_n_s3_per_m3: 200.0 * strength,
            },
            HiddenEffect::QuinticStiffness => Self::QuinticStiffness {
                k5_n_per_m5: 4.0e9 * strength,
            },
            HiddenEffect::ExponentialStiffness => Self::ExponentialStiffness {
                f0_n: 8.0 * strength,
                x0_m: STIFFENING_M,
            },
            HiddenEffect::EndStop => Self::EndStop {
                k_s_n_per_m: 5000.0 * strength,
                x_s_m: STOP_M,
            },
            _ => return None,
        })
    }

    pub(super) fn values(&self) -> Vec<f64> {
        match *self {
            Self::X2vDamping { d_n_s_per_m3 } => vec![d_n_s_per_m3],
            Self::XvDamping { d_n_s_per_m2 } => vec![d_n_s_per_m2],
            Self::PositionFriction {
                mu_n_per_m,
                v_s_m_per_s,
            } => vec![mu_n_per_m, v_s_m_per_s],
            Self::CubicDamping { d_n_s3_per_m3 } => vec![d_n_s3_per_m3],
            Self::QuinticStiffness { k5_n_per_m5 } => vec![k5_n_per_m5],
            Self::ExponentialStiffness { f0_n, x0_m } => vec![f0_n, x0_m],
            Self::EndStop { k_s_n_per_m, x_s_m } => vec![k_s_n_per_m, x_s_m],
        }
    }

    /// What the law adds to the hand force \[N\].
    pub(crate) fn added_force_n(&self, x: f64, v: f64) -> f64 {
        match *self {
            Self::X2vDamping { d_n_s_per_m3 } => d_n_s_per_m3 * x * x * v,
            Self::XvDamping { d_n_s_per_m2 } => d_n_s_per_m2 * x * v,
            Self::PositionFriction {
                mu_n_per_m,
                v_s_m_per_s,
            } => mu_n_per_m * x.abs() * (v / v_s_m_per_s).tanh(),
            Self::CubicDamping { d_n_s3_per_m3 } => d_n_s3_per_m3 * v * v * v,
            Self::QuinticStiffness { k5_n_per_m5 } => k5_n_per_m5 * x.powi(5),
            Self::ExponentialStiffness { f0_n, x0_m } => {
                let u = x / x0_m;
                f0_n * (u.exp_m1() - u)
            }
            Self::EndStop { k_s_n_per_m, x_s_m } => k_s_n_per_m * (x - x_s_m).max(0.0),
        }
    }
}
