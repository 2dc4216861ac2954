//! Statistics of a few scores by hand, and which directions an effect is tried in.

use super::*;
use crate::data::cases::{Cases, Tally};
use crate::tests::made_up::{RIG, SAMPLES, close, exact, hand};
use snug_model::Effect::{
    AccelerationBias, Backlash, CoulombFriction, CubicStiffness, GripSlip, SecondMass, TorqueOffset,
};
use snug_model::{Model, Scale};

fn of(effect: Effect, whole: bool) -> Vec<Column> {
    let specs = effect.description().parameters.iter();
    let ranges: Vec<PlausibleRange> = specs
        .map(|spec| Scale::HandOnTool.range(spec, &RIG))
        .collect();
    directions(effect, &ranges, whole)
}

/// Scores 1, 2, 3 of variance 1. Plain: 6 / √14 = 1.6036. Bounded: 0.8944, 1.4142, 1.6641, together 1.6834 of their length.
#[test]
fn the_statistic_is_the_larger_of_the_plain_and_the_bounded_sum() {
    let column = Column::with_scores(CubicStiffness, vec![1.0, 2.0, 3.0]);
    close(column.statistic(), 1.683_420_776_673_379, 1e-12);
    let mut loud = column.clone();
    loud.variances = vec![1e12; 3];
    loud.bound();
    close(loud.statistic(), 6.0 / 14.0_f64.sqrt(), 1e-9);
}

#[test]
fn a_sign_that_physics_fixes_lets_nothing_count_against_it() {
    let against = vec![-1.0, -2.0, -3.0];
    assert_eq!(
        Column::with_scores(Backlash, against.clone()).statistic(),
        0.0
    );
    let free = Column::with_scores(CubicStiffness, against);
    close(free.statistic(), 1.683_420_776_673_379, 1e-12);
    let gap = Column::with_scores(Backlash, vec![-1.0, -2.0, -3.0]);
    close(
        gap.flipped_statistic(&[-1.0; 3]),
        1.683_420_776_673_379,
        1e-12,
    );
}

#[test]
fn a_tightening_that_knows_nothing_of_an_effect_counts_as_nothing() {
    let mut column = Column::with_scores(CubicStiffness, vec![1.0, 2.0, 3.0, 0.0]);
    column.variances[3] = 0.0;
    column.bound();
    close(column.statistic(), 1.683_420_776_673_379, 1e-12);
    let nothing = Column::with_scores(CubicStiffness, vec![0.0; 4]);
    assert_eq!((nothing.statistic(), nothing.predicted_gain()), (0.0, 0.0));
}

/// (Σ s)² / Σ I = 36 / 9.
#[test]
fn a_shared_size_is_predicted_to_remove_its_squared_sum_over_the_information() {
    let mut column = Column::with_scores(CubicStiffness, vec![1.0, 2.0, 3.0]);
    column.information = 9.0;
    close(column.predicted_gain(), 4.0, 1e-12);
    assert_eq!(column.chance_p(), None, "its signs can be flipped");
    let mut against = Column::with_scores(Backlash, vec![-1.0, -2.0, -3.0]);
    against.information = 9.0;
    assert_eq!(against.predicted_gain(), 0.0);
}

/// 1/4 + 4/1 + 9/… : 0.25 + 4 + 3.25 = 7.5, `chi2.sf(7.5, 3)` = 0.0575585 (SciPy 1.17.1). Whatever the signs.
#[test]
fn sizes_of_their_own_remove_the_energy_of_every_tightening() {
    let mut column = Column::with_scores(AccelerationBias, vec![1.0, -2.0, 3.0]);
    column.variances = vec![4.0, 1.0, 9.0 / 3.25];
    assert!(column.is_own());
    close(column.predicted_gain(), 7.5, 1e-12);
    close(
        column.chance_p().expect("it has no sign"),
        0.057_558_451_972_636_4,
        1e-9,
    );
    // One that knows nothing takes no degree of freedom.
    column.scores.push(0.0);
    column.variances.push(0.0);
    close(
        column.chance_p().expect("it has no sign"),
        0.057_558_451_972_636_4,
        1e-9,
    );
}

