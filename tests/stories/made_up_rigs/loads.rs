//! Hoists that lift a load, in some another in each recording.

use super::names;
use super::rig::{Noise, Rig, moved};
use snug_campaign::{Diagnosis, Verdict};
use snug_study::Verb;

/// What a hoist lacks that lifts so much \[kg\] against such a force \[N\] in each recording, pulled as hard either way beside it.
fn hoist(loads: &[[f64; 2]]) -> Diagnosis {
    hoist_pulled(|load| [load - 15.0, load + 15.0], loads)
}

/// The same, pulled with forces between these two \[N\] for a load; dry friction of 1.5 N holds, too.
fn hoist_pulled(between: fn(f64) -> [f64; 2], loads: &[[f64; 2]]) -> Diagnosis {
    let mut noise = Noise(73);
    let recording = |&[mass, load]: &[f64; 2]| {
        let forces = noise.levels(between(load), 300, 3000);
        let rate = |[_, v]: [f64; 2], u: f64| {
            let friction = 1.5 * (v / 5e-4).tanh();
            [v, (u - 12.0 * v - friction - load) / mass]
        };
        let speeds = moved(&forces, 12, rate).map(|[_, v]| v);
        noise.with(&forces, speeds, 2e-3)
    };
    let rig = Rig::that_slides_at_speeds(loads.iter().map(recording).collect());
    rig.told(&Verb::Improve)
}

/// Nothing is missing but a force of this size on average and the friction, and noise is left.
#[track_caller]
fn lacks_friction_and(diagnosis: &Diagnosis, effect: &str, mean: f64) {
    let headline = &diagnosis.headline;
    let mut added: Vec<(&str, f64)> = (diagnosis.added.iter())
        .map(|one| (one.effect.as_str(), one.parameters[0].value))
        .collect();
    added.sort_by_key(|(name, _)| *name != effect);
    let [(first, force), ("coulomb_friction", friction)] = added[..] else {
        panic!("{:?}: {headline}", names(diagnosis))
    };
    assert_eq!(first, effect, "{headline}");
    assert!((force - mean).abs() < 0.05, "{force}: {headline}");
    assert!((friction - 1.5).abs() < 0.03, "{friction}: {headline}");
    assert_eq!(diagnosis.verdict, Verdict::Adequate, "{headline}");
    let left = diagnosis.ladder.last().unwrap().rms_fitted_output;
    assert!(left < 1.15 * 2e-3, "{left}: {headline}");
}

/// Its mass and its weight are each recording's own: it was a start 28 m off a spring that is none, with a cubic one.
#[test]
fn another_load_in_each_recording_is_one() {
    let diagnosis = hoist(&[[1.8, -4.0], [2.0, -2.0], [2.3, 1.0], [2.7, 6.0]]);
    lacks_friction_and(&diagnosis, "constant_load", 0.25);
}

#[test]
fn the_same_force_in_each_recording_is_an_offset() {
    let diagnosis = hoist(&[[2.0, -3.0]; 3]);
    lacks_friction_and(&diagnosis, "torque_offset", -3.0);
}

/// It hardly ever goes down: while it goes up, friction holds as the load does, and was told of the size of both. A fit from there does not see
/// the other, a regression of the equation of motion does.
#[test]
fn a_hoist_that_hardly_goes_down_has_friction_and_a_load() {
    let diagnosis = hoist_pulled(|load| [load - 3.0, load + 12.0], &[[2.0, 6.0]; 3]);
    lacks_friction_and(&diagnosis, "torque_offset", 6.0);
}
