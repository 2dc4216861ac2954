//! Scores of a few tightenings whose residual is known exactly.

use super::*;
use crate::data::cases::{Cases, Tally};
use crate::pooled::fit::fit_effects;
use crate::tests::made_up::{NOISE, SAMPLES, WHOLE, close, custom_force, exact, hand};
use snug_campaign::Correction;
use snug_identify::FitTask;
use snug_model::Effect::{AccelerationBias, CubicStiffness, TorqueOffset};

const CAMPAIGNS: usize = 2000;

/// Scores `effect` against the base model with m, c, k of the hands that made `cases`, each times its factor.
fn scored<T>(
    cases: &[FitTask<'_>],
    factors: [f64; 3],
    effect: Effect,
    campaigns: usize,
    look: impl Fn(&Scorer<'_, '_>, &Scored) -> T,
) -> T {
    let tally = Tally::default();
    let pooled = PooledModel::new(Cases::new(cases, &tally), &[]).expect("the base model is one");
    let own = (0..cases.len())
        .map(|number| {
            let pairs = hand(number).into_iter().zip(factors);
            pairs.map(|(value, factor)| value * factor).collect()
        })
        .collect();
    let names = ["mass_kg", "damping_kg_per_s", "stiffness_n_per_m"];
    let squares = vec![SAMPLES as f64; cases.len()];
    let fitted = Fitted::made_up(&[], &squares, SAMPLES).with_own(&names, own, 0);
    let control = Control { campaigns, seed: 1 };
    let scorer = Scorer::new(&pooled, &fitted, WHOLE, control);
    let scored = scorer.score(&[effect]).expect("it can be simulated");
    look(&scorer, &scored)
}

fn column(cases: &[FitTask<'_>], factors: [f64; 3], effect: Effect) -> Column {
    scored(cases, factors, effect, 0, |_, scored| {
        scored.columns[0].clone()
    })
}

/// A torque offset acts linearly, so its predicted size Σ s / Σ I is its size; what is left is that signatures are averaged
/// over 20 ms, where the hand swings in 280.
#[test]
fn the_predicted_size_of_a_linear_effect_is_its_size() {
    let cases: Vec<FitTask> = (0..3).map(|n| exact(n, &[TorqueOffset], &[0.5])).collect();
    let column = column(&cases, [1.0; 3], TorqueOffset);
    assert!(
        column.scores.iter().all(|&score| score > 0.0),
        "each tightening says so"
    );
    let predicted = column.scores.iter().sum::<f64>() / column.information;
    close(predicted, 0.5, 0.1);
}

/// A hand that is 0.1 ‰ heavier, better damped and softer than the model's leaves a residual that its own m, c, k explain.
#[test]
fn what_mass_damping_and_stiffness_can_imitate_speaks_for_no_effect() {
    let cases: Vec<FitTask> = (0..3).map(|n| exact(n, &[], &[])).collect();
    let column = column(&cases, [0.9999, 0.9999, 1.0001], CubicStiffness);
    let residual = scored(
        &cases,
        [0.9999, 0.9999, 1.0001],
        CubicStiffness,
        0,
        |scorer, _| {
            let values = scorer.values(0);
            let mut room = Room::default();
            let (residual, _) = scorer.pooled.weighted(0, &values, &[], &mut room);
            dot(residual, residual)
        },
    );
    assert!(residual > 1e-6, "there is a residual: {residual:e}");
    assert!(
        column.predicted_gain() < 1e-4 * residual,
        "{:e}",
        column.predicted_gain()
    );
}

/// What the model has already, under another name: 2 x³ for a cubic spring's x³.
#[test]
fn what_a_shared_size_of_the_model_can_imitate_is_not_new() {
    let cases: Vec<FitTask> = (0..3)
        .map(|n| exact(n, &[CubicStiffness], &[2e6]))
        .collect();
    let tally = Tally::default();
    let counted = Cases::new(&cases, &tally);
    let information = |effects: &[Effect], effect: Effect| {
        let fitted = fit_effects(counted, effects, None, WHOLE).expect("it can be fitted");
        let pooled = PooledModel::new(counted, effects).expect("the effects go together");
        let scorer = Scorer::new(&pooled, &fitted, WHOLE, Control::default());
        scorer
            .score(&[effect])
            .expect("it can be simulated")
            .columns[0]
            .information
    };
    let again = custom_force("cubic_again", "2*p*x^3", 0.0);
    let beside_nothing = information(&[TorqueOffset], again);
    let beside_itself = information(&[CubicStiffness], again);
    // Averaging over 20 ms, which the model's own size is not, leaves a little.
    assert!(
        beside_itself < 0.02 * beside_nothing,
        "{beside_itself:e} of {beside_nothing:e}"
    );
}

/// Scores of nothing but noise have the variance that they are judged by; that of 2000 draws scatters by 3 %.
#[test]
fn campaigns_of_noise_scatter_as_the_variances_say() {
    let cases: Vec<FitTask> = (0..2).map(|n| exact(n, &[], &[])).collect();
    scored(
        &cases,
        [1.0; 3],
        CubicStiffness,
        CAMPAIGNS,
        |scorer, scored| {
            assert_eq!(scorer.control_campaigns(), CAMPAIGNS);
            for unit in 0..2 {
                let draws = (0..CAMPAIGNS).map(|one| scorer.of_noise(scored, one)[0].scores[unit]);
                let squares: f64 = draws.map(|score| score * score).sum();
                close(
                    squares / CAMPAIGNS as f64,
                    scored.columns[0].variances[unit],
                    0.16,
                );
            }
            let drawn = |one| scorer.of_noise(scored, one)[0].scores[0];
            assert_ne!(drawn(0), drawn(1));
        },
    );
}

#[test]
fn without_a_known_noise_there_is_no_campaign_of_it() {
    let mut case = exact(0, &[], &[]);
    case.tightening.to_mut().noise = None;
    let (cases, tally) = ([case], Tally::default());
    let pooled = PooledModel::new(Cases::new(&cases, &tally), &[]).expect("it is one");
    let fitted = Fitted::made_up(&[], &[1.0], SAMPLES);
    let control = Control {
        campaigns: 10,
        seed: 1,
    };
    let of = |fitted: &Fitted, clusters| {
        Scorer::new(&pooled, fitted, clusters, control).control_campaigns()
    };
    assert_eq!(of(&fitted, WHOLE), 10);
    assert_eq!(
        of(&fitted, Clusters { per_case: 6 }),
        0,
        "stretches of a record are not drawn"
    );
    assert_eq!(of(&fitted.unweighted(), WHOLE), 0);
}

/// A bias that was taken out with standard error e comes back as e · 1/σ in every sample: a signature of the same shape, so
/// I becomes I (1 + e² I). Averaging changes no constant.
#[test]
fn the_uncertainty_of_the_bias_that_was_taken_out_widens_what_looks_like_it() {
    let plain = exact(0, &[], &[]);
    let mut corrected = plain.clone();
    let error = 0.05;
    corrected.tightening.to_mut().corrections.push(Correction {
        effect: "acceleration_bias".to_owned(),
        constant_of: Some(Quantity::Acceleration),
        value: 0.3,
        standard_error: error,
        unit: "rad/s^2".to_owned(),
        significant: true,
    });
    let variance = |case: FitTask<'_>| column(&[case], [1.0; 3], AccelerationBias).variances[0];
    let (information, widened) = (variance(plain), variance(corrected));
    assert!(
        information < SAMPLES as f64 / NOISE.powi(2),
        "m, c, k imitate a part of it"
    );
    close(
        widened,
        information * (1.0 + error * error * information),
        1e-9,
    );
}
