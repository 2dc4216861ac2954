//! Parts of a task that contradict each other, or hold what is no number, are refused with a reason that names them.
#![allow(clippy::unwrap_used)]

use snug_campaign::{FitStatus, Intersample, NoiseFloor, Quantity, Rig, Tightening};
use snug_identify::{FitTask, IdentifyError, IdentifySettings, identify, identify_all};
use snug_model::{Input, Model, ModelError};

const RIG: Rig = Rig {
    lever_arm_m: 0.33,
    known_inertia_kg_m2: 0.275,
};
const HAND: [f64; 3] = [2.1, 104.0, 2450.0];
const INTERVAL_S: f64 = 5e-4;
const SAMPLES: usize = 1000;
const NOISE: f64 = 0.5;

fn torque() -> Vec<f64> {
    (0..SAMPLES)
        .map(|i| if i < 300 { 0.1 * i as f64 } else { 0.0 })
        .collect()
}

/// What the hand makes of the torque, and a fast tone in place of noise.
fn acceleration() -> Vec<f64> {
    let input = Input::new(&torque(), INTERVAL_S, Intersample::Linear);
    let motion = Model::new(RIG, &[]).unwrap().simulate(&HAND, &input);
    let motion = motion.unwrap().acceleration_rad_per_s2.unwrap();
    let tone = |i: usize| NOISE * 2f64.sqrt() * (2.9 * i as f64).sin();
    (0..SAMPLES).map(|i| motion[i] + tone(i)).collect()
}

fn measured() -> Tightening {
    Tightening::from_torque(RIG, INTERVAL_S, torque())
        .with(Quantity::Acceleration, acceleration())
        .with_noise(NoiseFloor::white(Quantity::Acceleration, NOISE))
}

/// What becomes of a tightening beside the input of the one that was measured and the model of its rig.
fn refusal(tightening: &Tightening) -> IdentifyError {
    let input = Input::new(&torque(), INTERVAL_S, Intersample::Linear);
    refusal_with(tightening, &input)
}

fn refusal_with(tightening: &Tightening, input: &Input) -> IdentifyError {
    let (model, settings) = (Model::new(RIG, &[]).unwrap(), IdentifySettings::default());
    identify(&model, input, tightening, &settings).unwrap_err()
}

fn arrays(torque: Vec<f64>, output: Vec<f64>) -> Result<FitTask<'static>, IdentifyError> {
    FitTask::from_arrays(RIG, INTERVAL_S, torque, Quantity::Acceleration, output)
}

#[test]
fn arrays_become_a_task_that_gives_the_estimate_of_its_parts() {
    let noise = NoiseFloor::white(Quantity::Acceleration, NOISE);
    let task = arrays(torque(), acceleration()).unwrap().with_noise(noise);
    let estimate = task.identify().unwrap();
    assert_eq!(estimate.status, FitStatus::Converged);
    for (parameter, truth) in estimate.parameters.iter().zip(HAND) {
        let interval = parameter.interval.unwrap();
        assert!(
            interval.low < truth && truth < interval.high,
            "{parameter:?}"
        );
    }
    for intersample in [Intersample::Linear, Intersample::BandLimited] {
        let input = Input::new(&torque(), INTERVAL_S, intersample);
        let (model, settings) = (Model::new(RIG, &[]).unwrap(), IdentifySettings::default());
        let of_parts = identify(&model, &input, &measured(), &settings).unwrap();
        assert_eq!(of_parts == estimate, intersample == Intersample::Linear);
    }
}

#[test]
fn arrays_of_different_lengths() {
    let short = acceleration()[..SAMPLES - 1].to_vec();
    let expected = IdentifyError::UnequalLengths {
        channel: "acceleration",
        samples: SAMPLES - 1,
        torque_samples: SAMPLES,
    };
    assert_eq!(arrays(torque(), short).unwrap_err(), expected);
    let unused = measured().with(Quantity::Velocity, vec![0.0; SAMPLES + 1]);
    assert!(matches!(
        refusal(&unused),
        IdentifyError::UnequalLengths {
            channel: "velocity",
            ..
        }
    ));
    let nothing = arrays(Vec::new(), Vec::new()).unwrap_err();
    assert_eq!(nothing, ModelError::NoSamples.into());
}

