//! Every sensitivity against central differences of the simulation, for every effect, quantity and input behaviour.

use snug_campaign::{Intersample, Quantity, Rig};
use snug_model::{Effect, Input, Law, Model, ParameterSpec, Scale};

const RIG: Rig = Rig {
    lever_arm_m: 0.33,
    known_inertia_kg_m2: 0.15,
};
const SAMPLES: usize = 400;

fn pulse() -> Vec<f64> {
    (0..SAMPLES)
        .map(|index| {
            let phase = index as f64 / 200.0 * std::f64::consts::PI;
            if index < 200 {
                20.0 * phase.sin().powi(2)
            } else {
                0.0
            }
        })
        .collect()
}

/// A value inside a parameter's range at which its sensitivity is not zero, off the grid of samples, where nothing has a kink.
fn inner_value(spec: &ParameterSpec) -> f64 {
    match spec.vanishes_at {
        Some(0.0) => 0.033 * spec.maximum,
        _ => 1.003 * spec.starts[0],
    }
}

/// m, c, k and the inner values of the effects' parameters.
fn inner_values(effects: &[Effect]) -> Vec<f64> {
    let own = effects
        .iter()
        .flat_map(|effect| effect.description().parameters)
        .map(inner_value);
    [2.0, 60.0, 1800.0].into_iter().chain(own).collect()
}

/// How exact the slopes to the parameters of an effect are meant to be, as a share of the largest.
fn tolerance(effect: Effect, intersample: Intersample) -> f64 {
    let specs = effect.description().parameters;
    let own: Vec<f64> = specs.iter().map(inner_value).collect();
    let delays_torque = effect
        .logged_torque(&own)
        .is_some_and(|logged| logged.delay_s != 0.0);
    // The torque's slope is that of a line over m = 5 samples on either side, lest noise pass for knowledge of the delay:
    // Δ² (3m² + 3m − 1)/30 of its second derivative off, 0.3 % for this pulse at 2 kHz, and more where the pulse begins
    // and ends with a kink.
    if delays_torque && intersample == Intersample::Linear {
        return 0.06;
    }
    PLAIN_TOLERANCE
}

const PLAIN_TOLERANCE: f64 = 2e-6;

fn check(effects: &[Effect], intersample: Intersample, quantity: Quantity) {
    let model = Model::new(RIG, effects).expect("a valid rig");
    let input = Input::new(&pulse(), 5e-4, intersample).with_rest_before(0.4);
    let values = inner_values(effects);
    let mut tolerances = vec![PLAIN_TOLERANCE; 3];
    for &effect in effects {
        let count = effect.description().parameters.len();
        tolerances.extend(vec![tolerance(effect, intersample); count]);
    }
    let free: Vec<usize> = (0..values.len()).collect();
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
        .expect("a valid simulation");

    let mut plain = vec![0.0; SAMPLES];
    model
        .output(&values, &input, quantity, &mut plain)
        .expect("a valid simulation");
    assert!(
        plain
            .iter()
            .zip(&output)
            .all(|(a, b)| (a - b).abs() < 1e-12 * (1.0 + a.abs())),
        "the value does not depend on whether sensitivities ride along"
    );

    for &parameter in &free {
        let step = 1e-5 * values[parameter].abs();
        let shifted = |sign: f64| {
            let mut moved = values.clone();
            moved[parameter] += sign * step;
            let mut output = vec![0.0; SAMPLES];
            model
                .output(&moved, &input, quantity, &mut output)
                .expect("a valid simulation");
            output
        };
        let (up, down) = (shifted(1.0), shifted(-1.0));
        let column = &sensitivity[parameter * SAMPLES..(parameter + 1) * SAMPLES];
        let largest = column
            .iter()
            .fold(0.0_f64, |largest, value| largest.max(value.abs()));
        assert!(
            largest > 0.0,
            "{effects:?}: `{}` changes nothing at {}; give it, in its ParameterSpec, a range and starts where it acts, and \
             `vanishes_at` where it does not",
            model.parameters()[parameter].name,
            values[parameter]
        );
        for (index, analytic) in column.iter().enumerate() {
            let difference = (up[index] - down[index]) / (2.0 * step);
            assert!(
                (analytic - difference).abs() < tolerances[parameter] * largest,
                "{effects:?} {quantity:?} {intersample:?} `{}` sample {index}: {analytic} against {difference}",
                model.parameters()[parameter].name
            );
        }
    }
}

