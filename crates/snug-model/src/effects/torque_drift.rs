//! The torque sensor reads ever more, or ever less: T − T1 t acts where T is logged.
//!
//! T1 > 0 is a sensor that reads more as time goes on. Counted from where the pulse or the record begins. In the residual what a torque
//! does that grows evenly: behind a spring a straight line, as of an output that drifts; dry friction tells them apart.
//!
//! Valid for: a zero that moves at one rate while a recording lasts.
//!
//! Source: drift of the torque sensor's zero, as of strain gauges that warm up.

use crate::description::{ActsOn, Description, Kind, ParameterSpec, Scope, state};
use crate::law::{Instant, Law};
use crate::numeric::number::Number;

state! {
    summary: "The torque sensor's zero moves while a recording lasts.",
    equation: "T - T1 t acts, T is logged",
}

pub(super) struct TorqueDrift;

impl Law for TorqueDrift {
    fn description(&self) -> &'static Description {
        &Description {
            name: "torque_drift",
            kind: Kind::Measurement,
            acts_on: ActsOn::Machines,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[ParameterSpec {
                name: "drift_nm_per_s",
                meaning: "drift of the torque",
                unit: "Nm/s",
                starts: &[0.0],
                minimum: -20.0,
                maximum: 20.0,
                limits: (-500.0, 500.0),
                vanishes_at: Some(0.0),
                scope: Scope::PerTightening,
            }],
            states: &[],
            twins: &["output_drift", "torque_offset"],
            excited_by: "nothing: it is there at rest, and grows",
            shows_as: "what a torque does that grows evenly",
            check: "Read the torque sensor with no load for as long as a recording lasts: it must stay where it is.",
            on_machine: None,
            valid_for: "a zero that moves at one rate while a recording lasts",
            source: "JCGM 200:2012, International Vocabulary of Metrology: instrumental drift",
        }
    }

    #[inline(always)]
    fn torque<N: Number>(&self, p: &[N], at: &Instant<N>) -> Option<N> {
        Some(-p[0].times(at.since_onset_s))
    }
}

#[cfg(test)]
mod tests {
    use crate::effects::Effect;
    use crate::effects::trial::Trial;

    /// From the onset at 20 ms on less acts than is logged, before it more.
    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::TorqueDrift, 1e-8);
    }
}
