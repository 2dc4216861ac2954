//! What is suspected of records that were made wrong on purpose.
#![allow(clippy::unwrap_used)]

use super::*;
use crate::tests::made_up::on_machine;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use snug_campaign::{Intersample, Rig, Tightening};
use snug_identify::IdentifySettings;
use snug_model::{Input, Model, Scale};

const RIG: Rig = Rig {
    lever_arm_m: 1.0,
    known_inertia_kg_m2: 0.0,
};
const INTERVAL_S: f64 = 0.01;
const SAMPLES: usize = 4_000;

fn random(seed: u64) -> Vec<f64> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    (0..SAMPLES).map(|_| rng.random_range(-1.0..1.0)).collect()
}

/// A torque that nobody repeats, and the angle of 1 kg on 4 kg/s and 50 N/m.
fn oscillator() -> (Vec<f64>, Vec<f64>) {
    let torque_nm = random(1);
    let input = Input::new(&torque_nm, INTERVAL_S, Intersample::Linear);
    let mut angle_rad = vec![0.0; SAMPLES];
    let model = Model::new(RIG, &[]).unwrap();
    let quantity = Quantity::Displacement;
    model
        .output(&[1.0, 4.0, 50.0], &input, quantity, &mut angle_rad)
        .unwrap();
    (torque_nm, angle_rad)
}

/// As a study declares it.
fn declared(torque_nm: Vec<f64>, output: Vec<f64>, quantity: Quantity) -> FitTask<'static> {
    let input = Input::new(&torque_nm, INTERVAL_S, Intersample::Linear);
    let tightening = Tightening::from_torque(RIG, INTERVAL_S, torque_nm).with(quantity, output);
    FitTask {
        tightening: Cow::Owned(tightening),
        input: Cow::Owned(input),
        model: Cow::Owned(Model::new(RIG, &[]).unwrap()),
        settings: Cow::Owned(IdentifySettings {
            fitted_output: quantity,
            ..IdentifySettings::default()
        }),
    }
}

/// Of a model that explains nothing.
fn suspected(task: FitTask<'_>) -> Vec<Suspicion> {
    let explained = Explained {
        output: task.quantity().name(),
        share: 0.0,
        neighbours: 0.0,
        is_exact: false,
        beside_lines: false,
    };
    suspicions(&[task], explained, None)
}

#[test]
fn right_columns_and_no_fit_are_a_poor_minimum() {
    let (torque_nm, angle_rad) = oscillator();
    let found = suspected(declared(torque_nm, angle_rad, Quantity::Displacement));
    assert!(
        matches!(found[..], [Suspicion::PoorMinimum(share)] if share > 0.99),
        "{found:?}"
    );
}

#[test]
fn another_sign_is_suspected() {
    let (torque_nm, angle_rad) = oscillator();
    let pulled = torque_nm.iter().map(|torque| -torque).collect();
    let found = suspected(declared(pulled, angle_rad, Quantity::Displacement));
    assert!(
        matches!(found[0], Suspicion::Sign(share) if share > 0.99),
        "{found:?}"
    );
}

/// Three recordings of a machine, of which the input of the second has the other sign; and all three with it.
#[test]
fn a_recording_whose_input_is_turned_round_is_named() {
    let (torque_nm, angle_rad) = oscillator();
    let recording = |place: usize, sign: f64| {
        let torque_nm = torque_nm.iter().map(|torque| sign * torque).collect();
        let scale = Scale::Rig {
            torque_nm: 1.0,
            angle_rad: 0.02,
            time_s: 0.14,
        };
        let angle_rad = angle_rad.clone();
        let mut task = on_machine(
            scale,
            INTERVAL_S,
            torque_nm,
            Quantity::Displacement,
            angle_rad,
        );
        task.tightening.to_mut().id.file = format!("{place}.csv");
        task
    };
    let found = turned_round(&[recording(0, 1.0), recording(1, -1.0), recording(2, 1.0)]);
    let found = found.expect("one is turned round");
    assert_eq!((found.recordings, found.of), (vec!["1.csv".to_owned()], 3));
    assert!(found.share > 0.99);
    for sign in [1.0, -1.0] {
        let alike = [0, 1, 2].map(|place| recording(place, sign));
        assert_eq!(turned_round(&alike), None);
    }
}

#[test]
fn swapped_columns_are_suspected() {
    let (torque_nm, angle_rad) = oscillator();
    let found = suspected(declared(angle_rad, torque_nm, Quantity::Displacement));
    let is_it = |one: &Suspicion| matches!(one, Suspicion::Swapped(share) if *share > 0.99);
    assert!(found.iter().any(is_it), "{found:?}");
}

