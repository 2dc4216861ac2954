//! The operator pushes back on purpose: +F = F_v s((t − t_on)/t_rise), s(u) = u² (3 − 2u) from 0 to 1.
//!
//! t counts from the onset of the pulse as the input states it. F_v > 0 pushes against the displacement; F_v = 0 is the base
//! model. Excited by itself. In the residual a slow, one-sided shift that comes late and stays.
//!
//! Valid for: one push per tightening that then stays, in windows that last beyond t_on; it does not depend on the motion.
//!
//! Source: voluntary reaction, 100 ms and more after the stimulus.

use crate::description::{ActsOn, Description, Kind, ParameterSpec, Scope, state};
use crate::law::{Instant, Law};
use crate::numeric::number::Number;
use crate::reaction;

state! {
    summary: "The operator pushes against the tool on purpose, a reaction time after the onset.",
    equation: "F + F_v s((t - t_on) / t_rise)",
}

pub(super) struct VoluntaryPush;

impl Law for VoluntaryPush {
    fn description(&self) -> &'static Description {
        &Description {
            name: "voluntary_push",
            kind: Kind::Muscular,
            acts_on: ActsOn::Anything,
            summary: SUMMARY,
            equation: EQUATION,
            parameters: &[
                ParameterSpec {
                    name: "f_n",
                    meaning: "push",
                    unit: "N",
                    starts: &[2.0],
                    minimum: -50.0,
                    maximum: 50.0,
                    limits: (-500.0, 500.0),
                    vanishes_at: Some(0.0),
                    scope: Scope::Shared,
                },
                reaction::ONSET,
                reaction::RISE,
            ],
            states: &[],
            twins: &["torque_offset"],
            excited_by: "nothing: it comes with the person",
            shows_as: "misfit that is one-sided, comes late and stays",
            check: "Let somebody else start the tool so that the operator does not know when: a push on purpose then comes later or not at all.",
            on_machine: None,
            valid_for: "one push per tightening that then stays, in windows that last beyond t_on; whatever the motion",
            source: "Hammond 1956, The influence of prior instruction to the subject on an apparently involuntary neuro-muscular response, Journal of Physiology 132",
        }
    }

    #[inline(always)]
    fn force<N: Number>(&self, p: &[N], at: &Instant<N>, _own: &[N]) -> Option<N> {
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
    fn comes_late_and_stays() {
        for (f_n, onset_s, expected_n) in [
            (10.0, 0.2, 0.0),
            (10.0, 0.05, 5.0),
            (-10.0, 0.05, -5.0),
            (10.0, -0.2, 10.0),
            (0.0, 0.05, 0.0),
        ] {
            let found_n = trial::force(&VoluntaryPush, &[f_n, onset_s, 0.1], 0.0, 0.0);
            trial::assert_near(found_n, expected_n);
        }
    }

    #[test]
    fn moves_as_scipy_says() {
        Trial::ramp().agrees_with_scipy(Effect::VoluntaryPush, 1e-9);
    }
}
