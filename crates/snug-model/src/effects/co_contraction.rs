//! The operator braces: k becomes k (1 + r s((t − t_on)/t_rise)), s(u) = u² (3 − 2u) from 0 to 1.
//!
//! t counts from the onset of the pulse as the input states it. r > 0 stiffens; r = 0 is the base model. A spring that
//! stiffens while stretched takes energy from the muscle. Excited by displacement after t_on. In the residual the second
//! half of the motion is quicker than the first.
//!
//! Valid for: one rise per tightening, r > −1, in windows that last beyond t_on with the hand still displaced; any amplitude.
//!
//! Source: antagonist co-activation raises joint stiffness (Hogan 1984).

use crate::description::{ActsOn, Description, Kind, ParameterSpec, Scope, state};
use crate::law::{Instant, Law};
use crate::numeric::number::Number;
use crate::reaction;

state! {
    summary: "The operator tenses the arm during the pulse and becomes stiffer.",
    equation: "k (1 + r s((t - t_on) / t_rise))",
}

pub(super) struct CoContraction;

impl Law for CoContraction {
    fn description(&self) -> &'static Description {
        &Description {
            name: "co_contraction",
            kind: Kind::Muscular,
            acts_on: ActsOn::Anything,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[
                ParameterSpec {
                    name: "rise_ratio",
                    meaning: "rise of the stiffness (1 = doubled)",
                    unit: "1",
                    starts: &[0.1],
                    minimum: -0.9,
                    maximum: 4.0,
                    limits: (-0.99, 40.0),
                    vanishes_at: Some(0.0),
                    scope: Scope::Shared,
                },
                reaction::ONSET,
                reaction::RISE,
            ],
            states: &[],
            twins: &["cubic_stiffness", "grip_slip"],
            excited_by: "displacement that lasts beyond the reaction time",
            shows_as: "late misfit in proportion to the displacement: the way back is quicker than the way out",
            check: "Ask the operator to grip as firmly before the pulse as during it (watch the grip force): the stiffening should go away.",
            on_machine: None,
            valid_for: "one rise per tightening, r > -1, while the hand is still displaced after t_on; any amplitude",
            source: "Hogan 1984, Adaptive control of mechanical impedance by coactivation of antagonist muscles, IEEE Transactions on Automatic Control 29",
        }
    }

    #[inline(always)]
    fn stiffening<N: Number>(&self, p: &[N], at: &Instant<N>) -> Option<N> {
        Some(p[0] * reaction::rise(p[1], p[2], at))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Effect;
    use crate::effects::trial;
    use crate::effects::trial::Trial;

    #[test]
    fn stiffens_late_and_stays_so() {
        for (ratio, onset_s, expected) in [
            (0.4, 0.2, 0.0),
            (0.4, 0.05, 0.2),
            (-0.4, -0.2, -0.4),
            (0.0, 0.05, 0.0),
        ] {
            let p = [ratio, onset_s, 0.1];
            let found = CoContraction.stiffening(&p, &trial::at(0.01, 0.0));
            trial::assert_near(found.expect("bracing stiffens"), expected);
        }
    }

    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::CoContraction, 1e-9);
    }
}