const QUANTITIES: [Quantity; 3] = [
    Quantity::Displacement,
    Quantity::Velocity,
    Quantity::Acceleration,
];

#[test]
fn base_model() {
    for intersample in [
        Intersample::ZeroOrder,
        Intersample::Linear,
        Intersample::BandLimited,
    ] {
        for quantity in QUANTITIES {
            check(&[], intersample, quantity);
        }
    }
}

#[test]
fn every_effect_alone() {
    for &effect in Effect::ALL {
        for quantity in QUANTITIES {
            check(&[effect], Intersample::Linear, quantity);
        }
    }
}

#[test]
fn many_effects_together() {
    check(
        &[
            Effect::MaxwellBranch,
            Effect::CubicStiffness,
            Effect::CoulombFriction,
            Effect::AccelerationBias,
            Effect::InitialMotion,
        ],
        Intersample::Linear,
        Quantity::Acceleration,
    );
    check(
        &[
            Effect::Backlash,
            Effect::SecondMass,
            Effect::GripSlip,
            Effect::StretchReflex,
            Effect::TorqueDelay,
            Effect::TorqueLag,
            Effect::AccelerationLag,
            Effect::GravityLeakage,
        ],
        Intersample::ZeroOrder,
        Quantity::Displacement,
    );
}

#[test]
fn the_order_of_effects_does_not_matter() {
    let input = Input::new(&pulse(), 5e-4, Intersample::Linear);
    let respond = |effects: &[Effect]| {
        let model = Model::new(RIG, effects).expect("a valid rig");
        let mut output = vec![0.0; SAMPLES];
        let values = inner_values(effects);
        model
            .output(&values, &input, Quantity::Acceleration, &mut output)
            .expect("a valid simulation");
        output
    };
    let mut effects = [
        Effect::Backlash,
        Effect::SecondMass,
        Effect::GripSlip,
        Effect::CoContraction,
        Effect::TorqueDependentStiffness,
        Effect::TorqueDelay,
        Effect::TorqueLag,
        Effect::AccelerationLag,
    ];
    let forward = respond(&effects);
    effects.reverse();
    for (a, b) in forward.iter().zip(respond(&effects)) {
        assert!((a - b).abs() < 1e-10, "{a} against {b}");
    }
}

#[test]
fn an_effect_of_size_zero_is_the_base_model() {
    let input = Input::new(&pulse(), 5e-4, Intersample::Linear);
    let base = Model::new(RIG, &[]).expect("a valid rig");
    let mut expected = vec![0.0; SAMPLES];
    base.output(
        &[2.0, 60.0, 1800.0],
        &input,
        Quantity::Acceleration,
        &mut expected,
    )
    .expect("a valid simulation");
    for &effect in Effect::ALL {
        let model = Model::new(RIG, &[effect]).expect("a valid rig");
        let specs = effect.description().parameters;
        assert!(
            specs.iter().any(|spec| spec.vanishes_at.is_some()),
            "{}: say in its file at which value of a parameter it is not there (`vanishes_at: Some(…)`)",
            effect.name()
        );
        let gone = specs
            .iter()
            .map(|spec| spec.vanishes_at.unwrap_or(spec.starts[0]));
        let values: Vec<f64> = [2.0, 60.0, 1800.0].into_iter().chain(gone).collect();
        let mut output = vec![0.0; SAMPLES];
        model
            .output(&values, &input, Quantity::Acceleration, &mut output)
            .expect("a valid simulation");
        for (a, b) in output.iter().zip(&expected) {
            assert!(
                (a - b).abs() < 1e-7,
                "{}: {a} against {b} of the base model where every `vanishes_at` of its file says that it is not there",
                effect.name()
            );
        }
    }
}

/// As it holds a machine, which stops and rests: at rest nothing depends on anything, and the slopes end and begin with a step.
#[test]
fn dry_friction_of_a_machine() {
    let scale = Scale::Rig {
        torque_nm: 10.0,
        angle_rad: 0.1,
        time_s: 0.05,
    };
    for effect in [Effect::CoulombFriction, Effect::StribeckFriction] {
        let effect = scale.effect(effect, &RIG).expect("a valid rig");
        for quantity in [Quantity::Displacement, Quantity::Velocity] {
            check(&[effect], Intersample::ZeroOrder, quantity);
        }
    }
}
