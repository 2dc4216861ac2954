//! The torque sensor does not read zero at rest: T − T0 acts where T is logged.
//!
//! Parameter: offset_nm \[Nm\], −2 to 2. Excited by itself. In the residual a step at the window's start that the spring turns
//! into a constant angle T0/(k l²). Source: sensor zero offset.

use crate::numeric::number::Number;
use crate::effect::{Description, Kind, Law, LoggedTorque, ParameterSpec, Scope};

pub struct TorqueOffset;

impl Law for TorqueOffset {
    fn description(&self) -> &'static Description {
        &Description {
            name: "torque_offset",
            kind: Kind::Measurement,
            summary: "The torque sensor reads a constant too much.",
            equation: "T - T0 acts, T is logged",
            parameters: &[ParameterSpec {
                name: "offset_nm",
                meaning: "offset",
                unit: "Nm",
                starts: &[0.0],
                minimum: -2.0,
                maximum: 2.0,
                limits: (-50.0, 50.0),
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["voluntary_push", "output_offset"],
            excited_by: "nothing: it is there at rest",
            shows_as: "a small free oscillation from the first sample on, around a constant angle",
            check: "Read the torque sensor with no load, before and after the run: it must show zero.",
            source: "sensor zero offset",
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
