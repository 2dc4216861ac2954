//! Starts from spectra: the truth behind simulated records, whatever the units.
#![allow(clippy::unwrap_used)]

use super::*;
use crate::residual::restarts::motions_at;
use crate::settings::IdentifySettings;
use proptest::prelude::*;
use snug_campaign::{Intersample, Rig, Tightening};
use snug_model::{Input, Model};
use std::borrow::Cow;

const RIG: Rig = Rig {
    lever_arm_m: 0.5,
    known_inertia_kg_m2: 0.1,
};
/// Two minutes at 100 Hz; resonance at 0.8 Hz.
const INTERVAL_S: f64 = 0.01;
const SAMPLES: usize = 12_000;
const TRUTH: [f64; 3] = [1.6, 3.0, 50.0];

/// Torque steps of all lengths, from rest, and what `output` they make in units `torque`, `time` and `output` times as small.
fn record(
    truth: [f64; 3],
    quantity: Quantity,
    [torque, time, output]: [f64; 3],
) -> FitTask<'static> {
    let mut torque_nm = Vec::with_capacity(SAMPLES);
    let (mut level, mut state) = (1.0, 12_345_u64);
    while torque_nm.len() < SAMPLES {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        let length = 20 + (state >> 33) as usize % 200;
        torque_nm.extend((0..length).map(|_| level + 0.3));
        level = -level;
    }
    torque_nm.truncate(SAMPLES);
    let model = Model::new(RIG, &[]).unwrap();
    let input = Input::new(&torque_nm, INTERVAL_S, Intersample::BandLimited);
    let mut motion = vec![0.0; SAMPLES];
    model.output(&truth, &input, quantity, &mut motion).unwrap();
    let scaled =
        |values: &[f64], factor: f64| values.iter().map(|v| v * factor).collect::<Vec<_>>();
    // Inertia is torque over output, times time squared for each time the output still has to be differentiated.
    let left = 2 - Record::order_of(quantity);
    let rig = Rig {
        known_inertia_kg_m2: RIG.known_inertia_kg_m2 * torque / output * f64::powi(time, left),
        ..RIG
    };
    let torque_nm = scaled(&torque_nm, torque);
    let tightening = Tightening::from_torque(rig, INTERVAL_S * time, torque_nm.clone())
        .with(quantity, scaled(&motion, output));
    FitTask {
        input: Cow::Owned(Input::new(
            &torque_nm,
            INTERVAL_S * time,
            Intersample::BandLimited,
        )),
        model: Cow::Owned(Model::new(rig, &[]).unwrap()),
        settings: Cow::Owned(IdentifySettings {
            fitted_output: quantity,
            ..IdentifySettings::default()
        }),
        tightening: Cow::Owned(tightening),
    }
}

const AS_IT_IS: [f64; 3] = [1.0; 3];

#[test]
fn the_truth_is_found_from_whatever_was_measured() {
    for quantity in Quantity::ALL {
        let start = spectral_start(&[record(TRUTH, quantity, AS_IT_IS)]).unwrap();
        for (found, truth) in start.values.iter().zip(TRUTH) {
            assert!((found / truth - 1.0).abs() < 0.02, "{quantity:?} {start:?}");
        }
        assert!(start.unexplained < 1e-3, "{quantity:?} {start:?}");
    }
}

/// A drive has no spring, and its angle runs away.
#[test]
fn what_is_not_there_is_next_to_nothing_and_not_nothing() {
    for quantity in [Quantity::Velocity, Quantity::Displacement] {
        let start = spectral_start(&[record([1.6, 3.0, 0.0], quantity, AS_IT_IS)]).unwrap();
        let [m, c, k] = start.values;
        assert!(
            (m / 1.6 - 1.0).abs() < 0.02 && (c / 3.0 - 1.0).abs() < 0.02,
            "{start:?}"
        );
        assert!(k > 0.0 && k < 0.1, "{start:?}");
    }
}

