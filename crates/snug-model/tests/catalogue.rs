//! Effects against SciPy: the table in `reference/effects.csv`, made as its head says.

use snug_campaign::{Intersample, Motion, Rig};
use snug_model::{Effect, Input, Model};
use std::collections::BTreeSet;
use std::f64::consts::PI;

const TABLE: &str = include_str!("reference/effects.csv");
const RIG: Rig = Rig {
    lever_arm_m: 0.33,
    known_inertia_kg_m2: 0.275,
};
const BASE: [f64; 3] = [2.3, 103.0, 2315.0];
const INTERVAL_S: f64 = 1e-4;
const SAMPLES: usize = 3001;
const ONSET_S: f64 = 0.02;
/// Sizes of θ \[rad\], ω \[rad/s\] and α \[rad/s²\] that errors are relative to.
const SIZES: [f64; 3] = [0.05, 0.9, 40.0];

/// The logged torque at `index` samples from the first \[Nm\].
fn torque_nm(effect: Effect, index: usize) -> f64 {
    match (effect, index) {
        (Effect::TorqueLag, 0..2000) => 30.0 * (PI * index as f64 / 2000.0).sin().powi(2),
        (Effect::TorqueLag, _) => 0.0,
        (_, 200..=1000) => 30.0 * (index - 200) as f64 / 800.0,
        (_, 1001..1010) => 3.0 * (1010 - index) as f64,
        _ => 0.0,
    }
}

fn motion(effect: Effect, own: &[f64]) -> Motion {
    let torque: Vec<f64> = (0..SAMPLES).map(|index| torque_nm(effect, index)).collect();
    let input = Input::new(&torque, INTERVAL_S, Intersample::Linear).with_onset(ONSET_S);
    let values: Vec<f64> = BASE.iter().chain(own).copied().collect();
    let model = Model::new(RIG, &[effect]).expect("a valid rig");
    model.simulate(&values, &input)
}

/// What a law's smoothness allows a fixed step of 0.1 ms to reach.
fn tolerance(effect: Effect) -> f64 {
    match effect {
        // The torque's slope is that of a line over m = 5 samples on either side: Δ² (3m² + 3m − 1)/30 of its second derivative
        // off, which with this torque and τ is 2e-6 of the acceleration and 3e-6 of the velocity.
        Effect::TorqueLag => 5e-6,
        // The acceleration is taken as straight between samples.
        Effect::AccelerationLag => 2e-6,
        // So is what leaks in.
        Effect::CentripetalCrosstalk | Effect::GravityLeakage => 5e-8,
        // Their rates have a kink where the velocity changes its sign, in the middle of a step.
        Effect::BoucWen | Effect::DirectionalDamping => 5e-8,
        // The damper sets in with a jump of c v (10 N at the first contact) in the middle of a step. What Runge and Kutta's
        // weights make of it is up to a third of the step off, h c v l / 3 I = 2e-4 rad/s, as is ω from then on.
        Effect::Backlash => 5e-5,
        _ => 1e-9,
    }
}

#[test]
fn each_effect_shows_as_scipy_says() {
    let rows: Vec<Vec<&str>> = TABLE
        .lines()
        .filter(|line| !line.starts_with('#'))
        .skip(1)
        .map(|line| line.split(',').collect())
        .collect();
    let names: BTreeSet<&str> = rows.iter().map(|row| row[0]).collect();
    // The other seven are in `independent_solutions.rs`.
    assert_eq!(names.len() + 7, Effect::ALL.len());
    let number = |text: &str| text.parse::<f64>().expect("a number of the table");
    let mut failures = Vec::new();
    for name in names {
        let effect = Effect::named(name).expect("an effect of the catalogue");
        let of_effect: Vec<_> = rows.iter().filter(|row| row[0] == name).collect();
        let own: Vec<f64> = of_effect[0][1].split(' ').map(number).collect();
        let motion = motion(effect, &own);
        let signals = [
            motion.displacement_rad,
            motion.velocity_rad_per_s,
            motion.acceleration_rad_per_s2,
        ]
        .map(|signal| signal.expect("a simulation gives every quantity"));
        for row in of_effect {
            let sample = (number(row[2]) / INTERVAL_S).round() as usize;
            for (quantity, signal) in signals.iter().enumerate() {
                let expected = number(row[3 + quantity]);
                let error = (signal[sample] - expected).abs() / SIZES[quantity];
                if error >= tolerance(effect) {
                    failures.push(format!(
                        "{name} quantity {quantity} at {} s: {} against {expected}, error {error:.1e}",
                        row[2], signal[sample]
                    ));
                }
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn two_effects_with_a_parameter_of_one_name_stay_apart() {
    let model = Model::new(RIG, &[Effect::MaxwellBranch, Effect::TorqueLag]).expect("a valid rig");
    let names: Vec<&str> = model.parameters()[3..]
        .iter()
        .map(|p| p.name.as_str())
        .collect();
    assert_eq!(names, ["k_m_n_per_m", "tau_s", "torque_lag_tau_s"]);
}
