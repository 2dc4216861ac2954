//! Slides whose place is read with a zero that moves, or that is far away.

use super::rig::{Noise, Rig, moved};
use super::{names, says};
use snug_campaign::{Diagnosis, Verdict};
use snug_study::Verb;

/// The noise of the reading, of a motion of some 0.1 \[m\].
const NOISE: f64 = 4e-4;

/// Three recordings of it.
fn slide(seen: impl Fn(usize, f64, f64) -> f64, metre: f64) -> Diagnosis {
    slides(3, seen, metre)
}

/// A slide on a spring, of which `seen` of its place is read after so many seconds in so many recordings; a metre is so much of the unit.
fn slides(recordings: usize, seen: impl Fn(usize, f64, f64) -> f64, metre: f64) -> Diagnosis {
    let mut noise = Noise(61);
    let mut recording = |number: usize| {
        let inputs = noise.levels([-20.0, 20.0], 100, 2000);
        let rate = |[x, v]: [f64; 2], u: f64| [v, (u - 20.0 * v - 90.0 * 25.0 * x) / 1.5];
        let places = moved(&inputs, 10, rate).map(|[x, _]| x).enumerate();
        let read = places.map(|(sample, x)| metre * seen(number, 1e-3 * sample as f64, x));
        noise.with(&inputs, read, metre * NOISE * 0.1)
    };
    Rig::that_slides((0..recordings).map(&mut recording).collect()).told(&Verb::Improve)
}

/// Nothing is missing but that, and noise is left.
#[track_caller]
fn lacks(diagnosis: &Diagnosis, effect: &str, metre: f64) {
    let headline = &diagnosis.headline;
    assert_eq!(names(diagnosis), [effect], "{headline}");
    assert_eq!(diagnosis.verdict, Verdict::Adequate, "{headline}");
    let left = diagnosis.ladder.last().unwrap().rms_fitted_output;
    assert!(left < 1.1 * metre * NOISE * 0.1, "{left}: {headline}");
}

/// A drift was a second mode at the slide's own frequency.
#[test]
fn a_reading_that_drifts_by_as_much_as_the_slide_moves_is_one() {
    let rates = [0.02, -0.03, 0.01];
    let diagnosis = slide(|number, t, x| x + rates[number] * t, 1.0);
    lacks(&diagnosis, "output_drift", 1.0);
    let drift = &diagnosis.added[0].parameters[0];
    let mean = rates.iter().sum::<f64>() / 3.0;
    assert!((drift.value - mean).abs() < 1e-4, "{drift:?}");
    assert_eq!(drift.unit, "rad/s");
}

/// Of five recordings the sensor of one drifts, and that of another is `off` by so much.
fn one_drifts_and_one_is(off: fn(f64) -> f64) -> Diagnosis {
    let seen = |number: usize, t: f64, x: f64| match number {
        2 => x + 0.02 * t,
        4 => x + off(t),
        _ => x,
    };
    slides(5, seen, 1.0)
}

/// A sensor that slips by 0.2 m within 50 ms, which no effect does: another recording's drift was the rig's, and the model adequate.
#[test]
fn a_recording_of_which_much_is_left_stands_apart() {
    let diagnosis = one_drifts_and_one_is(|t| 0.2 * ((t - 0.9) / 0.05).clamp(0.0, 1.0));
    let headline = &diagnosis.headline;
    assert_eq!(diagnosis.verdict, Verdict::Undecided, "{headline}");
    assert!(says(
        &diagnosis,
        "of r4.csv (1 of 5 recordings) the model leaves"
    ));
}

/// A zero that is set anew at one sample keeps its recording out, and the drift of the other is all that the rest lacks. It was a second mode.
#[test]
fn a_recording_whose_zero_jumps_spoils_no_other() {
    let diagnosis = one_drifts_and_one_is(|t| if t > 0.9 { 0.2 } else { 0.0 });
    lacks(&diagnosis, "output_drift", 1.0);
}

/// A slide with dry friction, of which in one recording of 2 s the reading stands still for an eighth of a second.
#[test]
fn a_recording_whose_reading_is_stuck_spoils_no_other() {
    let mut noise = Noise(62);
    let mut recording = |number: usize| {
        let forces = noise.tones([0.5, 12.0], 4.0, 2000);
        let rate = |[x, v]: [f64; 2], u: f64| {
            let friction = 2.5 * (v / 1e-3).tanh();
            [v, (u - 6.0 * v - 900.0 * x - friction) / 1.5]
        };
        let places = moved(&forces, 40, rate).map(|[x, _]| x);
        let mut read = noise.with(&forces, places, 2e-5);
        if number == 2 {
            let [_, stuck] = read[800];
            read[800..925].iter_mut().for_each(|[_, y]| *y = stuck);
        }
        read
    };
    let rig = Rig::that_slides((0..3).map(&mut recording).collect());
    let diagnosis = rig.told_with("intersample: ZeroOrder", &Verb::Improve);
    let headline = &diagnosis.headline;
    assert_eq!(names(&diagnosis), ["coulomb_friction"], "{headline}");
    assert_eq!(diagnosis.verdict, Verdict::Adequate, "{headline}");
    let friction = diagnosis.added[0].parameters[0].value;
    assert!((friction / 2.5 - 1.0).abs() < 0.02, "{friction}");
}

/// A counter that reads 32 768 at rest, of a motion of some ten counts.
#[test]
fn a_counter_s_zero_may_be_as_far_away_as_it_counts() {
    let diagnosis = slide(|_, _, x| x + 32.768, 1000.0);
    lacks(&diagnosis, "output_offset", 1000.0);
    let offset = diagnosis.added[0].parameters[0].value;
    assert!((offset - 32_768.0).abs() < 0.1, "{offset}");
}

/// A load cell that drifts before a spring with dry friction: a place that drifts does as much while the friction is missing, and less
/// beside it.
#[test]
fn a_load_cell_that_drifts_is_told_from_a_place_that_does() {
    let mut noise = Noise(67);
    let mut recording = |number: usize| {
        let forces = noise.tones([1.0, 40.0], 2.3, 2000);
        let rate = |[x, v]: [f64; 2], u: f64| {
            let friction = 1.5 * (v / 0.01).tanh();
            [v, (u - 0.4 * v - 60.0 * x - friction) / 0.032]
        };
        let places: Vec<f64> = moved(&forces, 20, rate).map(|[x, _]| x).collect();
        let rate = 2.0 * (number as f64 - 1.2);
        let read = forces.iter().enumerate();
        let read: Vec<f64> = read
            .map(|(sample, u)| u + rate * 1e-3 * sample as f64)
            .collect();
        noise.with(&read, places.into_iter(), 5e-4)
    };
    let rig = Rig::that_slides((0..4).map(&mut recording).collect());
    let diagnosis = rig.told_with("intersample: ZeroOrder", &Verb::Improve);
    let headline = &diagnosis.headline;
    let mut added: Vec<(&str, f64)> = (diagnosis.added.iter())
        .map(|one| (one.effect.as_str(), one.parameters[0].value))
        .collect();
    added.sort_by(|a, b| a.0.cmp(b.0));
    let [("coulomb_friction", friction), ("torque_drift", drift)] = added[..] else {
        panic!("{added:?}: {headline}")
    };
    for (found, expected) in [(friction, 1.5), (drift, 2.0 * 0.3)] {
        assert!((found / expected - 1.0).abs() < 0.02, "{found}: {headline}");
    }
    let left = diagnosis.ladder.last().unwrap().rms_fitted_output;
    assert!(left < 1.1 * 5e-4, "{left}: {headline}");
}
