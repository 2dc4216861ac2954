//! Rigs whose input a controller holds from sample to sample, of which the study says nothing.

use super::rig::{FORCE, Noise, Rig, moved};
use super::{names, says};
use snug_study::Verb;

/// The noise of a pendulum's encoder \[rad\].
const OF_THE_PENDULUM: f64 = 1.75e-3;
/// The noise of a slide's accelerometer \[m/s²\].
const OF_THE_ACCELEROMETER: f64 = 1.5;

/// A pendulum that swings to 80°, turned by a torque that a controller holds from sample to sample.
pub(super) fn pendulum() -> Rig {
    let mut noise = Noise(7);
    let mut recording = || -> Vec<[f64; 2]> {
        let levels: Vec<f64> = (0..12).map(|_| 12.0 * noise.even() - 6.0).collect();
        let inputs: Vec<f64> = (0..1500).map(|k| levels[k / 130]).collect();
        let rate = |[x, v]: [f64; 2], u: f64| [v, (u - 0.025 * v - 8.0 * x.sin()) / 0.012];
        let angles = moved(&inputs, 20, rate).map(|[x, _]| x);
        noise.with(&inputs, angles, OF_THE_PENDULUM)
    };
    Rig::that_turns((0..3).map(|_| recording()).collect())
}

/// Taken as running straight between samples it leaves four times the noise, and nothing stands in for that. With it held the rig is known
/// to its noise.
#[test]
fn a_pendulum_driven_by_a_held_torque_is_known_to_its_noise() {
    let diagnosis = pendulum().told(&Verb::Improve);
    let names = names(&diagnosis);
    assert_eq!(names, ["gravity_torque"], "{}", diagnosis.headline);
    let weight = &diagnosis.added[0].parameters[0];
    let (low, high) = (weight.low.unwrap(), weight.high.unwrap());
    assert!((weight.value + 8.0).abs() < 0.02, "{weight:?}");
    assert!(low <= -8.0 && -8.0 <= high, "{weight:?}");
    let left = diagnosis.ladder.last().unwrap().rms_fitted_output;
    assert!(left < 1.05 * OF_THE_PENDULUM, "{left}");
    let headline = diagnosis.headline.to_string();
    assert!(!headline.contains("still a motion"), "{headline}");
}

/// A slide whose acceleration is measured, which follows its force at once, that a controller holds from sample to sample.
pub(super) fn slide() -> Rig {
    let mut noise = Noise(13);
    let mut recording = || -> Vec<[f64; 2]> {
        let inputs = noise.levels([-3.0, 3.0], 100, 4000);
        let rate = |[x, v]: [f64; 2], u: f64| [v, (u - 0.4 * v - 60.0 * x) / 0.02];
        let states: Vec<[f64; 2]> = moved(&inputs, 20, rate).collect();
        let accelerations = states.iter().zip(&inputs).map(|(&at, &u)| rate(at, u)[1]);
        noise.with(&inputs, accelerations, OF_THE_ACCELEROMETER)
    };
    Rig::declared(
        [FORCE, "Acceleration", "MetrePerSecondSquared"],
        (0..6).map(|_| recording()).collect(),
    )
}

/// Half a sampling interval is no delay there, and what does what a hold does is found instead of one, a spring beside a damper. Nothing is
/// missing.
#[test]
fn a_slide_with_an_accelerometer_and_a_held_force_lacks_nothing() {
    let diagnosis = slide().told(&Verb::Improve);
    let none: [&str; 0] = [];
    assert_eq!(names(&diagnosis), none, "{}", diagnosis.headline);
    assert!(says(&diagnosis, "held from sample to sample"));
    let left = diagnosis.ladder.last().unwrap().rms_fitted_output;
    assert!(left < 1.02 * OF_THE_ACCELEROMETER, "{left}");
}
