//! Starts, stragglers and corrections of a few numbers, and refits of tightenings with a known effect.

use super::*;
use crate::data::cases::Tally;
use crate::pooled::fit::fit_effects;
use crate::pooled::model::Room;
use crate::tests::made_up::{SAMPLES, WHOLE, close, exact, hand, noisy, term};
use snug_least_squares::Profile;
use snug_model::Effect::{AccelerationBias, Backlash, CubicStiffness, GripSlip, TorqueOffset};

const NAMES: [&str; 3] = ["mass_kg", "damping_kg_per_s", "stiffness_n_per_m"];

/// A start of a gap that promises to remove so much.
fn gap(start: f64, gain: f64) -> Column {
    let mut column = Column::with_scores(Backlash, vec![gain.sqrt()]);
    (column.start, column.information) = (vec![start], 1.0);
    column
}

#[test]
fn the_starts_that_promise_most_are_tried_each_once() {
    let mut other = gap(9.0, 100.0);
    other.effect = GripSlip;
    let columns = [
        gap(1.0, 4.0),
        gap(2.0, 9.0),
        gap(1.0, 16.0),
        other,
        gap(3.0, 1.0),
    ];
    assert_eq!(promising(Backlash, &columns, 8), [[1.0], [2.0], [3.0]]);
    assert_eq!(promising(Backlash, &columns, 2), [[1.0], [2.0]]);
    assert!(promising(CubicStiffness, &columns, 8).is_empty());
}

