//! The grip can only hold so much: the whole hand force F becomes F_max tanh(F / F_max).
//!
//! F_max without limit is the base model, and what is lost grows as 1/F_max². Excited by large forces: high targets. In the
//! residual it stands around the largest force, where the hand gives way and the tool goes further.
//!
//! Valid for: forces around F_max; far below nothing slips. It has no memory: the grip holds again at once, where it was
//! before.
//!
//! Source: limit of friction in the grip, smoothed.

use crate::description::{ActsOn, Description, Kind, ParameterSpec, Scope, state};
use crate::law::Law;
use crate::numeric::number::Number;

state! {
    summary: "The grip slips: the hand's force cannot exceed a limit.",
    equation: "F_max tanh(F / F_max)",
}

pub(super) struct GripSlip;

impl Law for GripSlip {
    fn description(&self) -> &'static Description {
        &Description {
            name: "grip_slip",
            kind: Kind::Mechanical,
            acts_on: ActsOn::Hands,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[ParameterSpec {
                name: "f_max_n",
                meaning: "force at which the grip slips",
                unit: "N",
                starts: &[150.0, 60.0, 280.0],
                minimum: 10.0,
                maximum: 300.0,
                limits: (3.0, 1000.0),
                vanishes_at: Some(1e9),
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["coulomb_friction", "cubic_stiffness"],
            excited_by: "large forces: high target torque, weak grip",
            shows_as: "misfit where the force is largest: the tool goes further than the spring would let it",
            check: "Mark handle and glove with a line and look after a high-torque tightening whether it has moved; repeat with a firmer grip.",
            on_machine: None,
            valid_for: "forces around F_max; it has no memory: the grip holds again at once, where it was before",
            source: "Johansson and Westling 1984, Roles of glabrous skin receptors and sensorimotor memory in automatic control of precision grip, Experimental Brain Research 56",
        }
    }

    #[inline(always)]
    fn limit<N: Number>(&self, p: &[N], force_n: N) -> Option<N> {
        Some(p[0] * (force_n / p[0]).tanh())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Effect;
    use crate::effects::trial::Trial;

    #[test]
    fn weak_forces_pass_and_strong_ones_are_limited() {
        for (f_max_n, force_n, expected_n) in [
            (100.0, 1e-3, 1e-3),
            (100.0, 1e4, 100.0),
            (100.0, -1e4, -100.0),
            (1e9, 50.0, 50.0),
        ] {
            let found_n = GripSlip.limit(&[f_max_n], force_n);
            let found_n = found_n.expect("slip limits the force");
            assert!((found_n - expected_n).abs() < 1e-6, "{found_n}");
        }
    }

    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::GripSlip, 1e-9);
    }
}
