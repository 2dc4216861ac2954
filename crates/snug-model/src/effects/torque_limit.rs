//! A drive that gives no more than its most: of the torque T that it is told to exert
//!
//! ```text
//! T / (1 + (T / T_max)⁶⁴)^(1/64)
//! ```
//!
//! acts, which is T no further than T_max from 0, its corners rounded over a hundredth. T_max without limit is the base model. Excited by
//! commands beyond T_max. In the residual it stands where the command is largest, with the command's sign.
//!
//! Valid for: a limit that is the same both ways and at any speed; a command, not a torque that was measured at the rig.
//!
//! Source: saturation of amplifiers, current limits and valves.

use crate::description::{ActsOn, Description, Kind, ParameterSpec, Scope, state};
use crate::law::{Instant, Law};
use crate::numeric::number::Number;

state! {
    summary: "The drive gives no more than its most, whatever it is told.",
    equation: "clip(T, -T_max, T_max)",
}

/// The power is 2 to this: the corner is lower than the limit by 1.1 %.
const SQUARINGS: usize = 6;

pub(super) struct TorqueLimit;

impl Law for TorqueLimit {
    fn description(&self) -> &'static Description {
        &Description {
            name: "torque_limit",
            kind: Kind::Drive,
            acts_on: ActsOn::Machines,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[ParameterSpec {
                name: "t_max_nm",
                meaning: "the most that the drive gives",
                unit: "Nm",
                starts: &[15.0, 10.0, 22.0],
                minimum: 2.0,
                maximum: 50.0,
                limits: (0.5, 100.0),
                vanishes_at: Some(1e9),
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["quadratic_damping"],
            excited_by: "commands beyond what the drive gives",
            shows_as: "misfit where the command is largest, with its sign",
            check: "Hold the rig still, raise the command beyond the largest of the recordings and measure the torque or current: it must follow to the end. Look up the drive's current limit.",
            on_machine: None,
            valid_for: "a limit that is the same both ways and at any speed; a command, not a torque that was measured at the rig",
            source: "Tao and Kokotovic 1996, Adaptive Control of Systems with Actuator and Sensor Nonlinearities, Wiley",
        }
    }

    #[inline(always)]
    fn torque<N: Number>(&self, p: &[N], at: &Instant<N>) -> Option<N> {
        let mut over = at.torque_nm / p[0];
        for _ in 0..SQUARINGS {
            over = over * over;
        }
        let mut root = over.plus(at.lever_arm_m.constant(1.0));
        for _ in 0..SQUARINGS {
            root = root.sqrt();
        }
        Some(at.torque_nm / root - at.torque_nm)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Effect;
    use crate::effects::trial;
    use crate::effects::trial::Trial;

    /// At the limit itself it is lower by the 64th root of 2.
    #[test]
    fn takes_off_what_is_beyond_the_limit() {
        for (limit_nm, torque_nm, expected_nm) in [
            (10.0, 30.0, -20.0),
            (10.0, -30.0, 20.0),
            (10.0, 5.0, 0.0),
            (10.0, 10.0, 10.0 * (0.5_f64.powf(1.0 / 64.0) - 1.0)),
            (1e9, 30.0, 0.0),
        ] {
            let at = Instant {
                torque_nm,
                ..trial::at(0.1, 0.7)
            };
            let found = TorqueLimit
                .torque(&[limit_nm], &at)
                .expect("it is a torque");
            trial::assert_near(found, expected_nm);
        }
    }

    /// As the torque shuts off it passes the corner within a third of a step, which is worth 2e-6.
    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::TorqueLimit, 5e-6);
    }
}
