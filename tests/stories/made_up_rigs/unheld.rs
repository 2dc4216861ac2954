//! Rigs that nothing brings back, on which a load pulls that nobody recorded.

use super::rig::{Noise, Rig, moved};
use super::{names, says};
use snug_campaign::Verdict;
use snug_study::Verb;

/// An axis on which a load pulls that nobody recorded, its angle measured: once astray, a free run stays so, and laws come closest to that
/// which bend the whole way a little. What air does is told by itself, and where nothing is hidden nothing is named.
#[test]
fn an_axis_with_an_unrecorded_load_lacks_what_air_does_or_nothing() {
    for (air, expected) in [(0.004, &["quadratic_damping"][..]), (0.0, &[])] {
        let mut noise = Noise(19);
        let mut recording = || {
            let inputs = noise.tones([0.1, 8.0], 0.16, 6000);
            let loads = noise.levels([-0.05, 0.05], 100, 6000);
            let acting: Vec<f64> = inputs.iter().zip(&loads).map(|(u, w)| u + w).collect();
            let rate = |[_, v]: [f64; 2], u: f64| [v, (u - 0.05 * v - air * v * v.abs()) / 0.01];
            let angles = moved(&acting, 4, rate).map(|[x, _]| x);
            noise.with(&inputs, angles, 5e-4)
        };
        let rig = Rig::that_turns((0..4).map(|_| recording()).collect());
        let diagnosis = rig.told(&Verb::Improve);
        assert_eq!(names(&diagnosis), expected, "{}", diagnosis.headline);
        assert!(
            says(&diagnosis, "Nothing brings"),
            "{:?}",
            diagnosis.reasons
        );
        for one in &diagnosis.added {
            let size = one.parameters[0].value;
            assert!((size / air - 1.0).abs() < 0.15, "{size}");
        }
    }
}

/// A rotor with a brake of eddy currents, and one in a fluid that gives way: as a damper while they are slow, dry friction came closest to
/// what is weaker beyond a speed.
#[test]
fn a_rotor_lacks_a_brake_that_is_weaker_beyond_a_speed() {
    type Brake = fn(f64) -> f64;
    let brakes: [(&str, Brake); 2] = [
        ("peak_v_law", |v| 0.9 * v / (1.0 + (v / 25.0).powi(2))),
        ("level_v_law", |v| {
            0.9 * v / (1.0 + (v / 25.0).powi(2)).sqrt()
        }),
    ];
    for (law, brake) in brakes {
        let mut noise = Noise(67);
        let mut recording = || {
            let inputs = noise.levels([-30.0, 30.0], 150, 4000);
            let rate = |[v]: [f64; 1], u: f64| [(u - 0.04 * v - brake(v)) / 0.04];
            let speeds = moved(&inputs, 4, rate).map(|[v]| v);
            noise.with(&inputs, speeds, 0.05)
        };
        let rig = Rig::that_turns_at_speeds((0..2).map(|_| recording()).collect());
        let diagnosis = rig.told_with("intersample: ZeroOrder", &Verb::Improve);
        let headline = &diagnosis.headline;
        assert_eq!(names(&diagnosis), [law], "{headline}");
        for (one, size) in diagnosis.added[0].parameters.iter().zip([0.9, 25.0]) {
            let found = one.value;
            assert!((found / size - 1.0).abs() < 0.02, "{found}: {headline}");
        }
        let left = diagnosis.ladder.last().unwrap().rms_fitted_output;
        assert!(left < 0.055, "{left}: {headline}");
    }
}

/// A drive with a fine encoder, its torque held from sample to sample: what a straight torque misses is more than the encoder's noise and no
/// reason to restart, and nothing is missing.
#[test]
fn a_drive_with_a_fine_encoder_and_a_held_torque_lacks_nothing() {
    let mut noise = Noise(21);
    let mut recording = || {
        let inputs = noise.tones([0.1, 8.0], 0.16, 2000);
        let rate = |[_, v]: [f64; 2], u: f64| [v, (u - 0.05 * v) / 0.01];
        let angles = moved(&inputs, 50, rate).map(|[x, _]| x);
        noise.with(&inputs, angles, 1e-6)
    };
    let rig = Rig::that_turns((0..2).map(|_| recording()).collect());
    let diagnosis = rig.told(&Verb::Improve);
    assert_eq!(names(&diagnosis), [""; 0], "{}", diagnosis.headline);
    let left = diagnosis.ladder.last().unwrap().rms_fitted_output;
    assert!(left < 1.1e-6, "{left}: {}", diagnosis.headline);
}

