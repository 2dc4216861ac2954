//! What is supported, promising or alike, of candidates with a few gains each.

use super::*;
use crate::tests::made_up::{WHOLE, candidate, close, ranking, term};
use snug_model::Effect::{
    Backlash, CoulombFriction, CubicStiffness, QuadraticDamping, QuadraticStiffness,
    StribeckFriction, TorqueDelay,
};

const STRETCHES: Clusters = Clusters { per_case: 6 };

fn settings() -> DiagnoseSettings {
    DiagnoseSettings::default()
}

/// Four tightenings with 100 residuals each, of which the model leaves `squares` each.
fn model(squares: f64) -> Fitted {
    Fitted::made_up(&[], &[squares; 4], 100)
}

/// A clear gain that sums to 4 · `mean`.
fn clear(mean: f64) -> [f64; 4] {
    [mean * 0.9, mean * 1.1, mean, mean]
}

#[test]
fn the_first_candidate_that_is_beyond_chance_is_justified() {
    let ranking = ranking(vec![
        candidate(CubicStiffness, 0.051, &clear(50.0)),
        // 60 − 59 + 1 − 1: a gain, but within its own scatter.
        candidate(TorqueDelay, 0.01, &[60.0, -59.0, 1.0, -1.0]),
        candidate(QuadraticStiffness, 0.05, &clear(20.0)),
        candidate(Backlash, 0.001, &clear(10.0)),
    ]);
    assert_eq!(
        justified(&ranking, &model(300.0), &model(300.0), &settings()),
        Ok(2)
    );
}

/// 1 % of 1200 is 12; at the noise 0.3 % of 400 is 1.2.
#[test]
fn a_supported_candidate_that_removes_too_little_is_named_with_its_share() {
    let of = |mean: f64, current: &Fitted| {
        justified(
            &ranking(vec![candidate(CubicStiffness, 0.01, &clear(mean))]),
            current,
            current,
            &settings(),
        )
    };
    assert_eq!(of(3.01, &model(300.0)), Ok(0));
    assert_eq!(of(0.31, &model(100.0)), Ok(0));
    for (mean, squares) in [(2.99, 300.0), (0.29, 100.0)] {
        let Err(Stop::TooSmall { effect, share }) = of(mean, &model(squares)) else {
            panic!("{mean} of {squares} is too small")
        };
        assert_eq!(effect, CubicStiffness);
        close(share, mean / squares, 1e-12);
    }
}

/// Where the noise is not known everything that a record of thousands of samples shows is beyond chance. What counts then is the
/// share of what the first model left: 0.5 % is little for a law that is in no catalogue, 0.05 % for an effect that is.
#[test]
fn what_is_a_trifle_of_what_the_first_model_left_ends_the_selection() {
    let [first, current] = [10_000.0, 100.0].map(|squares| model(squares).unweighted());
    let law = term("x_v_law");
    let of = |effect: Effect, mean: f64, first: &Fitted| {
        let ranking = ranking(vec![candidate(effect, 0.001, &clear(mean))]);
        justified(&ranking, &current, first, &settings())
    };
    for (effect, mean, share) in [(law, 50.0, 0.005), (CubicStiffness, 5.0, 0.0005)] {
        let Err(Stop::Trifle {
            effect: named,
            share: told,
        }) = of(effect, mean, &first)
        else {
            panic!("{mean} is a trifle")
        };
        assert_eq!(named, effect);
        close(told, share, 1e-12);
        assert_eq!(
            of(effect, mean, &current),
            Ok(0),
            "of what is left it is much"
        );
    }
    assert_eq!(of(CubicStiffness, 50.0, &first), Ok(0));
    // An effect of the catalogue behind the law is enough.
    let both = ranking(vec![
        candidate(law, 0.001, &clear(50.0)),
        candidate(CubicStiffness, 0.001, &clear(20.0)),
    ]);
    assert_eq!(justified(&both, &current, &first, &settings()), Ok(1));
}

