//! The accelerometer turns in the field of gravity: a + γ sin θ.
//!
//! Velocity and displacement are integrated from a and carry its integrals. Parameter: gamma_rad_per_s2 \[rad/s²\], −30 to 30
//! (g over the sensor's distance from the joint). Excited by displacement. In the residual it follows the displacement, like a
//! changed stiffness that no force explains. Source: static sensitivity of accelerometers.

use crate::numeric::number::Number;
use crate::effect::{Description, Instant, Kind, Kinematics, Law, ParameterSpec, Scope};

pub struct GravityLeakage;

impl Law for GravityLeakage {
    fn description(&self) -> &'static Description {
        &Description {
            name: "gravity_leakage",
            kind: Kind::Measurement,
            summary: "The accelerometer feels gravity differently as it turns.",
            equation: "a + gamma sin(theta)",
            parameters: &[ParameterSpec {
                name: "gamma_rad_per_s2",
                meaning: "acceleration at a right angle",
                unit: "rad/s^2",
                starts: &[0.0],
                minimum: -30.0,
                maximum: 30.0,
                limits: (-300.0, 300.0),
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["cubic_stiffness", "torque_dependent_stiffness"],
            excited_by: "large displacements",
            shows_as: "misfit that follows the displacement, in the acceleration without a force",
            check: "Turn the tool slowly by hand and watch the acceleration: a reading that follows the angle is gravity, so look at how the sensor is mounted.",
            source: "static sensitivity of accelerometers",
        }
    }

    #[inline(always)]
    fn cross_sensitivity<N: Number>(&self, p: &[N], _at: &Instant<N>, motion: &Kinematics<N>) -> Option<N> {
        Some(p[0] * motion.displacement_rad.sin())
    }

    fn measurement_only(&self) -> bool {
        true
    }
}
