//! The way back is damped differently: +F = c_r v where v < 0 (rebound), nothing where v ≥ 0.
//!
//! Parameter: c_rebound_kg_per_s \[kg/s\], −200 to 300; passive as long as c + c_r ≥ 0. Excited by the rebound after the
//! peak. In the residual nothing shows until the peak, then a misfit in proportion to the velocity.
//! Source: muscle resists lengthening and shortening differently (Hill's force–velocity relation).

use crate::numeric::number::Number;
use crate::numeric::real::Real;
use crate::effect::{Description, Instant, Kind, Law, ParameterSpec, Scope};

pub struct DirectionalDamping;

impl Law for DirectionalDamping {
    fn description(&self) -> &'static Description {
        &Description {
            name: "directional_damping",
            kind: Kind::Mechanical,
            summary: "The hand damps the way back differently from the way out.",
            equation: "F + c_r v where v < 0",
            parameters: &[ParameterSpec {
                name: "c_rebound_kg_per_s",
                meaning: "extra damping of the rebound",
                unit: "kg/s",
                starts: &[0.0],
                minimum: -200.0,
                maximum: 300.0,
                limits: (-500.0, 3000.0),
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["quadratic_stiffness"],
            excited_by: "the rebound after the peak: a window that goes on long enough",
            shows_as: "misfit that starts at the peak displacement and follows the velocity on the way back only",
            check: "Watch the handle come back after shut-off, on a film or in the recorded velocity: the hand brakes the return differently from the push.",
            source: "Hill, force-velocity relation of muscle",
        }
    }

    #[inline(always)]
    fn force<N: Number>(&self, p: &[N], at: &Instant<N>, _own: &[N]) -> Option<N> {
        let v = at.v_m_per_s;
        let back = (-v).value().is_positive();
        Some(N::select(back, p[0] * v, v.constant(0.0)))
    }
}
