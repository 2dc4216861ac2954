//! Hysteresis of skin and soft tissue: +F = k_h z, where z follows x until it saturates at ±z_max.
//!
//! ```text
//! z' = v (1 − (½ sgn(v z) + ½) |z| / z_max)
//! ```
//!
//! F has the sign of the base model; k_h = 0 is the base model. Stiff for small motion, a constant force k_h z_max for large.
//! Excited by reversals. In the residual a step at every reversal that builds up over z_max.
//!
//! Valid for: travel from about z_max on; for less it is a spring k_h and k takes it over. The loop does not depend on how
//! fast it is passed through.
//!
//! Source: Bouc (1967) and Wen (1976) with n = 1, β = γ.

use crate::description::{ActsOn, Description, Kind, OnMachine, ParameterSpec, Scope, state};
use crate::law::{Instant, Law};
use crate::numeric::lanewise::Lanewise;
use crate::numeric::number::Number;

state! {
    summary: "Soft tissue sticks first and then gives way at a constant force, with a loop at every reversal.",
    equation: "F + k_h z,  dz/dt = v (1 - (sgn(v z)/2 + 1/2) abs(z) / z_max)",
}

pub(super) struct BoucWen;

impl Law for BoucWen {
    fn description(&self) -> &'static Description {
        &Description {
            name: "bouc_wen",
            kind: Kind::Mechanical,
            acts_on: ActsOn::Anything,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[
                ParameterSpec {
                    name: "k_h_n_per_m",
                    meaning: "stiffness that lets go",
                    unit: "N/m",
                    starts: &[200.0],
                    minimum: 0.0,
                    maximum: 2e4,
                    limits: (0.0, 2e5),
                    vanishes_at: Some(0.0),
                    scope: Scope::Shared,
                },
                ParameterSpec {
                    name: "z_max_m",
                    meaning: "travel until it lets go",
                    unit: "m",
                    starts: &[0.0025, 0.0008, 0.008],
                    minimum: 1e-4,
                    maximum: 0.02,
                    limits: (1e-4, 0.05),
                    vanishes_at: None,
                    scope: Scope::Shared,
                },
            ],
            states: &["hysteresis_m"],
            twins: &["maxwell_branch", "coulomb_friction"],
            excited_by: "reversals: a window that goes on long enough",
            shows_as: "misfit that steps at every reversal and builds up over a short way",
            check: "Repeat with a bare hand and with a thick glove: soft tissue and padding give way and leave a loop at every reversal.",
            on_machine: Some(OnMachine {
                summary: Some(
                    "Something sticks first and then gives way at a constant force, with a loop at every reversal.",
                ),
                shows_as: None,
                check: "Push slowly to and fro over a short way with the power off and draw force over way: what gives way leaves a loop at every reversal (cables, seals, belts, rubber).",
            }),
            valid_for: "travel from about z_max on, for less it is a spring k_h; the loop does not depend on speed",
            source: "Bouc 1967, Forced vibration of mechanical systems with hysteresis, 4th Conference on Nonlinear Oscillations, Prague; Wen 1976, Method for random vibration of hysteretic systems, Journal of the Engineering Mechanics Division ASCE 102",
        }
    }

    #[inline(always)]
    fn force<N: Number>(&self, p: &[N], _at: &Instant<N>, own: &[N]) -> Option<N> {
        Some(p[0] * own[0])
    }

    #[inline(always)]
    fn rates<N: Number>(
        &self,
        p: &[N],
        at: &Instant<N>,
        own: &[N],
        _hand_n: N,
        rates: &mut [N],
    ) -> Option<()> {
        let (v, z) = (at.v_m_per_s, own[0]);
        let building_up = (v.value() * z.value()).is_positive();
        rates[0] = N::select(building_up, v - v * z.abs() / p[1], v);
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Effect;
    use crate::effects::trial;
    use crate::effects::trial::Trial;

    #[test]
    fn gives_way_at_its_travel_and_sticks_at_once_on_the_way_back() {
        let p = [2000.0, 0.0025];
        for (v_m_per_s, z_m, expected) in
            [(0.1, 0.0, 0.1), (0.1, 0.0025, 0.0), (-0.1, 0.0025, -0.1)]
        {
            let (at, mut rates) = (trial::at(0.0, v_m_per_s), [0.0]);
            BoucWen.rates(&p, &at, &[z_m], 0.0, &mut rates);
            trial::assert_near(rates[0], expected);
            assert_eq!(BoucWen.force(&p, &at, &[z_m]), Some(2000.0 * z_m));
        }
    }

    /// Its rates have a kink where the velocity changes its sign, in the middle of a step.
    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::BoucWen, 5e-8);
    }
}
