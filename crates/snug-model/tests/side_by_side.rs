//! A tightening has the same bits whatever stands beside it in a vector register.

#![allow(clippy::unwrap_used)]

use snug_campaign::{Intersample, Quantity, Rig};
use snug_model::{
    CustomEffectSettings, CustomParameterSettings, Effect, Input, Law, Model, Place, Run, Scale,
    simulate_side_by_side,
};

/// More than any register holds, and not a multiple of it.
const MEMBERS: usize = 11;

/// One tightening of its own rig, size, length, onset and zero.
struct Member {
    model: Model,
    values: Vec<f64>,
    input: Input,
}

fn member(effects: &[Effect], number: usize, intersample: Intersample) -> Member {
    let own = number as f64;
    let rig = Rig {
        lever_arm_m: 0.3 + 0.01 * own,
        known_inertia_kg_m2: 0.15 + 0.01 * own,
    };
    let torque: Vec<f64> = (0..400 - 13 * number)
        .map(|index| {
            let phase = index as f64 / (180.0 + own) * std::f64::consts::PI;
            if phase < std::f64::consts::PI {
                (15.0 + own) * phase.sin().powi(2)
            } else {
                0.0
            }
        })
        .collect();
    let mut values = vec![2.0 + 0.1 * own, 60.0 - own, 1800.0 + 50.0 * own];
    for effect in effects {
        for spec in effect.description().parameters {
            let inside = match spec.starts[0] {
                0.0 => 0.02 * spec.maximum,
                start => start,
            };
            values.push(inside * (1.0 + 0.01 * own));
        }
    }
    Member {
        model: Model::new(rig, effects).unwrap(),
        values,
        input: Input::new(&torque, 5e-4 + 1e-6 * own, intersample)
            .with_rest_before(0.2 + 0.01 * own)
            .with_onset(0.001 * own)
            .with_zero_at((!number.is_multiple_of(3)).then_some(7 * number)),
    }
}

/// Output and sensitivities of every member, alone and side by side.
fn compare(members: &[Member], free: &[usize], quantity: Quantity) {
    let room = |columns: usize| -> Vec<Vec<f64>> {
        let samples = members.iter().map(|member| member.input.samples());
        samples
            .map(|samples| vec![0.0; samples * columns])
            .collect()
    };
    let (mut alone, mut alone_sensitivity) = (room(1), room(free.len()));
    for (index, member) in members.iter().enumerate() {
        member
            .model
            .sensitivities(
                &member.values,
                free,
                &member.input,
                quantity,
                &mut alone[index],
                &mut alone_sensitivity[index],
            )
            .unwrap();
    }
    let (mut output, mut sensitivity) = (room(1), room(free.len()));
    let mut runs: Vec<Run<'_>> = (members.iter())
        .zip(output.iter_mut().zip(&mut sensitivity))
        .map(|(member, (output, sensitivity))| Run {
            model: &member.model,
            values: &member.values,
            input: &member.input,
            quantity,
            output,
            sensitivity,
        })
        .collect();
    simulate_side_by_side(&mut runs, free).unwrap();
    let names: Vec<&str> = members[0]
        .model
        .effects()
        .map(|effect| effect.name())
        .collect();
    let bits = |signals: &[Vec<f64>]| -> Vec<u64> {
        signals
            .iter()
            .flatten()
            .map(|value| value.to_bits())
            .collect()
    };
    assert!(output.iter().flatten().any(|&value| value != 0.0));
    assert_eq!(bits(&alone), bits(&output), "{names:?} {quantity:?}");
    assert_eq!(
        bits(&alone_sensitivity),
        bits(&sensitivity),
        "{names:?} {quantity:?} {free:?}"
    );
}

