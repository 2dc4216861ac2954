//! Rigs whose force comes and goes with the way.

use super::names;
use super::rig::{Noise, Rig, moved};
use snug_campaign::{EffectParameter, Verdict};
use snug_study::Verb;
use std::f64::consts::TAU;

/// A carriage on a screw that is shaken by twelve forces of this size \[N\] and pulled by such a `ripple` \[N\], eight short recordings with
/// such noise \[m\].
fn carriage(size_n: f64, noise_m: f64, ripple: impl Fn(f64) -> f64) -> Rig {
    let mut noise = Noise(2);
    let mut recording = || -> Vec<[f64; 2]> {
        let tones: Vec<[f64; 2]> = (0..12)
            .map(|tone| {
                [
                    0.5 * 16.0_f64.powf(f64::from(tone) / 11.0),
                    TAU * noise.even(),
                ]
            })
            .collect();
        let force = |t: f64| -> f64 {
            let tones = tones.iter().map(|[hz, phase]| (TAU * hz * t + phase).sin());
            size_n * tones.sum::<f64>()
        };
        let inputs: Vec<f64> = (0..1500).map(|k| force(1e-3 * f64::from(k))).collect();
        let rate = |[x, v]: [f64; 2], u: f64| [v, (u - 20.0 * v - 400.0 * x - ripple(x)) / 3.0];
        let places = moved(&inputs, 10, rate).map(|[x, _]| x);
        noise.with(&inputs, places, noise_m)
    };
    Rig::that_slides((0..8).map(|_| recording()).collect())
}

/// That these are amplitudes and wavelength of a ripple of such a size \[N\] and wavelength \[m\].
fn is_ripple(found: &[EffectParameter], size_n: f64, wavelength_m: f64) {
    let [sine, cosine, wavelength] = [0, 1, 2].map(|index| found[index].value);
    let off = (sine.hypot(cosine) / size_n - 1.0).abs();
    assert!(off < 0.03, "{sine} {cosine}");
    let off = (wavelength / wavelength_m - 1.0).abs();
    assert!(off < 0.005, "{wavelength}");
}

/// What takes most of the error in parts that took no part comes first, with its size, and the model without it is not called adequate.
#[test]
fn a_screw_s_ripple_comes_first_of_eight_recordings() {
    let rig = carriage(16.0, 1e-4, |x| 10.0 * (TAU * x / 0.006 + 0.7).sin());
    let diagnosis = rig.told(&Verb::Diagnose);
    let (first, headline) = (&diagnosis.ranking[0], &diagnosis.headline);
    assert_eq!(first.effect, "torque_ripple", "{headline}");
    assert_ne!(diagnosis.verdict, Verdict::Adequate, "{headline}");
    is_ripple(&first.parameters, 10.0, 0.006);
}

/// A motor's magnets and its slots, a screw's pitch and its balls. Either alone leads a free run astray: held out, neither was told from chance,
/// or a model with the first was called adequate.
#[test]
fn a_screw_s_balls_are_told_beside_its_pitch() {
    const NOISE_M: f64 = 5e-5;
    let pitch_and_balls =
        |x: f64| 2.0 * (TAU * x / 0.006 + 0.7).sin() + 1.2 * (TAU * x / 0.0026 + 1.9).sin();
    let rig = carriage(5.0, NOISE_M, pitch_and_balls);
    let diagnosis = rig.told_with("intersample: ZeroOrder", &Verb::Improve);
    let headline = &diagnosis.headline;
    assert_eq!(
        names(&diagnosis),
        ["torque_ripple", "second_ripple"],
        "{headline}"
    );
    is_ripple(&diagnosis.added[0].parameters, 2.0, 0.006);
    is_ripple(&diagnosis.added[1].parameters, 1.2, 0.0026);
    let left = diagnosis.ladder.last().unwrap().rms_fitted_output;
    assert!(left < 1.1 * NOISE_M, "{left}: {headline}");
}
