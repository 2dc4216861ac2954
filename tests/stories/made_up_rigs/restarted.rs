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
