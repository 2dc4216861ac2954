//! The logged torque is early by d: the torque that acts at time t is the logged torque of t − d.
//!
//! Excited by fast torque changes (shut-off). Its residual follows dT/dt. Half a sample of delay already looks like
//! physics. Source: channel timing of separate amplifiers and filters.

use crate::effect::{Description, Kind, Law, ParameterSpec, Scope};
use crate::{Input, Number};

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
                unit: "s",
                starts: &[0.0],
                minimum: -0.01,
                maximum: 0.01,
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["torque_lag", "acceleration_lag"],
            excited_by: "fast torque changes: shut-off, hard joints",
            shows_as: "misfit that follows dT/dt",
            source: "channel timing",
        }
    }

    #[inline(always)]
    fn torque<N: Number>(&self, p: &[N], input: &Input, time_s: f64) -> N {
        let now = input.at(time_s).0;
        let (then, slope) = input.at(time_s - p[0].value());
        p[0].chain(then - now, -slope)
    }
}
