//! Effects that a study writes itself: against the catalogue's own laws, against central differences, and their errors.

#![allow(clippy::unwrap_used)]

use snug_campaign::{Intersample, Motion, Quantity, Rig};
use snug_model::{
    CustomEffectSettings, CustomParameterSettings, Effect, Input, Kind, Law, Model, ModelError,
    ModelSettings, Place, Scope,
};

const RIG: Rig = Rig {
    lever_arm_m: 0.33,
    known_inertia_kg_m2: 0.275,
};
const BASE: [f64; 3] = [2.3, 103.0, 2315.0];
const SAMPLES: usize = 600;

fn parameter(name: &str) -> CustomParameterSettings {
    CustomParameterSettings {
        name: name.to_owned(),
        unit: "unit".to_owned(),
        start: 1.0,
        minimum: -1e7,
        maximum: 1e7,
        ..Default::default()
    }
}

fn settings(place: Place, expression: &str, parameters: &[&str]) -> CustomEffectSettings {
    CustomEffectSettings {
        name: "own_law".to_owned(),
        place,
        expression: expression.to_owned(),
        parameters: parameters.iter().copied().map(parameter).collect(),
    }
}

fn custom(place: Place, expression: &str, parameters: &[&str]) -> Effect {
    Effect::custom(&settings(place, expression, parameters)).unwrap()
}

fn input() -> Input {
    let torque: Vec<f64> = (0..SAMPLES)
        .map(|index| match index {
            40..=200 => 30.0 * (index - 40) as f64 / 160.0,
            _ => 0.0,
        })
        .collect();
    Input::new(&torque, 5e-4, Intersample::Linear).with_onset(0.02)
}

fn simulate(effects: &[Effect], own: &[f64]) -> [Vec<f64>; 3] {
    let model = Model::new(RIG, effects).unwrap();
    let values: Vec<f64> = BASE.iter().chain(own).copied().collect();
    let Motion {
        displacement_rad,
        velocity_rad_per_s,
        acceleration_rad_per_s2,
    } = model.simulate(&values, &input()).unwrap();
    [
        displacement_rad,
        velocity_rad_per_s,
        acceleration_rad_per_s2,
    ]
    .map(Option::unwrap)
}

/// Simulations under both sets of effects agree to rounding, and differ from the base model's.
fn assert_same(own: Effect, catalogue: Effect, values: &[f64], also: &[Effect], theirs: &[f64]) {
    let values: Vec<f64> = values.iter().chain(theirs).copied().collect();
    let with = |first: Effect| -> Vec<Effect> {
        std::iter::once(first).chain(also.iter().copied()).collect()
    };
    let (found, expected) = (
        simulate(&with(own), &values),
        simulate(&with(catalogue), &values),
    );
    let without = simulate(also, theirs);
    let name = catalogue.name();
    for quantity in 0..3 {
        let largest = |signal: &[f64]| signal.iter().fold(0.0_f64, |most, y| most.max(y.abs()));
        let size = largest(&expected[quantity]);
        let difference = |a: &[f64], b: &[f64]| {
            a.iter()
                .zip(b)
                .fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()))
        };
        let error = difference(&found[quantity], &expected[quantity]) / size;
        assert!(error < 1e-12, "{name}, quantity {quantity}: {error:e}");
        let change = difference(&found[quantity], &without[quantity]) / size;
        assert!(
            change > 1e-4,
            "{name}, quantity {quantity}: only {change:e}"
        );
    }
}

#[test]
fn laws_of_the_catalogue_written_as_expressions_are_the_same_laws() {
    let force = |expression, parameters: &[&str]| custom(Place::Force, expression, parameters);
    assert_same(
        force("p*x^3", &["p"]),
        Effect::CubicStiffness,
        &[9e5],
        &[],
        &[],
    );
    assert_same(
        force("p*v*abs(v)", &["p"]),
        Effect::QuadraticDamping,
        &[80.0],
        &[],
        &[],
    );
    assert_same(
        force("p*tanh(v/0.01)", &["p"]),
        Effect::CoulombFriction,
        &[8.0],
        &[],
        &[],
    );
    assert_same(
        force("f*smooth_step((t - t0)/rise)", &["f", "t0", "rise"]),
        Effect::VoluntaryPush,
        &[20.0, 0.05, 0.06],
        &[],
        &[],
    );
    // Its k is the base model's; T is what torque_offset leaves of the logged torque.
    assert_same(
        force("2315*kappa*abs(T)*theta*l", &["kappa"]),
        Effect::TorqueDependentStiffness,
        &[0.03],
        &[Effect::TorqueOffset],
        &[1.5],
    );
    assert_same(
        custom(Place::Torque, "-T0", &["T0"]),
        Effect::TorqueOffset,
        &[1.5],
        &[Effect::GripSlip],
        &[40.0],
    );
    let measured = |expression| custom(Place::Measurement, expression, &["p"]);
    assert_same(
        measured("p*sin(theta)"),
        Effect::GravityLeakage,
        &[20.0],
        &[Effect::AccelerationLag],
        &[0.002],
    );
    assert_same(
        measured("p*(v/l)^2"),
        Effect::CentripetalCrosstalk,
        &[0.5],
        &[Effect::CubicStiffness],
        &[5e5],
    );
}

