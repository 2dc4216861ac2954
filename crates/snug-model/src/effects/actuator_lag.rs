//! A drive that follows its command through a first-order lag: of the torque u that it is told, q acts, τ q' + q = u.
//!
//! Excited by commands that change within a few τ. In the residual it follows du/dt with a tail that decays over τ. Where the rig is
//! linear and rests before, what is measured behind the same lag looks the same; friction, play or weight tell them apart, since the
//! drive's lag comes before them and a sensor's after.
//!
//! Valid for: a command, not a torque that was measured at the rig; one time constant at any size and either way.
//!
//! Source: rise of a motor's current, a propeller's speed, a valve's flow.

use crate::description::{ActsOn, Description, Kind, ParameterSpec, Scope, state};
use crate::law::Law;
use crate::numeric::number::Number;

state! {
    summary: "The drive takes a while to give what it is told.",
    equation: "q acts,  tau dq/dt = T - q",
}

pub(super) struct ActuatorLag;

impl Law for ActuatorLag {
    fn description(&self) -> &'static Description {
        &Description {
            name: "actuator_lag",
            kind: Kind::Drive,
            acts_on: ActsOn::Machines,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[ParameterSpec {
                name: "tau_s",
                meaning: "time constant with which the drive follows",
                unit: "s",
                starts: &[0.0, 0.004],
                minimum: 0.0,
                maximum: 0.02,
                limits: (0.0, 0.05),
                vanishes_at: Some(0.0),
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["acceleration_lag", "torque_delay"],
            excited_by: "commands that change within a few time constants",
            shows_as: "misfit that follows the command's slope and decays after each change",
            check: "Hold the rig still, step the command and measure the torque or current: it must rise as fast as the time constant says.",
            on_machine: None,
            valid_for: "a command, not a torque that was measured at the rig; one time constant at any size and either way",
            source: "Franklin, Powell and Emami-Naeini 2019, Feedback Control of Dynamic Systems, Pearson",
        }
    }

    #[inline(always)]
    fn actuator_lag_s<N: Number>(&self, p: &[N]) -> Option<N> {
        Some(p[0])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Effect;
    use crate::effects::trial::Trial;

    #[test]
    fn what_acts_is_behind_what_is_told() {
        assert_eq!(ActuatorLag.actuator_lag_s(&[0.003]), Some(0.003));
        let behind = |tau_s: f64| Trial::ramp().motion(Effect::ActuatorLag, &[tau_s])[1][500];
        assert!(behind(0.003) < behind(0.0));
    }

    /// As the torque begins to fall, what it gives has a kink of a tenth of a millisecond's slope.
    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::ActuatorLag, 1e-8);
    }
}
