//! Candidates compared by hand, and small campaigns with a known effect, or none, ranked.

mod nested;

use super::*;
use crate::data::cases::Tally;
use crate::pooled::fit::fit_effects;
use crate::tests::made_up::{WHOLE, candidate, close, noisy, silent};
use snug_identify::{FitTask, IdentifyError};
use snug_least_squares::SolveError;
use snug_model::Effect::{CubicStiffness, QuadraticDamping, TorqueOffset};
use std::sync::atomic::AtomicBool;

#[test]
fn candidates_are_compared_tightening_by_tightening() {
    let one = candidate(CubicStiffness, 0.01, &[10.0, 12.0, 9.0, 13.0]);
    let other = candidate(QuadraticDamping, 0.01, &[5.0, 7.0, 4.5, 7.0]);
    assert_eq!(one.gain(), 44.0);
    assert_eq!(one.beyond(&other), [5.0, 5.0, 4.5, 6.0]);
    assert!(one.ahead_of(&other) > 2.0);
    close(
        other.ahead_of(&one),
        -20.5 / (1.5_f64 * 0.5).sqrt() / 2.0_f64.sqrt(),
        0.3,
    );
}

/// Shares of 10, 30, 20 and 60 are 20 % in sum; what is left of each is 2 − 2, 3 − 6, 10 − 4 and 9 − 12: of variance 54/3,
/// times four tightenings, over 120.
#[test]
fn the_error_of_a_share_is_that_of_a_ratio_of_two_sums() {
    let one = candidate(CubicStiffness, 0.01, &[2.0, 3.0, 10.0, 9.0]);
    let error = one.share_error(&[10.0, 30.0, 20.0, 60.0]);
    close(error, (54.0 / 3.0 * 4.0_f64).sqrt() / 120.0, 1e-12);
    let every = candidate(CubicStiffness, 0.01, &[2.0, 6.0, 4.0, 12.0]);
    assert_eq!(
        every.share_error(&[10.0, 30.0, 20.0, 60.0]),
        0.0,
        "each gains a fifth"
    );
}

/// Eight of eight loud gains: `norm.sf(sqrt(8))` = 0.0023389, SciPy 1.17.1.
#[test]
fn chance_of_a_gain_counts_every_candidate_that_was_tried() {
    let mut gains = [1e5; 8];
    gains[0] = 1e9;
    let one = candidate(CubicStiffness, 1.0, &gains);
    close(one.p_of_gain(20), 20.0 * 0.002_338_867_490_523_6, 1e-6);
    assert_eq!(one.p_of_gain(1000), 1.0);
}

#[test]
fn what_explains_most_comes_first() {
    let mut all = [
        candidate(CubicStiffness, 0.01, &[1.0, 1.0]),
        candidate(QuadraticDamping, 0.9, &[-3.0, 9.0]),
        candidate(TorqueOffset, 0.5, &[-9.0, 3.0]),
    ];
    sort(&mut all);
    let order = all.map(|one| one.effect);
    assert_eq!(order, [QuadraticDamping, CubicStiffness, TorqueOffset]);
}

#[test]
fn a_gain_is_what_is_left_without_less_what_is_left_with() {
    let with = Fitted::made_up(&[], &[80.0, 130.0], 100).with_torque_noise(&[5.0, 0.0]);
    assert_eq!(gains(&[100.0, 120.0], &with), [25.0, -10.0]);
}

#[test]
fn an_effect_that_leaves_nothing_finite_is_impossible_and_other_errors_are_told() {
    let leaving = |squares: f64| Fitted::made_up(&[], &[squares], 100);
    assert!(matches!(possible(Ok(leaving(3.0))), Ok(Some(_))));
    assert!(matches!(possible(Ok(leaving(f64::INFINITY))), Ok(None)));
    assert!(matches!(possible(Ok(leaving(f64::NAN))), Ok(None)));
    let refused = IdentifyError::from(snug_least_squares::SolveError::NoStart);
    assert!(matches!(
        possible(Err(DiagnoseError::Identify(refused))),
        Ok(None)
    ));
    assert!(possible(Err(DiagnoseError::Interrupted)).is_err());
}

