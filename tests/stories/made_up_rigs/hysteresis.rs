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