/// A sensor's gain error, p a, is seen alike in acceleration, velocity and displacement.
#[test]
fn what_is_added_to_the_acceleration_shows_in_what_is_integrated_from_it() {
    let gain = custom(Place::Measurement, "p*a", &["p"]);
    let (found, base) = (simulate(&[gain], &[0.1]), simulate(&[], &[]));
    // The leak is integrated along straight lines between samples 0.5 ms apart, hence the tolerances.
    for (quantity, tolerance) in [(0, 2e-4), (1, 2e-4), (2, 1e-13)] {
        let size = base[quantity]
            .iter()
            .fold(0.0_f64, |most, y| most.max(y.abs()));
        for (found, base) in found[quantity].iter().zip(&base[quantity]) {
            assert!(
                (found - 1.1 * base).abs() < tolerance * size,
                "{found} against 1.1 × {base}"
            );
        }
    }
}

#[test]
fn an_addition_to_the_torque_is_in_the_torque_that_others_see() {
    let pushed = custom(Place::Torque, "p*step(t)", &["p"]);
    let seen = Effect::custom(&CustomEffectSettings {
        name: "seen".to_owned(),
        ..settings(Place::Force, "q*T", &["q"])
    })
    .unwrap();
    // T + p − l q (T + p) = (1 − l q) (T + p): the same as the addition alone with a scaled torque.
    let (p, q) = (4.0, 0.7);
    let both = simulate(&[pushed, seen], &[p, q]);
    let alone = simulate(&[pushed], &[p]);
    for quantity in 0..3 {
        for (both, alone) in both[quantity].iter().zip(&alone[quantity]) {
            assert!((both - (1.0 - 0.33 * q) * alone).abs() < 1e-12 * (1.0 + alone.abs()));
        }
    }
}