/// A table between two stops, on a guide that damps it all along. Half a sampling interval hides beside what the stops do, so that it is
/// looked at first: with a torque that runs straight a gap and a spring that relaxes come closest, and the mass comes out 7 % too large.
#[test]
fn a_table_with_play_has_a_spring_that_does_not_act_within_it() {
    let mut noise = Noise(29);
    let mut recording = || {
        let inputs = noise.tones([0.5, 8.0], 30.0, 6000);
        let rate = |[x, v]: [f64; 2], u: f64| {
            [
                v,
                (u - 30.0 * v - 9000.0 * (x - x.clamp(-1e-3, 1e-3))) / 3.0,
            ]
        };
        let places = moved(&inputs, 10, rate).map(|[x, _]| x);
        noise.with(&inputs, places, 1e-5)
    };
    let rig = Rig::that_slides((0..3).map(|_| recording()).collect());
    let diagnosis = rig.told(&Verb::Improve);
    let headline = diagnosis.headline.to_string();
    assert_eq!(names(&diagnosis), ["slack_spring_law"], "{headline}");
    assert!(headline.contains("softer within b of rest"), "{headline}");
    let sizes = diagnosis.added[0].parameters.iter();
    let expected = [-9000.0, 1e-3];
    for (found, expected) in sizes.zip(expected) {
        assert!((found.value / expected - 1.0).abs() < 0.01, "{found:?}");
    }
    let left = diagnosis.ladder.last().unwrap().rms_fitted_output;
    assert!(left < 1.1e-5, "{left}: {headline}");
    assert!(says(&diagnosis, "held from sample to sample"));
}

/// A slide between two springs that press on it where it rests: whichever way it is moved, one of them pushes back with all of its preload.
#[test]
fn a_slide_between_preloaded_springs_lacks_their_preload() {
    let mut noise = Noise(33);
    let mut recording = || {
        let inputs = noise.tones([0.5, 10.0], 20.0, 4000);
        let rate = |[x, v]: [f64; 2], u: f64| {
            let preload = 4.0 * (x / 1e-5).tanh();
            [v, (u - 15.0 * v - 3000.0 * x - preload) / 2.0]
        };
        let places = moved(&inputs, 50, rate).map(|[x, _]| x);
        noise.with(&inputs, places, 1e-5)
    };
    let rig = Rig::that_slides((0..2).map(|_| recording()).collect());
    let diagnosis = rig.told(&Verb::Improve);
    let headline = diagnosis.headline.to_string();
    assert_eq!(names(&diagnosis), ["preload_law"], "{headline}");
    assert!(headline.contains("a preloaded spring"), "{headline}");
    let preload = &diagnosis.added[0].parameters[0];
    assert!((preload.value / 4.0 - 1.0).abs() < 0.01, "{preload:?}");
}

/// One recording of a minute of such an axis with dry friction in it: a spring that shows nowhere is none, however long a recording lasts.
#[test]
fn a_long_recording_of_an_axis_with_an_unrecorded_load_lacks_dry_friction_alone() {
    if !snug_tests::long("a long recording of an axis") {
        return;
    }
    let mut noise = Noise(22);
    let inputs = noise.tones([0.1, 8.0], 0.16, 60_000);
    let loads = noise.levels([-0.05, 0.05], 100, 60_000);
    let acting: Vec<f64> = inputs.iter().zip(&loads).map(|(u, w)| u + w).collect();
    let rate = |[_, v]: [f64; 2], u: f64| [v, (u - 0.05 * v - 0.08 * (v / 0.05).tanh()) / 0.01];
    let angles = moved(&acting, 4, rate).map(|[x, _]| x);
    let rig = Rig::that_turns(vec![noise.with(&inputs, angles, 5e-4)]);
    let diagnosis = rig.told(&Verb::Improve);
    let headline = diagnosis.headline.to_string();
    assert_eq!(names(&diagnosis), ["coulomb_friction"], "{headline}");
    let friction = &diagnosis.added[0].parameters[0];
    assert!((friction.value / 0.08 - 1.0).abs() < 0.1, "{friction:?}");
}

