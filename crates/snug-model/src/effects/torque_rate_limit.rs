//! A drive that changes what it gives no faster than it can: of the torque u that it is told, q acts,
//!
//! ```text
//! q follows u with |q'| ≤ R
//! ```
//!
//! R without limit is the base model. Excited by commands that jump. In the residual it stands after every jump of the command, for as long as
//! the jump is large, and straight.
//!
//! Valid for: a command, not a torque that was measured at the rig; one limit up and down.
//!
//! Source: ramp of a frequency converter, most flow of a valve, rate limit of a servo.

use crate::description::{ActsOn, Description, Kind, ParameterSpec, Scope, state};
use crate::law::Law;
use crate::numeric::number::Number;

state! {
    summary: "The drive changes what it gives no faster than it can.",
    equation: "q acts,  q follows T with |dq/dt| <= R",
}

pub(super) struct TorqueRateLimit;

impl Law for TorqueRateLimit {
    fn description(&self) -> &'static Description {
        &Description {
            name: "torque_rate_limit",
            kind: Kind::Drive,
            acts_on: ActsOn::Machines,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[ParameterSpec {
                name: "rate_nm_per_s",
                meaning: "most by which what the drive gives changes",
                unit: "Nm/s",
                starts: &[250.0, 80.0, 800.0],
                minimum: 5.0,
                maximum: 20_000.0,
                limits: (0.1, 1e6),
                vanishes_at: Some(1e9),
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["actuator_lag", "second_mode"],
            excited_by: "commands that jump by more than the drive follows in a sample",
            shows_as: "misfit after each jump of the command, the longer the larger the jump",
            check: "Hold the rig still, step the command by a little and by a lot, and measure the torque or current: a limited rate rises straight and takes longer the larger the step. Look up the drive's ramp time.",
            on_machine: None,
            valid_for: "a command, not a torque that was measured at the rig; one limit up and down",
            source: "Tao and Kokotovic 1996, Adaptive Control of Systems with Actuator and Sensor Nonlinearities, Wiley",
        }
    }

    #[inline(always)]
    fn actuator_rate_nm_per_s<N: Number>(&self, p: &[N]) -> Option<N> {
        Some(p[0])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Effect;
    use crate::effects::trial::Trial;

    #[test]
    fn what_acts_is_behind_what_is_told_too_fast() {
        assert_eq!(
            TorqueRateLimit.actuator_rate_nm_per_s(&[250.0]),
            Some(250.0)
        );
        let behind = |rate: f64| Trial::ramp().motion(Effect::TorqueRateLimit, &[rate])[1][500];
        assert!(behind(250.0) < behind(1e9));
    }

    /// It follows the ramp up and falls for 60 ms where the torque ends at once.
    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::TorqueRateLimit, 1e-6);
    }
}
