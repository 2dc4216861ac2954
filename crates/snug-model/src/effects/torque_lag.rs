//! The logged torque y is the acting torque T through a first-order lag: τ y' = T − y, so T = y + τ y' acts.
//!
//! y' is taken over as many milliseconds as the torque's course allows, since τ multiplies its noise. Excited by fast torque
//! changes (shut-off). In the residual it follows dT/dt, with an echo of d²T/dt² that a plain delay does not have.
//!
//! Valid for: filters of first order, τ ≥ 0, torque that changes over more than the few samples y' is taken over. Any
//! amplitude.
//!
//! Source: low-pass filter of the torque channel.

use crate::description::{ActsOn, Description, Kind, ParameterSpec, Scope, state};
use crate::law::{Law, LoggedTorque};
use crate::numeric::number::Number;

state! {
    summary: "The torque channel is filtered more than the acceleration channel.",
    equation: "T + tau dT/dt acts, T is logged",
}

pub(super) struct TorqueLag;

impl Law for TorqueLag {
    fn description(&self) -> &'static Description {
        &Description {
            name: "torque_lag",
            kind: Kind::Measurement,
            acts_on: ActsOn::Anything,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[ParameterSpec {
                name: "tau_s",
                meaning: "time constant of the lag",
                unit: "s",
                starts: &[0.0],
                minimum: 0.0,
                maximum: 0.02,
                limits: (0.0, 0.05),
                vanishes_at: Some(0.0),
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["torque_delay", "acceleration_lag"],
            excited_by: "fast torque changes: shut-off, hard joints",
            shows_as: "misfit that follows dT/dt",
            check: "Look up the low-pass filter of the torque channel, and compare its step response with the acceleration channel's.",
            on_machine: None,
            valid_for: "filters of first order, torque that changes over more than a few samples; any amplitude",
            source: "Ljung 1999, System Identification: Theory for the User, Prentice Hall",
        }
    }

    #[inline(always)]
    fn logged_torque<N: Number>(&self, p: &[N]) -> Option<LoggedTorque<N>> {
        Some(LoggedTorque {
            lag_s: p[0],
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
    fn what_acts_is_ahead_of_what_is_logged() {
        let logged = TorqueLag.logged_torque(&[0.003]);
        let logged = logged.expect("it is how torque is logged");
        assert_eq!(
            (logged.lag_s, logged.delay_s, logged.offset_nm),
            (0.003, 0.0, 0.0)
        );
        let ahead = |tau_s: f64| Trial::sine_squared().motion(Effect::TorqueLag, &[tau_s])[0][500];
        assert!(ahead(0.003) > ahead(0.0));
    }

    /// The torque's slope is that of a line over m = 5 samples on either side: Δ² (3m² + 3m − 1)/30 of its second derivative
    /// off, which with this torque and τ is 2e-6 of the acceleration and 3e-6 of the velocity.
    #[test]
    fn moves_as_scipy_says() {
        Trial::sine_squared().agrees_with_scipy(Effect::TorqueLag, 5e-6);
    }
}
