//! A control valve whose packing sticks: dry friction of a good part of what drives it.

use super::rig::{Noise, Rig};
use snug_campaign::Verdict;
use snug_study::Verb;

const MASS_KG: f64 = 0.03;
const DAMPING_KG_PER_S: f64 = 60.0;
const STIFFNESS_N_PER_M: f64 = 4e4;
const FRICTION_N: f64 = 250.0;
/// Steps of the implicit rule from sample to sample.
const STEPS: u32 = 400;

/// A millisecond later: Euler's rule, implicit in damping and in a friction that holds at rest to the last bit (Moreau's time stepping).
fn moved_from([mut x, mut v]: [f64; 2], force_n: f64) -> [f64; 2] {
    let h = 1e-3 / f64::from(STEPS);
    for _ in 0..STEPS {
        let free = (v + h * (force_n - STIFFNESS_N_PER_M * x) / MASS_KG)
            / (1.0 + h * DAMPING_KG_PER_S / MASS_KG);
        let held = h * FRICTION_N / MASS_KG;
        v = free - free.clamp(-held, held);
        x += h * v;
    }
    [x, v]
}

/// Levels of a force, each reached in 30 ms, and where the stem is then to a fiftieth of a millimetre.
fn recording(noise: &mut Noise) -> Vec<[f64; 2]> {
    let levels = noise.levels([-900.0, 900.0], 150, 3000);
    let forces: Vec<f64> = (0..levels.len())
        .map(|end| {
            let last = &levels[end.saturating_sub(29)..=end];
            last.iter().sum::<f64>() / 30.0
        })
        .collect();
    let mut state = [0.0; 2];
    let places = forces.iter().map(|&force| {
        let [x, _] = state;
        state = moved_from(state, force);
        x
    });
    noise.with(&forces, places, 2e-5)
}

/// Without it the model takes what friction takes out of the motion for fifteen times the damping, from where no step led back: told was a
/// drift of the output, or nothing.
#[test]
fn a_valve_that_sticks_lacks_dry_friction() {
    let recordings = vec![recording(&mut Noise(11))];
    let diagnosis = Rig::that_slides(recordings).told(&Verb::Diagnose);
    let headline = &diagnosis.headline;
    assert_eq!(diagnosis.verdict, Verdict::MissingEffect, "{headline}");
    let best = &diagnosis.ranking[0];
    assert_eq!(best.effect, "coulomb_friction", "{headline}");
    let friction_n = best.parameters[0].value;
    assert!(
        (friction_n / FRICTION_N - 1.0).abs() < 0.1,
        "{friction_n}: {headline}"
    );
}
