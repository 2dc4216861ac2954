//! A weight on an arm: +T = a sin θ + b cos θ.
//!
//! With a mass m at distance d from the axis √(a² + b²) = m g d, and the ratio says where the zero of θ stands: a < 0, b = 0 hangs,
//! a > 0 stands upright, a = 0 holds the arm level. Both 0 is the base model. It may give back what was put in before the window
//! began. Excited by angles of more than a few degrees. In the residual it follows the angle, whatever the speed.
//!
//! Valid for: an axis that is not vertical and an arm that makes no more than a few turns: over many it is a ripple of a turn,
//! and the zero of θ drifts. For small angles b is an offset of the torque and a a stiffness.
//!
//! Source: the physical pendulum.

use crate::description::{ActsOn, Description, Kind, ParameterSpec, Scope, state};
use crate::law::{Instant, Law};
use crate::numeric::number::Number;

state! {
    summary: "A weight on an arm pulls it down: the torque goes with the angle.",
    equation: "T + a sin(theta) + b cos(theta)",
}

pub(super) struct GravityTorque;

impl Law for GravityTorque {
    fn description(&self) -> &'static Description {
        &Description {
            name: "gravity_torque",
            kind: Kind::Mechanical,
            acts_on: ActsOn::MachinesOfFewTurns,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[
                ParameterSpec {
                    name: "a_nm",
                    meaning: "torque at a right angle",
                    unit: "Nm",
                    starts: &[0.0],
                    minimum: -20.0,
                    maximum: 20.0,
                    limits: (-200.0, 200.0),
                    vanishes_at: Some(0.0),
                    scope: Scope::Shared,
                },
                ParameterSpec {
                    name: "b_nm",
                    meaning: "torque at the zero of the angle",
                    unit: "Nm",
                    starts: &[0.0],
                    minimum: -20.0,
                    maximum: 20.0,
                    limits: (-200.0, 200.0),
                    vanishes_at: Some(0.0),
                    scope: Scope::Shared,
                },
            ],
            states: &[],
            twins: &["gravity_leakage", "torque_offset"],
            excited_by: "angles of more than a few degrees",
            shows_as: "misfit that follows the angle, whatever the speed: the rig swings or sags by itself",
            check: "Let go of the arm with the power off: a weight makes it swing to one place and stay there. Balance it, or turn the axis upright, and repeat.",
            on_machine: None,
            valid_for: "an axis that is not vertical and no more than a few turns; for small angles it is a stiffness and an offset of the torque",
            source: "Huygens 1673, Horologium Oscillatorium",
        }
    }

    #[inline(always)]
    fn torque<N: Number>(&self, p: &[N], at: &Instant<N>) -> Option<N> {
        let theta = at.x_m.times(at.lever_arm_m.constant(1.0) / at.lever_arm_m);
        let (sine, cosine) = theta.sin_cos();
        Some(p[0] * sine + p[1] * cosine)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Effect;
    use crate::effects::trial;
    use crate::effects::trial::Trial;

    #[test]
    fn follows_the_angle() {
        for (p, angle_rad, expected_nm) in [
            ([-3.0, 0.0], 0.5, -3.0 * 0.5_f64.sin()),
            ([0.0, 2.0], -0.5, 2.0 * 0.5_f64.cos()),
            ([0.0, 0.0], 1.0, 0.0),
        ] {
            let at = trial::at(0.33 * angle_rad, 0.7);
            let found = GravityTorque.torque(&p, &at).expect("it is a torque");
            trial::assert_near(found, expected_nm);
        }
    }

    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::GravityTorque, 1e-9);
    }
}
