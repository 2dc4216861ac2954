//! The fitted output reads ever more, or ever less: y + y1 t, in the output's own unit.
//!
//! y1 > 0 reads more as time goes on. Counted from where the record begins. In the residual a straight line through each recording.
//! In velocity this is what an accelerometer's bias makes of what is integrated from it.
//!
//! Valid for: a zero that moves at one rate while a recording lasts; what other channels are integrated from it does not follow.
//!
//! Source: drift of the output channel's zero, as of a sensor that warms up.

use crate::description::{
    ActsOn, Description, Kind, OUTPUT_UNIT_PER_SECOND, ParameterSpec, Scope, state,
};
use crate::law::{Kinematics, Law};
use crate::numeric::number::Number;

state! {
    summary: "The fitted output channel's zero moves while a recording lasts.",
    equation: "y + y1 t",
}

pub(super) struct OutputDrift;

impl Law for OutputDrift {
    fn description(&self) -> &'static Description {
        &Description {
            name: "output_drift",
            kind: Kind::Measurement,
            acts_on: ActsOn::Machines,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[ParameterSpec {
                name: "y1",
                meaning: "drift of the output",
                unit: OUTPUT_UNIT_PER_SECOND,
                starts: &[0.0],
                minimum: -10.0,
                maximum: 10.0,
                limits: (-1000.0, 1000.0),
                vanishes_at: Some(0.0),
                scope: Scope::PerTightening,
            }],
            states: &[],
            twins: &["torque_drift", "output_offset", "acceleration_bias"],
            excited_by: "nothing: it is there at rest, and grows",
            shows_as: "a straight line in the fitted output",
            check: "Read the fitted channel with the rig at rest for as long as a recording lasts: it must stay where it is.",
            on_machine: None,
            valid_for: "a zero that moves at one rate while a recording lasts",
            source: "JCGM 200:2012, International Vocabulary of Metrology: instrumental drift",
        }
    }

    #[inline(always)]
    fn measure<N: Number>(
        &self,
        p: &[N],
        since_rest_s: N::Real,
        seen: Kinematics<N>,
    ) -> Option<Kinematics<N>> {
        Some(seen.shifted(p[0].times(since_rest_s)))
    }
}

#[cfg(test)]
mod tests {
    use crate::effects::Effect;
    use crate::effects::trial::Trial;
    use crate::effects::{Law, trial};
    use snug_campaign::Quantity;

    /// y + y1 t from where the record begins, 1.48 s before the first sample.
    #[test]
    fn adds_a_straight_line_whatever_is_compared() {
        let trial = Trial::ramp().rested_before(1.48);
        let plain = trial.motion_of(&[], &[]);
        let drifting = trial.motion(Effect::OutputDrift, &[0.02]);
        for quantity in 0..3 {
            for sample in [0, 1230] {
                let elapsed_s = 1.48 + f64::from(sample) * trial::INTERVAL_S;
                let at = sample as usize;
                trial::assert_near(
                    drifting[quantity][at] - plain[quantity][at],
                    0.02 * elapsed_s,
                );
            }
        }
    }

    #[test]
    fn its_rate_is_told_in_the_output_s_unit_per_second() {
        let spec = &Effect::OutputDrift.description().parameters[0];
        let units = Quantity::ALL.map(|output| spec.unit_where(output));
        assert_eq!(units, ["rad/s", "rad/s^2", "rad/s^3"]);
    }
}
