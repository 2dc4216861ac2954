//! The accelerometer is not aligned with its circle: a + ε ω², from the centripetal acceleration.
//!
//! ε > 0 feels it as acceleration with the torque; ε of 1 is an axis 45° off. Velocity and displacement are integrated from a and
//! carry its integrals. Excited by fast rotation. In the residual it is one-sided and peaks with the speed, out and back
//! alike.
//!
//! Valid for: a sensor that is fixed to the tool, so that its axis keeps its angle to the circle, velocity and displacement
//! integrated from this very acceleration. It follows ω at once.
//!
//! Source: transverse sensitivity and mounting of the accelerometer.

use crate::description::{ActsOn, Description, Kind, OnMachine, ParameterSpec, Scope, state};
use crate::law::{Instant, Kinematics, Law};
use crate::numeric::number::Number;

state! {
    summary: "The accelerometer picks up centripetal acceleration.",
    equation: "a + epsilon omega^2",
}

pub(super) struct CentripetalCrosstalk;

impl Law for CentripetalCrosstalk {
    fn description(&self) -> &'static Description {
        &Description {
            name: "centripetal_crosstalk",
            kind: Kind::Measurement,
            acts_on: ActsOn::Anything,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[ParameterSpec {
                name: "epsilon",
                meaning: "share of the squared speed",
                unit: "1",
                starts: &[0.0],
                minimum: -1.0,
                maximum: 1.0,
                limits: (-10.0, 10.0),
                vanishes_at: Some(0.0),
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["quadratic_damping"],
            excited_by: "fast rotation: high target torque, light arms",
            shows_as: "misfit that follows the square of the velocity, the same sign on the way out and back",
            check: "Check that the accelerometer's axis lies along the circle on which it moves: turned towards the joint, it feels the rotation itself.",
            on_machine: Some(OnMachine {
                summary: None,
                shows_as: None,
                check: "Check that the accelerometer's axis lies along the circle on which it moves: turned towards the axis of rotation, it feels the rotation itself.",
            }),
            valid_for: "a sensor fixed to the tool, velocity and displacement integrated from this very acceleration",
            source: "ISO 16063-31:2009, Calibration of vibration and shock transducers: testing of transverse vibration sensitivity",
        }
    }

    #[inline(always)]
    fn cross_sensitivity<N: Number>(
        &self,
        p: &[N],
        _at: &Instant<N>,
        motion: &Kinematics<N>,
    ) -> Option<N> {
        Some(p[0] * motion.velocity_rad_per_s.power(2))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Effect;
    use crate::effects::trial;
    use crate::effects::trial::Trial;

    #[test]
    fn follows_the_squared_speed_out_and_back() {
        for (epsilon, speed, expected) in [(0.4, 0.5, 0.1), (0.4, -0.5, 0.1), (0.0, 0.5, 0.0)] {
            let motion = Kinematics {
                displacement_rad: 0.1,
                velocity_rad_per_s: speed,
                acceleration_rad_per_s2: 3.0,
            };
            let at = trial::at(0.0, 0.0);
            let found = CentripetalCrosstalk.cross_sensitivity(&[epsilon], &at, &motion);
            trial::assert_near(found.expect("the sensor feels it"), expected);
        }
    }

    /// What leaks in is taken as straight between samples.
    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::CentripetalCrosstalk, 5e-8);
    }
}
