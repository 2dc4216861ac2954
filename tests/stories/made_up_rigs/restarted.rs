//! Rigs that no free run follows for long, and whose model is restarted from the measured motion.

use super::names;
use super::rig::{Noise, Rig, moved};
use snug_campaign::Verdict;
use snug_study::Verb;
use std::f64::consts::TAU;

/// A lever that is turned to and fro, its angle by an encoder of 4096 steps: a mass on a spring of its own, driven by the motion taken up at
/// every restart, foretold the steps in that, and was credited with half of what gravity and dry friction left.
#[test]
fn what_foretells_errors_of_the_motion_taken_up_is_no_part_of_the_rig() {
    let mut noise = Noise(71);
    let step = TAU / 4096.0;
    let mut recording = || {
        let inputs = noise.tones([1.0, 16.0], 1.8, 3000);
        let rate = |[x, v]: [f64; 2], u: f64| {
            let friction = 0.05 * v + 0.4 * (v / 2e-2).tanh();
            [v, (u - friction - 6.0 * x.sin()) / 1.5e-3]
        };
        let angles = moved(&inputs, 40, rate).map(|[x, _]| (x / step).round() * step);
        noise.with(&inputs, angles, 0.0)
    };
    let rig = Rig::that_turns((0..3).map(|_| recording()).collect());
    let diagnosis = rig.told(&Verb::Improve);
    let headline = diagnosis.headline.to_string();
    let found = ["gravity_torque", "coulomb_friction"];
    assert_eq!(names(&diagnosis), found, "{headline}");
    assert_eq!(diagnosis.verdict, Verdict::Adequate, "{headline}");
    let friction = diagnosis.added[1].parameters[0].value;
    assert!(
        (friction / 0.4 - 1.0).abs() < 0.03,
        "{friction}: {headline}"
    );
}

/// Samples over which a gust goes on.
const GUST: usize = 150;

/// A trolley of 55 g that gusts push, which nobody recorded, and what swings below it, tuned to 16 Hz.
fn in_gusts(size_n: f64, hangs_kg: f64) -> Rig {
    let mut noise = Noise(83);
    let (natural, damping) = (TAU * 16.0, 0.1 * TAU * 16.0);
    let mut recording = || {
        let inputs = noise.levels([-40.0, 40.0], 75, 5000);
        let draws: Vec<f64> = (0..inputs.len() + GUST).map(|_| noise.draw()).collect();
        let gusts =
            (draws.windows(GUST)).map(|some| some.iter().sum::<f64>() / (GUST as f64).sqrt());
        let pairs = inputs.iter().zip(gusts);
        let acting: Vec<f64> = pairs.map(|(u, gust)| u + size_n * gust).collect();
        let rate = |[_, v, stretched, hung]: [f64; 4], u: f64| {
            let pull = natural * natural * stretched + damping * (v - hung);
            [v, (u - 0.45 * v - hangs_kg * pull) / 0.055, v - hung, pull]
        };
        let places = moved(&acting, 20, rate).map(|[x, ..]| x);
        noise.with(&inputs, places, 2e-3)
    };
    Rig::that_slides((0..4).map(|_| recording()).collect())
}

/// From restart to restart a mass of its own foretells gusts, as it goes on with what they did: where none swings there, none is told.
#[test]
fn a_trolley_in_gusts_lacks_what_swings_below_it_or_nothing() {
    let still = in_gusts(6.0, 0.0).told_with("intersample: ZeroOrder", &Verb::Improve);
    assert!(still.added.is_empty(), "{}", still.headline);
    let swings = in_gusts(3.0, 0.015).told_with("intersample: ZeroOrder", &Verb::Improve);
    let headline = &swings.headline;
    assert_eq!(names(&swings), ["attached_mass"], "{headline}");
    for (one, size) in swings.added[0].parameters.iter().zip([0.015, 16.0]) {
        let (name, value) = (&one.name, one.value);
        assert!(
            (value / size - 1.0).abs() < 0.2,
            "{name} {value}: {headline}"
        );
    }
}
