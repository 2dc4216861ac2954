//! The base model against SciPy's `lsim`, closed forms and its own convergence; effects have theirs in their own files.
//!
//! Common case: l = 0.33 m, I_n = 0.275 kg m², m = 2.3 kg, c = 103 kg/s, k = 2315 N/m, 301 samples at 1 kHz; torque
//! straight between (0 s, 0), (0.02 s, 0), (0.1 s, 30 Nm), (0.101 s, 0). Compared at samples 50, 100, 150 and 300.

use snug_campaign::{Intersample, Quantity, Rig};
use snug_model::{Effect, Input, Model, euler_displacement};

const RIG: Rig = Rig {
    lever_arm_m: 0.33,
    known_inertia_kg_m2: 0.275,
};
const BASE: [f64; 3] = [2.3, 103.0, 2315.0];
const SAMPLES: usize = 301;
const INTERVAL_S: f64 = 1e-3;
const COMPARED: [usize; 4] = [50, 100, 150, 300];

fn torque() -> Vec<f64> {
    (0..SAMPLES)
        .map(|index| match index {
            20..=100 => 30.0 * (index - 20) as f64 / 80.0,
            _ => 0.0,
        })
        .collect()
}

fn angle(intersample: Intersample) -> Vec<f64> {
    angle_with(&[], &BASE, intersample)
}

fn angle_with(effects: &[Effect], values: &[f64], intersample: Intersample) -> Vec<f64> {
    let model = Model::new(RIG, effects).expect("a valid rig");
    let input = Input::new(&torque(), INTERVAL_S, intersample);
    let mut output = vec![0.0; SAMPLES];
    model
        .output(values, &input, Quantity::Displacement, &mut output)
        .expect("a valid simulation");
    output
}

fn assert_agrees(computed: &[f64], reference: [f64; 4], tolerance: f64) {
    for (index, expected) in COMPARED.into_iter().zip(reference) {
        let error = (computed[index] - expected).abs();
        assert!(
            error < tolerance,
            "sample {index}: {} against {expected}",
            computed[index]
        );
    }
}

#[test]
fn base_model_agrees_with_lsim_under_both_holds() {
    assert_agrees(
        &angle(Intersample::Linear),
        [
            0.0027008892816023367,
            0.03658739148014635,
            0.05064282015272524,
            -0.009323497237733456,
        ],
        1e-14,
    );
    assert_agrees(
        &angle(Intersample::ZeroOrder),
        [
            0.0025754116949703925,
            0.03603438307288272,
            0.050821053928464886,
            -0.009329000819095191,
        ],
        1e-14,
    );
}

/// A lag of 4 ms, of the drive or of the sensor, is the same on a linear rig, under both holds: `lsim` of 1/((I s² + C s + K)(τ s + 1)).
/// What the sensor's lag takes as straight between samples is not, which is 2e-8 here.
#[test]
fn a_lag_before_and_after_a_linear_rig_agrees_with_lsim() {
    let under = [
        (
            Intersample::Linear,
            [
                0.0019013009475021953,
                0.03241549261747723,
                0.05177934823492287,
                -0.00929668824225077,
            ],
        ),
        (
            Intersample::ZeroOrder,
            [
                0.0018024674387483398,
                0.031895374004082516,
                0.0519198495208437,
                -0.009292953507851595,
            ],
        ),
    ];
    let values = [BASE[0], BASE[1], BASE[2], 0.004];
    for (intersample, reference) in under {
        for effect in [Effect::ActuatorLag, Effect::AccelerationLag] {
            assert_agrees(
                &angle_with(&[effect], &values, intersample),
                reference,
                3e-8,
            );
        }
    }
}

/// A band-limited input far below the fold-over: one steady sine through the base model has a closed-form amplitude.
#[test]
fn band_limited_input_gives_the_frequency_response() {
    let (samples, interval_s) = (4001, 1e-3);
    let frequency_hz = 180.0;
    let omega = 2.0 * std::f64::consts::PI * frequency_hz;
    let sine: Vec<f64> = (0..samples)
        .map(|index| (omega * index as f64 * interval_s).cos())
        .collect();
    let model = Model::new(RIG, &[]).expect("a valid rig");
    let input = Input::new(&sine, interval_s, Intersample::BandLimited);
    let mut angle = vec![0.0; samples];
    model
        .output(&BASE, &input, Quantity::Displacement, &mut angle)
        .expect("a valid simulation");
    let square = RIG.lever_arm_m * RIG.lever_arm_m;
    let inertia = RIG.known_inertia_kg_m2 + BASE[0] * square;
    let (stiffness, damping) = (BASE[2] * square, BASE[1] * square);
    let (real, imaginary) = (stiffness - inertia * omega * omega, damping * omega);
    let norm = real * real + imaginary * imaginary;
    for index in [3000, 3101, 3499] {
        let phase = omega * index as f64 * interval_s;
        let expected = (real * phase.cos() + imaginary * phase.sin()) / norm;
        let error = (angle[index] - expected).abs() * norm.sqrt();
        assert!(error < 2e-4, "relative error {error} at sample {index}");
    }
}

#[test]
fn explicit_euler_converges_to_the_exact_response_at_first_order() {
    let error = |refinement: usize| {
        let interval_s = INTERVAL_S / refinement as f64;
        let coarse = torque();
        let fine: Vec<f64> = (0..(SAMPLES - 1) * refinement + 1)
            .map(|index| {
                let (whole, part) = (index / refinement, index % refinement);
                let next = coarse.get(whole + 1).copied().unwrap_or(0.0);
                coarse[whole] + (next - coarse[whole]) * part as f64 / refinement as f64
            })
            .collect();
        let euler = euler_displacement(&RIG, &BASE, &fine, interval_s).expect("a valid simulation");
        (euler[150 * refinement] - 0.05064282015272524).abs()
    };
    let (one, eight) = (error(1), error(8));
    assert!(one < 2e-3, "{one}");
    assert!(
        (one / eight - 8.0).abs() < 1.0,
        "first order: {}",
        one / eight
    );
}
