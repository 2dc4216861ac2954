//! Drives whose encoder begins anew after every turn, or reads something where they begin.

use super::rig::{Noise, Rig, TORQUE, moved};
use super::says;
use snug_campaign::words::headline::Headline;
use snug_campaign::{Diagnosis, Verdict};
use snug_study::Verb;

/// Dry friction of the drives \[Nm, N\].
const FRICTION: f64 = 0.3;

/// Dry friction of that size is what the headline names, and nothing else.
#[track_caller]
fn lacks_dry_friction(diagnosis: &Diagnosis) {
    let headline = &diagnosis.headline;
    assert_eq!(diagnosis.verdict, Verdict::Adequate, "{headline}");
    let Headline::Adequate { added, .. } = headline else {
        panic!("{headline}")
    };
    let named: Vec<&str> = added.iter().map(|one| one.effect.as_str()).collect();
    assert_eq!(named, ["coulomb_friction"], "{headline}");
    let found = diagnosis.added.iter();
    let friction = found.filter(|one| one.effect == "coulomb_friction");
    let size = friction.map(|one| one.parameters[0].value).next().unwrap();
    assert!((size / FRICTION - 1.0).abs() < 0.05, "{size}");
}

/// Three recordings of a drive with dry friction, from these angles on, as its encoder reads `seen` of them.
fn driven(
    noise: &mut Noise,
    from: [f64; 3],
    noise_rad: f64,
    seen: fn(f64) -> f64,
) -> Vec<Vec<[f64; 2]>> {
    let mut recording = |from: f64| -> Vec<[f64; 2]> {
        let tones = noise.tones([0.5, 15.0], 0.3, 3000);
        let levels = noise.levels([-1.2, 1.2], 600, 3000);
        let inputs: Vec<f64> = tones.iter().zip(levels).map(|(a, b)| a + b).collect();
        let rate = |[_, v]: [f64; 2], u: f64| {
            let friction = FRICTION * (v / 0.01).tanh();
            [v, (u - 0.05 * v - friction) / 0.02]
        };
        let angles = moved(&inputs, 20, rate).map(|[x, _]| x + from);
        let read = noise.with(&inputs, angles, noise_rad);
        read.into_iter().map(|[u, x]| [u, seen(x)]).collect()
    };
    from.map(&mut recording).to_vec()
}

#[test]
fn an_angle_that_begins_anew_after_every_turn_is_put_together() {
    let seen = |x: f64| x.to_degrees().rem_euclid(360.0);
    let rig = Rig::declared(
        [TORQUE, "Displacement", "Degree"],
        driven(&mut Noise(41), [0.0, 1.7, -2.5], 5e-4, seen),
    );
    lacks_dry_friction(&rig.told(&Verb::Improve));
}

/// Nothing brings it back: where its encoder reads nothing is no matter of the drive, nor is that it misreads now and then.
#[test]
fn a_drive_that_begins_elsewhere_and_is_misread_lacks_what_it_lacks_from_0() {
    let mut recordings = driven(&mut Noise(42), [12.0, -7.0, 31.0], 5e-4, |x| x);
    for rows in &mut recordings {
        rows.iter_mut()
            .skip(300)
            .step_by(700)
            .for_each(|[_, x]| *x += 0.5);
    }
    let rig = Rig::that_turns(recordings);
    let diagnosis = rig.told(&Verb::Improve);
    lacks_dry_friction(&diagnosis);
    assert!(
        says(&diagnosis, "where their sensor does not read 0"),
        "{:?}",
        diagnosis.reasons
    );
}

/// A counter of pulses sees how fast a drive on an elastic belt turns, and not which way: no effect is to stand for that.
#[test]
fn a_counter_that_sees_no_direction_is_told_before_a_search() {
    let mut noise = Noise(47);
    let mut recording = || {
        let inputs = noise.levels([-3.0, 3.0], 300, 4000);
        let rate = |[x, v]: [f64; 2], u: f64| [v, (u - 0.08 * v - 12.0 * x) / 0.01];
        let speeds = moved(&inputs, 6, rate).map(|[_, v]| v.abs());
        noise.with(&inputs, speeds, 0.005)
    };
    let rig = Rig::that_turns_at_speeds((0..3).map(|_| recording()).collect());
    let diagnosis = rig.told(&Verb::Improve);
    assert_eq!(diagnosis.verdict, Verdict::NotFitted);
    assert!(says(&diagnosis, "has its sign"), "{:?}", diagnosis.reasons);
    assert!(diagnosis.added.is_empty() && diagnosis.ranking.is_empty());
}
