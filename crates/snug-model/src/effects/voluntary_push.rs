//! The operator pushes back on purpose: +F = F_v s((t − t_on)/t_rise), s(u) = u² (3 − 2u) from 0 to 1.
//!
//! t counts from the onset of the pulse as the input states it. Parameters: f_n −50 to 50 N (> 0 pushes against the
//! displacement), onset_s 0 to 0.3 s, rise_s 0.01 to 0.3 s; F_v = 0 is the base model. Excited by itself. In the residual a
//! slow, one-sided shift that comes late and stays. Source: voluntary reaction, 100 ms and more after the stimulus.

use crate::numeric::number::Number;
use crate::reaction;
use crate::effect::{Description, Instant, Kind, Law, ParameterSpec, Scope};

pub struct VoluntaryPush;

impl Law for VoluntaryPush {
    fn description(&self) -> &'static Description {
        &Description {
            name: "voluntary_push",
            kind: Kind::Muscular,
            summary: "The operator pushes against the tool on purpose, a reaction time after the onset.",
            equation: "F + F_v s((t - t_on) / t_rise)",
            parameters: &[ParameterSpec {
                name: "f_n",
                meaning: "push",
                unit: "N",
                starts: &[2.0],
                minimum: -50.0,
                maximum: 50.0,
                limits: (-500.0, 500.0),
                scope: Scope::Shared,
            }, reaction::ONSET, reaction::RISE],
            states: &[],
            twins: &["torque_offset"],
            excited_by: "nothing: it comes with the person",
            shows_as: "misfit that is one-sided, comes late and stays",
            check: "Let somebody else start the tool so that the operator does not know when: a push on purpose then comes later or not at all.",
            source: "voluntary reaction times",
        }
    }

    #[inline(always)]
    fn force<N: Number>(&self, p: &[N], at: &Instant<N>, _own: &[N]) -> Option<N> {
        Some(p[0] * reaction::rise(p[1], p[2], at))
    }
}