/// Runs `look` with `effects` asked of `count` tightenings of the base model.
fn with_pooled<T>(
    count: usize,
    effects: &[Effect],
    look: impl FnOnce(&mut PooledModel<'_>) -> T,
) -> T {
    let cases: Vec<FitTask> = (0..count).map(|number| exact(number, &[], &[])).collect();
    let tally = Tally::default();
    let pooled = PooledModel::new(Cases::new(&cases, &tally), effects);
    look(&mut pooled.expect("the effects go together"))
}

/// A fit of the base model that leaves `squares` of each tightening.
fn base(squares: &[f64]) -> Fitted {
    let own = (0..squares.len())
        .map(|number| hand(number).to_vec())
        .collect();
    Fitted::made_up(&[], squares, SAMPLES).with_own(&NAMES, own, 0)
}

#[test]
fn an_effect_s_values_go_where_its_parameters_are() {
    with_pooled(
        2,
        &[TorqueOffset, AccelerationBias, CubicStiffness],
        |pooled| {
            let current = base(&[1.0; 2]);
            let cubic = pooled.with_effect(current.start(pooled), CubicStiffness, &[7e5]);
            assert_eq!(
                cubic.shared,
                [0.0, 7e5],
                "behind the offset, which begins as usual"
            );
            assert_eq!(cubic.own[1][..3], hand(1), "as the current fit has them");
            let bias = pooled.with_effect(current.start(pooled), AccelerationBias, &[0.4]);
            assert_eq!(
                (bias.own[0][3], bias.own[1][3]),
                (0.4, 0.4),
                "each tightening's own"
            );
            assert_eq!(bias.shared, [0.0, 0.0]);
        },
    );
}

/// Masses 2, 3 and 40 times what they were: 3 is usual. A bias of its own has nothing to be a multiple of.
#[test]
fn own_parameters_are_corrected_by_what_is_usual() {
    with_pooled(1, &[AccelerationBias], |pooled| {
        let without = vec![vec![1.0, 10.0, 100.0, 0.0]; 3];
        let with = [
            [2.0, 5.0, 100.0, 1.0],
            [3.0, 5.0, 110.0, 2.0],
            [40.0, 20.0, 90.0, 3.0],
        ];
        let factors = astray(pooled, &with.map(|own| own.to_vec()), &without);
        assert_eq!(factors, [3.0, 0.5, 1.0, 1.0]);
        let mut own = [2.0, 10.0, 7.0, 0.3];
        times(&mut own, &factors);
        assert_eq!(own, [6.0, 5.0, 7.0, 0.3]);
    });
}

/// A fit that ended with these squares of each tightening.
fn ended(squares: &[f64], own: Vec<Vec<f64>>, shared: Vec<f64>) -> PooledFit {
    let p = shared.len();
    let profile = |squares: &f64| Profile {
        shared: Vec::new(),
        cost: 0.5 * squares,
        curvature: vec![0.0; p * p],
        gradient: vec![0.0; p],
    };
    PooledFit {
        profiles: squares.iter().map(profile).collect(),
        shared,
        own,
        converged: true,
        work: snug_least_squares::Work::default(),
    }
}

/// Errors are roots: 1.33 times the usual squares are 1.153 times the usual error, 1.31 times are 1.145.
#[test]
fn who_keeps_more_than_the_others_and_has_more_was_left_behind() {
    with_pooled(5, &[CubicStiffness], |pooled| {
        let current = base(&[100.0, 100.0, 100.0, 100.0, 1000.0]);
        let of = |squares: [f64; 5]| {
            left_behind(pooled, &current, &ended(&squares, Vec::new(), vec![0.0]))
        };
        // The last has most, but kept no more of it than the others did.
        assert_eq!(
            of([10.0, 10.0, 13.3, 10.0, 100.0]),
            (vec![2], vec![0, 1, 3, 4])
        );
        assert_eq!(of([10.0, 10.0, 13.1, 10.0, 100.0]).0, [0_usize; 0]);
        // Kept more, but has no more than the others: it was small before.
        let current = base(&[100.0, 100.0, 100.0, 100.0, 10.0]);
        let end = ended(&[10.0, 10.0, 10.0, 10.0, 10.0], Vec::new(), vec![0.0]);
        assert!(left_behind(pooled, &current, &end).0.is_empty());
    });
}

/// Tightening 2 ended where its hand is so stiff that nothing moves, and no step leads back. With the others' cubic spring
/// it finds its own hand again from where it was without one.
#[test]
fn who_was_left_behind_is_fetched_with_what_the_others_found() {
    let cases: Vec<FitTask> = (0..4)
        .map(|n| noisy(n, &[CubicStiffness], &[2e6]))
        .collect();
    let tally = Tally::default();
    let counted = Cases::new(&cases, &tally);
    let mut pooled = PooledModel::new(counted, &[CubicStiffness]).expect("they go together");
    let mut own: Vec<Vec<f64>> = (0..4).map(|number| hand(number).to_vec()).collect();
    own[2][2] *= 1e4;
    let squares: Vec<f64> = (0..4)
        .map(|member| {
            let values = pooled.values(member, &own[member], &[2e6]);
            let mut room = Room::default();
            let (residual, _) = pooled.weighted(member, &values, &[], &mut room);
            residual.iter().map(|r| r * r).sum()
        })
        .collect();
    let usual = SAMPLES as f64;
    assert!(squares[2] > 2.0 * usual, "it is off: {squares:?}");
    let current = base(&[3.0 * usual; 4]);
    let end = ended(&squares, own, vec![2e6]);
    let fetched = catch_up(&mut pooled, &current, end).expect("it can be simulated");
    assert!(
        fetched.profiles[2].cost < 0.6 * usual,
        "{}",
        fetched.profiles[2].cost
    );
    close(fetched.own[2][0], hand(2)[0], 0.1);
    // Who was not left behind is where it was: nobody is fetched a second time.
    let before = tally.done().pooled_fits;
    let again = catch_up(&mut pooled, &current, fetched.clone()).expect("it can be simulated");
    assert_eq!(tally.done().pooled_fits, before);
    assert_eq!(again, fetched);
}

/// Refits `effect` to tightenings that were made with it, without noise.
fn refitted(effect: Effect, size: f64, columns: &[Column]) -> Fitted {
    let cases: Vec<FitTask> = (0..3)
        .map(|number| exact(number, &[effect], &[size]))
        .collect();
    let tally = Tally::default();
    let counted = Cases::new(&cases, &tally);
    let current = fit_effects(counted, &[], None, WHOLE).expect("the base model can be fitted");
    let settings = DiagnoseSettings::default();
    refit(
        counted,
        &current,
        effect,
        columns,
        Way::Far(None),
        WHOLE,
        &settings,
    )
    .expect("it can be fitted")
}

#[test]
fn a_single_start_leads_to_the_size_that_the_data_were_made_with() {
    let mut column = Column::with_scores(CubicStiffness, vec![1.0]);
    column.information = 1.0;
    let fitted = refitted(CubicStiffness, 2e6, &[column]);
    close(fitted.size(CubicStiffness), 2e6, 1e-3);
    for (own, number) in fitted.own.iter().zip(0..) {
        close(own[0], hand(number)[0], 1e-3);
    }
}

/// Where no column says where to begin, the effect's usual start has to do.
#[test]
fn an_effect_without_a_column_begins_at_its_usual_start() {
    let fitted = refitted(TorqueOffset, 0.5, &[]);
    close(fitted.size(TorqueOffset), 0.5, 1e-3);
}

/// From play of a tenth of the true 0.5 mm and from forty times as much, which promises more and by itself leads astray.
#[test]
fn of_several_starts_the_one_that_leads_lowest_is_followed() {
    let fitted = refitted(Backlash, 5e-4, &[gap(0.02, 9.0), gap(5e-5, 4.0)]);
    close(fitted.size(Backlash), 5e-4, 0.02);
    let cases: Vec<FitTask> = (0..3).map(|n| exact(n, &[Backlash], &[5e-4])).collect();
    let tally = Tally::default();
    let counted = Cases::new(&cases, &tally);
    let current = fit_effects(counted, &[], None, WHOLE).expect("the base model can be fitted");
    let pooled = PooledModel::new(counted, &[Backlash]).expect("they go together");
    let starts =
        [0.02, 5e-4].map(|gap| pooled.with_effect(current.start(&pooled), Backlash, &[gap]));
    let seen_from_afar = |starts: &[Start]| {
        rough(&pooled, &current, starts)
            .expect("it can be fitted")
            .shared[0]
    };
    close(seen_from_afar(&starts), 5e-4, 0.02);
    assert!(
        seen_from_afar(&starts[..1]) > 1e-3,
        "forty times too much leads elsewhere"
    );
}

/// A term describes; the best of its starts is near enough, and the others are not followed.
#[test]
fn a_term_in_no_catalogue_is_followed_from_its_best_start_only() {
    let stop = term("end_stop_law");
    let at = |x0: f64, gain: f64| {
        let mut column = gap(x0, gain);
        (column.effect, column.start) = (stop, vec![1000.0, x0]);
        column
    };
    let cases: Vec<FitTask> = (0..3).map(|n| exact(n, &[stop], &[3000.0, 0.01])).collect();
    let tally = Tally::default();
    let counted = Cases::new(&cases, &tally);
    let current = fit_effects(counted, &[], None, WHOLE).expect("the base model can be fitted");
    let before = tally.done().pooled_fits;
    let columns = [at(0.009, 9.0), at(0.04, 4.0)];
    let settings = DiagnoseSettings::default();
    let fitted = refit(
        counted,
        &current,
        stop,
        &columns,
        Way::Far(None),
        WHOLE,
        &settings,
    )
    .expect("fitted");
    assert_eq!(tally.done().pooled_fits, before + 1);
    close(fitted.shared[0], 3000.0, 0.01);
}

/// Of two records of noise a few steps from the usual start take as much as all, to a hundredth of what chance does, with fewer steps.
#[test]
fn beside_noise_a_few_steps_tell_what_the_end_does() {
    let cases: Vec<FitTask> = (0..2).map(|number| noisy(number, &[], &[])).collect();
    let tally = Tally::default();
    let counted = Cases::new(&cases, &tally);
    let clusters = Clusters { per_case: 8 };
    let current = fit_effects(counted, &[], None, clusters).expect("the base model can be fitted");
    assert!(current.leaves_white_noise(counted));
    let settings = DiagnoseSettings::default();
    let steps = || tally.done().steps;
    for effect in [CubicStiffness, TorqueOffset, AccelerationBias] {
        let before = steps();
        let along = |way| refit(counted, &current, effect, &[], way, clusters, &settings);
        let end = along(Way::Far(None));
        let between = steps();
        let nearby = along(Way::Nearby);
        let [end, nearby] = [end, nearby].map(|fitted| fitted.expect("fitted").squares());
        let by_chance = current.squares() / current.count() as f64;
        assert!(nearby <= current.squares(), "{}", effect.name());
        let missed = (nearby - end) / by_chance;
        assert!(missed < 0.01, "{}: {missed}", effect.name());
        assert!(steps() - between <= between - before);
    }
}
