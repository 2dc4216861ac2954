//! Rigs that meet a stop.

use super::names;
use super::rig::{Noise, Rig, moved};
use snug_study::Verb;

/// A slide on a soft spring that meets a rubber stop. No free run of a model without the stop follows it; restarted from the measured motion
/// again and again, it lacked a mass on a spring beside the stop.
#[test]
fn a_slide_that_meets_a_rubber_stop_lacks_that_alone() {
    const NOISE: f64 = 2e-5;
    let mut noise = Noise(61);
    let mut recording = || {
        let inputs = noise.tones([1.0, 16.0], 10.0, 3000);
        let rate = |[x, v]: [f64; 2], u: f64| {
            let stop = 3e4 * (x - 0.02).max(0.0);
            [v, (u - 7.5 * v - 800.0 * x - stop) / 0.75]
        };
        let places = moved(&inputs, 10, rate).map(|[x, _]| x);
        noise.with(&inputs, places, NOISE)
    };
    let rig = Rig::that_slides((0..2).map(|_| recording()).collect());
    let diagnosis = rig.told_with("intersample: ZeroOrder", &Verb::Improve);
    let headline = &diagnosis.headline;
    assert_eq!(names(&diagnosis), ["end_stop_law"], "{headline}");
    for (one, size) in diagnosis.added[0].parameters.iter().zip([3e4, 0.02]) {
        let found = one.value;
        assert!((found / size - 1.0).abs() < 0.01, "{found}: {headline}");
    }
    let left = diagnosis.ladder.last().unwrap().rms_fitted_output;
    assert!(left < 2.0 * NOISE, "{left}: {headline}");
}
