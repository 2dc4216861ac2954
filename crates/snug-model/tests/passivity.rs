//! Passive laws never give back more energy than they took.

use snug_campaign::{Intersample, Rig};
use snug_model::{Effect, Input, Kind, Law, Model, ParameterSpec};

const RIG: Rig = Rig {
    lever_arm_m: 0.33,
    known_inertia_kg_m2: 0.275,
};
const INTERVAL_S: f64 = 1e-4;

/// The smallest and largest work \[J\] done on the hand since rest, ∫ (T − I_n α) ω dt, with a hand that weighs nothing.
fn work(base: [f64; 3], effect: Effect, own: &[f64]) -> (f64, f64) {
    // A push, a pull that turns the motion, and a free end: every quadrant of x and v is visited.
    let torque: Vec<f64> = (0..8000)
        .map(|index| match index {
            0..1000 => 6.0 * (index as f64 / 1000.0 * std::f64::consts::PI).sin().powi(2),
            1000..3000 => {
                -6.0 * ((index - 1000) as f64 / 2000.0 * std::f64::consts::PI)
                    .sin()
                    .powi(2)
            }
            _ => 0.0,
        })
        .collect();
    let model = Model::new(RIG, &[effect]).expect("a valid rig");
    let values: Vec<f64> = base.iter().chain(own).copied().collect();
    let input = Input::new(&torque, INTERVAL_S, Intersample::Linear);
    let motion = model.simulate(&values, &input).expect("a valid simulation");
    let velocity = motion.velocity_rad_per_s.expect("simulated");
    let acceleration = motion.acceleration_rad_per_s2.expect("simulated");
    let power: Vec<f64> = (0..torque.len())
        .map(|i| (torque[i] - RIG.known_inertia_kg_m2 * acceleration[i]) * velocity[i])
        .collect();
    let (mut total, mut range) = (0.0_f64, (0.0_f64, 0.0_f64));
    for pair in power.windows(2) {
        total += 0.5 * INTERVAL_S * (pair[0] + pair[1]);
        range = (range.0.min(total), range.1.max(total));
    }
    range
}

/// A size that acts, within what the law is valid for.
fn moderate(spec: &ParameterSpec) -> f64 {
    match spec.starts.iter().copied().fold(0.0, f64::max) {
        0.0 => 0.02 * spec.maximum,
        largest => largest,
    }
}

/// What is mechanical and yet may give back more than was put in since the window began, each for its reason.
const NOT_PASSIVE: [Effect; 6] = [
    // What is measured moves otherwise than what is driven: torque times its velocity is no work.
    Effect::SecondMode,
    // The hand holds against it from before, with a force that then does work.
    Effect::TorqueRipple,
    Effect::SecondRipple,
    // A weight may come down that was up before, on an arm or on a rope.
    Effect::GravityTorque,
    Effect::ConstantLoad,
    // Less friction one way is less of the base model's.
    Effect::AsymmetricViscousFriction,
];

/// Once where nothing but the effect can dissipate, once with a damper for the laws that act through it.
#[test]
fn passive_laws_never_give_back_more_than_they_took() {
    let mechanical = |effect: &&Effect| {
        effect.description().kind == Kind::Mechanical && !NOT_PASSIVE.contains(effect)
    };
    for &effect in Effect::ALL.iter().filter(mechanical) {
        let specs = effect.description().parameters;
        let own: Vec<f64> = specs.iter().map(moderate).collect();
        for base in [[0.0, 0.0, 500.0], [0.0, 30.0, 1500.0]] {
            let (least, most) = work(base, effect, &own);
            let name = effect.name();
            assert!(most > 0.05, "{name}: only {most} J went in");
            assert!(
                least > -1e-5 * most,
                "{name} with {own:?}: {least} J of {most} J came from nowhere; mind the sign of what it adds, or give it \
                 another `kind` than `Mechanical`, which is passive"
            );
        }
    }
}

/// The measure itself can fail: damping of the wrong sign creates energy.
#[test]
fn an_active_law_is_noticed() {
    let (least, most) = work([0.0, 0.0, 500.0], Effect::QuadraticDamping, &[-100.0]);
    assert!(least < -0.1 * most, "{least} J of {most} J");
}
