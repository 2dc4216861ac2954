//! Passive mechanics. x = l θ, v = l ω at the grip; a positive force acts as −l F on the tool.

use super::HiddenEffect;

/// Speed over which dry friction changes sign \[m/s\].
pub(crate) const FRICTION_SPEED_M_PER_S: f64 = 0.01;

/// A mechanical effect with its numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MechanicalLaw {
    /// F += k3 x³.
    CubicStiffness {
        /// k3 \[N/m³\].
        k3_n_per_m3: f64,
    },
    /// F += k2 x².
    QuadraticStiffness {
        /// k2 \[N/m²\].
        k2_n_per_m2: f64,
    },
    /// F += Fc tanh(v/v_s).
    CoulombFriction {
        /// Fc \[N\].
        fc_n: f64,
        /// v_s \[m/s\].
        v_s_m_per_s: f64,
    },
    /// F += c2 v |v|.
    QuadraticDamping {
        /// c2 \[N s²/m²\].
        c2_n_s2_per_m2: f64,
    },
    /// F += c_r v where v < 0.
    DirectionalDamping {
        /// c_r \[kg/s\].
        c_rebound_kg_per_s: f64,
    },
    /// Spring and damper act only where |x| > g, the spring on x ∓ g.
    Backlash {
        /// g \[m\].
        gap_m: f64,
    },
    /// F += f, f' = k_m v − f/τ.
    MaxwellBranch {
        /// k_m \[N/m\].
        k_m_n_per_m: f64,
        /// τ \[s\].
        tau_s: f64,
    },
    /// F = k (x − x2) + c (v − v2), m2 x2'' = F − k2 x2 − c2 v2.
    SecondMass {
        /// m2 \[kg\].
        m2_kg: f64,
        /// k2 \[N/m\].
        k2_n_per_m: f64,
        /// c2 \[kg/s\].
        c2_kg_per_s: f64,
    },
    /// F becomes F_max tanh(F/F_max).
    GripSlip {
        /// F_max \[N\].
        f_max_n: f64,
    },
    /// F += k_h z, z' = v (1 − (½ sgn(v z) + ½) |z|/z_max).
    BoucWen {
        /// k_h \[N/m\].
        k_h_n_per_m: f64,
        /// z_max \[m\].
        z_max_m: f64,
    },
}

impl MechanicalLaw {
    /// `effect` at `strength`, if it is a mechanical one.
    pub(super) fn of(effect: HiddenEffect, strength: f64) -> Option<Self> {
        Some(match effect {
            HiddenEffect::CubicStiffness => Self::CubicStiffness {
                k3_n_per_m3: 3.3e6 * strength,
            },
            HiddenEffect::QuadraticStiffness => Self::QuadraticStiffness {
                k2_n_per_m2: 6.0e4 * strength,
            },
            HiddenEffect::CoulombFriction => Self::CoulombFriction {
                fc_n: 8.0 * strength,
                v_s_m_per_s: FRICTION_SPEED_M_PER_S,
            },
            HiddenEffect::QuadraticDamping => Self::QuadraticDamping {
                c2_n_s2_per_m2: 150.0 * strength,
            },
            HiddenEffect::DirectionalDamping => Self::DirectionalDamping {
                c_rebound_kg_per_s: 80.0 * strength,
            },
            HiddenEffect::Backlash => Self::Backlash {
                gap_m: 0.003 * strength,
            },
            HiddenEffect::MaxwellBranch => Self::MaxwellBranch {
                k_m_n_per_m: 3000.0 * strength,
                tau_s: 0.03,
            },
            // Weak means a heavy support that hardly gives: stiffness and damping grow as the strength falls.
            HiddenEffect::SecondMass => Self::SecondMass {
                m2_kg: 1.5,
                k2_n_per_m: 8000.0 / strength,
                c2_kg_per_s: 60.0 / strength,
            },
            // What saturation takes grows as 1/F_max², so this is linear in the strength.
            HiddenEffect::GripSlip => Self::GripSlip {
                f_max_n: 80.0 / strength.sqrt(),
            },
            HiddenEffect::BoucWen => Self::BoucWen {
                k_h_n_per_m: 4000.0 * strength,
                z_max_m: 0.0025,
            },
            _ => return None,
        })
    }

    pub(super) fn values(&self) -> Vec<f64> {
        match *self {
            Self::CubicStiffness { k3_n_per_m3 } => vec![k3_n_per_m3],
            Self::QuadraticStiffness { k2_n_per_m2 } => vec![k2_n_per_m2],
            Self::CoulombFriction { fc_n, v_s_m_per_s } => vec![fc_n, v_s_m_per_s],
            Self::QuadraticDamping { c2_n_s2_per_m2 } => vec![c2_n_s2_per_m2],
            Self::DirectionalDamping { c_rebound_kg_per_s } => vec![c_rebound_kg_per_s],
            Self::Backlash { gap_m } => vec![gap_m],
            Self::MaxwellBranch { k_m_n_per_m, tau_s } => vec![k_m_n_per_m, tau_s],
            Self::SecondMass {
                m2_kg,
                k2_n_per_m,
                c2_kg_per_s,
            } => vec![m2_kg, k2_n_per_m, c2_kg_per_s],
            Self::GripSlip { f_max_n } => vec![f_max_n],
            Self::BoucWen {
                k_h_n_per_m,
                z_max_m,
            } => vec![k_h_n_per_m, z_max_m],
        }
    }

    /// What the law adds to the hand force \[N\]; `branch` is the law's own state (f or z).
    pub(crate) fn added_force_n(&self, x_m: f64, v_m_per_s: f64, branch: f64) -> f64 {
        match *self {
            Self::CubicStiffness { k3_n_per_m3 } => k3_n_per_m3 * x_m * x_m * x_m,
            Self::QuadraticStiffness { k2_n_per_m2 } => k2_n_per_m2 * x_m * x_m,
            Self::CoulombFriction {
                fc_n,
                v_s_m_per_s: v_s,
            } => fc_n * (v_m_per_s / v_s).tanh(),
            Self::QuadraticDamping { c2_n_s2_per_m2 } => {
                c2_n_s2_per_m2 * v_m_per_s * v_m_per_s.abs()
            }
            Self::DirectionalDamping { c_rebound_kg_per_s } => {
                c_rebound_kg_per_s * v_m_per_s.min(0.0)
            }
            Self::MaxwellBranch { .. } => branch,
            Self::BoucWen { k_h_n_per_m, .. } => k_h_n_per_m * branch,
            Self::Backlash { .. } | Self::SecondMass { .. } | Self::GripSlip { .. } => 0.0,
        }
    }

    /// Rate of the law's own state: f' \[N/s\] or z' \[m/s\].
    pub(crate) fn branch_rate(&self, v_m_per_s: f64, branch: f64) -> f64 {
        match *self {
            Self::MaxwellBranch { k_m_n_per_m, tau_s } => k_m_n_per_m * v_m_per_s - branch / tau_s,
            Self::BoucWen { z_max_m, .. } => {
                let loading = if v_m_per_s * branch > 0.0 { 1.0 } else { 0.0 };
                v_m_per_s * (1.0 - loading * branch.abs() / z_max_m)
            }
            _ => 0.0,
        }
    }
}