#[test]
fn a_sample_that_is_no_number_is_named_with_its_channel() {
    let spoilt = |mut samples: Vec<f64>, value: f64| {
        samples[123] = value;
        samples[200] = value;
        samples
    };
    for value in [f64::NAN, f64::INFINITY] {
        for (refused, channel) in [
            (arrays(spoilt(torque(), value), acceleration()), "torque"),
            (
                arrays(torque(), spoilt(acceleration(), value)),
                "acceleration",
            ),
        ] {
            let told = refused.unwrap_err().to_string();
            let expected = format!("the {channel} is {value} at sample 123");
            assert!(told.starts_with(&expected), "{told}");
        }
    }
    let beside = measured().with(Quantity::Displacement, spoilt(torque(), f64::NAN));
    assert!(matches!(
        refusal(&beside),
        IdentifyError::NotFinite {
            channel: "displacement",
            sample: 123,
            ..
        }
    ));
}

#[test]
fn an_interval_or_a_rig_that_cannot_be() {
    for interval_s in [0.0, -1e-3, f64::NAN] {
        let quantity = Quantity::Acceleration;
        let refused = FitTask::from_arrays(RIG, interval_s, torque(), quantity, acceleration());
        assert!(matches!(
            refused,
            Err(IdentifyError::Model(ModelError::InputTime {
                what: "interval_s",
                ..
            }))
        ));
    }
    let rig = Rig {
        lever_arm_m: 0.0,
        ..RIG
    };
    let quantity = Quantity::Acceleration;
    let refused = FitTask::from_arrays(rig, INTERVAL_S, torque(), quantity, acceleration());
    assert!(matches!(
        refused,
        Err(IdentifyError::Model(ModelError::Rig { .. }))
    ));
}

#[test]
fn an_input_of_another_torque() {
    let mut other = torque();
    other[250] = 99.0;
    let input = Input::new(&other, INTERVAL_S, Intersample::BandLimited);
    let expected = IdentifyError::InputTorque {
        sample: 250,
        input_nm: 99.0,
        tightening_nm: torque()[250],
    };
    assert_eq!(refusal_with(&measured(), &input), expected);
    let longer = Input::new(&[1.0; SAMPLES + 5], INTERVAL_S, Intersample::Linear);
    let expected = IdentifyError::InputLength {
        input_samples: SAMPLES + 5,
        output_samples: SAMPLES,
    };
    assert_eq!(refusal_with(&measured(), &longer), expected);
    let without = Tightening {
        torque_nm: Vec::new(),
        ..measured()
    };
    assert!(matches!(
        refusal(&without),
        IdentifyError::UnequalLengths { .. }
    ));
}

#[test]
fn an_input_at_another_rate() {
    for interval_s in [2.0 * INTERVAL_S, f64::NAN, 0.0] {
        let mut tightening = measured();
        tightening.time_base.interval_s = interval_s;
        let told = refusal(&tightening).to_string();
        let expected = format!("every {INTERVAL_S} s, the tightening every {interval_s} s");
        assert!(told.contains(&expected), "{told}");
    }
    let mut rounded = measured();
    rounded.time_base.interval_s = INTERVAL_S * (1.0 + 1e-12);
    let (model, settings) = (Model::new(RIG, &[]).unwrap(), IdentifySettings::default());
    let input = Input::new(&torque(), INTERVAL_S, Intersample::Linear);
    assert!(identify(&model, &input, &rounded, &settings).is_ok());
}

