//! The tool already moves when the window begins: θ(0) = θ0, ω(0) = ω0.
//!
//! Both count in the direction of the torque. Excited by itself; decays with the hand–arm's own time constant. In the residual
//! a free oscillation from the first sample on, before the pulse.
//!
//! Valid for: free motion before the window, without torque that the window does not hold; not in a simulation that takes up
//! the measured motion.
//!
//! Source: preceding tightening, posture.

use crate::description::{ActsOn, Description, Kind, OnMachine, ParameterSpec, Scope, state};
use crate::law::Law;
use crate::numeric::number::Number;

state! {
    summary: "The tool is not at rest when the window begins.",
    equation: "theta(0) = theta0, omega(0) = omega0",
}

pub(super) struct InitialMotion;

impl Law for InitialMotion {
    fn description(&self) -> &'static Description {
        &Description {
            name: "initial_motion",
            kind: Kind::Measurement,
            acts_on: ActsOn::Anything,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[
                ParameterSpec {
                    name: "theta0_rad",
                    meaning: "angle at the start",
                    unit: "rad",
                    starts: &[0.0],
                    minimum: -0.2,
                    maximum: 0.2,
                    limits: (-1.0, 1.0),
                    vanishes_at: Some(0.0),
                    scope: Scope::PerTightening,
                },
                ParameterSpec {
                    name: "omega0_rad_per_s",
                    meaning: "speed at the start",
                    unit: "rad/s",
                    starts: &[0.0],
                    minimum: -5.0,
                    maximum: 5.0,
                    limits: (-50.0, 50.0),
                    vanishes_at: Some(0.0),
                    scope: Scope::PerTightening,
                },
            ],
            states: &[],
            twins: &["acceleration_bias"],
            excited_by: "nothing: it is there at the start",
            shows_as: "a free, decaying oscillation from the first sample on, before the pulse",
            check: "Hold the tool still for a second before each start, and check that the window begins before the pulse does.",
            on_machine: Some(OnMachine {
                summary: Some("The rig is not at rest when the window begins."),
                shows_as: None,
                check: "Keep the rig still for a second before each start, and check that the recording begins before the input does.",
            }),
            valid_for: "free motion before the window, without torque that the window does not hold",
            source: "Ljung 1999, System Identification: Theory for the User, Prentice Hall",
        }
    }

    #[inline(always)]
    fn initial<N: Number>(&self, p: &[N]) -> Option<(N, N)> {
        Some((p[0], p[1]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Effect;
    use crate::effects::trial;
    use crate::effects::trial::Trial;

    #[test]
    fn the_window_begins_with_it() {
        assert_eq!(InitialMotion.initial(&[0.01, -0.3]), Some((0.01, -0.3)));
        assert!(Effect::InitialMotion.sets_initial_motion());
        let motion = Trial::ramp().motion(Effect::InitialMotion, &[0.01, -0.3]);
        trial::assert_near(motion[0][0], 0.01);
        trial::assert_near(motion[1][0], -0.3);
    }

    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::InitialMotion, 1e-9);
    }
}
