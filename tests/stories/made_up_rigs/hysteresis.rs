//! Rigs whose spring has a loop.

use super::names;
use super::rig::{Noise, Rig, moved};
use snug_study::Verb;

/// A mass on a spring and a mount of wire rope, which stiffens as it is pressed and goes back stiffer still: a published benchmark's rig (Noël
/// and Schoukens 2016). It was a cubic spring, a loop that gives way, play, a lag and a damper.
#[test]
fn a_mount_of_wire_rope_is_a_loop_that_stiffens() {
    const NOISE: f64 = 8e-6;
    let mut noise = Noise(41);
    let mut recording = || {
        let inputs = noise.tones([5.0, 90.0], 20.0, 4000);
        let rate = |[x, v, z]: [f64; 3], u: f64| {
            let loops = v - 800.0 * v.abs() * z + 1100.0 * v * z.abs();
            [v, (u - 10.0 * v - 5e4 * x - 5e4 * z) / 2.0, loops]
        };
        let places = moved(&inputs, 10, rate).map(|[x, _, _]| x);
        noise.with(&inputs, places, NOISE)
    };
    let rig = Rig::that_slides((0..2).map(|_| recording()).collect());
    let diagnosis = rig.told(&Verb::Improve);
    let headline = &diagnosis.headline;
    assert_eq!(names(&diagnosis), ["general_bouc_wen"], "{headline}");
    let sizes = [5e4, 800.0, -1100.0];
    for (one, size) in diagnosis.added[0].parameters.iter().zip(sizes) {
        let found = one.value;
        assert!(
            (found / size - 1.0).abs() < 0.1,
            "{} {found}: {headline}",
            one.name
        );
    }
    let left = diagnosis.ladder.last().unwrap().rms_fitted_output;
    assert!(left < 1.1 * NOISE, "{left}: {headline}");
}

/// A spring in series with dry friction that lets go after a millimetre, of which the motion makes five in a sample: simulated in one step from
/// sample to sample, its loop bent otherwise and left three times the noise.
#[test]
fn a_loop_that_turns_within_a_sample_is_simulated_in_shorter_steps() {
    const NOISE: f64 = 2e-5;
    let mut noise = Noise(42);
    let mut recording = || {
        let inputs = noise.tones([2.5, 60.0], 400.0, 2500);
        let rate = |[x, v, z]: [f64; 3], u: f64| {
            let loops = v - 500.0 * v.abs() * z - 500.0 * v * z.abs();
            [v, (u - 100.0 * v - 1e5 * x - 1.5e5 * z) / 2.0, loops]
        };
        let places = moved(&inputs, 40, rate).map(|[x, _, _]| x);
        noise.with(&inputs, places, NOISE)
    };
    let rig = Rig::that_slides((0..2).map(|_| recording()).collect());
    let diagnosis = rig.told_with("intersample: ZeroOrder", &Verb::Improve);
    let headline = &diagnosis.headline;
    assert_eq!(names(&diagnosis), ["bouc_wen"], "{headline}");
    for (one, size) in diagnosis.added[0].parameters.iter().zip([1.5e5, 1e-3]) {
        let found = one.value;
        assert!((found / size - 1.0).abs() < 0.01, "{found}: {headline}");
    }
    let left = diagnosis.ladder.last().unwrap().rms_fitted_output;
    assert!(left < 1.1 * NOISE, "{left}: {headline}");
}
