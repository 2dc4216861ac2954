//! What the person does a reaction time after the pulse: a rise from 0 to 1 that begins at t_on and takes t_rise.

use crate::description::{ParameterSpec, Scope};
use crate::law::Instant;
use crate::numeric::number::Number;

/// t_on.
pub(crate) const ONSET: ParameterSpec = ParameterSpec {
    name: "onset_s",
    meaning: "begin after the pulse",
    unit: "s",
    starts: &[0.08, 0.04, 0.15, 0.22],
    minimum: 0.0,
    maximum: 0.3,
    limits: (0.0, 0.5),
    vanishes_at: None,
    scope: Scope::Shared,
};

/// t_rise.
pub(crate) const RISE: ParameterSpec = ParameterSpec {
    name: "rise_s",
    meaning: "duration of the rise",
    unit: "s",
    starts: &[0.05, 0.15],
    minimum: 0.01,
    maximum: 0.3,
    limits: (0.005, 0.5),
    vanishes_at: None,
    scope: Scope::Shared,
};

/// s((t − t_on)/t_rise), s(u) = u² (3 − 2u) from 0 to 1.
#[inline(always)]
pub(crate) fn rise<N: Number>(onset_s: N, rise_s: N, at: &Instant<N>) -> N {
    ((-onset_s).plus(at.since_onset_s) / rise_s).smooth_step()
}
