//! What other crates hold on to: effects put in and taken out, the zero of the measured displacement, texts and lists.

#![allow(clippy::unwrap_used)]

use snug_campaign::{Intersample, Quantity, Rig};
use snug_model::{
    Effect, INVISIBLE, Input, Kind, Law, Model, ModelError, ModelSettings, ParameterSettings,
    TRENDS,
};
use std::collections::BTreeMap;

const RIG: Rig = Rig {
    lever_arm_m: 0.33,
    known_inertia_kg_m2: 0.275,
};
const SAMPLES: usize = 500;
const INTERVAL_S: f64 = 5e-4;
const REST_BEFORE_S: f64 = 1.4;

fn torque() -> impl Iterator<Item = f64> {
    (0..SAMPLES).map(|index| {
        if index < 160 {
            0.15 * index as f64
        } else {
            0.0
        }
    })
}

fn input() -> Input {
    let torque: Vec<f64> = torque().collect();
    Input::new(&torque, INTERVAL_S, Intersample::Linear).with_rest_before(REST_BEFORE_S)
}

#[test]
fn an_effect_goes_in_and_out_and_leaves_the_rest_as_it_was_set() {
    let mut model = Model::new(RIG, &[Effect::MaxwellBranch]).unwrap();
    for (index, parameter) in model.parameters_mut().iter_mut().enumerate() {
        parameter.value = 0.01 * (index + 1) as f64;
        parameter.minimum = -1.0 - index as f64;
        parameter.maximum = 2.0 + index as f64;
        parameter.fixed = index % 2 == 0;
    }
    let more = model.with_effect(Effect::TorqueLag).unwrap();
    assert_eq!(more.parameters()[..5], model.parameters()[..]);
    let plain = Model::new(RIG, &[Effect::MaxwellBranch, Effect::TorqueLag]).unwrap();
    assert_eq!(more.parameters()[5], plain.parameters()[5]);
    assert_eq!(more.rig(), model.rig());

    let back = more.without_effect(Effect::TorqueLag).unwrap();
    assert_eq!(back.parameters(), model.parameters());
    // Without the other tau_s beside it, the lag's is called by its own name again, and keeps what was set.
    let mut more = more;
    more.parameters_mut()[5].value = 0.007;
    let lag = more.without_effect(Effect::MaxwellBranch).unwrap();
    let parameter = &lag.parameters()[3];
    assert_eq!((parameter.name.as_str(), parameter.value), ("tau_s", 0.007));
    assert_eq!(lag.parameters()[..3], model.parameters()[..3]);

    assert!(matches!(
        model.with_effect(Effect::MaxwellBranch),
        Err(ModelError::DuplicateEffect { .. })
    ));
    assert!(matches!(
        model.without_effect(Effect::Backlash),
        Err(ModelError::UnknownEffect { .. })
    ));
}

/// θ − θ(t0) + ½ b ((r + t)² − (r + t0)²): the displacement that a biased sensor shows, zeroed at t0.
#[test]
fn a_zeroed_displacement_loses_at_every_sample_what_it_is_at_one() {
    let (zero_at, bias) = (37, 0.8);
    let zeroed = input().with_zero_at(Some(zero_at));
    let model = Model::new(RIG, &[Effect::AccelerationBias]).unwrap();
    let base = Model::new(RIG, &[]).unwrap();
    let values = [2.3, 103.0, 2315.0, bias];
    let output = |model: &Model, values: &[f64], input: &Input, quantity| {
        let mut output = vec![0.0; SAMPLES];
        model.output(values, input, quantity, &mut output).unwrap();
        output
    };
    let (mut found, mut sensitivity) = (vec![0.0; SAMPLES], vec![0.0; 4 * SAMPLES]);
    model
        .sensitivities(
            &values,
            &[0, 1, 2, 3],
            &zeroed,
            Quantity::Displacement,
            &mut found,
            &mut sensitivity,
        )
        .unwrap();
    let truth = output(&base, &values[..3], &input(), Quantity::Displacement);
    let since_rest = |index: usize| REST_BEFORE_S + index as f64 * INTERVAL_S;
    for index in 0..SAMPLES {
        let slope = 0.5 * (since_rest(index).powi(2) - since_rest(zero_at).powi(2));
        let moved = truth[index] - truth[zero_at];
        assert!((found[index] - moved - bias * slope).abs() < 1e-13);
        assert!((sensitivity[3 * SAMPLES + index] - slope).abs() < 1e-13);
    }
    assert_eq!(found[zero_at], 0.0);

    for quantity in [Quantity::Velocity, Quantity::Acceleration] {
        assert_eq!(
            output(&model, &values, &zeroed, quantity),
            output(&model, &values, &input(), quantity),
            "only the displacement is zeroed"
        );
    }
    // Not a sensor's effect: the true motion stays as it is.
    let moved = Model::new(RIG, &[Effect::InitialMotion]).unwrap();
    for (model, values) in [
        (&base, &values[..3]),
        (&moved, &[2.3, 103.0, 2315.0, 0.01, 0.1]),
    ] {
        assert_eq!(
            output(model, values, &zeroed, Quantity::Displacement),
            output(model, values, &input(), Quantity::Displacement)
        );
    }
    let late = input().with_zero_at(Some(10 * SAMPLES));
    let last = output(&model, &values, &late, Quantity::Displacement)[SAMPLES - 1];
    assert_eq!(last, 0.0, "as at the last sample");
}