fn check(effects: &[Effect], intersample: Intersample) {
    let members: Vec<Member> = (0..MEMBERS)
        .map(|number| member(effects, number, intersample))
        .collect();
    let all: Vec<usize> = (0..members[0].values.len()).collect();
    for quantity in [Quantity::Displacement, Quantity::Acceleration] {
        compare(&members, &all, quantity);
    }
    compare(&members, &all[all.len() - 1..], Quantity::Velocity);
    compare(&members, &[], Quantity::Velocity);
}

#[test]
fn the_base_model_and_every_effect() {
    check(&[], Intersample::Linear);
    for &effect in Effect::ALL {
        check(&[effect], Intersample::Linear);
    }
}

/// As it holds a machine, where each stops and rests in its own time.
#[test]
fn dry_friction_of_a_machine() {
    let scale = Scale::Rig {
        torque_nm: 10.0,
        angle_rad: 0.1,
        time_s: 0.05,
    };
    let rig = member(&[], 0, Intersample::ZeroOrder)
        .model
        .rig()
        .to_owned();
    for effect in [Effect::CoulombFriction, Effect::StribeckFriction] {
        check(
            &[scale.effect(effect, &rig).unwrap()],
            Intersample::ZeroOrder,
        );
    }
}

#[test]
fn effects_together() {
    let effects = [
        Effect::Backlash,
        Effect::SecondMass,
        Effect::GripSlip,
        Effect::StretchReflex,
        Effect::TorqueDelay,
        Effect::GravityLeakage,
    ];
    check(&effects, Intersample::ZeroOrder);
    check(&effects[..3], Intersample::BandLimited);
}

#[test]
fn laws_of_a_study() {
    let law = |name: &str, place: Place, expression: &str| {
        let parameter = CustomParameterSettings {
            name: "p".to_owned(),
            unit: "N".to_owned(),
            start: 0.7,
            minimum: 0.0,
            maximum: 5.0,
            ..Default::default()
        };
        Effect::custom(&CustomEffectSettings {
            name: name.to_owned(),
            place,
            expression: expression.to_owned(),
            parameters: vec![parameter],
        })
        .unwrap()
    };
    for (number, expression) in [
        "p*tanh(v/0.1)*exp(-t^2) + sqrt(abs(x))*sin(30*t)",
        "p*min(x, v) + max(T, 3)*smooth_step(t/0.1) + abs(v)^p*sign(v)",
        "p*atan(theta) + cos(omega) + log(2 + x^2) + step(v)*x^3/(1 + x^-4)",
    ]
    .into_iter()
    .enumerate()
    {
        let force = law(&format!("force_{number}"), Place::Force, expression);
        check(&[force], Intersample::Linear);
    }
    let torque = law("more_torque", Place::Torque, "p*x*T");
    check(&[torque], Intersample::Linear);
    let sensor = law("more_acceleration", Place::Measurement, "p*a*v");
    check(&[sensor], Intersample::Linear);
}

#[test]
fn simulations_that_take_up_the_measured_motion() {
    for effects in [
        &[][..],
        &[Effect::MaxwellBranch],
        &[Effect::AccelerationBias],
    ] {
        let members: Vec<Member> = (0..MEMBERS)
            .map(|number| {
                let mut member = member(effects, number, Intersample::Linear);
                let motions = (0..40).map(|i| [0.01 * i as f64, 0.1 * (number + i) as f64]);
                member.input = (member.input).with_restarts(20 + number, motions.collect());
                member
            })
            .collect();
        let all: Vec<usize> = (0..members[0].values.len()).collect();
        compare(&members, &all, Quantity::Velocity);
    }
}

#[test]
fn runs_that_are_not_alike_wait_for_their_own_turn() {
    let cubic = &[Effect::CubicStiffness];
    let mut members: Vec<Member> = (0..4)
        .map(|number| member(cubic, number, Intersample::Linear))
        .collect();
    members.insert(1, member(cubic, 5, Intersample::ZeroOrder));
    members.push(member(&[Effect::QuadraticDamping], 6, Intersample::Linear));
    compare(&members, &[0, 3], Quantity::Acceleration);
}
