//! A positioner that a controller holds: its input answers the noise of its own place.

use super::names;
use super::rig::{Noise, Rig, moved_from};
use snug_campaign::Verdict;
use snug_study::Verb;

/// The noise of the place \[m\].
const NOISE: f64 = 2e-5;

/// Dry friction and nothing else is missing; a hold taken for straight was a second mode of 56 Hz that pushes the other way.
#[test]
fn a_controller_s_held_force_is_no_second_mode() {
    let mut noise = Noise(79);
    let mut recording = |_| {
        let goals = noise.levels([-0.05, 0.05], 250, 4000);
        let (mut state, mut before, mut speed) = ([0.0, 0.0], 0.0, 0.0);
        let mut rows = Vec::new();
        for goal in goals {
            let place = state[0] + NOISE * noise.draw();
            speed = 0.7 * speed + 0.3 * (place - before) / 1e-3;
            before = place;
            let force = (900.0 * (goal - place) - 12.5 * speed).clamp(-25.0, 25.0);
            rows.push([force, place]);
            let rate = |[_, v]: [f64; 2], u: f64| {
                let friction = 1.2 * (v / 1.6e-3).tanh();
                [v, (u - 3.0 * v - friction) / 0.5]
            };
            state = moved_from(state, force, 10, rate);
        }
        rows
    };
    let rig = Rig::that_slides((0..4).map(&mut recording).collect());
    let diagnosis = rig.told(&Verb::Improve);
    let headline = &diagnosis.headline;
    assert_eq!(names(&diagnosis), ["coulomb_friction"], "{headline}");
    let friction = diagnosis.added[0].parameters[0].value;
    assert!(
        (friction / 1.2 - 1.0).abs() < 0.05,
        "{friction}: {headline}"
    );
    assert_ne!(diagnosis.verdict, Verdict::NotFitted, "{headline}");
}