#[test]
fn a_model_of_another_rig() {
    let mut tightening = measured();
    tightening.rig.known_inertia_kg_m2 = 0.3;
    let expected = IdentifyError::OtherRig {
        field: "known_inertia_kg_m2",
        model: RIG.known_inertia_kg_m2,
        tightening: 0.3,
    };
    assert_eq!(refusal(&tightening), expected);
    tightening = measured();
    tightening.rig.lever_arm_m = 0.4;
    assert!(
        refusal(&tightening)
            .to_string()
            .contains("lever_arm_m is 0.33")
    );
}

#[test]
fn noise_that_cannot_be() {
    let white = |deviation| NoiseFloor::white(Quantity::Acceleration, deviation);
    for deviation in [-0.5, f64::NAN, f64::INFINITY] {
        let told = refusal(&measured().with_noise(white(deviation))).to_string();
        let expected = format!("the noise's standard_deviation is {deviation}");
        assert!(told.starts_with(&expected), "{told}");
    }
    let coloured = NoiseFloor {
        autoregression: vec![0.2, f64::NAN],
        ..white(NOISE)
    };
    assert!(matches!(
        refusal(&measured().with_noise(coloured)),
        IdentifyError::Noise {
            what: "autoregression",
            ..
        }
    ));
    let still = arrays(torque(), acceleration())
        .unwrap()
        .with_noise(white(0.0));
    let unknown = arrays(torque(), acceleration()).unwrap();
    assert_eq!(still.identify(), unknown.identify(), "not whitened");
}

#[test]
fn a_fixed_parameter_that_is_no_number() {
    let mut task = arrays(torque(), acceleration()).unwrap();
    let damping = &mut task.model.to_mut().parameters_mut()[1];
    (damping.value, damping.fixed) = (f64::NAN, true);
    let told = task.identify().unwrap_err().to_string();
    assert!(
        told.starts_with("the fixed parameter damping_kg_per_s is NaN"),
        "{told}"
    );
}

#[test]
fn what_was_not_measured_is_named_first() {
    let (input, model) = (
        Input::new(&torque(), INTERVAL_S, Intersample::Linear),
        Model::new(RIG, &[]).unwrap(),
    );
    let settings = IdentifySettings {
        fitted_output: Quantity::Velocity,
        ..IdentifySettings::default()
    };
    let quantity = Quantity::Velocity;
    assert_eq!(
        identify(&model, &input, &measured(), &settings).unwrap_err(),
        IdentifyError::MissingOutput { quantity }
    );
}

/// One that is refused costs its neighbours nothing.
#[test]
fn the_others_of_a_batch_are_identified() {
    let good = arrays(torque(), acceleration()).unwrap();
    let mut bad = good.clone();
    bad.tightening.to_mut().rig.lever_arm_m = 0.5;
    let outcomes = identify_all(&[good.clone(), bad, good.clone()]);
    assert_eq!(outcomes[0], good.identify());
    assert!(matches!(outcomes[1], Err(IdentifyError::OtherRig { .. })));
    assert_eq!(outcomes[2], outcomes[0]);
}

/// A beginning, a restarted simulation and an input with noise on top are all of the same tightening.
#[test]
fn what_is_made_of_a_task_contradicts_nothing() {
    let mut task = arrays(torque(), acceleration()).unwrap();
    let motion = Model::new(RIG, &[]).unwrap().simulate(&HAND, &task.input);
    let motion = motion.unwrap();
    for quantity in [Quantity::Displacement, Quantity::Velocity] {
        let samples = motion.get(quantity).unwrap().to_vec();
        task.tightening.to_mut().motion.set(quantity, samples);
    }
    assert_eq!(task.check(), Ok(()));
    assert_eq!(task.beginning(400).check(), Ok(()));
    assert_eq!(task.along_motion().unwrap().check(), Ok(()));
    let noisy = task.input.with_added(&[0.1; SAMPLES]).smoothed(3);
    *task.input.to_mut() = noisy;
    assert_eq!(task.check(), Ok(()));
    assert_eq!(task.beginning(400).check(), Ok(()));
}
