//! The hand's spring and damper do not end on ground but on a second mass (forearm) that is held itself.
//!
//! ```text
//! F = k (x − x2) + c (v − v2),  x2' = v2,  m2 v2' = F_hand − k2 x2 − c2 v2
//! ```
//!
//! F_hand is the spring's and damper's force. Parameters: m2_kg 0.2 to 20 kg, k2_n_per_m 100 to 1e5 N/m, c2_kg_per_s 0 to
//! 500 kg/s; m2 or k2 without limit is the base model. Excited by short pulses, whose bandwidth reaches the second
//! resonance. In the residual it rings, in the acceleration most. Source: two-degree-of-freedom hand–arm models (ISO 10068).

use crate::numeric::number::Number;
use crate::effect::{Deflection, Description, Instant, Kind, Law, ParameterSpec, Scope};

pub struct SecondMass;

impl Law for SecondMass {
    fn description(&self) -> &'static Description {
        &Description {
            name: "second_mass",
            kind: Kind::Mechanical,
            summary: "The forearm gives way too: the hand is held by a second mass on a second spring.",
            equation: "k (x - x2) + c (v - v2),  m2 dv2/dt = F_hand - k2 x2 - c2 v2",
            parameters: &[ParameterSpec {
                name: "m2_kg",
                meaning: "second mass",
                unit: "kg",
                starts: &[2.0, 0.7, 6.0],
                minimum: 0.2,
                maximum: 20.0,
                limits: (0.05, 100.0),
                scope: Scope::Shared,
            }, ParameterSpec {
                name: "k2_n_per_m",
                meaning: "stiffness behind it",
                unit: "N/m",
                starts: &[1e4, 2e3, 4e4],
                minimum: 100.0,
                maximum: 1e5,
                limits: (50.0, 1e6),
                scope: Scope::Shared,
            }, ParameterSpec {
                name: "c2_kg_per_s",
                meaning: "damping behind it",
                unit: "kg/s",
                starts: &[100.0, 20.0],
                minimum: 0.0,
                maximum: 500.0,
                limits: (0.0, 5000.0),
                scope: Scope::Shared,
            }],
            states: &["support_x_m", "support_v_m_per_s"],
            twins: &["torque_delay", "maxwell_branch"],
            excited_by: "short pulses: hard joints, fast shut-off",
            shows_as: "ringing at a second frequency, in the acceleration most",
            check: "Repeat with the elbow supported and with the arm stretched out: ringing that changes comes from the forearm; ringing that stays comes from the mounting.",
            source: "two-degree-of-freedom hand-arm models (ISO 10068)",
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
    ) {
        rates[0] = own[1];
        rates[1] = (hand_n - p[1] * own[0] - p[2] * own[1]) / p[0];
    }
}
