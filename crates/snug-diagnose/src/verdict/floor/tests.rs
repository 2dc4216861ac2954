//! What is said of fits that were lost on purpose.
#![allow(clippy::unwrap_used)]

use super::*;
use crate::data::cases::Tally;
use crate::tests::made_up::machine_with_friction as machine;
use snug_model::Effect;
use std::borrow::Cow;

/// m, c, k of the machine.
const TRUTH: [f64; 3] = [0.4, 1.9, 30.0];
const SAMPLES: usize = 3000;
/// Samples from one restart to the next.
const APART: usize = 10;

/// What is said of a fit of the base model that ended at these numbers and explains nothing of the output.
fn said(friction_nm: f64, values: [f64; 3], were_tried: bool) -> Option<FailedFit> {
    said_leaving(1e12, friction_nm, values, were_tried)
}

/// The same of one that leaves so much of the output.
fn said_leaving(
    squares: f64,
    friction_nm: f64,
    values: [f64; 3],
    were_tried: bool,
) -> Option<FailedFit> {
    let cases = [machine(friction_nm)];
    let fitted = ended_at(values, squares);
    let tally = Tally::default();
    let plain = PlainEquation::of(&cases)?;
    shortfall(&plain, Cases::new(&cases, &tally), &fitted, were_tried)
}

/// A fit of the base model that ended at these numbers and leaves so much of the output.
fn ended_at(values: [f64; 3], squares: f64) -> Fitted {
    let names = ["mass_kg", "damping_kg_per_s", "stiffness_n_per_m"];
    let fitted = Fitted::made_up(&[], &[squares], SAMPLES).unweighted();
    fitted.with_own(&names, vec![values.to_vec()], 0)
}

#[test]
fn a_good_fit_is_no_failed_one() {
    assert_eq!(said(0.0, TRUTH, true), None);
    // Nor one that is some per cent off.
    assert_eq!(said(0.0, [0.42, 2.0, 29.0], true), None);
}

#[test]
fn a_lost_fit_is_told_with_both_shares_and_where_to_begin() {
    let failed = said(0.0, [4.0, 30.0, 900.0], false).unwrap();
    assert!(failed.promised > 0.999 && failed.kept < 0.5, "{failed:?}");
    for ((_, found), truth) in failed.sizes.iter().zip(TRUTH) {
        assert!((found - truth).abs() < 0.02 * truth, "{failed:?}");
    }
    let words = failed.to_string();
    assert!(
        words.contains("explains more than 99.99\u{a0}%") && words.contains("the fit failed"),
        "{words}"
    );
}

/// Whatever the accelerations say, it follows the motion from the first sample to the last.
#[test]
fn a_fit_that_explains_all_of_the_output_is_no_failed_one() {
    assert_eq!(said_leaving(1e-9, 0.0, [4.0, 30.0, 900.0], true), None);
}

/// Restarted from the motion itself, any model explains nearly all of the output; what bends it from one restart to the next, only the machine.
#[test]
fn what_bends_a_restarted_motion_is_what_counts() {
    let mut case = machine(0.0);
    // As the machine moves.
    let motion = |sample: usize| {
        let t = 5e-3 * sample as f64;
        let angle = (5.0 * t).sin() + 0.5 * (11.0 * t).sin();
        [angle, case.measured()[sample]]
    };
    let restarts = (0..SAMPLES).step_by(APART).map(motion).collect();
    case.input = Cow::Owned(case.input.into_owned().with_restarts(APART, restarts));
    let (cases, tally) = ([case], Tally::default());
    let share =
        |values| share_of_bend(Cases::new(&cases, &tally), &ended_at(values, 1e12)).unwrap();
    assert!(share(TRUTH) > 0.99, "{}", share(TRUTH));
    let lost = [4.0, 30.0, 900.0];
    assert!(share(lost) < 0.5, "{}", share(lost));
}

/// Without friction the regression does no better than a fit of the base model; with it both lack something, and only a search that
/// did not find it has failed.
#[test]
fn what_an_effect_lacks_is_held_against_a_search_only() {
    let plain = machine(15.0);
    let cases = [plain];
    let equation = PlainEquation::of(&cases).unwrap();
    let best = equation.as_fitted(&[], &[TRUTH.to_vec()]).unwrap().base;
    assert_eq!(said(15.0, best, false), None);
    let failed = said(15.0, best, true).unwrap();
    assert!(failed.is_plain && failed.promised > 0.98, "{failed:?}");
}

/// Dry friction, found, is what was promised.
#[test]
fn a_fit_with_the_effect_keeps_the_promise() {
    let cases = [machine(15.0)];
    let plain = PlainEquation::of(&cases).unwrap();
    let friction = plain
        .plain
        .iter()
        .find(|one| one.name() == Effect::CoulombFriction.name());
    let effects = [*friction.unwrap()];
    let at = [[TRUTH.as_slice(), &[15.0]].concat()];
    let kept = plain.equation.explained_by(&effects, &at).unwrap();
    let promised = plain.plainly(&effects, &at).unwrap();
    assert!(!falls_short(kept, &promised, PLAIN_PROMISE));
}
