//! The way back is damped differently: +F = c_r v where v < 0 (rebound), nothing where v ≥ 0.
//!
//! c_r > 0 brakes the rebound more than the way out. Excited by the rebound after the peak. In the residual nothing shows
//! until the peak, then a misfit in proportion to the velocity.
//!
//! Valid for: pulses that push to positive x, so that v < 0 is the way back; passive as long as c + c_r ≥ 0. It follows v
//! at once: no time scale, any rig.
//!
//! Source: muscle resists lengthening and shortening differently (Hill's force–velocity relation).

use crate::description::{ActsOn, Description, Kind, ParameterSpec, Scope, state};
use crate::law::{Instant, Law};
use crate::numeric::lanewise::Lanewise;
use crate::numeric::number::Number;

state! {
    summary: "The hand damps the way back differently from the way out.",
    equation: "F + c_r v where v < 0",
}

pub(super) struct DirectionalDamping;

impl Law for DirectionalDamping {
    fn description(&self) -> &'static Description {
        &Description {
            name: "directional_damping",
            kind: Kind::Mechanical,
            acts_on: ActsOn::Hands,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[ParameterSpec {
                name: "c_rebound_kg_per_s",
                meaning: "extra damping of the rebound",
                unit: "kg/s",
                starts: &[0.0],
                minimum: -200.0,
                maximum: 300.0,
                limits: (-500.0, 3000.0),
                vanishes_at: Some(0.0),
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["quadratic_stiffness"],
            excited_by: "the rebound after the peak: a window that goes on long enough",
            shows_as: "misfit that starts at the peak displacement and follows the velocity on the way back only",
            check: "Watch the handle come back after shut-off, on a film or in the recorded velocity: the hand brakes the return differently from the push.",
            on_machine: None,
            valid_for: "pulses that push to positive x, with c + c_r >= 0; it has no time scale",
            source: "Hill 1938, The heat of shortening and the dynamic constants of muscle, Proceedings of the Royal Society B 126",
        }
    }

    #[inline(always)]
    fn force<N: Number>(&self, p: &[N], at: &Instant<N>, _own: &[N]) -> Option<N> {
        let v = at.v_m_per_s;
        let back = (-v).value().is_positive();
        Some(N::select(back, p[0] * v, v.constant(0.0)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Effect;
    use crate::effects::trial;
    use crate::effects::trial::Trial;

    #[test]
    fn brakes_the_way_back_only() {
        for (c_r, v_m_per_s, expected_n) in
            [(40.0, 0.5, 0.0), (40.0, -0.5, -20.0), (0.0, -0.5, 0.0)]
        {
            let found_n = trial::force(&DirectionalDamping, &[c_r], 0.0, v_m_per_s);
            trial::assert_near(found_n, expected_n);
        }
    }

    /// Its rates have a kink where the velocity changes its sign, in the middle of a step.
    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::DirectionalDamping, 5e-8);
    }
}
