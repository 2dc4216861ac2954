//! The logged torque y is the acting torque T through a first-order lag: τ y' = T − y, so T = y + τ y' acts.
//!
//! y' is taken over as many milliseconds as the torque's course allows, since τ multiplies its noise.
//! Parameter: tau_s \[s\], 0 to 0.02. Excited by fast torque changes (shut-off). In the residual it follows dT/dt, with an echo
//! of d²T/dt² that a plain delay does not have. Source: low-pass filter of the torque channel.

use crate::numeric::number::Number;
use crate::effect::{Description, Kind, Law, LoggedTorque, ParameterSpec, Scope};

pub struct TorqueLag;

impl Law for TorqueLag {
    fn description(&self) -> &'static Description {
        &Description {
            name: "torque_lag",
            kind: Kind::Measurement,
            summary: "The torque channel is filtered more than the acceleration channel.",
            equation: "T + tau dT/dt acts, T is logged",
            parameters: &[ParameterSpec {
                name: "tau_s",
                meaning: "time constant of the lag",
                unit: "s",
                starts: &[0.0],
                minimum: 0.0,
                maximum: 0.02,
                limits: (0.0, 0.05),
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["torque_delay", "acceleration_lag"],
            excited_by: "fast torque changes: shut-off, hard joints",
            shows_as: "misfit that follows dT/dt",
            check: "Look up the low-pass filter of the torque channel, and compare its step response with the acceleration channel's.",
            source: "low-pass filter of the torque channel",
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