/// A flywheel that hardly anything slows down, its speed measured, with dry friction in its bearing and without: what a load did to it once
/// it keeps, and the motion it began with is no more to blame than anything else.
#[test]
fn a_flywheel_with_an_unrecorded_load_lacks_dry_friction_or_nothing() {
    for (friction, expected) in [(0.05, &["coulomb_friction"][..]), (0.0, &[])] {
        let mut noise = Noise(23);
        let mut recording = || {
            let inputs = noise.tones([0.1, 8.0], 0.16, 6000);
            let loads = noise.levels([-0.06, 0.06], 100, 6000);
            let acting: Vec<f64> = inputs.iter().zip(&loads).map(|(u, w)| u + w).collect();
            let rate =
                |[v]: [f64; 1], u: f64| [(u - 0.002 * v - friction * (v / 0.02).tanh()) / 0.05];
            let speeds = moved(&acting, 4, rate).map(|[v]| v);
            noise.with(&inputs, speeds, 0.02)
        };
        let rig = Rig::that_turns_at_speeds((0..3).map(|_| recording()).collect());
        let diagnosis = rig.told(&Verb::Improve);
        assert_eq!(names(&diagnosis), expected, "{}", diagnosis.headline);
        assert!(
            says(&diagnosis, "Hardly anything brings") || says(&diagnosis, "Run freely"),
            "{:?}",
            diagnosis.reasons
        );
        assert_ne!(diagnosis.verdict, Verdict::UnlistedEffect);
        for one in &diagnosis.added {
            let size = one.parameters[0].value;
            assert!((size / friction - 1.0).abs() < 0.15, "{size}");
        }
    }
}

/// The noise of a joint's encoder [rad].
const OF_THE_JOINT: f64 = 2e-4;

/// A joint that lacks four things at once, its torque held by a controller and read 0.1 Nm too small.
pub fn joint() -> Rig {
    let mut noise = Noise(25);
    let mut recording = || {
        let inputs: Vec<f64> = noise.tones([0.8, 40.0], 0.24, 1500);
        let acting: Vec<f64> = inputs.iter().map(|u| u + 0.1).collect();
        let rate = |[x, v]: [f64; 2], u: f64| {
            let friction = 0.06 * (v / 0.01).tanh() + 0.003 * v * v.abs();
            [
                v,
                (u - 0.05 * v - 2.0 * x - 60.0 * x.powi(3) - friction) / 0.01,
            ]
        };
        let angles = moved(&acting, 10, rate).map(|[x, _]| x);
        noise.with(&inputs, angles, OF_THE_JOINT)
    };
    Rig::that_turns((0..4).map(|_| recording()).collect())
}

/// No single one lets a free run follow, and from restart to restart one stand-in leaves eight times the noise; a free run tells all four.
/// Half an interval's delay is none of them.
#[test]
fn a_joint_with_a_held_torque_lacks_four_things_and_no_delay() {
    if !snug_tests::long("four effects of a joint") {
        return;
    }
    let diagnosis = joint().told(&Verb::Improve);
    let headline = diagnosis.headline.to_string();
    let mut names = names(&diagnosis);
    names.sort_unstable();
    let all = [
        "coulomb_friction",
        "cubic_stiffness",
        "quadratic_damping",
        "torque_offset",
    ];
    assert_eq!(names, all, "{headline}");
    assert!(!headline.contains("small"), "{headline}");
    let left = diagnosis.ladder.last().unwrap().rms_fitted_output;
    assert!(left < 1.05 * OF_THE_JOINT, "{left}: {headline}");
}

/// An axis that was computed and not measured: what is left is rounding, which lacks nothing.
#[test]
fn of_computed_data_rounding_is_no_effect() {
    let mut noise = Noise(24);
    let mut recording = || {
        let inputs = noise.tones([0.1, 8.0], 0.16, 2000);
        // Exact for a torque that is held: v goes to u/c, and x with it.
        let (c, decay) = (0.05, f64::exp(-0.05 / 0.01 * 1e-3));
        let (mut x, mut v) = (0.0, 0.0);
        let angles: Vec<f64> = inputs
            .iter()
            .map(|u| {
                let at = x;
                x += u / c * 1e-3 + (v - u / c) * (1.0 - decay) * 0.01 / c;
                v = u / c + (v - u / c) * decay;
                at
            })
            .collect();
        noise.with(&inputs, angles.into_iter(), 0.0)
    };
    let rig = Rig::that_turns((0..3).map(|_| recording()).collect());
    let diagnosis = rig.told(&Verb::Improve);
    assert_eq!(names(&diagnosis), [""; 0], "{}", diagnosis.headline);
    assert_eq!(
        diagnosis.verdict,
        Verdict::Adequate,
        "{}",
        diagnosis.headline
    );
    assert!(
        diagnosis.headline.to_string().contains("rounding"),
        "{}",
        diagnosis.headline
    );
}
