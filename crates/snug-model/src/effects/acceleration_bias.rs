//! The accelerometer's zero is off: a + b; in the integrated velocity a slope, in the displacement a parabola.
//!
//! Always there; counted from the instant the integration began, which is why a long quiet part before the pulse makes
//! it grow. Source: sensor zero offset, temperature drift.

use crate::numeric::number::Number;
use crate::effect::{Description, Kind, Kinematics, Law, ParameterSpec, Scope};

pub struct AccelerationBias;

impl Law for AccelerationBias {
    fn description(&self) -> &'static Description {
        &Description {
            name: "acceleration_bias",
            kind: Kind::Measurement,
            summary: "The accelerometer does not read zero at rest.",
            equation: "a + b",
            parameters: &[ParameterSpec {
                name: "bias_rad_per_s2",
                meaning: "bias",
                unit: "rad/s^2",
                starts: &[0.0],
                minimum: -2.0,
                maximum: 2.0,
                limits: (-50.0, 50.0),
                scope: Scope::PerTightening,
            }],
            states: &[],
            twins: &["initial_motion"],
            excited_by: "nothing: it is there at rest",
            shows_as: "a constant in the acceleration, a parabola in the displacement",
            check: "Read the accelerometer with the tool at rest, cold and warm: it must show zero; if not, record a quiet part before each pulse.",
            source: "sensor zero offset",
        }
    }

    #[inline(always)]
    fn measure<N: Number>(
        &self,
        p: &[N],
        since_rest_s: N::Real,
        motion: Kinematics<N>,
    ) -> Option<Kinematics<N>> {
        Some(Kinematics {
            displacement_rad: motion.displacement_rad + p[0].times(since_rest_s * 0.5 * since_rest_s),
            velocity_rad_per_s: motion.velocity_rad_per_s + p[0].times(since_rest_s),
            acceleration_rad_per_s2: motion.acceleration_rad_per_s2 + p[0],
        })
    }

    fn measurement_only(&self) -> bool {
        true
    }
}
