//! The logged torque is early by d: the torque that acts at time t is the logged torque of t − d.
//!
//! Excited by fast torque changes (shut-off). Its residual follows dT/dt. Half a sample of delay already looks like
//! physics. Source: channel timing of separate amplifiers and filters.

use crate::numeric::number::Number;
use crate::effect::{Description, Kind, Law, LoggedTorque, ParameterSpec, Scope};

pub struct TorqueDelay;

impl Law for TorqueDelay {
    fn description(&self) -> &'static Description {
        &Description {
            name: "torque_delay",
            kind: Kind::Measurement,
            summary: "The torque channel runs ahead of (or behind) the acceleration channel.",
            equation: "T(t) -> T(t - d)",
            parameters: &[ParameterSpec {
                name: "delay_s",
                meaning: "delay",
                unit: "s",
                starts: &[0.0],
                minimum: -0.01,
                maximum: 0.01,
                limits: (-0.03, 0.03),
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["torque_lag", "acceleration_lag"],
            excited_by: "fast torque changes: shut-off, hard joints",
            shows_as: "misfit that follows dT/dt",
            check: "Feed one pulse to both channels and compare their edges; look for different filters or acquisition cards.",
            source: "channel timing",
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
