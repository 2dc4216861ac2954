//! Dry friction of a machine against the closed form of a mass on a spring: between two reversals it swings about ±F_c/k, and it comes to rest
//! where the spring holds it no more.

#![allow(clippy::unwrap_used)]

use snug_campaign::{Intersample, Quantity, Rig};
use snug_model::{Effect, Input, Model, Scale};

const RIG: Rig = Rig {
    lever_arm_m: 1.0,
    known_inertia_kg_m2: 0.0,
};
const SCALE: Scale = Scale::Rig {
    torque_nm: 5.0,
    angle_rad: 0.01,
    time_s: 0.04,
};
const INTERVAL_S: f64 = 5e-3;
const SAMPLES: usize = 1000;
/// kg, N/m and N.
const M: f64 = 2.0;
const K: f64 = 1200.0;
const HELD: f64 = 1.2;

/// Let go at `x0`: half swing number n is from X_n to −X_n + 2 s F_c/k, s the sign of X_n.
fn closed_form(x0: f64, t: f64) -> f64 {
    let (omega, shift) = ((K / M).sqrt(), HELD / K);
    let (mut turn, mut since) = (x0, t);
    let half_s = std::f64::consts::PI / omega;
    loop {
        if turn.abs() <= shift {
            return turn;
        }
        let about = shift * turn.signum();
        if since < half_s {
            return about + (turn - about) * (omega * since).cos();
        }
        (turn, since) = (2.0 * about - turn, since - half_s);
    }
}

fn simulated(x0: f64, steps: usize) -> Vec<f64> {
    let effects = [Effect::CoulombFriction, Effect::InitialMotion];
    let effects = effects.map(|effect| SCALE.effect(effect, &RIG).unwrap());
    let model = Model::scaled(RIG, &effects, SCALE).unwrap();
    let input = Input::new(&[0.0; SAMPLES], INTERVAL_S, Intersample::ZeroOrder).in_steps(steps);
    let mut angle = vec![0.0; SAMPLES];
    let values = [M, 0.0, K, HELD, x0, 0.0];
    model
        .output(&values, &input, Quantity::Displacement, &mut angle)
        .unwrap();
    angle
}

/// 50 samples a swing: a reversal falls within a step, which is off by what the spring's force changes in it, and the rest is the method's own.
#[test]
fn a_swing_decays_by_as_much_each_time_and_rests_where_it_does() {
    for x0 in [0.0205, -0.0133, 0.0009] {
        for (steps, most) in [(1, 2e-5), (2, 5e-6), (8, 4e-7)] {
            let found = simulated(x0, steps);
            for (k, x) in found.iter().enumerate() {
                let error = (x - closed_form(x0, k as f64 * INTERVAL_S)).abs();
                assert!(error < most, "{x0} {steps} sample {k}: {error}");
            }
            assert_eq!(found[SAMPLES - 200], found[SAMPLES - 1], "it creeps");
        }
    }
}

/// On the edge of being moved: 1.2 N hold 1.199, and let go of 1.201.
#[test]
fn what_rests_stays_until_it_is_pushed_by_more() {
    let effects = [SCALE.effect(Effect::CoulombFriction, &RIG).unwrap()];
    let model = Model::scaled(RIG, &effects, SCALE).unwrap();
    let pushed = |force: f64| {
        let input = Input::new(&[force; SAMPLES], INTERVAL_S, Intersample::ZeroOrder);
        let mut outputs = [Quantity::Displacement, Quantity::Acceleration].map(|quantity| {
            let mut output = vec![0.0; SAMPLES];
            let values = [M, 0.0, 0.0, HELD];
            model
                .output(&values, &input, quantity, &mut output)
                .unwrap();
            output
        });
        outputs.each_mut().map(|output| output[SAMPLES - 1])
    };
    assert_eq!(pushed(1.199), [0.0, 0.0]);
    // x = a t²/2 with 0.001 N on 2 kg.
    let [x, a] = pushed(1.201);
    let t = INTERVAL_S * (SAMPLES - 1) as f64;
    assert!(
        (a - 0.0005).abs() < 1e-12 && (x - 0.00025 * t * t).abs() < 1e-9,
        "{x} {a}"
    );
}