#[test]
fn sensitivities_are_those_of_central_differences() {
    let laws: [(Place, &str, &[&str], &[f64]); 3] = [
        (
            Place::Force,
            "p*x^2*v + q*tanh(v/0.05)",
            &["p", "q"],
            &[4e4, 3.0],
        ),
        (
            Place::Torque,
            "-p*T*exp(-q*t^2)",
            &["p", "q"],
            &[0.05, 30.0],
        ),
        (
            Place::Measurement,
            "p*omega*abs(omega) + q*a*T",
            &["p", "q"],
            &[0.3, 0.004],
        ),
    ];
    for (place, expression, parameters, own) in laws {
        let model = Model::new(RIG, &[custom(place, expression, parameters)]).unwrap();
        let values: Vec<f64> = BASE.iter().chain(own).copied().collect();
        let (input, free) = (input(), [0, 1, 2, 3, 4]);
        for quantity in [Quantity::Displacement, Quantity::Acceleration] {
            let mut output = vec![0.0; SAMPLES];
            let mut sensitivity = vec![0.0; SAMPLES * free.len()];
            model
                .sensitivities(
                    &values,
                    &free,
                    &input,
                    quantity,
                    &mut output,
                    &mut sensitivity,
                )
                .unwrap();
            for parameter in free {
                let step = 1e-5 * values[parameter];
                let shifted = |sign: f64| {
                    let mut moved = values.clone();
                    moved[parameter] += sign * step;
                    let mut output = vec![0.0; SAMPLES];
                    model.output(&moved, &input, quantity, &mut output).unwrap();
                    output
                };
                let (up, down) = (shifted(1.0), shifted(-1.0));
                let column = &sensitivity[parameter * SAMPLES..(parameter + 1) * SAMPLES];
                let largest = column.iter().fold(0.0_f64, |most, y| most.max(y.abs()));
                assert!(largest > 0.0);
                for (index, slope) in column.iter().enumerate() {
                    let difference = (up[index] - down[index]) / (2.0 * step);
                    assert!(
                        (slope - difference).abs() < 2e-6 * largest,
                        "{expression}, {quantity:?}, parameter {parameter}, sample {index}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_study_declares_names_and_uses_its_own_effects() {
    let text = r#"(
        effects: ["x2v_damping", "cubic_stiffness"],
        custom: [
            (name: "x2v_damping", place: Force, expression: "p*x^2*v", parameters: [
                (name: "p", unit: "N s/m^3", start: 0.0, minimum: 0.0, maximum: 1e7, further_starts: [5.0]),
            ]),
            (name: "drift", place: Measurement, expression: "b*t", parameters: [(name: "b", shared: false)]),
        ],
        parameters: {"p": (value: Some(3.0))},
    )"#;
    let model_settings: ModelSettings = ron::from_str(text).unwrap();
    let model = model_settings.model(RIG).unwrap();
    let names: Vec<&str> = model.effects().map(|effect| effect.name()).collect();
    assert_eq!(names, ["x2v_damping", "cubic_stiffness"]);
    let parameter = &model.parameters()[3];
    assert_eq!(
        (parameter.name.as_str(), parameter.unit.as_str()),
        ("p", "N s/m^3")
    );
    assert_eq!(
        (parameter.value, parameter.minimum, parameter.maximum),
        (3.0, 0.0, 1e7)
    );
    let further: Vec<f64> = model
        .further_starts()
        .iter()
        .map(|start| start[3])
        .collect();
    assert_eq!(further, [5.0]);

    let own = model_settings.custom_effects().unwrap();
    assert_eq!(
        own.iter().map(Effect::name).collect::<Vec<_>>(),
        ["x2v_damping", "drift"]
    );
    assert_eq!(own[0], model_settings.effect("x2v_damping").unwrap());
    assert_eq!(model_settings.effect("backlash").unwrap(), Effect::Backlash);
    let description = own[0].description();
    assert_eq!(
        (description.kind, description.equation),
        (Kind::Custom, "F + p*x^2*v")
    );
    assert_eq!(description.excited_by, "whatever changes x, v");
    assert_eq!(
        own[1].description().parameters[0].scope,
        Scope::PerTightening
    );
    assert!(
        !Effect::ALL.contains(&own[0]),
        "the catalogue stays the catalogue"
    );

    let unknown = model_settings.effect("x2v").unwrap_err().to_string();
    for known in [
        "`x2v`",
        "x2v_damping, drift, cubic_stiffness",
        "gravity_leakage",
    ] {
        assert!(unknown.contains(known), "{unknown}");
    }
    let again: ModelSettings = ron::from_str(&ron::to_string(&model_settings).unwrap()).unwrap();
    assert_eq!(again, model_settings, "a study as run can be read again");
}

#[test]
fn the_same_declaration_is_the_same_effect() {
    let first = custom(Place::Force, "p*x*v", &["p"]);
    assert_eq!(first, custom(Place::Force, "p*x*v", &["p"]));
    let other = custom(Place::Force, "p*x*v*2", &["p"]);
    assert_ne!(first, other);
    assert_eq!(
        Model::new(RIG, &[first, other]).unwrap_err(),
        ModelError::DuplicateEffect { effect: "own_law" },
        "one name, one effect"
    );
}

#[test]
fn what_cannot_be_an_effect_says_why() {
    let good = settings(Place::Force, "p*x", &["p"]);
    let with = |change: fn(&mut CustomEffectSettings)| {
        let mut bad = good.clone();
        change(&mut bad);
        Effect::custom(&bad).unwrap_err().to_string()
    };
    type Case = (fn(&mut CustomEffectSettings), &'static str);
    let cases: [Case; 12] = [
        (
            |bad| bad.name = "cubic_stiffness".into(),
            "`cubic_stiffness` is an effect of the catalogue",
        ),
        (
            |bad| bad.name = "own law".into(),
            "`own law` must be a letter",
        ),
        (
            |bad| bad.parameters[0].name = "v".into(),
            "parameter `v` is a variable",
        ),
        (
            |bad| bad.parameters[0].name = "q-1".into(),
            "parameter `q-1` must be a letter",
        ),
        (
            |bad| bad.parameters.push(parameter("p")),
            "parameter `p` is declared twice",
        ),
        (
            |bad| bad.parameters.push(parameter("q")),
            "parameter `q` does not occur",
        ),
        (
            |bad| bad.parameters[0].minimum = 2.0,
            "`p` has start 1, minimum 2, maximum 10000000; allowed is a minimum below",
        ),
        (|bad| bad.parameters[0].start = f64::NAN, "has start NaN"),
        (
            |bad| bad.parameters[0].further_starts = vec![2.0, 2e7],
            "has start 20000000",
        ),
        (
            |bad| bad.expression = "p*y".into(),
            "effect `own_law`: in the expression `p*y`, at character 3, found `y`; allowed is a parameter (p), a variable (x, v",
        ),
        (
            |bad| bad.expression = "p*a".into(),
            "at character 3, found `a`",
        ),
        (
            |bad| bad.expression = "p/x".into(),
            "the expression `p/x` is inf at x = 0 m",
        ),
    ];
    for (change, expected) in cases {
        let message = with(change);
        assert!(message.contains(expected), "{message}");
    }

    let twice = ModelSettings {
        custom: vec![
            settings(Place::Force, "p*x", &["p"]),
            settings(Place::Force, "p*v", &["p"]),
        ],
        ..ModelSettings::default()
    };
    let message = twice.model(RIG).unwrap_err().to_string();
    assert!(message.contains("`own_law` is declared twice"), "{message}");
}
