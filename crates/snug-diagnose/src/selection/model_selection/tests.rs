//! What is chosen from rankings of a few numbers, and a pair that is in simulated data.

use super::*;
use crate::tests::made_up::{WHOLE, candidate, close, noisy, ranking, term, with_selection};
use snug_identify::FitTask;
use snug_model::Effect::{
    CoulombFriction, CubicStiffness, QuadraticDamping, QuadraticStiffness, TorqueOffset,
};

/// Eight tightenings with 100 residuals each of which the model leaves 300, 200 of it beyond the noise.
fn current() -> Fitted {
    Fitted::made_up(&[], &[300.0; 8], 100)
}

/// A gain of about `mean` in each of them.
fn clear(mean: f64) -> [f64; 8] {
    [0.9, 1.1, 1.0, 1.0, 1.0, 1.0, 1.05, 0.95].map(|share| share * mean)
}

/// The effects that are to be added beside `ranking`, none of which is looked at together with another.
fn chosen(ranking: &Ranking, room: usize) -> Vec<Effect> {
    let steps = with_selection(&[], &DiagnoseSettings::default(), |selection| {
        selection.choose(&current(), ranking, 0, room)
    });
    let steps = steps.expect("nothing is fitted");
    steps.iter().map(|(addition, _)| addition.effect).collect()
}

#[test]
fn one_effect_that_leaves_nothing_but_noise_is_added_alone() {
    let ranking = ranking(vec![
        candidate(CubicStiffness, 0.002, &clear(190.0)),
        candidate(QuadraticStiffness, 0.002, &clear(188.0)),
        candidate(QuadraticDamping, 0.002, &clear(20.0)),
    ]);
    let steps = with_selection(&[], &DiagnoseSettings::default(), |selection| {
        selection.choose(&current(), &ranking, 0, 5)
    });
    let steps = steps.expect("nothing is fitted");
    let [(addition, fitted)] = steps.as_slice() else {
        panic!("{} effects", steps.len())
    };
    assert_eq!(
        (addition.effect, addition.p_family),
        (CubicStiffness, 0.002)
    );
    assert_eq!(fitted.effects, [CubicStiffness]);
    // 8 · 190 of a misfit of 8 · 200.
    close(addition.heldout_gain, 0.95, 1e-12);
}

/// Of equals: the term is ahead by 2 % of one tightening and behind in another.
#[test]
fn a_catalogue_effect_comes_before_an_unlisted_term_that_explains_as_much() {
    let mut as_much = clear(190.0);
    (as_much[0], as_much[1]) = (as_much[0] - 5.0, as_much[1] + 4.0);
    let of = |listed: &[f64]| {
        let candidates = vec![
            candidate(term("x5_law"), 0.002, &clear(190.0)),
            candidate(CubicStiffness, 0.002, listed),
        ];
        chosen(&ranking(candidates), 1)
    };
    assert_eq!(of(&as_much), [CubicStiffness]);
    assert_eq!(
        of(&clear(180.0)),
        [term("x5_law")],
        "clearly ahead of every tightening"
    );
}

#[test]
fn a_catalogue_effect_that_chance_explains_stands_for_no_term() {
    let candidates = vec![
        candidate(term("x5_law"), 0.002, &clear(190.0)),
        candidate(CubicStiffness, 0.06, &clear(190.0)),
    ];
    assert_eq!(chosen(&ranking(candidates), 1), [term("x5_law")]);
}

/// Beside a pendulum's weight nothing is left for the spring to do, beside the others it is: the likelier story.
#[test]
fn of_terms_that_explain_as_much_the_one_that_replaces_a_spring_is_named() {
    let names = ["mass_kg", "damping_kg_per_s", "stiffness_n_per_m"];
    let with_stiffness = |name: &str, stiffness: f64| {
        let mut one = candidate(term(name), 0.002, &clear(190.0));
        one.fitted = one
            .fitted
            .with_own(&names, vec![vec![2.0, 90.0, stiffness]; 8], 0);
        one
    };
    let all = |stiffness: [f64; 3]| {
        chosen(
            &ranking(vec![
                with_stiffness("abs_x_x_law", stiffness[0]),
                with_stiffness("sine_law", stiffness[1]),
                with_stiffness("x5_law", stiffness[2]),
            ]),
            1,
        )
    };
    assert_eq!(all([2000.0, 20.0, 2000.0]), [term("sine_law")]);
    assert_eq!(
        all([2000.0; 3]),
        [term("abs_x_x_law")],
        "of several the first"
    );
}

