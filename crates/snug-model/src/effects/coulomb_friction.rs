//! Dry friction in grip and joint: +F = F_c tanh(v / v_s) with v_s = 0.01 m/s.
//!
//! Excited by any motion; relatively strongest in weak pulses. Its residual follows sign(v): a step at every reversal.
//! Source: Coulomb friction, smoothed as usual in identification so that it is differentiable.

use crate::numeric::number::Number;
use crate::effect::{Description, Instant, Kind, Law, ParameterSpec, Scope};

/// v_s, the velocity over which the friction turns \[m/s\].
const SMOOTHING_M_PER_S: f64 = 0.01;

pub struct CoulombFriction;

impl Law for CoulombFriction {
    fn description(&self) -> &'static Description {
        &Description {
            name: "coulomb_friction",
            kind: Kind::Mechanical,
            summary: "Dry friction holds against every motion with a constant force.",
            equation: "F + Fc tanh(v / 0.01 m/s)",
            parameters: &[ParameterSpec {
                name: "fc_n",
                meaning: "friction force",
                unit: "N",
                starts: &[1.0],
                minimum: 0.0,
                maximum: 30.0,
                limits: (0.0, 300.0),
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["quadratic_damping"],
            excited_by: "any motion; relatively strongest in weak pulses",
            shows_as: "misfit that follows the sign of the velocity, with a step at every reversal",
            check: "Move the handle slowly by hand with the tool off and feel or measure whether it needs a small force to move at all: look for rubbing sleeves, cables, hoses and the suspension.",
            source: "Coulomb friction, smoothed",
        }
    }

    #[inline(always)]
    fn force<N: Number>(&self, p: &[N], at: &Instant<N>, _own: &[N]) -> Option<N> {
        Some(p[0] * (at.v_m_per_s * (1.0 / SMOOTHING_M_PER_S)).tanh())
    }
}