/// 15 % of what is left, which is 0.015 % of all, are 8 % of the error with which it predicts.
#[test]
fn what_is_left_counts_too_for_a_model_that_is_to_predict() {
    let [first, current] = [100_000.0, 100.0].map(|squares| model(squares).unweighted());
    let predicts = DiagnoseSettings {
        for_prediction: true,
        ..settings()
    };
    let of = |effect: Effect, mean: f64, settings: &DiagnoseSettings| {
        let ranking = ranking(vec![candidate(effect, 0.001, &clear(mean))]);
        justified(&ranking, &current, &first, settings).is_ok()
    };
    assert!(of(QuadraticDamping, 15.0, &predicts));
    assert!(!of(QuadraticDamping, 15.0, &settings()));
    assert!(
        !of(QuadraticDamping, 5.0, &predicts),
        "too little of what is left"
    );
    assert!(
        !of(term("x_v_law"), 15.0, &predicts),
        "it is in no catalogue"
    );
}

/// A law in no catalogue is told from 10 % of what the first model left on.
#[test]
fn laws_in_no_catalogue_are_asked_for_while_enough_is_left() {
    let of = |left: f64| {
        let [first, current] = [100.0, left].map(|squares| model(squares).unweighted());
        laws_may_matter(&first, &current)
    };
    assert!(of(100.0) && of(10.1) && !of(9.9));
    assert!(
        laws_may_matter(&model(1e4), &model(1.0)),
        "the noise is known"
    );
}

#[test]
fn a_size_that_may_be_nothing_supports_nothing() {
    let mut inert = candidate(CubicStiffness, 0.001, &clear(50.0));
    assert!(inert.is_supported(&settings()));
    inert.is_told_from_nothing = false;
    assert!(!inert.is_supported(&settings()));
}

#[test]
fn where_nothing_is_supported_the_smallest_p_of_those_that_gain_is_told() {
    let ranking = ranking(vec![
        candidate(CubicStiffness, 0.5, &clear(20.0)),
        candidate(QuadraticStiffness, 0.2, &clear(10.0)),
        candidate(TorqueDelay, 0.001, &clear(-10.0)),
    ]);
    let stop = justified(&ranking, &model(300.0), &model(300.0), &settings());
    assert_eq!(stop, Err(Stop::NothingSupported { best_p: 0.2 }));
    let none = justified(
        &Ranking::default(),
        &model(300.0),
        &model(300.0),
        &settings(),
    );
    assert_eq!(none, Err(Stop::NothingSupported { best_p: 1.0 }));
}

/// Beside friction a delay was added and taken out again: beside friction it is doubted, beside friction and a stiffness it is not.
#[test]
fn what_was_taken_out_is_doubted_beside_the_same_effects_only() {
    let with = |effects: &[Effect]| Fitted::made_up(effects, &[100.0], 100);
    let mut path = SelectionPath::only(with(&[CoulombFriction]));
    path.stand_on(with(&[CoulombFriction, TorqueDelay]));
    for (last, doubted) in [
        (&[CoulombFriction][..], true),
        (&[CubicStiffness, CoulombFriction], false),
    ] {
        path.stand_on(with(last));
        path.ranking = ranking(vec![candidate(TorqueDelay, 0.001, &clear(50.0))]);
        path.doubt_what_was_taken_out();
        let candidates = &path.ranking.candidates;
        assert_eq!(!candidates[0].is_told_from_nothing, doubted);
    }
}

#[test]
fn where_rounding_is_left_nothing_is_looked_for() {
    let all = || ranking(vec![candidate(CubicStiffness, 0.001, &clear(50.0))]);
    let exact = model(300.0).exact();
    let first = model(300.0).unweighted();
    let stop = justified(&all(), &exact, &first, &settings());
    assert_eq!(stop, Err(Stop::Exact));
    assert_eq!(justified(&all(), &first, &first, &settings()), Ok(0));
}

#[test]
fn misfit_is_what_noise_does_not_explain() {
    let fitted = Fitted::made_up(&[], &[250.0, 80.0], 100);
    assert_eq!(misfits(&fitted), [150.0, -20.0]);
    assert_eq!(misfit(&fitted), 130.0);
    let unknown = fitted.unweighted();
    assert_eq!(misfits(&unknown), [250.0, 80.0]);
    assert_eq!(misfit(&unknown), 330.0);
    assert_eq!(
        misfit(&model(99.0)),
        0.396,
        "a share of it can always be told"
    );
}

