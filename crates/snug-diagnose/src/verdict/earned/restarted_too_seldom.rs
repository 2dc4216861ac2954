//! Whether a model of a rig that pushes itself away is restarted after it has fallen away: what it then predicts is errors of the motion
//! that it took up, grown large.

use crate::data::cases::Cases;
use crate::pooled::equation::values;
use crate::pooled::fitted::Fitted;
use crate::verdict::thresholds::FALLEN_AWAY;
use snug_campaign::words::suspicion::RestartedTooSeldom;
use snug_identify::{FEWEST_APART, FitTask};

/// The recording that falls furthest by how `fitted` says it falls, if that is too far and it can be restarted sooner.
pub(crate) fn restarted_too_seldom(
    cases: Cases<'_>,
    fitted: &Fitted,
) -> Option<RestartedTooSeldom> {
    if !cases.are_restarted() {
        return None;
    }
    let of_each = cases.iter().zip(values(cases, fitted)?);
    let of_each = of_each.filter_map(|(case, values)| of_one(case, &values));
    of_each.max_by(|a, b| (a.every_s / a.falls_in_s).total_cmp(&(b.every_s / b.falls_in_s)))
}

/// Of a recording whose model has these `values` of its parameters.
fn of_one(case: &FitTask<'_>, values: &[f64]) -> Option<RestartedTooSeldom> {
    let &[mass, _, stiffness, ..] = values else {
        return None;
    };
    let (rig, interval_s) = (case.model.rig(), case.tightening.time_base.interval_s);
    let square = rig.lever_arm_m * rig.lever_arm_m;
    let inertia = rig.known_inertia_kg_m2 + mass * square;
    let falls_in_s = (inertia / (-stiffness * square)).sqrt();
    let every_s = case.input.samples_between_restarts()? as f64 * interval_s;
    let can_be_sooner = falls_in_s >= FEWEST_APART as f64 * interval_s;
    // Of a spring that brings back it is no number.
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

    /// A rig restarted every 20 samples, of mass 2 kg, that falls away in so many samples.
    fn told(falls_in_samples: f64) -> Option<RestartedTooSeldom> {
        let mut case = exact(0, &[], &[]);
        let motions = vec![[0.0; 2]; case.measured().len().div_ceil(20)];
        case.input = Cow::Owned(case.input.into_owned().with_restarts(20, motions));
        let (rig, interval_s) = (case.model.rig(), case.tightening.time_base.interval_s);
        let square = rig.lever_arm_m * rig.lever_arm_m;
        let inertia = rig.known_inertia_kg_m2 + 2.0 * square;
        let stiffness = -inertia / square / (falls_in_samples * interval_s).powi(2);
        of_one(&case, &[2.0, 1.0, stiffness])
    }

    #[test]
    fn a_model_that_has_fallen_away_before_its_next_restart_is_told() {
        let found = told(9.0).unwrap();
        assert!((found.every_s / found.falls_in_s - 20.0 / 9.0).abs() < 1e-9);
        assert_eq!(told(20.0), None, "as often as is advised");
        assert_eq!(told(5.0), None, "it cannot be restarted sooner");
    }

    #[test]
    fn what_a_spring_brings_back_falls_nowhere() {
        let mut case = exact(0, &[], &[]);
        case.input = Cow::Owned(
            case.input
                .into_owned()
                .with_restarts(20, vec![[0.0; 2]; 100]),
        );
        assert_eq!(of_one(&case, &[2.0, 1.0, 1e6]), None);
    }
}
