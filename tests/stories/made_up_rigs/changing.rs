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

/// What slides under tones, recording by recording; its acceleration goes with the share of the recording that is over, place, speed and force.
fn slides(seed: u64, of: [&dyn Fn(f64, [f64; 2], f64) -> f64; 3]) -> Diagnosis {
    const SAMPLES: usize = 6000;
    let mut noise = Noise(seed);
    let recordings = of.map(|acceleration| {
        let inputs = noise.tones([0.8, 20.0], 20.0, SAMPLES);
        let rate = |[x, v, t_s]: [f64; 3], u: f64| {
            let over = t_s / (1e-3 * SAMPLES as f64);
            [v, acceleration(over, [x, v], u), 1.0]
        };
        let places = moved(&inputs, 10, rate).map(|[x, _, _]| x);
        noise.with(&inputs, places, 2e-5)
    });
    Rig::that_slides(recordings.into()).told(&Verb::Improve)
}

/// A vessel on springs, of which mass \[kg\] and stiffness \[N/m\] go with the share of a recording that is over, recording by recording.
fn on_springs(of: [&dyn Fn(f64) -> [f64; 2]; 3]) -> Diagnosis {
    let [a, b, c] = of.map(|numbers| {
        move |over: f64, [x, v]: [f64; 2], u: f64| {
            let [mass, stiffness] = numbers(over);
            (u - 40.0 * v - stiffness * x) / mass
        }
    });
    slides(51, [&a, &b, &c])
}

/// One that runs out: what is left of its mass at the end of each recording, over that at the beginning.
fn vessel(left: f64) -> Diagnosis {
    on_springs([&|over| [5.0 * (1.0 - (1.0 - left) * over), 8000.0]; 3])
}

/// What is told of a rig that changes, where nothing was looked for beside that.
#[track_caller]
fn told(diagnosis: &Diagnosis, what: &Changing, times: f64) -> Changes {
    let found = changes(diagnosis).expect("it changes");
    assert_eq!(&found.what, what);
    assert!((found.times / times - 1.0).abs() < 0.05, "{found:?}");
    assert_eq!(diagnosis.word(), "the rig changes while it is measured");
    assert!(diagnosis.added.is_empty() && diagnosis.ranking.is_empty());
    found.clone()
}

#[test]
fn what_is_put_on_halfway_is_told_with_where_it_is() {
    let put_on = |over: f64| [if over < 0.5 { 5.0 } else { 7.5 }, 8000.0];
    let found = told(&on_springs([&put_on; 3]), &Changing::Mass, 1.5);
    let after = found.after.expect("at once");
    assert!((after - 0.5).abs() < 0.07, "{after}");
    assert!(found.only_in.is_empty(), "{:?}", found.only_in);
}

#[test]
fn the_recording_in_which_a_spring_gives_way_is_named() {
    let stays = |_| [5.0, 8000.0];
    let gives_way = |over: f64| [5.0, 8000.0 * (1.0 - 0.45 * over)];
    let rig = on_springs([&stays, &gives_way, &stays]);
    let found = told(&rig, &Changing::Stiffness, 0.55);
    assert_eq!(
        (found.after, found.only_in),
        (None, vec!["r1.csv".to_owned()])
    );
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

/// On a spring that hardens, too, the noise of an acceleration hides what the damper does unless it is averaged.
#[test]
fn a_damper_that_warms_up_is_told_beside_what_is_missing() {
    if !snug_tests::long("a damper that warms up beside a hardening spring") {
        return;
    }
    let warms_up = |over: f64, [x, v]: [f64; 2], u: f64| {
        let damping = 40.0 * (1.0 - 0.5 * over);
        (u - damping * v - 8000.0 * x - 3e7 * x.powi(3)) / 5.0
    };
    let diagnosis = slides(53, [&warms_up; 3]);
    assert_eq!(
        diagnosis.verdict,
        Verdict::Undecided,
        "{}",
        diagnosis.headline
    );
    assert_eq!(diagnosis.added[0].effect, "cubic_stiffness");
    let found = changes(&diagnosis).expect("it changes");
    assert_eq!(found.what, Changing::Damping);
    assert!((found.times - 0.5).abs() < 0.1, "{found:?}");
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