#[test]
fn every_effect_says_what_to_check_and_names_twins_that_exist() {
    let described: Vec<_> = Effect::ALL
        .iter()
        .map(Law::description)
        .chain(TRENDS)
        .collect();
    for description in &described {
        let name = description.name;
        assert!(
            description.check.ends_with('.') && description.check.len() > 30,
            "{name}: say in `check`, in a sentence, what to look at on the bench"
        );
        for twin in description.twins {
            assert!(
                described.iter().any(|other| other.name == *twin),
                "{name}: its twin `{twin}` is no effect of the catalogue; correct `twins` in its file"
            );
        }
        for parameter in description.parameters {
            let range = parameter.minimum..=parameter.maximum;
            assert!(
                parameter.starts.iter().all(|start| range.contains(start)),
                "{name}: `starts` of `{}` leave {range:?}; widen the range in its file or move them",
                parameter.name
            );
        }
    }
    assert!(TRENDS.iter().all(|trend| trend.kind == Kind::Trend));
    let names = TRENDS
        .iter()
        .map(|trend| trend.name)
        .chain(INVISIBLE.iter().map(|one| one.name));
    for name in names {
        assert!(
            Effect::named(name).is_none(),
            "{name} is no law of motion; take it out of the list in effects.rs"
        );
    }
}

/// A lever arm or a torque that is wrong by a factor: other m, c, k give the very same motion.
#[test]
fn what_is_called_invisible_is_invisible() {
    let acceleration = |rig, values: [f64; 3], gain: f64| {
        let torque: Vec<f64> = torque().map(|torque| gain * torque).collect();
        let input = Input::new(&torque, INTERVAL_S, Intersample::Linear);
        let mut output = vec![0.0; SAMPLES];
        let model = Model::new(rig, &[]).unwrap();
        model
            .output(&values, &input, Quantity::Acceleration, &mut output)
            .unwrap();
        output
    };
    let (m, c, k) = (2.3, 103.0, 2315.0);
    let truth = acceleration(RIG, [m, c, k], 1.0);
    let longer = Rig {
        lever_arm_m: 0.33 * 1.1,
        ..RIG
    };
    let by_lever = acceleration(longer, [m, c, k].map(|value| value / 1.21), 1.0);
    let square = 0.33 * 0.33;
    let heavier = (1.05 * (0.275 + m * square) - 0.275) / square;
    let by_gain = acceleration(RIG, [heavier, 1.05 * c, 1.05 * k], 1.05);
    for index in 0..SAMPLES {
        for other in [by_lever[index], by_gain[index]] {
            assert!((other - truth[index]).abs() < 1e-10 * (1.0 + truth[index].abs()));
        }
    }
}

#[test]
fn a_standard_error_belongs_to_a_fixed_parameter() {
    let model = |standard_error, fixed| {
        let settings = ParameterSettings {
            standard_error: Some(standard_error),
            fixed,
            ..ParameterSettings::default()
        };
        ModelSettings {
            parameters: BTreeMap::from([("mass_kg".to_owned(), settings)]),
            ..ModelSettings::default()
        }
        .model(RIG)
    };
    assert_eq!(
        model(0.1, true).unwrap().parameters()[0].standard_error,
        Some(0.1)
    );
    for (standard_error, fixed) in [(0.1, false), (-0.1, true), (f64::NAN, true)] {
        let refused = model(standard_error, fixed).unwrap_err().to_string();
        assert!(
            refused.contains("`mass_kg`") && refused.contains("fixed"),
            "{refused}"
        );
    }
}

/// What is ranked once because it is one and the same moves the output as its other does.
#[test]
fn what_is_called_the_same_is_the_same() {
    let simulated = |effect, compared| {
        let model = Model::new(RIG, &[effect]).unwrap();
        let mut values: Vec<f64> = model.parameters().iter().map(|one| one.value).collect();
        values[3] = 0.3;
        let mut output = vec![0.0; SAMPLES];
        model
            .output(&values, &input(), compared, &mut output)
            .unwrap();
        output
    };
    for compared in [
        Quantity::Displacement,
        Quantity::Velocity,
        Quantity::Acceleration,
    ] {
        for &effect in Effect::ALL {
            let Some(other) = effect.same_as(compared) else {
                continue;
            };
            let name = effect.name();
            let other = Effect::named(other)
                .unwrap_or_else(|| panic!("{name}: `same_as` names no effect: {other}"));
            assert_eq!(
                simulated(effect, compared),
                simulated(other, compared),
                "{name} and {} differ in {compared:?}; correct `same_as` in its file",
                other.name()
            );
        }
    }
}

#[test]
fn two_effects_with_a_parameter_of_one_name_stay_apart() {
    let model = Model::new(RIG, &[Effect::MaxwellBranch, Effect::TorqueLag]).unwrap();
    let own = model.parameters()[3..].iter();
    let names: Vec<&str> = own.map(|parameter| parameter.name.as_str()).collect();
    assert_eq!(names, ["k_m_n_per_m", "tau_s", "torque_lag_tau_s"]);
}
