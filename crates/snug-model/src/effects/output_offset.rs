//! The fitted output has a constant offset: y + y0, in the output's own unit.
//!
//! y0 > 0 reads too much. Always there. In the residual a constant. In acceleration this is the same as `acceleration_bias`.
//!
//! Valid for: a zero that stays the same in the fitted channel while the tightening lasts; what other channels are integrated
//! from it does not follow.
//!
//! Source: sensor zero of the output channel.

use crate::description::{
    ActsOn, Description, Kind, OUTPUT_UNIT, OnMachine, ParameterSpec, Scope, state,
};
use crate::law::{Kinematics, Law};
use crate::numeric::number::Number;
use snug_campaign::Quantity;

state! {
    summary: "The fitted output channel does not read zero at rest.",
    equation: "y + y0",
}

pub(super) struct OutputOffset;

impl Law for OutputOffset {
    fn description(&self) -> &'static Description {
        &Description {
            name: "output_offset",
            kind: Kind::Measurement,
            acts_on: ActsOn::Anything,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[ParameterSpec {
                name: "y0",
                meaning: "offset",
                unit: OUTPUT_UNIT,
                starts: &[0.0],
                minimum: -10.0,
                maximum: 10.0,
                limits: (-1000.0, 1000.0),
                vanishes_at: Some(0.0),
                scope: Scope::PerTightening,
            }],
            states: &[],
            twins: &["torque_offset", "acceleration_bias"],
            excited_by: "nothing: it is there at rest",
            shows_as: "a constant in the fitted output",
            check: "Read the fitted channel with the tool at rest: it must show zero.",
            on_machine: Some(OnMachine {
                summary: None,
                shows_as: None,
                check: "Read the fitted channel with the rig at rest: it must show zero.",
            }),
            valid_for: "a zero of the fitted channel that does not drift within a tightening",
            source: "JCGM 200:2012, International Vocabulary of Metrology: zero error",
        }
    }

    #[inline(always)]
    fn measure<N: Number>(
        &self,
        p: &[N],
        _since_rest_s: N::Real,
        seen: Kinematics<N>,
    ) -> Option<Kinematics<N>> {
        Some(seen.shifted(p[0]))
    }

    fn same_as(&self, compared: Quantity) -> Option<&'static str> {
        (compared == Quantity::Acceleration).then_some("acceleration_bias")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Effect;
    use crate::effects::trial;
    use crate::effects::trial::Trial;

    #[test]
    fn adds_a_constant_whatever_is_compared() {
        let trial = Trial::ramp();
        let plain = trial.motion_of(&[], &[]);
        let shifted = trial.motion(Effect::OutputOffset, &[0.02]);
        for quantity in 0..3 {
            trial::assert_near(shifted[quantity][1230] - plain[quantity][1230], 0.02);
        }
    }

    #[test]
    fn is_the_bias_where_acceleration_is_compared() {
        let same = |compared| OutputOffset.same_as(compared);
        assert_eq!(same(Quantity::Acceleration), Some("acceleration_bias"));
        assert_eq!(same(Quantity::Velocity), None);
        assert_eq!(same(Quantity::Displacement), None);
    }
}
