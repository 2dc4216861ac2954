//! The accelerometer is not aligned with its circle: a + ε ω², from the centripetal acceleration.
//!
//! Velocity and displacement are integrated from a and carry its integrals. Parameter: epsilon, −1 to 1 (1 is an axis 45°
//! off). Excited by fast rotation. In the residual it is one-sided and peaks with the speed, out and back alike.
//! Source: transverse sensitivity and mounting of the accelerometer.

use crate::numeric::number::Number;
use crate::effect::{Description, Instant, Kind, Kinematics, Law, ParameterSpec, Scope};

pub struct CentripetalCrosstalk;

impl Law for CentripetalCrosstalk {
    fn description(&self) -> &'static Description {
        &Description {
            name: "centripetal_crosstalk",
            kind: Kind::Measurement,
            summary: "The accelerometer picks up centripetal acceleration.",
            equation: "a + epsilon omega^2",
            parameters: &[ParameterSpec {
                name: "epsilon",
                meaning: "share of the squared speed",
                unit: "1",
                starts: &[0.0],
                minimum: -1.0,
                maximum: 1.0,
                limits: (-10.0, 10.0),
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["quadratic_damping"],
            excited_by: "fast rotation: high target torque, light arms",
            shows_as: "misfit that follows the square of the velocity, the same sign on the way out and back",
            check: "Check that the accelerometer's axis lies along the circle on which it moves: turned towards the joint, it feels the rotation itself.",
            source: "transverse sensitivity of the accelerometer",
        }
    }

    #[inline(always)]
    fn cross_sensitivity<N: Number>(&self, p: &[N], _at: &Instant<N>, motion: &Kinematics<N>) -> Option<N> {
        Some(p[0] * motion.velocity_rad_per_s.power(2))
    }

    fn measurement_only(&self) -> bool {
        true
    }
}