const TRIED: [Effect; 3] = [QuadraticDamping, CubicStiffness, TorqueOffset];

fn ranked(
    cases: &[FitTask<'_>],
    tried: &[Effect],
    control: usize,
    watch: &Watch<'_>,
) -> Result<Ranking, DiagnoseError> {
    let tally = Tally::default();
    let counted = Cases::new(cases, &tally);
    let base = fit_effects(counted, &[], None, WHOLE).expect("the base model can be fitted");
    let settings = DiagnoseSettings {
        sign_flips: 999,
        ..DiagnoseSettings::default()
    };
    let ranking = rank(counted, &base, tried, WHOLE, &settings, control, watch)?;
    assert_eq!(tally.done().rankings, 1);
    assert_eq!(tally.done().signatures, cases.len() * ranking.columns.len());
    Ok(ranking)
}

/// Of 2⁸ patterns of signs two go as far as eight tightenings that agree: a p of 1/128, that of 999 flips within 0.013.
#[test]
fn the_effect_that_the_data_were_made_with_comes_first_with_its_size() {
    let cases: Vec<FitTask> = (0..8)
        .map(|n| noisy(n, &[CubicStiffness], &[2e6]))
        .collect();
    let ranking = ranked(&cases, &TRIED, 0, &silent()).expect("it can be ranked");
    let first = &ranking.candidates[0];
    assert_eq!(first.effect, CubicStiffness);
    close(first.fitted.size(CubicStiffness), 2e6, 0.05);
    assert!(first.p_family < 0.021, "{}", first.p_family);
    assert!(first.gains.iter().filter(|gain| **gain > 0.0).count() >= 7);
    assert!(
        first.fitted.scale() < 1.15,
        "noise is left: {}",
        first.fitted.scale()
    );
    assert!(ranking.candidates[1].gain() < 0.9 * first.gain());
    assert!(ranking.impossible.is_empty());
}

/// Whatever the data hold, campaigns of noise alone call something supported in 5 % of cases: of 200 in 10 ± 3.1.
#[test]
fn campaigns_of_noise_alone_are_seldom_called_an_effect() {
    let cases: Vec<FitTask> = (0..8).map(|n| noisy(n, &[], &[])).collect();
    let ranking = ranked(&cases, &TRIED, 200, &silent()).expect("it can be ranked");
    let (campaigns, alarms) = ranking.control;
    assert_eq!(campaigns, 200);
    assert!((1..=25).contains(&alarms), "{alarms}");
    let supported = ranking.candidates.iter().any(|one| one.p_family <= 0.01);
    assert!(!supported, "nothing is there");
}

#[test]
fn who_ends_a_ranking_gets_none() {
    let cases: Vec<FitTask> = (0..2).map(|n| noisy(n, &[], &[])).collect();
    let (tell, ended) = (|_: &str| {}, AtomicBool::new(true));
    let watch = Watch::new(&tell).until(&ended);
    let ranking = ranked(&cases, &TRIED, 0, &watch);
    assert!(matches!(ranking, Err(DiagnoseError::Interrupted)));
}

/// A law that is infinite at its start is no reason to end a diagnosis, whichever fit finds out; an end that was asked for
/// is.
#[test]
fn a_candidate_that_cannot_be_simulated_is_left_out() {
    for refused in [
        DiagnoseError::Solve(SolveError::NoStart),
        DiagnoseError::Identify(IdentifyError::Solve(SolveError::NoStart)),
    ] {
        assert!(matches!(possible(Err(refused)), Ok(None)));
    }
    assert!(possible(Err(DiagnoseError::Interrupted)).is_err());
}
