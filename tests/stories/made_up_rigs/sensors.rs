//! What a machine's sensor makes of a motion.

use super::names;
use super::rig::{FORCE, Noise, Rig, moved};
use snug_campaign::Verdict;
use snug_study::Verb;
use std::f64::consts::TAU;

/// A mass on a rubber mount, shaken, with a piezoelectric accelerometer whose amplifier lets through nothing below 3 Hz: two lags, a gap and
/// dry friction explained 99 % of it, none of which is there.
#[test]
fn an_accelerometer_that_is_ac_coupled_is_told_with_its_corner() {
    const CORNER_HZ: f64 = 3.0;
    const NOISE: f64 = 0.02;
    let mut noise = Noise(41);
    let mut recording = || {
        let inputs = noise.tones([1.5, 60.0], 8.0, 3000);
        let acceleration = |x: f64, v: f64, u: f64| (u - 45.0 * v - 12_000.0 * x) / 12.0;
        // Of the speed, too, nothing slow comes through: s' = a − ω_c s.
        let rate = |[x, v, s]: [f64; 3], u: f64| {
            let a = acceleration(x, v, u);
            [v, a, a - TAU * CORNER_HZ * s]
        };
        let read = (moved(&inputs, 20, rate).zip(&inputs))
            .map(|([x, v, s], &u)| acceleration(x, v, u) - TAU * CORNER_HZ * s);
        noise.with(&inputs, read, NOISE)
    };
    let rig = Rig::declared(
        [FORCE, "Acceleration", "MetrePerSecondSquared"],
        (0..3).map(|_| recording()).collect(),
    );
    let diagnosis = rig.told_with("intersample: ZeroOrder", &Verb::Improve);
    let headline = &diagnosis.headline;
    assert_eq!(names(&diagnosis), ["ac_coupling"], "{headline}");
    assert_eq!(diagnosis.verdict, Verdict::Adequate, "{headline}");
    let corner = diagnosis.added[0].parameters[0].value;
    assert!((corner / CORNER_HZ - 1.0).abs() < 0.02, "{corner}");
    let left = diagnosis.ladder.last().unwrap().rms_fitted_output;
    assert!(left < 1.1 * NOISE, "{left}: {headline}");
}
