//! The measured acceleration a is the true α through a first-order lag: τ a' = α − a.
//!
//! The measured velocity and displacement are integrated from a, from rest: ω − τ a, and from it θ − τ (ω − τ a); a velocity or an
//! angle that a filter of its own lets through late is the same. So is, as far as the rig is linear, a drive whose torque follows
//! its command late. Excited by fast torque changes. In the residual it follows dα/dt.
//!
//! Valid for: filters of first order, τ ≥ 0, all channels behind the same filter, at rest before the first sample. Any amplitude.
//!
//! Source: low-pass filter of the sensor; current loop of a drive.

use crate::description::{ActsOn, Description, Kind, OnMachine, ParameterSpec, Scope, state};
use crate::law::Law;
use crate::numeric::number::Number;

state! {
    summary: "The motion channel is filtered more than the torque channel.",
    equation: "y + tau dy/dt is the true motion, y is measured",
}

pub(super) struct AccelerationLag;

impl Law for AccelerationLag {
    fn description(&self) -> &'static Description {
        &Description {
            name: "acceleration_lag",
            kind: Kind::Measurement,
            acts_on: ActsOn::Anything,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[ParameterSpec {
                name: "tau_s",
                meaning: "time constant of the lag",
                unit: "s",
                starts: &[0.0, 0.004],
                minimum: 0.0,
                maximum: 0.02,
                limits: (0.0, 0.05),
                vanishes_at: Some(0.0),
                scope: Scope::Shared,
            }],
            states: &[],
            twins: &["torque_delay", "torque_lag"],
            excited_by: "fast torque changes: shut-off, hard joints",
            shows_as: "misfit that follows the acceleration's slope",
            check: "Look up the low-pass filter of the motion channel, and compare its step response with the torque channel's.",
            on_machine: Some(OnMachine {
                summary: Some(
                    "The measured motion is filtered, or the torque follows its command late.",
                ),
                shows_as: None,
                check: "Look up the filter of the speed or angle signal and the time constant of the drive's current loop.",
            }),
            valid_for: "filters of first order, one for all channels of the motion, rest before the first sample; any amplitude",
            source: "Ljung 1999, System Identification: Theory for the User, Prentice Hall",
        }
    }

    #[inline(always)]
    fn acceleration_lag_s<N: Number>(&self, p: &[N]) -> Option<N> {
        Some(p[0])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Effect;
    use crate::effects::trial::Trial;

    #[test]
    fn what_is_measured_is_behind() {
        assert_eq!(AccelerationLag.acceleration_lag_s(&[0.003]), Some(0.003));
        let behind = |tau_s: f64| Trial::ramp().motion(Effect::AccelerationLag, &[tau_s])[2][500];
        assert!(behind(0.003) < behind(0.0));
    }

    /// The acceleration is taken as straight between samples.
    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::AccelerationLag, 2e-6);
    }
}
