//! The fitted output has a constant offset: y + y0, in the output's own unit.
//!
//! In acceleration this is the same as `acceleration_bias`. Source: sensor zero of the output channel.

use crate::numeric::number::Number;
use crate::effect::{Description, Kind, Kinematics, Law, ParameterSpec, Scope};
use snug_campaign::Quantity;

pub struct OutputOffset;

impl Law for OutputOffset {
    fn description(&self) -> &'static Description {
        &Description {
            name: "output_offset",
            kind: Kind::Measurement,
            summary: "The fitted output channel does not read zero at rest.",
            equation: "y + y0",
            parameters: &[ParameterSpec {
                name: "y0",
                meaning: "offset",
                unit: "output unit",
                starts: &[0.0],
                minimum: -10.0,
                maximum: 10.0,
                limits: (-1000.0, 1000.0),
                scope: Scope::PerTightening,
            }],
            states: &[],
            twins: &["torque_offset", "acceleration_bias"],
            excited_by: "nothing: it is there at rest",
            shows_as: "a constant in the fitted output",
            check: "Read the fitted channel with the tool at rest: it must show zero.",
            source: "sensor zero offset",
        }
    }

    #[inline(always)]
    fn measure<N: Number>(
        &self,
        p: &[N],
        _since_rest_s: N::Real,
        motion: Kinematics<N>,
    ) -> Option<Kinematics<N>> {
        Some(Kinematics {
            displacement_rad: motion.displacement_rad + p[0],
            velocity_rad_per_s: motion.velocity_rad_per_s + p[0],
            acceleration_rad_per_s2: motion.acceleration_rad_per_s2 + p[0],
        })
    }

    fn measurement_only(&self) -> bool {
        true
    }

    fn same_as(&self, compared: Quantity) -> Option<&'static str> {
        (compared == Quantity::Acceleration).then_some("acceleration_bias")
    }
}
