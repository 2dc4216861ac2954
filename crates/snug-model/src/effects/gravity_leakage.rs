//! The accelerometer turns in the field of gravity: a + γ sin θ.
//!
//! |γ| is at most g over the sensor's distance from the joint; γ > 0 adds to the reading where θ > 0. Velocity and
//! displacement are integrated from a and carry its integrals. Excited by displacement. In the residual it follows the
//! displacement, like a changed stiffness that no force explains.
//!
//! Valid for: any angle, counted from where gravity adds nothing to the reading (what it adds at rest is a bias), velocity and
//! displacement integrated from this very acceleration. It follows θ at once.
//!
//! Source: static sensitivity of accelerometers.

use crate::description::{ActsOn, Description, Kind, OnMachine, ParameterSpec, Scope, state};
use crate::law::{Instant, Kinematics, Law};
use crate::numeric::number::Number;

state! {
    summary: "The accelerometer feels gravity differently as it turns.",
    equation: "a + gamma sin(theta)",
}

pub(super) struct GravityLeakage;

impl Law for GravityLeakage {
    fn description(&self) -> &'static Description {
        &Description {
            name: "gravity_leakage",
            kind: Kind::Measurement,
            acts_on: ActsOn::Anything,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[ParameterSpec {
                name: "gamma_rad_per_s2",
                meaning: "acceleration at a right angle",
                unit: "rad/s^2",
                starts: &[0.0],
                minimum: -30.0,
                maximum: 30.0,
                limits: (-300.0, 300.0),
                vanishes_at: Some(0.0),
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["cubic_stiffness", "torque_dependent_stiffness"],
            excited_by: "large displacements",
            shows_as: "misfit that follows the displacement, in the acceleration without a force",
            check: "Turn the tool slowly by hand and watch the acceleration: a reading that follows the angle is gravity, so look at how the sensor is mounted.",
            on_machine: Some(OnMachine {
                summary: None,
                shows_as: None,
                check: "Turn the rig slowly with the power off and watch the acceleration: a reading that follows the angle is gravity, so look at how the sensor is mounted.",
            }),
            valid_for: "any angle, counted from where gravity adds nothing to the reading: what it adds at rest is a bias",
            source: "IEEE Std 1293-1998, Test Procedure for Linear, Single-Axis, Nongyroscopic Accelerometers: tests in the field of gravity",
        }
    }

    #[inline(always)]
    fn cross_sensitivity<N: Number>(
        &self,
        p: &[N],
        _at: &Instant<N>,
        motion: &Kinematics<N>,
    ) -> Option<N> {
        Some(p[0] * motion.displacement_rad.sin())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Effect;
    use crate::effects::trial;
    use crate::effects::trial::Trial;

    #[test]
    fn follows_the_sine_of_the_angle() {
        for (gamma, angle, expected) in [
            (10.0, 0.3, 10.0 * 0.3_f64.sin()),
            (10.0, -0.3, -10.0 * 0.3_f64.sin()),
            (0.0, 0.3, 0.0),
        ] {
            let motion = Kinematics {
                displacement_rad: angle,
                velocity_rad_per_s: 0.5,
                acceleration_rad_per_s2: 3.0,
            };
            let at = trial::at(0.0, 0.0);
            let found = GravityLeakage.cross_sensitivity(&[gamma], &at, &motion);
            trial::assert_near(found.expect("the sensor feels it"), expected);
        }
    }

    /// What leaks in is taken as straight between samples.
    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::GravityLeakage, 5e-8);
    }
}
