//! The measured acceleration a is the true α through a first-order lag: τ a' = α − a.
//!
//! The measured velocity and displacement are integrated from a, from rest: ω − τ a, and from it θ − τ (ω − τ a).
//! Parameter: tau_s \[s\], 0 to 0.02. Excited by fast torque changes. In the residual it follows dα/dt.
//! Source: low-pass filter of the accelerometer.

use crate::numeric::number::Number;
use crate::effect::{Description, Kind, Law, ParameterSpec, Scope};

pub struct AccelerationLag;

impl Law for AccelerationLag {
    fn description(&self) -> &'static Description {
        &Description {
            name: "acceleration_lag",
            kind: Kind::Measurement,
            summary: "The acceleration channel is filtered more than the torque channel.",
            equation: "a + tau da/dt = alpha",
            parameters: &[ParameterSpec {
                name: "tau_s",
                meaning: "time constant of the lag",
                unit: "s",
                starts: &[0.0, 0.004],
                minimum: 0.0,
                maximum: 0.02,
                limits: (0.0, 0.05),
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["torque_delay", "torque_lag"],
            excited_by: "fast torque changes: shut-off, hard joints",
            shows_as: "misfit that follows the acceleration's slope",
            check: "Look up the low-pass filter of the acceleration channel, and compare its step response with the torque channel's.",
            source: "low-pass filter of the accelerometer",
        }
    }

    #[inline(always)]
    fn acceleration_lag_s<N: Number>(&self, p: &[N]) -> Option<N> {
        Some(p[0])
    }

    fn measurement_only(&self) -> bool {
        true
    }
}