#[test]
fn twins_are_those_that_these_data_cannot_tell_from_the_chosen_one() {
    let ranking = ranking(vec![
        candidate(CubicStiffness, 0.01, &[10.0, 12.0, 9.0, 13.0]),
        // As much, now more and now less: 1 ± 3 behind.
        candidate(QuadraticStiffness, 0.01, &[11.0, 11.0, 10.0, 11.0]),
        // 5 less of each.
        candidate(QuadraticDamping, 0.01, &[5.0, 7.0, 4.0, 7.0]),
        candidate(term("x5_law"), 0.01, &[11.0, 11.0, 10.0, 11.0]),
        // As much in sum, but of one tightening.
        candidate(TorqueDelay, 0.01, &[44.0, 30.0, -15.0, -20.0]),
    ]);
    assert_eq!(twins(&ranking, 0, &WHOLE), [QuadraticStiffness]);
    assert_eq!(twins(&ranking, 1, &WHOLE), [CubicStiffness]);
    // A term that is in no catalogue names the effects it may stand for.
    assert_eq!(
        twins(&ranking, 3, &WHOLE),
        [CubicStiffness, QuadraticStiffness]
    );
}

/// Of dry friction with a shape nothing but dry friction is left; in the second it has a shape.
#[test]
fn a_richer_law_that_was_fitted_to_be_the_simpler_one_is_no_twin_of_it() {
    let friction = [10.0, 12.0, 9.0, 13.0];
    for (shaped, is_twin) in [
        ([10.1, 12.0, 9.1, 13.0], false),
        ([11.0, 11.0, 10.0, 11.0], true),
    ] {
        let ranking = ranking(vec![
            candidate(CoulombFriction, 0.01, &friction),
            candidate(StribeckFriction, 0.01, &shaped),
        ]);
        assert_eq!(
            twins(&ranking, 0, &WHOLE).contains(&StribeckFriction),
            is_twin
        );
        assert_eq!(twins(&ranking, 1, &WHOLE), [CoulombFriction]);
    }
}

#[test]
fn what_explains_clearly_more_is_no_twin_but_better() {
    let ranking = ranking(vec![
        candidate(CubicStiffness, 0.01, &clear(20.0)),
        candidate(QuadraticStiffness, 0.01, &clear(15.0)),
    ]);
    assert!(twins(&ranking, 1, &WHOLE).is_empty());
}

/// The difference of 22.5 is that of one loud tightening: 1.1 standard deviations.
#[test]
fn to_keep_up_is_to_explain_more_than_half_and_not_clearly_less() {
    let best = candidate(CubicStiffness, 0.01, &[40.0, 0.5, 0.5, 3.0]);
    let with = |loud: f64| candidate(QuadraticStiffness, 0.01, &[loud, 1.0, 0.5, 2.0]);
    assert!(with(19.0).keeps_up_with(&best, &WHOLE), "22.5 of 44");
    assert!(!with(18.0).keeps_up_with(&best, &WHOLE), "21.5 of 44");
    let behind = candidate(QuadraticStiffness, 0.01, &clear(8.0));
    let best = candidate(CubicStiffness, 0.01, &clear(10.0));
    assert!(!behind.keeps_up_with(&best, &WHOLE), "2 less of each");
    assert!(best.keeps_up_with(&behind, &WHOLE));
}

/// Bounded at four, 3 is 3/5 of each: √6 = 2.4 standard deviations where all six agree, √6/3 where two do not.
#[test]
fn of_a_long_record_only_what_is_plainly_more_counts() {
    let leaving = |squares: f64| Fitted::made_up(&[], &[squares; 6], 100);
    let even = [1.0, -1.0, 1.0, -1.0, 1.0, -1.0];
    assert!(leaves_more(
        &leaving(131.0),
        &leaving(100.0),
        &even,
        &STRETCHES
    ));
    assert!(!leaves_more(
        &leaving(129.0),
        &leaving(100.0),
        &even,
        &STRETCHES
    ));
    assert!(leaves_more(
        &leaving(100.0),
        &leaving(100.0),
        &[3.0; 6],
        &STRETCHES
    ));
    let disagreeing = [3.0, 3.0, 3.0, 3.0, -3.0, -3.0];
    assert!(!leaves_more(
        &leaving(100.0),
        &leaving(100.0),
        &disagreeing,
        &STRETCHES
    ));
    assert!(!leaves_more(
        &leaving(131.0),
        &leaving(100.0),
        &[3.0; 6],
        &WHOLE
    ));
}

