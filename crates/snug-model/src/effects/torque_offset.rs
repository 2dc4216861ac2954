//! The torque sensor does not read zero at rest: T − T0 acts where T is logged.
//!
//! T0 > 0 is a sensor that reads too much. Excited by itself. In the residual a step at the window's start that the spring
//! turns into a constant angle −T0/(k l²).
//!
//! Valid for: a zero that does not drift within a tightening.
//!
//! Source: sensor zero offset.

use crate::description::{ActsOn, Description, Kind, ParameterSpec, Scope, state};
use crate::law::{Law, LoggedTorque};
use crate::numeric::number::Number;

state! {
    summary: "The torque sensor reads a constant too much.",
    equation: "T - T0 acts, T is logged",
}

pub(super) struct TorqueOffset;

impl Law for TorqueOffset {
    fn description(&self) -> &'static Description {
        &Description {
            name: "torque_offset",
            kind: Kind::Measurement,
            acts_on: ActsOn::Anything,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[ParameterSpec {
                name: "offset_nm",
                meaning: "offset",
                unit: "Nm",
                starts: &[0.0],
                minimum: -2.0,
                maximum: 2.0,
                limits: (-50.0, 50.0),
                vanishes_at: Some(0.0),
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["voluntary_push", "output_offset"],
            excited_by: "nothing: it is there at rest",
            shows_as: "a small free oscillation from the first sample on, around a constant angle",
            check: "Read the torque sensor with no load, before and after the run: it must show zero.",
            on_machine: None,
            valid_for: "a zero that does not drift within a tightening",
            source: "JCGM 200:2012, International Vocabulary of Metrology: zero error",
        }
    }

    #[inline(always)]
    fn logged_torque<N: Number>(&self, p: &[N]) -> Option<LoggedTorque<N>> {
        Some(LoggedTorque {
            offset_nm: p[0],
            ..LoggedTorque::faithful(p[0])
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Effect;
    use crate::effects::trial::Trial;

    #[test]
    fn what_reads_too_much_is_taken_off() {
        let logged = TorqueOffset.logged_torque(&[0.7]);
        let logged = logged.expect("it is how torque is logged");
        assert_eq!(
            (logged.offset_nm, logged.delay_s, logged.lag_s),
            (0.7, 0.0, 0.0)
        );
    }

    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::TorqueOffset, 1e-9);
    }
}
