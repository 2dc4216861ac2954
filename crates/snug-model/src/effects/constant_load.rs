//! A constant load on the drive, another in each recording: T − L acts.
//!
//! L > 0 holds against a positive torque. Excited by itself. In the residual what a constant torque does, as large in each recording
//! as what hangs on the rig in it.
//!
//! Valid for: a load that stays the same while a recording lasts, whichever way the rig moves. Its mass is the base model's.
//!
//! Source: the weight of a load that is hoisted.

use crate::description::{ActsOn, Description, Kind, ParameterSpec, Scope, state};
use crate::law::{Instant, Law};
use crate::numeric::number::Number;

state! {
    summary: "A constant load holds against the drive, another in each recording.",
    equation: "T - L acts, another L in each recording",
}

pub(super) struct ConstantLoad;

impl Law for ConstantLoad {
    fn description(&self) -> &'static Description {
        &Description {
            name: "constant_load",
            kind: Kind::Mechanical,
            acts_on: ActsOn::Machines,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[ParameterSpec {
                name: "load_nm",
                meaning: "load",
                unit: "Nm",
                starts: &[0.0],
                minimum: -20.0,
                maximum: 20.0,
                limits: (-500.0, 500.0),
                vanishes_at: Some(0.0),
                scope: Scope::PerTightening,
            }],
            states: &[],
            twins: &["torque_offset", "output_offset", "initial_motion"],
            excited_by: "nothing: it is there at rest",
            shows_as: "what a constant torque does, another in each recording",
            check: "Weigh what hangs on the rig in each recording, and look for what pulls at it: springs, cables, a slope, a zero that was set anew.",
            on_machine: None,
            valid_for: "a load that stays the same while a recording lasts, whichever way the rig moves",
            source: "the weight of a load that is hoisted",
        }
    }

    #[inline(always)]
    fn torque<N: Number>(&self, p: &[N], _at: &Instant<N>) -> Option<N> {
        Some(-p[0])
    }

    fn of_all(&self) -> Option<&'static str> {
        Some("torque_offset")
    }
}

#[cfg(test)]
mod tests {
    use crate::effects::Effect;
    use crate::effects::trial::Trial;

    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::ConstantLoad, 1e-9);
    }
}
