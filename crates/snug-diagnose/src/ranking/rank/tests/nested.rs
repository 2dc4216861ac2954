//! A larger model never fits worse: every effect that may act on a rig, and every term, leaves no more than the model without it.

use super::super::*;
use crate::data::cases::Tally;
use crate::ranking::applicability;
use crate::tests::made_up::{exact, noisy, quick, silent};
use snug_campaign::{Intersample, Quantity, Rig, Tightening, TighteningId};
use snug_identify::{ConstraintKind, FitTask, IdentifySettings, Simulation};
use snug_model::Effect::{
    Backlash, CoulombFriction, CubicStiffness, GravityTorque, SecondMode, StretchReflex,
};
use snug_model::{Input, Model, Scale};
use std::borrow::Cow;

/// Share of the squared error by which fits of the same model end apart: candidates stop at 10⁻⁶.
const TOLERANCE: f64 = 1e-5;

/// Asserts it of everything that could be missing beside `effects` in `cases`.
#[track_caller]
fn assert_nested(cases: &[FitTask<'_>], effects: &[Effect], fewest: usize) {
    let tally = Tally::default();
    let clusters = Clusters::of(cases);
    let counted = Cases::new(cases, &tally);
    let current = fit_effects(counted, effects, None, clusters).expect("it can be fitted");
    let all = applicability::candidates(cases, &current, &[]).expect("the rig is one");
    assert!(all.len() >= fewest, "{} candidates", all.len());
    let settings = quick(199);
    let ranking = rank(counted, &current, &all, clusters, &settings, 0, &silent());
    let ranking = ranking.expect("it can be ranked");
    assert_eq!(ranking.impossible, []);
    let most = (1.0 + TOLERANCE) * current.squares();
    let worse: Vec<String> = (ranking.candidates.iter())
        .filter(|candidate| candidate.fitted.squares() > most)
        .map(|candidate| {
            let times = candidate.fitted.squares() / current.squares();
            format!("{} leaves {times} times as much", candidate.effect.name())
        })
        .collect();
    assert!(worse.is_empty(), "{worse:#?}");
}

#[test]
fn of_tightenings_by_hand() {
    let cases: Vec<FitTask> = (0..8)
        .map(|n| noisy(n, &[CubicStiffness], &[2e6]))
        .collect();
    assert_nested(&cases, &[], 30);
}

/// Where only noise is left, and where the grip lets go.
#[test]
fn of_tightenings_by_hand_with_an_effect_already() {
    let cases: Vec<FitTask> = (0..8).map(|n| noisy(n, &[Backlash], &[5e-4])).collect();
    assert_nested(&cases, &[Backlash], 30);
}

/// What nobody could follow, without noise and from few tightenings, which are cut into stretches.
#[test]
fn of_few_tightenings() {
    let (effects, sizes) = ([StretchReflex, CoulombFriction], [400.0, 0.06, 8.0]);
    let cases: Vec<FitTask> = (0..3).map(|n| exact(n, &effects, &sizes)).collect();
    assert_nested(&cases, &[], 30);
}

const MACHINE: Rig = Rig {
    lever_arm_m: 1.0,
    known_inertia_kg_m2: 0.0,
};
const INTERVAL_S: f64 = 0.005;

/// A record of a machine of `m, c, k` with `effects` of these `sizes`, `quantity` measured with a fast tone on top; its study begins
/// a third off.
fn record(
    mck: [f64; 3],
    (effects, sizes): (&[Effect], &[f64]),
    scale: Scale,
    quantity: Quantity,
    simulation: Simulation,
) -> FitTask<'static> {
    let tones = [(4.1, 5.0), (11.3, 4.0), (23.7, 4.0), (37.9, 3.0)];
    let torque = |t: f64| -> f64 { tones.iter().map(|(w, a)| a * (w * t + a).sin()).sum() };
    let torque_nm: Vec<f64> = (0..600)
        .map(|i| torque(f64::from(i) * INTERVAL_S))
        .collect();
    let input = Input::new(&torque_nm, INTERVAL_S, Intersample::Linear);
    let scaled: Vec<Effect> = (effects.iter())
        .map(|&effect| scale.effect(effect, &MACHINE).expect("it is finite"))
        .collect();
    let truth = Model::scaled(MACHINE, &scaled, scale).expect("the effects go together");
    let motion = truth.simulate(&[&mck, sizes].concat(), &input);
    let motion = motion.expect("as many values as parameters");
    let exact = motion.get(quantity).expect("it is simulated");
    let power = exact.iter().map(|y| y * y).sum::<f64>() / exact.len() as f64;
    let measured = (exact.iter().enumerate())
        .map(|(i, y)| y + 0.01 * power.sqrt() * (2.9 * i as f64).sin())
        .collect();
    let mut tightening =
        Tightening::from_torque(MACHINE, INTERVAL_S, torque_nm).with(quantity, measured);
    tightening.id = TighteningId {
        file: "machine.csv".into(),
        number: 1,
    };
    let mut model = Model::scaled(MACHINE, &[], scale).expect("the rig is one");
    for (parameter, value) in model.parameters_mut().iter_mut().zip(mck) {
        parameter.value = 1.3 * value.max(0.01);
    }
    FitTask {
        input: Cow::Owned(simulation.of(input, &tightening)),
        tightening: Cow::Owned(tightening),
        model: Cow::Owned(model),
        settings: Cow::Owned(IdentifySettings {
            fitted_output: quantity,
            constraints: vec![ConstraintKind::Positive],
            simulation,
            ..IdentifySettings::default()
        }),
    }
}

/// Its torque, how far it moves and how long it takes to.
fn rig(torque_nm: f64, angle_rad: f64, time_s: f64) -> Scale {
    Scale::Rig {
        torque_nm,
        angle_rad,
        time_s,
    }
}

#[test]
fn of_a_drive_without_a_spring() {
    let mck = [0.11, 1.9, 0.0];
    let with = (&[CoulombFriction][..], &[0.6][..]);
    let scale = rig(4.0, 0.3, 0.1);
    let case = record(mck, with, scale, Quantity::Velocity, Simulation::FreeRun);
    assert_nested(&[case], &[], 25);
}

#[test]
fn of_a_mass_on_a_spring_in_acceleration() {
    let with = (&[CubicStiffness][..], &[4e4][..]);
    let (mck, scale) = ([2.0, 6.0, 800.0], rig(5.7, 0.01, 0.05));
    let quantity = Quantity::Acceleration;
    let case = record(mck, with, scale, quantity, Simulation::FreeRun);
    assert_nested(&[case], &[], 25);
}

/// Driven and measured at different places.
#[test]
fn of_an_arm_with_two_modes() {
    let with = (&[SecondMode][..], &[-0.4, 7.0, 0.03, 0.0][..]);
    let (mck, scale) = ([1.0, 2.0, 300.0], rig(5.7, 0.02, 0.06));
    let quantity = Quantity::Acceleration;
    let case = record(mck, with, scale, quantity, Simulation::FreeRun);
    assert_nested(&[case], &[], 25);
}

#[test]
fn of_a_pendulum_run_freely_and_restarted() {
    let with = (&[GravityTorque][..], &[-12.0, 1.0][..]);
    let (mck, scale) = ([1.0, 1.5, 0.0], rig(5.7, 0.5, 0.2));
    for simulation in [Simulation::FreeRun, Simulation::Restarted { every_s: 0.15 }] {
        let case = record(mck, with, scale, Quantity::Displacement, simulation);
        assert_nested(&[case], &[], 20);
    }
}