#[test]
fn of_a_pair_the_one_that_explains_more_by_itself_comes_first() {
    let ranking = ranking(vec![
        candidate(CubicStiffness, 0.002, &clear(100.0)),
        candidate(CoulombFriction, 0.002, &clear(60.0)),
        candidate(TorqueOffset, 0.5, &clear(40.0)),
    ]);
    let both = |effect: Effect| {
        let addition = Addition {
            effect,
            p_family: 0.01,
            heldout_gain: 0.5,
            share_of_first: 0.5,
            twins: Vec::new(),
        };
        (
            addition,
            Fitted::made_up(&[CubicStiffness, CoulombFriction], &[99.0; 8], 100),
        )
    };
    let order = |seed: usize, second: Effect| -> Vec<Effect> {
        let steps = with_selection(&[], &DiagnoseSettings::default(), |selection| {
            selection.larger_first(&current(), &ranking, seed, both(second))
        });
        assert_eq!(
            steps[1].1.squares(),
            8.0 * 99.0,
            "the second step holds both"
        );
        steps.iter().map(|(addition, _)| addition.effect).collect()
    };
    assert_eq!(order(1, CubicStiffness), [CubicStiffness, CoulombFriction]);
    assert_eq!(order(0, CoulombFriction), [CubicStiffness, CoulombFriction]);
    // What chance explains by itself is no first step.
    assert_eq!(order(1, TorqueOffset), [CoulombFriction, TorqueOffset]);
}

/// A misfit of 1600, of which 2 % are 32 and 5 % are 80, in 800 residuals.
#[test]
fn two_are_tried_together_where_one_leaves_much() {
    let left = |misfit: f64| Fitted::made_up(&[], &[100.0 + misfit / 8.0; 8], 100);
    with_selection(&[], &DiagnoseSettings::default(), |selection| {
        assert!(selection.leaves_much(&left(33.0), &current()));
        assert!(!selection.leaves_much(&left(31.0), &current()));
        assert!(
            selection.completes(&left(15.0), &current()),
            "less than 2 % of the noise"
        );
        assert!(
            !selection.completes(&left(17.0), &current()),
            "not the noise yet"
        );
        let unknown = current().unweighted();
        assert!(
            !selection.completes(&left(15.0).unweighted(), &unknown),
            "no noise is known"
        );
    });
}

/// Both a spring that stiffens and dry friction are in the data. One of them alone leaves much, both leave the noise.
#[test]
fn two_effects_that_are_both_in_the_data_are_added_as_a_pair() {
    let both = [CubicStiffness, CoulombFriction];
    let cases: Vec<FitTask> = (0..8).map(|n| noisy(n, &both, &[4e6, 8.0])).collect();
    with_selection(&cases, &DiagnoseSettings::default(), |selection| {
        let base = fit_effects(selection.cases, &[], None, WHOLE).expect("it can be fitted");
        let tried = [CubicStiffness, CoulombFriction, QuadraticDamping];
        let ranking = rank(
            selection.cases,
            &base,
            &tried,
            WHOLE,
            selection.settings,
            0,
            selection.watch,
        );
        let ranking = ranking.expect("it can be ranked");
        let best =
            justified(&ranking, &base, &base, selection.settings).expect("something is missing");
        let steps = selection
            .choose(&base, &ranking, best, 5)
            .expect("it can be fitted");
        let mut added: Vec<Effect> = steps.iter().map(|(addition, _)| addition.effect).collect();
        let first = added[0];
        assert_eq!(first, ranking.candidates[best].effect, "the larger first");
        added.sort_by_key(|effect| both.iter().position(|one| one == effect));
        assert_eq!(added, both);
        let fitted = &steps[1].1;
        close(fitted.size(CubicStiffness), 4e6, 0.1);
        close(fitted.size(CoulombFriction), 8.0, 0.1);
        // White noise: 2000 squares ± √4000.
        assert!((fitted.squares() - 2000.0).abs() < 5.0 * 4000.0_f64.sqrt());
        // With room for one alone, the pair is not looked for.
        let alone = selection
            .choose(&base, &ranking, best, 1)
            .expect("it can be fitted");
        assert_eq!(alone.len(), 1);
    });
}

#[test]
fn a_model_is_named_by_its_effects() {
    assert_eq!(list(&[]), "the base model");
    assert_eq!(
        list(&[CubicStiffness, TorqueOffset]),
        "cubic_stiffness + torque_offset"
    );
}
