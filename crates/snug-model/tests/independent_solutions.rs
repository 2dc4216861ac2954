//! The simulation against SciPy: `lsim` for the base model, `solve_ivp` (DOP853, rtol 1e-12) for every effect.
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

fn output(
    effects: &[Effect],
    own: &[f64],
    quantity: Quantity,
    intersample: Intersample,
) -> Vec<f64> {
    let model = Model::new(RIG, effects).expect("a valid rig");
    let input = Input::new(&torque(), INTERVAL_S, intersample);
    let values: Vec<f64> = BASE.iter().chain(own).copied().collect();
    let mut output = vec![0.0; SAMPLES];
    model.output(&values, &input, quantity, &mut output);
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
    let angle = |intersample| output(&[], &[], Quantity::Displacement, intersample);
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

/// Reference angles [rad] and accelerations [rad/s²] at the compared samples.
struct Case {
    effect: Effect,
    own: &'static [f64],
    angle: [f64; 4],
    acceleration: [f64; 4],
    tolerance: f64,
}

/// One Runge–Kutta step of 1 ms errs by (h ω)⁵/120 ≈ 1e−10 of the amplitude; friction turns over within few samples.
#[test]
fn each_effect_agrees_with_an_adaptive_integrator() {
    let cases = [
        Case {
            effect: Effect::CubicStiffness,
            own: &[9e5],
            angle: [
                0.0027008858870995324,
                0.036521834345374427,
                0.04850620489342817,
                -0.009492348845688456,
            ],
            acceleration: [
                14.70402170259769,
                15.079547306231703,
                -16.503178029764403,
                3.6551087787099314,
            ],
            tolerance: 1e-8,
        },
        Case {
            effect: Effect::CoulombFriction,
            own: &[5.0],
            angle: [
                0.0020578235388338324,
                0.032311171049880905,
                0.04455488362713189,
                -0.0006687464380751063,
            ],
            acceleration: [
                12.984582026797034,
                16.377152205070097,
                -11.878527087030815,
                1.0099413913099802,
            ],
            tolerance: 1e-5,
        },
        Case {
            effect: Effect::MaxwellBranch,
            own: &[800.0, 0.03],
            angle: [
                0.002684714462578315,
                0.03551675749062015,
                0.046297433277073544,
                -0.004596062659637479,
            ],
            acceleration: [
                14.415369241102738,
                14.317028146965146,
                -14.307966380615925,
                2.3795801773867225,
            ],
            tolerance: 1e-8,
        },
        Case {
            effect: Effect::InitialMotion,
            own: &[0.01, -0.3],
            angle: [
                0.0012397928798096548,
                0.032160073589704734,
                0.04815167750377608,
                -0.00876247521393463,
            ],
            acceleration: [
                18.423838546236286,
                17.835367748444487,
                -16.580630283359966,
                4.1392007031882265,
            ],
            tolerance: 1e-8,
        },
        Case {
            effect: Effect::TorqueDelay,
            own: &[0.004],
            angle: [
                0.0018017936780405422,
                0.03228135313978838,
                0.05194109034867598,
                -0.009335534981171175,
            ],
            acceleration: [
                13.486189951793646,
                16.465166049384376,
                -18.761884495906113,
                4.605839243801918,
            ],
            tolerance: 1e-8,
        },
    ];
    for Case {
        effect,
        own,
        angle,
        acceleration,
        tolerance,
    } in cases
    {
        let of = |quantity| output(&[effect], own, quantity, Intersample::Linear);
        assert_agrees(&of(Quantity::Displacement), angle, tolerance);
        assert_agrees(&of(Quantity::Acceleration), acceleration, 1e3 * tolerance);
    }
}

#[test]
fn sensor_offsets_add_what_their_equations_say() {
    let input_rest_s = 1.48;
    let model = Model::new(RIG, &[Effect::AccelerationBias]).expect("a valid rig");
    let input =
        Input::new(&torque(), INTERVAL_S, Intersample::Linear).with_rest_before(input_rest_s);
    let values = [BASE[0], BASE[1], BASE[2], 0.3];
    let plain = output(&[], &[], Quantity::Displacement, Intersample::Linear);
    let mut biased = vec![0.0; SAMPLES];
    model.output(&values, &input, Quantity::Displacement, &mut biased);
    let elapsed = input_rest_s + 200.0 * INTERVAL_S;
    assert!((biased[200] - plain[200] - 0.15 * elapsed * elapsed).abs() < 1e-13);

    let shifted = output(
        &[Effect::OutputOffset],
        &[0.02],
        Quantity::Velocity,
        Intersample::Linear,
    );
    let straight = output(&[], &[], Quantity::Velocity, Intersample::Linear);
    assert!((shifted[123] - straight[123] - 0.02).abs() < 1e-15);
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
    model.output(&BASE, &input, Quantity::Displacement, &mut angle);
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
        let euler = euler_displacement(&RIG, &BASE, &fine, interval_s);
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
