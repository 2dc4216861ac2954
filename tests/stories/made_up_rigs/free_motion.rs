//! Rigs that are let go and that no torque moves, and such of which hardly anything was recorded.

use super::rig::{Noise, Rig, moved};
use super::{names, says};
use snug_campaign::Verdict;
use snug_study::Verb;

/// Three recordings in which no torque acts: a state that begins elsewhere each time.
fn let_go<const N: usize>(
    noise: &mut Noise,
    from: [[f64; N]; 3],
    rate: impl Fn([f64; N]) -> [f64; N],
    measured: impl Fn([f64; N]) -> f64,
    size: f64,
) -> Vec<Vec<[f64; 2]>> {
    let recording = |begin: [f64; N]| {
        // What moves from rest is the way from where it began.
        let from_there = |way: [f64; N], _: f64| rate(std::array::from_fn(|i| begin[i] + way[i]));
        let states = moved(&[0.0; 4000], 4, from_there);
        let outputs = states.map(|way| measured(std::array::from_fn(|i| begin[i] + way[i])));
        noise.with(&[0.0; 4000], outputs, size)
    };
    from.map(recording).to_vec()
}

/// A hull in calm water, pulled over and let go: how it rolls shows what water does to it, as soon as its inertia is told; before, only ratios.
#[test]
fn a_hull_that_rolls_freely_lacks_what_water_does_once_its_inertia_is_told() {
    if !snug_tests::long("a hull that rolls") {
        return;
    }
    let rate = |[x, v]: [f64; 2]| [v, (-3e4 * v - 4e4 * v * v.abs() - 4e7 * x) / 4e5];
    let mut noise = Noise(31);
    let recordings = let_go(
        &mut noise,
        [[0.3, 0.0], [-0.25, 0.0], [0.2, 0.0]],
        rate,
        |[x, _]| x,
        5e-4,
    );
    let rig = Rig::that_turns(recordings);
    let unknown = rig.told(&Verb::Improve);
    assert_eq!(unknown.verdict, Verdict::NotFitted, "{}", unknown.headline);
    assert!(says(&unknown, "ratios only"), "{:?}", unknown.reasons);
    let known = rig.told_with(
        r#"parameters: {"mass_kg": (value: 4e5, fixed: true)}"#,
        &Verb::Improve,
    );
    let headline = known.headline.to_string();
    assert_eq!(known.verdict, Verdict::Adequate, "{headline}");
    assert_eq!(
        names(&known),
        ["initial_motion", "quadratic_damping"],
        "{headline}"
    );
    let water = &known.added[1].parameters[0];
    assert!((water.value / 4e4 - 1.0).abs() < 0.03, "{water:?}");
}

/// A wheel that coasts to a stop: bearing and air together.
#[test]
fn a_wheel_that_coasts_lacks_what_bearing_and_air_do() {
    let rate =
        |[v]: [f64; 1]| [(-0.3 * (v / 0.02).tanh() - 0.0016 * v * v.abs() - 0.004 * v) / 0.05];
    let mut noise = Noise(32);
    let recordings = let_go(&mut noise, [[40.0], [60.0], [25.0]], rate, |[v]| v, 0.02);
    let rig = Rig::that_turns_at_speeds(recordings);
    let diagnosis = rig.told_with(
        r#"parameters: {"mass_kg": (value: 0.05, fixed: true)}"#,
        &Verb::Improve,
    );
    let headline = diagnosis.headline.to_string();
    assert_eq!(diagnosis.verdict, Verdict::Adequate, "{headline}");
    let size = |name: &str| {
        let one = diagnosis.added.iter().find(|one| one.effect == name);
        one.unwrap_or_else(|| panic!("{name}: {headline}"))
            .parameters[0]
            .value
    };
    assert!(
        (size("coulomb_friction") / 0.3 - 1.0).abs() < 0.03,
        "{headline}"
    );
    assert!(
        (size("quadratic_damping") / 0.0016 - 1.0).abs() < 0.03,
        "{headline}"
    );
}

/// A drive under a constant torque whose sensor hums: nothing moved, and that is said in place of an effect.
#[test]
fn where_nothing_moves_that_is_said() {
    let mut noise = Noise(33);
    let mut recording = || noise.with(&[0.5; 2000], std::iter::repeat(10.0), 0.02);
    let rig = Rig::that_turns_at_speeds((0..3).map(|_| recording()).collect());
    let diagnosis = rig.told(&Verb::Improve);
    assert_eq!(
        diagnosis.verdict,
        Verdict::NotFitted,
        "{}",
        diagnosis.headline
    );
    assert!(says(&diagnosis, "Nothing moves"), "{:?}", diagnosis.reasons);
}

/// Strokes of sixty samples are compared as longer ones are; one of twenty is not, and is counted.
#[test]
fn short_recordings_are_compared_and_those_that_are_too_short_counted() {
    let mut noise = Noise(34);
    let inputs: Vec<f64> = (0..60)
        .map(|k| if (5..20).contains(&k) { 1.0 } else { 0.0 })
        .collect();
    let rate = |[x, v]: [f64; 2], u: f64| [v, (u - 0.3 * v - 40.0 * x - 8e4 * x * x * x) / 0.005];
    let mut recording = |samples: usize| {
        let places = moved(&inputs[..samples], 20, rate).map(|[x, _]| x);
        noise.with(&inputs[..samples], places, 2e-5)
    };
    let mut recordings: Vec<Vec<[f64; 2]>> = (0..8).map(|_| recording(60)).collect();
    recordings.push(recording(20));
    let diagnosis = Rig::that_turns(recordings).told(&Verb::Improve);
    assert_eq!(
        names(&diagnosis),
        ["cubic_stiffness"],
        "{}",
        diagnosis.headline
    );
    assert!(
        says(&diagnosis, "1 tightening took no part"),
        "{:?}",
        diagnosis.reasons
    );
}
