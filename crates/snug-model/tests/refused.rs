//! What cannot be simulated is refused with a reason: neither a panic nor an answer that is no number.
#![allow(clippy::unwrap_used)]

use snug_campaign::{Intersample, Quantity, Rig};
use snug_model::{
    Effect, Input, MAXIMUM_FREE, Model, ModelError, Run, euler_displacement, simulate_side_by_side,
    spring_damper_force,
};

const RIG: Rig = Rig {
    lever_arm_m: 0.33,
    known_inertia_kg_m2: 0.275,
};
const HAND: [f64; 3] = [2.1, 104.0, 2450.0];
const SAMPLES: usize = 50;
const KINDS: [Intersample; 3] = [
    Intersample::ZeroOrder,
    Intersample::Linear,
    Intersample::BandLimited,
];

fn input() -> Input {
    Input::new(&[10.0; SAMPLES], 1e-3, Intersample::Linear)
}

fn base() -> Model {
    Model::new(RIG, &[]).unwrap()
}

/// Why each way to simulate refuses; all of them for the same reason.
fn refusal(model: &Model, values: &[f64], input: &Input) -> ModelError {
    let reason = model.simulate(values, input).unwrap_err();
    let mut room = vec![0.0; input.samples()];
    let output = model.output(values, input, Quantity::Velocity, &mut room);
    assert_eq!(output.unwrap_err().to_string(), reason.to_string());
    reason
}

#[test]
fn as_many_values_as_the_model_has_parameters() {
    for (model, given) in [
        (base(), &HAND[..2]),
        (base(), &[2.1, 104.0, 2450.0, 1e6]),
        (Model::new(RIG, &[Effect::CubicStiffness]).unwrap(), &HAND),
        (Model::new(RIG, &[Effect::MaxwellBranch]).unwrap(), &[]),
    ] {
        let expected = model.parameters().len();
        assert_eq!(
            refusal(&model, given, &input()),
            ModelError::Length {
                what: "values",
                found: given.len(),
                expected
            }
        );
    }
}

#[test]
fn an_input_without_samples() {
    for kind in KINDS {
        let nothing = Input::new(&[], 1e-3, kind);
        assert_eq!(refusal(&base(), &HAND, &nothing), ModelError::NoSamples);
        let one = Input::new(&[1.0], 1e-3, kind);
        let motion = base().simulate(&HAND, &one).unwrap();
        assert_eq!(motion.displacement_rad, Some(vec![0.0]), "one is enough");
    }
}

#[test]
fn an_interval_that_is_none() {
    for interval_s in [0.0, -1e-3, f64::NAN, f64::INFINITY] {
        for kind in KINDS {
            let input = Input::new(&[1.0; SAMPLES], interval_s, kind);
            let told = refusal(&base(), &HAND, &input).to_string();
            let expected = format!("the input's interval_s is {interval_s} s");
            assert!(told.contains(&expected), "{told}");
        }
        let euler = euler_displacement(&RIG, &HAND, &[1.0; 3], interval_s);
        assert!(matches!(euler, Err(ModelError::InputTime { .. })));
    }
    for input in [
        input().with_onset(f64::NAN),
        input().with_rest_before(f64::INFINITY),
    ] {
        let reason = refusal(&base(), &HAND, &input);
        assert!(matches!(reason, ModelError::InputTime { .. }), "{reason}");
    }
}

#[test]
fn a_torque_that_is_no_number() {
    let mut torque_nm = [1.0; SAMPLES];
    torque_nm[7] = f64::NAN;
    torque_nm[9] = f64::INFINITY;
    for kind in KINDS {
        let input = Input::new(&torque_nm, 1e-3, kind);
        let told = refusal(&base(), &HAND, &input).to_string();
        assert!(told.contains("NaN Nm at sample 7"), "{told}");
        assert!(
            base().simulate(&HAND, &input.beginning(7)).is_ok(),
            "{kind:?}"
        );
        assert!(base().simulate(&HAND, &input.beginning(8)).is_err());
    }
    let noisy = input().with_added(&torque_nm);
    let reason = refusal(&base(), &HAND, &noisy);
    assert!(matches!(reason, ModelError::InputValue { sample: 7, .. }));
}

#[test]
fn room_for_the_answer() {
    let (model, input) = (base(), input());
    let simulate = |output: usize, sensitivity: usize, free: &[usize]| {
        let (mut output, mut sensitivity) = (vec![0.0; output], vec![0.0; sensitivity]);
        let asked = Quantity::Displacement;
        model.sensitivities(&HAND, free, &input, asked, &mut output, &mut sensitivity)
    };
    assert_eq!(simulate(SAMPLES, 2 * SAMPLES, &[0, 2]), Ok(()));
    let length = |what, found, expected| {
        Err(ModelError::Length {
            what,
            found,
            expected,
        })
    };
    assert_eq!(
        simulate(SAMPLES - 1, 0, &[]),
        length("output", SAMPLES - 1, SAMPLES)
    );
    assert_eq!(
        simulate(SAMPLES + 1, 0, &[]),
        length("output", SAMPLES + 1, SAMPLES)
    );
    assert_eq!(
        simulate(SAMPLES, SAMPLES, &[0, 1]),
        length("sensitivity", SAMPLES, 2 * SAMPLES)
    );
    assert_eq!(
        simulate(SAMPLES, SAMPLES, &[3]),
        Err(ModelError::ParameterIndex {
            index: 3,
            parameters: 3
        })
    );
    let many = [0; MAXIMUM_FREE + 1];
    assert_eq!(
        simulate(SAMPLES, many.len() * SAMPLES, &many),
        Err(ModelError::TooManyFree {
            free: many.len(),
            maximum: MAXIMUM_FREE
        })
    );
}

/// One that cannot be simulated keeps the others from being half done.
#[test]
fn of_several_runs_none_is_begun() {
    let (model, input) = (base(), input());
    let mut rooms = [vec![7.0; SAMPLES], vec![7.0; 3]];
    let runs = rooms.iter_mut().map(|output| Run {
        model: &model,
        values: &HAND,
        input: &input,
        quantity: Quantity::Displacement,
        output,
        sensitivity: &mut [],
    });
    let refused = simulate_side_by_side(&mut runs.collect::<Vec<_>>(), &[]);
    assert!(matches!(refused, Err(ModelError::Length { found: 3, .. })));
    assert_eq!(rooms[0], [7.0; SAMPLES]);
    assert_eq!(simulate_side_by_side(&mut [], &[]), Ok(()));
}

#[test]
fn the_base_model_needs_mass_damping_and_stiffness() {
    let motion = base().simulate(&HAND, &input()).unwrap();
    let both = |values: &[f64]| {
        [
            euler_displacement(&RIG, values, &[1.0; 3], 1e-3),
            spring_damper_force(&RIG, values, &motion),
        ]
    };
    for refused in both(&HAND[..2]) {
        assert!(matches!(refused, Err(ModelError::Length { found: 2, .. })));
    }
    assert!(both(&HAND).iter().all(Result::is_ok));
}