fn path(squares: f64, p_family: f64, mean: f64) -> SelectionPath {
    let mut path = SelectionPath::only(model(squares));
    path.ranking = ranking(vec![candidate(CubicStiffness, p_family, &clear(mean))]);
    path
}

/// The model leaves 1200 in 400 residuals, 800 beyond the noise; 2 % of it is 24, a fifth of the misfit 160.
#[test]
fn an_unsupported_candidate_is_promising_where_chance_seldom_does_as_much() {
    let is_promising = |p: f64, mean: f64| path(300.0, p, mean).is_promising(&settings()).is_some();
    assert!(is_promising(0.29, 6.1));
    assert!(!is_promising(0.29, 5.9), "too little to matter");
    assert!(!is_promising(0.31, 6.1), "chance does it often");
    assert!(!is_promising(0.05, 6.1), "it is supported");
    assert!(
        is_promising(0.31, 40.1),
        "but it explains a good part of the misfit"
    );
    assert!(!is_promising(0.31, 39.9));
    let at_the_noise = path(100.0, 0.31, 40.1);
    assert!(
        at_the_noise.is_promising(&settings()).is_none(),
        "there is no misfit"
    );
}

/// Of stretches that gain nothing but scatter a fit of all of them leaves 400 of 1200, or 800.
#[test]
fn what_takes_most_where_it_is_fitted_leaves_the_verdict_open() {
    let is_promising = |effect: Effect, left: f64, first: f64| {
        let stretches = |squares: f64| model(squares).unweighted().in_stretches();
        let mut path = SelectionPath::only(stretches(first));
        path.rungs.push(stretches(300.0));
        let one = Candidate {
            fitted: stretches(left),
            ..candidate(effect, 1.0, &[60.0, -59.0, 1.0, -1.0])
        };
        path.ranking = ranking(vec![one]);
        path.is_promising(&settings()).is_some()
    };
    assert!(is_promising(CubicStiffness, 100.0, 3000.0));
    assert!(!is_promising(CubicStiffness, 200.0, 3000.0));
    assert!(
        !is_promising(CubicStiffness, 100.0, 30_000.0),
        "a trifle of the first error"
    );
    assert!(!is_promising(term("x_v_law"), 100.0, 3000.0));
}

#[test]
fn a_new_rung_has_nothing_ranked_against_it() {
    let mut path = path(300.0, 0.01, 50.0);
    let addition = Addition {
        effect: CubicStiffness,
        p_family: 0.01,
        heldout_gain: 0.5,
        share_of_first: 0.5,
        twins: Vec::new(),
    };
    path.add(addition, model(150.0));
    assert_eq!((path.rungs.len(), path.additions.len()), (2, 1));
    assert_eq!(path.last().squares(), 600.0);
    assert!(path.ranking.candidates.is_empty());
}

#[test]
fn who_ends_a_selection_keeps_what_it_reached_and_other_errors_are_told() {
    let ended = path(300.0, 0.01, 50.0).until_interrupted(Err(DiagnoseError::Interrupted));
    let ended = ended.expect("what was reached holds");
    assert!(ended.is_interrupted());
    assert_eq!((ended.rungs.len(), ended.ranking.candidates.len()), (1, 1));
    let failed = path(300.0, 0.01, 50.0).until_interrupted(Err(DiagnoseError::NothingToCompare {
        reason: "there is none".into(),
    }));
    assert!(matches!(
        failed,
        Err(DiagnoseError::NothingToCompare { .. })
    ));
    let whole = path(300.0, 0.01, 50.0).until_interrupted(Ok(()));
    assert!(!whole.expect("it ended by itself").is_interrupted());
}
