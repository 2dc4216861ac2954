//! The hand's spring and damper do not end on ground but on a second mass (forearm) that is held itself.
//!
//! ```text
//! F = k (x − x2) + c (v − v2),  x2' = v2,  m2 v2' = F_hand − k2 x2 − c2 v2
//! ```
//!
//! F_hand is the spring's and damper's force; it pulls the second mass along. m2 or k2 without limit is the base model.
//! Excited by short pulses, whose bandwidth reaches the second resonance. In the residual it rings, in the acceleration
//! most.
//!
//! Valid for: pulses short enough to reach √(k2/m2); to slower motion k2 and c2 are in series with k and c and only these
//! change. Linear: any amplitude.
//!
//! Source: two-degree-of-freedom hand–arm models (ISO 10068).

use crate::description::{ActsOn, Description, Kind, OnMachine, ParameterSpec, Scope, state};
use crate::law::{Deflection, Instant, Law};
use crate::numeric::number::Number;

state! {
    summary: "The forearm gives way too: the hand is held by a second mass on a second spring.",
    equation: "k (x - x2) + c (v - v2),  m2 dv2/dt = F_hand - k2 x2 - c2 v2",
}

pub(super) struct SecondMass;

impl Law for SecondMass {
    fn description(&self) -> &'static Description {
        &Description {
            name: "second_mass",
            kind: Kind::Mechanical,
            acts_on: ActsOn::Anything,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[
                ParameterSpec {
                    name: "m2_kg",
                    meaning: "second mass",
                    unit: "kg",
                    starts: &[2.0, 0.7, 6.0],
                    minimum: 0.2,
                    maximum: 20.0,
                    limits: (0.05, 1e6),
                    vanishes_at: Some(1e12),
                    scope: Scope::Shared,
                },
                ParameterSpec {
                    name: "k2_n_per_m",
                    meaning: "stiffness behind it",
                    unit: "N/m",
                    starts: &[1e4, 2e3, 4e4],
                    minimum: 100.0,
                    maximum: 1e5,
                    limits: (50.0, 1e6),
                    vanishes_at: None,
                    scope: Scope::Shared,
                },
                ParameterSpec {
                    name: "c2_kg_per_s",
                    meaning: "damping behind it",
                    unit: "kg/s",
                    starts: &[100.0, 20.0],
                    minimum: 0.0,
                    maximum: 500.0,
                    limits: (0.0, 5000.0),
                    vanishes_at: None,
                    scope: Scope::Shared,
                },
            ],
            states: &["support_x_m", "support_v_m_per_s"],
            twins: &["torque_delay", "maxwell_branch"],
            excited_by: "short pulses: hard joints, fast shut-off",
            shows_as: "ringing at a second frequency, in the acceleration most",
            check: "Repeat with the elbow supported and with the arm stretched out: ringing that changes comes from the forearm; ringing that stays comes from the mounting.",
            on_machine: Some(OnMachine {
                summary: Some(
                    "What the spring stands on gives way too: a second mass on a second spring.",
                ),
                shows_as: None,
                check: "Tap the rig and its base and compare the ringing; clamp the base more firmly and repeat: ringing that changes comes from there.",
            }),
            valid_for: "pulses short enough to reach the second resonance, sqrt(k2 / m2); to slower motion only k and c seem other; any amplitude",
            source: "ISO 10068:2012, Mechanical impedance of the human hand-arm system at the driving point",
        }
    }

    #[inline(always)]
    fn support<N: Number>(&self, _p: &[N], own: &[N]) -> Option<Deflection<N>> {
        Some(Deflection {
            x_m: own[0],
            v_m_per_s: own[1],
        })
    }

    #[inline(always)]
    fn rates<N: Number>(
        &self,
        p: &[N],
        _at: &Instant<N>,
        own: &[N],
        hand_n: N,
        rates: &mut [N],
    ) -> Option<()> {
        rates[0] = own[1];
        rates[1] = (hand_n - p[1] * own[0] - p[2] * own[1]) / p[0];
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
    fn the_hand_pulls_the_second_mass_along_and_its_own_spring_holds_it() {
        let (p, own) = ([2.0, 1e4, 100.0], [0.001, 0.1]);
        let mut rates = [0.0; 2];
        SecondMass.rates(&p, &trial::at(0.0, 0.0), &own, 5.0, &mut rates);
        trial::assert_near(rates[0], 0.1);
        trial::assert_near(rates[1], (5.0 - 10.0 - 10.0) / 2.0);
        let support = SecondMass.support(&p, &own).expect("the hand ends on it");
        assert_eq!([support.x_m, support.v_m_per_s], own);
    }

    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::SecondMass, 1e-9);
    }
}
