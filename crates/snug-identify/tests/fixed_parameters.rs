//! A fixed parameter that is not known exactly: against the covariance of a fit in which it is free.

#![allow(clippy::unwrap_used)]

use snug_campaign::{Estimate, Intersample, NoiseFloor, Quantity, Rig, Tightening};
use snug_identify::{IdentifySettings, identify};
use snug_model::{Effect, Input, Model};

const RIG: Rig = Rig {
    lever_arm_m: 0.33,
    known_inertia_kg_m2: 0.275,
};
const SAMPLES: usize = 1500;
const INTERVAL_S: f64 = 2e-4;
const NOISE_RAD_PER_S2: f64 = 0.5;
const TRUTH: [f64; 4] = [2.3, 103.0, 2315.0, 8e5];

fn input() -> Input {
    let torque: Vec<f64> = (0..SAMPLES)
        .map(|index| {
            if index < 400 {
                0.075 * index as f64
            } else {
                0.0
            }
        })
        .collect();
    Input::new(&torque, INTERVAL_S, Intersample::Linear)
}

/// The true acceleration with noise from a fixed congruential sequence, uniform with the stated standard deviation.
fn tightening(model: &Model) -> Tightening {
    let mut acceleration = vec![0.0; SAMPLES];
    model
        .output(&TRUTH, &input(), Quantity::Acceleration, &mut acceleration)
        .unwrap();
    let mut state = 12_345_u64;
    for value in &mut acceleration {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let uniform = (state >> 11) as f64 / (1_u64 << 53) as f64;
        *value += NOISE_RAD_PER_S2 * 12.0_f64.sqrt() * (uniform - 0.5);
    }
    Tightening::from_torque(RIG, INTERVAL_S, input().logged_nm().to_vec())
        .with(Quantity::Acceleration, acceleration)
        .with_noise(NoiseFloor::white(Quantity::Acceleration, NOISE_RAD_PER_S2))
}

fn estimate(model: &Model, tightening: &Tightening) -> Estimate {
    identify(model, &input(), tightening, &IdentifySettings::default()).unwrap()
}

/// With k3 fixed at the joint optimum and its standard error there, m, c, k keep the joint fit's covariance:
/// (M⁻¹)₁₁ = A⁻¹ + A⁻¹ B (M⁻¹)₂₂ Bᵀ A⁻¹ for the blocks A, B of M = JᵀJ.
#[test]
fn a_parameter_fixed_where_a_joint_fit_found_it_leaves_the_others_as_uncertain_as_there() {
    let mut model = Model::new(RIG, &[Effect::CubicStiffness]).unwrap();
    let tightening = tightening(&model);
    let joint = estimate(&model, &tightening);
    let cubic = joint.parameter("k3_n_per_m3").unwrap().clone();
    let sigma = cubic.standard_error.unwrap();

    let parameter = &mut model.parameters_mut()[3];
    parameter.fixed = true;
    parameter.value = cubic.value;
    let exact = estimate(&model, &tightening);
    assert_eq!(exact.parameter("k3_n_per_m3").unwrap().interval, None);

    model.parameters_mut()[3].standard_error = Some(sigma);
    let uncertain = estimate(&model, &tightening);
    for row in 0..3 {
        for column in 0..3 {
            let size =
                (joint.covariance[row * 4 + row] * joint.covariance[column * 4 + column]).sqrt();
            let (found, expected) = (
                uncertain.covariance[row * 3 + column],
                joint.covariance[row * 4 + column],
            );
            assert!(
                (found - expected).abs() < 0.01 * size,
                "{row}, {column}: {found:e} against {expected:e}"
            );
        }
        let error = |estimate: &Estimate| estimate.parameters[row].standard_error.unwrap();
        assert!((error(&uncertain) / error(&joint) - 1.0).abs() < 0.01);
        let half = |estimate: &Estimate| {
            let interval = estimate.parameters[row].interval.unwrap();
            interval.high - interval.low
        };
        assert!((half(&uncertain) / half(&joint) - 1.0).abs() < 0.01);
        assert!(
            (uncertain.parameters[row].value - joint.parameters[row].value).abs()
                < 0.05 * error(&joint)
        );
    }
    // The check could fail: for the stiffness it makes a difference.
    let error = |estimate: &Estimate| estimate.parameters[2].standard_error.unwrap();
    assert!(
        error(&uncertain) > 1.2 * error(&exact),
        "{} against {}",
        error(&uncertain),
        error(&exact)
    );

    let fixed = uncertain.parameter("k3_n_per_m3").unwrap();
    assert!(fixed.fixed);
    assert_eq!(
        (fixed.value, fixed.standard_error),
        (cubic.value, Some(sigma))
    );
    let interval = fixed.interval.unwrap();
    assert!(((interval.high - cubic.value) / sigma - 1.959964).abs() < 1e-6);
    assert!(((cubic.value - interval.low) / sigma - 1.959964).abs() < 1e-6);
}
