//! Rigs that change while they are measured, and one that does not.

use super::rig::{Noise, Rig, moved};
use snug_campaign::words::changes::{Changes, Changing};
use snug_campaign::words::reason::Reason;
use snug_campaign::{Diagnosis, Verdict};
use snug_study::Verb;

fn changes(diagnosis: &Diagnosis) -> Option<&Changes> {
    diagnosis.reasons.iter().find_map(|reason| match reason {
        Reason::Changes(changes) => Some(changes),
        _ => None,
    })
}

/// A vessel on springs that runs out: what is left of its mass at the end of each recording, over that at the beginning.
fn vessel(left: f64) -> Diagnosis {
    const SAMPLES: usize = 6000;
    let mut noise = Noise(51);
    let mut recording = || {
        let inputs = noise.tones([0.8, 20.0], 20.0, SAMPLES);
        let rate = |[x, v, t_s]: [f64; 3], u: f64| {
            let mass = 5.0 * (1.0 - (1.0 - left) * t_s / (1e-3 * SAMPLES as f64));
            [v, (u - 40.0 * v - 8000.0 * x) / mass, 1.0]
        };
        let places = moved(&inputs, 10, rate).map(|[x, _, _]| x);
        noise.with(&inputs, places, 2e-5)
    };
    Rig::that_slides((0..3).map(|_| recording()).collect()).told(&Verb::Improve)
}

#[test]
fn a_vessel_that_runs_out_is_told_from_a_missing_effect() {
    let diagnosis = vessel(0.5);
    assert_ne!(
        diagnosis.verdict,
        Verdict::UnlistedEffect,
        "{}",
        diagnosis.headline
    );
    let found = changes(&diagnosis).expect("it changes");
    assert_eq!(found.what, Changing::Mass);
    assert!((found.times - 0.5).abs() < 0.12, "{found:?}");
}

#[test]
fn one_that_stays_as_it_is_changes_nothing() {
    let diagnosis = vessel(1.0);
    assert_eq!(
        diagnosis.verdict,
        Verdict::Adequate,
        "{}",
        diagnosis.headline
    );
    assert_eq!(changes(&diagnosis), None);
}
