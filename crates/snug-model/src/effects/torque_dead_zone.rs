//! A drive that does not answer to little: of the torque T that it is told to exert
//!
//! ```text
//! T - clip(T, -b, b)
//! ```
//!
//! acts, which is nothing up to b and all but b beyond. b → 0 is the base model. Excited by commands to both sides of b, both ways best:
//! of a rig that is driven far beyond b one way only, it is an offset. In the residual it stands where the command is small, and is b elsewhere.
//!
//! Valid for: a dead zone as wide either way and at any speed, behind which the drive answers as before; a command, not a torque that was
//! measured at the rig.
//!
//! Source: overlap of a valve's spool, least pulse of a motor's controller.

use crate::description::{ActsOn, Description, Kind, ParameterSpec, Scope, state};
use crate::law::{Instant, Law};
use crate::numeric::number::Number;

state! {
    summary: "The drive does not answer to commands that are too small.",
    equation: "T - clip(T, -b, b)",
}

pub(super) struct TorqueDeadZone;

impl Law for TorqueDeadZone {
    fn description(&self) -> &'static Description {
        &Description {
            name: "torque_dead_zone",
            kind: Kind::Drive,
            acts_on: ActsOn::Machines,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[ParameterSpec {
                name: "b_nm",
                meaning: "largest command that the drive does not answer",
                unit: "Nm",
                starts: &[1.0, 4.0],
                minimum: 0.0,
                maximum: 20.0,
                limits: (0.0, 50.0),
                vanishes_at: Some(0.0),
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["coulomb_friction", "torque_offset"],
            excited_by: "commands that pass through nothing",
            shows_as: "misfit with the sign of the command, constant but where the command is small",
            check: "Raise the command slowly from nothing, either way, and note at which the torque or current begins: friction of the rig holds the rig, not the current. Of a measured force, see how it scatters while nothing acts: such noise looks the same.",
            on_machine: None,
            valid_for: "a dead zone as wide either way and at any speed; a command, not a torque that was measured at the rig",
            source: "Tao and Kokotovic 1996, Adaptive Control of Systems with Actuator and Sensor Nonlinearities, Wiley",
        }
    }

    #[inline(always)]
    fn torque<N: Number>(&self, p: &[N], at: &Instant<N>) -> Option<N> {
        Some(-at.torque_nm.no_further_than(p[0]))
    }

    /// Of a rig that goes the way it is driven, both take as much from what it is told.
    fn likelier(&self) -> Option<&'static str> {
        Some("coulomb_friction")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Effect;
    use crate::effects::trial;
    use crate::effects::trial::Trial;

    #[test]
    fn takes_off_what_is_within_the_zone() {
        for (zone_nm, torque_nm, expected_nm) in [
            (4.0, 30.0, -4.0),
            (4.0, -30.0, 4.0),
            (4.0, 3.0, -3.0),
            (4.0, 0.0, 0.0),
            (0.0, 30.0, 0.0),
        ] {
            let at = Instant {
                torque_nm,
                ..trial::at(0.1, 0.7)
            };
            let found = TorqueDeadZone
                .torque(&[zone_nm], &at)
                .expect("it is a torque");
            assert_eq!(found, expected_nm, "{zone_nm} {torque_nm}");
        }
    }

    /// The kink as the command leaves the zone lies within a step.
    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::TorqueDeadZone, 1e-6);
    }
}