#[test]
fn stretches_of_a_tightening_share_its_own_sizes() {
    assert!(of(AccelerationBias, true)[0].is_own());
    assert!(!of(AccelerationBias, false)[0].is_own());
    assert!(!of(CubicStiffness, true)[0].is_own());
}

#[test]
fn an_effect_that_vanishes_at_its_start_is_tried_along_each_of_its_parameters() {
    let cubic = of(CubicStiffness, true);
    assert_eq!(cubic.len(), 1);
    assert_eq!((cubic[0].along, cubic[0].size()), (Some(0), (0, 1.0)));
    let initial = of(Effect::InitialMotion, true);
    let along: Vec<Option<usize>> = initial.iter().map(|column| column.along).collect();
    assert_eq!(along, [Some(0), Some(1)]);
}

#[test]
fn an_effect_that_is_there_at_its_start_is_tried_from_each_combination_of_starts() {
    let slip = of(GripSlip, true);
    let starts: Vec<&[f64]> = slip.iter().map(|column| column.start.as_slice()).collect();
    assert_eq!(starts, [[150.0], [60.0], [280.0]]);
    assert_eq!((slip[1].along, slip[1].size()), (None, (0, 60.0)));
    let second = of(SecondMass, true);
    assert_eq!(second.len(), 3 * 3 * 2);
    assert_eq!(second[0].start, [2.0, 1e4, 100.0], "the usual one first");
    assert_eq!(second[17].start, [6.0, 4e4, 20.0]);
}

/// What `effect` does to the acceleration of tightening 0, as its column says it.
fn signature(effect: Effect) -> Vec<f64> {
    let (cases, tally) = ([exact(0, &[], &[])], Tally::default());
    let counted = Cases::new(&cases, &tally);
    let without = PooledModel::new(counted, &[]).expect("the base model is one");
    let with = PooledModel::new(counted, &[effect]).expect("the effect goes with it");
    let values = hand(0);
    let asked = [Asked {
        member: 0,
        input: &cases[0].input,
        values: &values,
    }];
    let plain = without.outputs(&asked);
    of(effect, true)[0]
        .signatures(&with, &asked, &plain)
        .remove(0)
}

/// The acceleration of tightening 0 with `effect` of one size, less that without.
fn change(effect: Effect, size: f64) -> Vec<f64> {
    let of = |case: snug_identify::FitTask| case.measured().to_vec();
    let with = of(exact(0, &[effect], &[size]));
    let without = of(exact(0, &[], &[]));
    with.iter()
        .zip(without)
        .map(|(with, without)| with - without)
        .collect()
}

fn agree(found: &[f64], expected: &[f64], share: f64) {
    assert_eq!((found.len(), expected.len()), (SAMPLES, SAMPLES));
    let largest = expected.iter().fold(0.0_f64, |most, y| most.max(y.abs()));
    for (found, expected) in found.iter().zip(expected) {
        assert!(
            (found - expected).abs() < share * largest,
            "{found} {expected}"
        );
    }
}

/// The base model is linear in its torque: what 1 Nm too much reads as is the derivative, as far as the integration's error
/// of 1e-9 goes.
#[test]
fn a_derivative_is_what_a_unit_of_the_effect_changes() {
    agree(&signature(TorqueOffset), &change(TorqueOffset, 1.0), 1e-7);
}

#[test]
fn a_start_pushes_by_its_whole_size_against_none() {
    let usual = CoulombFriction.description().parameters[0].starts[0];
    let model = Model::new(RIG, &[CoulombFriction]).expect("the effect goes with the base model");
    assert_eq!(model.parameters()[3].value, usual);
    agree(
        &signature(CoulombFriction),
        &change(CoulombFriction, usual),
        1e-9,
    );
}