/// A damper and a spring alone, 300 kg/s and 50 N/m, under a force that changes from sample to sample and is held between: x goes on as
/// e^(−kt/c).
#[test]
fn a_mass_that_is_not_seen_can_be_simulated() {
    let rig = Rig {
        lever_arm_m: 1.0,
        known_inertia_kg_m2: 0.0,
    };
    let torque_nm: Vec<f64> = (0..SAMPLES).map(|k| (k * k % 97) as f64 - 48.0).collect();
    let stays = f64::exp(-50.0 / 300.0 * INTERVAL_S);
    let mut angle_rad = vec![0.0];
    for torque_nm in &torque_nm[1..] {
        angle_rad.push(stays * angle_rad.last().unwrap() + (1.0 - stays) * torque_nm / 50.0);
    }
    let motion = torque_nm.iter().zip(&angle_rad);
    let velocity: Vec<f64> = motion
        .map(|(torque, angle)| (torque - 50.0 * angle) / 300.0)
        .collect();
    let input = Input::new(&torque_nm, INTERVAL_S, Intersample::Linear);
    let motions = motions_at(&angle_rad, &velocity, 20);
    let tightening = Tightening::from_torque(rig, INTERVAL_S, torque_nm);
    let task = FitTask {
        input: Cow::Owned(input.with_restarts(20, motions)),
        model: Cow::Owned(Model::new(rig, &[]).unwrap()),
        tightening: Cow::Owned(tightening.with(Quantity::Velocity, velocity)),
        ..record(TRUTH, Quantity::Velocity, AS_IT_IS)
    };
    let start = spectral_start(std::slice::from_ref(&task)).unwrap();
    let mut output = vec![0.0; SAMPLES];
    let simulated = task
        .model
        .output(&start.values, &task.input, Quantity::Velocity, &mut output);
    let largest = output.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    assert!(simulated.is_ok() && largest < 1.0, "{start:?} {largest}");
}

#[test]
fn what_does_not_move_gives_no_start() {
    let mut still = record(TRUTH, Quantity::Displacement, AS_IT_IS);
    let motion = &mut still.tightening.to_mut().motion;
    motion.set(Quantity::Displacement, vec![0.3; SAMPLES]);
    assert_eq!(spectral_start(&[still]), None);
    assert_eq!(spectral_start(&[]), None);
}

/// What is known and held is not looked for.
#[test]
fn a_fixed_parameter_stays() {
    let mut task = record(TRUTH, Quantity::Displacement, AS_IT_IS);
    let stiffness = &mut task.model.to_mut().parameters_mut()[2];
    (stiffness.fixed, stiffness.value) = (true, 50.0);
    let start = spectral_start(&[task]).unwrap();
    assert_eq!(start.values[2], 50.0);
    assert!((start.values[0] / 1.6 - 1.0).abs() < 0.02, "{start:?}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// m, c, k scale as their units do: torque over output, with a time for each derivative.
    #[test]
    fn units_do_not_matter(
        exponents in [-6.0..6.0_f64, -3.0..3.0, -6.0..6.0],
        order in 0..3_usize,
    ) {
        let quantity = Quantity::ALL[order];
        let [torque, time, output] = exponents.map(|e| 10_f64.powf(e));
        let plain = spectral_start(&[record(TRUTH, quantity, AS_IT_IS)]).unwrap();
        let scaled = spectral_start(&[record(TRUTH, quantity, [torque, time, output])]).unwrap();
        let stiffness = torque / output * time.powi(-Record::order_of(quantity));
        for (power, (found, from)) in [2, 1, 0].into_iter().zip(scaled.values.iter().zip(plain.values)) {
            let expected = from * stiffness * time.powi(power);
            prop_assert!((found / expected - 1.0).abs() < 1e-6, "{plain:?} {scaled:?}");
        }
        prop_assert!((scaled.unexplained - plain.unexplained).abs() < 1e-9);
        prop_assert!((scaled.time_s / time / plain.time_s - 1.0).abs() < 1e-6);
    }
}
