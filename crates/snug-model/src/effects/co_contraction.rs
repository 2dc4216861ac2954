//! The operator braces: k becomes k (1 + r s((t − t_on)/t_rise)), s(u) = u² (3 − 2u) from 0 to 1.
//!
//! t counts from the onset of the pulse as the input states it. Parameters: rise_ratio −0.9 to 4, onset_s 0 to 0.3 s, rise_s
//! 0.01 to 0.3 s; r = 0 is the base model. A spring that stiffens while stretched takes energy from the muscle. Excited by
//! displacement after t_on. In the residual the second half of the motion is quicker than the first.
//! Source: antagonist co-activation raises joint stiffness (Hogan 1984).

use crate::numeric::number::Number;
use crate::reaction;
use crate::effect::{Description, Instant, Kind, Law, ParameterSpec, Scope};

pub struct CoContraction;

impl Law for CoContraction {
    fn description(&self) -> &'static Description {
        &Description {
            name: "co_contraction",
            kind: Kind::Muscular,
            summary: "The operator tenses the arm during the pulse and becomes stiffer.",
            equation: "k (1 + r s((t - t_on) / t_rise))",
            parameters: &[ParameterSpec {
                name: "rise_ratio",
                meaning: "rise of the stiffness (1 = doubled)",
                unit: "1",
                starts: &[0.1],
                minimum: -0.9,
                maximum: 4.0,
                limits: (-0.99, 40.0),
                scope: Scope::Shared,
            }, reaction::ONSET, reaction::RISE],
            states: &[],
            twins: &["cubic_stiffness", "grip_slip"],
            excited_by: "displacement that lasts beyond the reaction time",
            shows_as: "late misfit in proportion to the displacement: the way back is quicker than the way out",
            check: "Ask the operator to grip as firmly before the pulse as during it (watch the grip force): the stiffening should go away.",
            source: "Hogan 1984, antagonist co-activation",
        }
    }

    #[inline(always)]
    fn stiffening<N: Number>(&self, p: &[N], at: &Instant<N>) -> Option<N> {
        Some(p[0] * reaction::rise(p[1], p[2], at))
    }
}
