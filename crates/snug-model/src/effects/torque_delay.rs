//! The logged torque is early by d: the torque that acts at time t is the logged torque of t − d.
//!
//! d < 0 is a torque that is logged late. Excited by fast torque changes (shut-off). Its residual follows dT/dt. Half a sample
//! of delay already looks like physics.
//!
//! Valid for: one and the same delay at all frequencies and in all tightenings, and torque sampled finely enough that it is
//! known between samples. Any amplitude.
//!
//! Source: channel timing of separate amplifiers and filters.

use crate::description::{ActsOn, Description, Kind, ParameterSpec, Scope, state};
use crate::law::{Law, LoggedTorque};
use crate::numeric::number::Number;

state! {
    summary: "The torque channel runs ahead of (or behind) the acceleration channel.",
    equation: "T(t) -> T(t - d)",
}

pub(super) struct TorqueDelay;

impl Law for TorqueDelay {
    fn description(&self) -> &'static Description {
        &Description {
            name: "torque_delay",
            kind: Kind::Measurement,
            acts_on: ActsOn::Anything,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[ParameterSpec {
                name: "delay_s",
                meaning: "delay",
                unit: "s",
                starts: &[0.0],
                minimum: -0.01,
                maximum: 0.01,
                limits: (-0.03, 0.03),
                vanishes_at: Some(0.0),
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["torque_lag", "acceleration_lag"],
            excited_by: "fast torque changes: shut-off, hard joints",
            shows_as: "misfit that follows dT/dt",
            check: "Feed one pulse to both channels and compare their edges; look for different filters or acquisition cards.",
            on_machine: None,
            valid_for: "a delay that is the same at all frequencies, torque sampled finely enough to be known between samples; any amplitude",
            source: "Ljung 1999, System Identification: Theory for the User, Prentice Hall",
        }
    }

    #[inline(always)]
    fn logged_torque<N: Number>(&self, p: &[N]) -> Option<LoggedTorque<N>> {
        Some(LoggedTorque {
            delay_s: p[0],
            ..LoggedTorque::faithful(p[0])
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Effect;
    use crate::effects::trial::Trial;

    #[test]
    fn a_positive_one_acts_later_than_it_is_logged() {
        let logged = TorqueDelay.logged_torque(&[0.004]);
        let logged = logged.expect("it is how torque is logged");
        assert_eq!(
            (logged.delay_s, logged.lag_s, logged.offset_nm),
            (0.004, 0.0, 0.0)
        );
        let late = |delay_s: f64| Trial::ramp().motion(Effect::TorqueDelay, &[delay_s])[0][700];
        assert!(late(0.004) < late(0.0) && late(0.0) < late(-0.004));
    }

    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::TorqueDelay, 1e-9);
    }
}
