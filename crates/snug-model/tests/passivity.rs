//! Passive laws never give back more energy than they took.

use snug_campaign::{Intersample, Rig};
use snug_model::{Effect, Input, Model};

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
    let motion = model.simulate(&values, &input);
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

#[test]
fn passive_laws_never_give_back_more_than_they_took() {
    // Undamped springs where the law needs one to act on; nothing else dissipates.
    let cases: [(Effect, [f64; 3], &[f64]); 7] = [
        (Effect::CoulombFriction, [0.0, 0.0, 500.0], &[5.0]),
        (Effect::QuadraticDamping, [0.0, 0.0, 500.0], &[100.0]),
        (Effect::DirectionalDamping, [0.0, 0.0, 500.0], &[50.0]),
        (Effect::Backlash, [0.0, 30.0, 1500.0], &[0.002]),
        (Effect::MaxwellBranch, [0.0, 0.0, 500.0], &[2000.0, 0.03]),
        (Effect::SecondMass, [0.0, 30.0, 1500.0], &[2.0, 2e3, 20.0]),
        (Effect::BoucWen, [0.0, 0.0, 500.0], &[3000.0, 0.003]),
    ];
    for (effect, base, own) in cases {
        let (least, most) = work(base, effect, own);
        assert!(most > 0.05, "{}: only {most} J went in", effect.name());
        assert!(
            least > -1e-5 * most,
            "{}: {least} J of {most} J came from nowhere",
            effect.name()
        );
    }
}

/// The measure itself can fail: damping of the wrong sign creates energy.
#[test]
fn an_active_law_is_noticed() {
    let (least, most) = work([0.0, 0.0, 500.0], Effect::QuadraticDamping, &[-100.0]);
    assert!(least < -0.1 * most, "{least} J of {most} J");
}
