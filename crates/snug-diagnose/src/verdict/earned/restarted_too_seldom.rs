//! Whether a model of a rig that pushes itself away is restarted after it has fallen away: what it then predicts is errors of the motion
//! that it took up, grown large.

use crate::data::cases::Cases;
use crate::pooled::equation::values;
use crate::pooled::fitted::Fitted;
use crate::verdict::pushed_away::{falls_in_s, pushed_away};
use crate::verdict::thresholds::FALLEN_AWAY;
use snug_campaign::words::suspicion::RestartedTooSeldom;
use snug_identify::{FEWEST_APART, FitTask};

/// The recording that falls furthest, if that is too far and it can be restarted sooner: by how a plain regression says that the rig falls, for
/// a fit of predictions that have fallen away may end at any stiffness, and where it does not say so by what is `fitted`.
pub(crate) fn restarted_too_seldom(
    cases: Cases<'_>,
    fitted: &Fitted,
) -> Option<RestartedTooSeldom> {
    if !cases.are_restarted() {
        return None;
    }
    let fall_in_s = match pushed_away(&cases) {
        Some(pushes) => vec![pushes.falls_in_s; cases.len()],
        None => {
            let each = cases.iter().zip(values(cases, fitted)?);
            each.map(|(case, values)| falls_in_s(case, [values[0], values[2]]))
                .collect()
        }
    };
    let of_each = cases.iter().zip(fall_in_s);
    let of_each = of_each.filter_map(|(case, falls_in_s)| of_one(case, falls_in_s));
    of_each.max_by(|a, b| (a.every_s / a.falls_in_s).total_cmp(&(b.every_s / b.falls_in_s)))
}

/// Of a recording that falls away in this time, which is no number of one that does not.
fn of_one(case: &FitTask<'_>, falls_in_s: f64) -> Option<RestartedTooSeldom> {
    let interval_s = case.tightening.time_base.interval_s;
    let every_s = case.input.samples_between_restarts()? as f64 * interval_s;
    let can_be_sooner = falls_in_s >= FEWEST_APART as f64 * interval_s;
    (can_be_sooner && every_s > FALLEN_AWAY * falls_in_s).then_some(RestartedTooSeldom {
        every_s,
        falls_in_s,
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::tests::made_up::exact;
    use std::borrow::Cow;

    /// A rig restarted every 20 samples that falls away in so many samples.
    fn told(falls_in_samples: f64) -> Option<RestartedTooSeldom> {
        let mut case = exact(0, &[], &[]);
        let motions = vec![[0.0; 2]; case.measured().len().div_ceil(20)];
        case.input = Cow::Owned(case.input.into_owned().with_restarts(20, motions));
        let interval_s = case.tightening.time_base.interval_s;
        of_one(&case, falls_in_samples * interval_s)
    }

    #[test]
    fn a_model_that_has_fallen_away_before_its_next_restart_is_told() {
        let found = told(9.0).unwrap();
        assert!((found.every_s / found.falls_in_s - 20.0 / 9.0).abs() < 1e-9);
        assert_eq!(told(20.0), None, "as often as is advised");
        assert_eq!(told(5.0), None, "it cannot be restarted sooner");
        assert_eq!(told(f64::NAN), None, "a spring brings it back");
    }
}