#[test]
fn an_output_without_its_sign_is_suspected() {
    let (torque_nm, angle_rad) = oscillator();
    let folded = angle_rad.iter().map(|angle| angle.abs()).collect();
    let found = suspected(declared(torque_nm, folded, Quantity::Displacement));
    assert_eq!(found, [Suspicion::NoSign("displacement")]);
}

#[test]
fn another_derivative_is_suspected() {
    let (torque_nm, angle_rad) = oscillator();
    let found = suspected(declared(torque_nm, angle_rad, Quantity::Acceleration));
    let is_it = |one: &Suspicion| {
        let Suspicion::Derivative {
            declared,
            other,
            share,
        } = *one
        else {
            return false;
        };
        (declared, other) == ("acceleration", "displacement") && share > 0.99
    };
    assert!(found.iter().any(is_it), "{found:?}");
}

#[test]
fn two_signals_that_know_nothing_of_each_other_are_no_oscillator() {
    let smooth: Vec<f64> = (random(2).windows(8))
        .map(|some| some.iter().sum())
        .chain([0.0; 7])
        .collect();
    let found = suspected(declared(random(1), smooth, Quantity::Velocity));
    assert_eq!(found, [Suspicion::NoOscillator]);
}

#[test]
fn where_noise_alone_is_measured_nothing_moves() {
    let found = suspected(declared(random(1), random(2), Quantity::Velocity));
    assert_eq!(found, [Suspicion::Still]);
}

#[test]
fn one_spike_is_told_before_that_nothing_moves() {
    let (torque_nm, mut angle_rad) = oscillator();
    angle_rad[SAMPLES / 2] = 1e12;
    let spike = told_of(&angle_rad, 0.0);
    let task = declared(torque_nm, angle_rad, Quantity::Displacement);
    let explained = Explained {
        output: "displacement",
        share: 0.0,
        neighbours: 0.0,
        is_exact: false,
        beside_lines: false,
    };
    let found = suspicions(&[task], explained, spike);
    assert!(
        matches!(found[..], [Suspicion::Outliers { share, .. }] if share > 0.99),
        "{found:?}"
    );
}

/// What is told of a model that leaves what was measured `beside` its motion.
fn told_of(beside: &[f64], share: f64) -> Option<Suspicion> {
    let (torque_nm, angle_rad) = oscillator();
    let measured = angle_rad.iter().zip(beside).map(|(y, beside)| y + beside);
    let task = declared(torque_nm, measured.collect(), Quantity::Displacement);
    let mut simulated = snug_campaign::Motion::default();
    simulated.set(Quantity::Displacement, angle_rad);
    let estimate =
        snug_identify::identify(&task.model, &task.input, &task.tightening, &task.settings)
            .unwrap();
    let seen = [Seen {
        tightening: &task.tightening,
        simulated: &simulated,
        estimate: &estimate,
        unscored: 0,
    }];
    let explained = Explained {
        output: "displacement",
        share,
        neighbours: correlation(&left(&[task.lent()], &seen)),
        is_exact: false,
        beside_lines: false,
    };
    left_over(&[task.lent()], Some(&explained), &seen)
}

#[test]
fn spikes_and_noise_are_told_from_a_motion_that_is_left() {
    let mut spikes = random(3).iter().map(|one| 1e-3 * one).collect::<Vec<_>>();
    for place in (50..SAMPLES).step_by(400) {
        spikes[place] = 0.5;
    }
    let found = told_of(&spikes, 0.4);
    assert!(
        matches!(found, Some(Suspicion::Outliers { samples: 40, of: 4000, share }) if share > 0.99),
        "{found:?}"
    );
    assert_eq!(told_of(&random(3), 0.4), Some(Suspicion::Noise));
    assert_eq!(told_of(&random(3), -0.1), None);
    let motion: Vec<f64> = (0..SAMPLES).map(|k| (0.05 * k as f64).sin()).collect();
    assert_eq!(told_of(&motion, 0.4), None);
}

/// A motion that is a tenth of what was missing is more than noise; a hundredth of it, or as much that is white, is not told as more.
#[test]
fn only_a_motion_that_is_no_small_part_is_more_than_noise_of_an_unknown_size() {
    let left = |squares| Fitted::made_up(&[], &[squares], 100).unweighted();
    let leaves_more = |squares, neighbours| {
        let explained = Explained {
            output: "displacement",
            share: 0.99,
            neighbours,
            is_exact: false,
            beside_lines: false,
        };
        leaves_more_than_noise(&left(1000.0), &left(squares), Some(&explained))
    };
    assert!(leaves_more(100.0, 0.9));
    assert!(!leaves_more(10.0, 0.9));
    assert!(!leaves_more(100.0, 0.1));
}
