//! Rigs of which an engineer would name the drive, or that a controller holds them where they would not stay.

use super::rig::{Noise, Rig, moved, moved_from};
use super::{names, says};
use snug_campaign::{Diagnosis, Verdict};
use snug_study::Verb;
use std::f64::consts::TAU;

/// The noise of the encoder [rad].
const NOISE: f64 = 2e-4;

/// An axis on a spring, of whose commanded torque only what is `given` at its angle acts.
fn commanded(tone_nm: f64, given: fn(f64, f64) -> f64) -> Diagnosis {
    let mut noise = Noise(27);
    let mut recording = || {
        let inputs = noise.tones([0.5, 40.0], tone_nm, 2500);
        let rate = |[x, v]: [f64; 2], u: f64| [v, (given(u, x) - 0.15 * v - 30.0 * x) / 0.02];
        let angles = moved(&inputs, 10, rate).map(|[x, _]| x);
        noise.with(&inputs, angles, NOISE)
    };
    Rig::that_turns((0..2).map(|_| recording()).collect()).told(&Verb::Improve)
}

/// Nothing but this effect, of this size within a hundredth, and only noise left.
#[track_caller]
fn lacks(diagnosis: &Diagnosis, effect: &str, size: f64) {
    let headline = &diagnosis.headline;
    assert_eq!(names(diagnosis), [effect], "{headline}");
    let found = diagnosis.added[0].parameters[0].value;
    assert!((found / size - 1.0).abs() < 0.01, "{found}");
    let left = diagnosis.ladder.last().unwrap().rms_fitted_output;
    assert!(left < 1.1 * NOISE, "{left}: {headline}");
}

#[test]
fn an_amplifier_at_its_limit_is_no_spring_and_no_unknown_law() {
    let diagnosis = commanded(0.9, |u, _| u.clamp(-3.0, 3.0));
    lacks(&diagnosis, "torque_limit", 3.0);
}

#[test]
fn a_drive_that_does_not_answer_to_little_has_a_dead_zone() {
    let diagnosis = commanded(0.5, |u, _| u - u.clamp(-0.4, 0.4));
    lacks(&diagnosis, "torque_dead_zone", 0.4);
}

/// A drive that rests half of the time and is sampled so seldom that friction stops it within a sample: simulated in steps as long as
/// that, it never rests, and no fit of its lag settles.
#[test]
fn a_slowly_sampled_drive_rests_where_friction_holds_it() {
    const SPEED_NOISE: f64 = 1e-3;
    let mut noise = Noise(31);
    let mut recording = || {
        let inputs = noise.levels([-10.0, 10.0], 60, 900);
        let rate = |[v, torque]: [f64; 2], u: f64| {
            let friction = 4.0 * (v / 2e-4).tanh();
            [(torque - 30.0 * v - friction) / 0.24, (u - torque) / 0.012]
        };
        let speeds = moved(&inputs, 120, rate).map(|[v, _]| v);
        noise.with(&inputs, speeds, SPEED_NOISE)
    };
    let rig = Rig::that_turns_at_speeds((0..2).map(|_| recording()).collect());
    let said = r#"effects: ["coulomb_friction", "actuator_lag"], intersample: ZeroOrder"#;
    let diagnosis = rig.told_with(said, &Verb::Compare);
    let left = diagnosis.ladder[0].rms_fitted_output;
    assert!(left < 1.1 * SPEED_NOISE, "{left}: {}", diagnosis.headline);
}

/// A motor whose current takes 20 ms to rise, with dry friction: the lag comes before the friction, as no sensor's does.
#[test]
fn a_motor_whose_current_rises_slowly_lacks_that_and_dry_friction() {
    let mut noise = Noise(29);
    let mut recording = || {
        let inputs = noise.levels([-2.0, 2.0], 100, 4000);
        let rate = |[v, torque]: [f64; 2], u: f64| {
            let friction = 0.3 * (v / 0.01).tanh();
            [(torque - 0.1 * v - friction) / 0.05, (u - torque) / 0.02]
        };
        let speeds = moved(&inputs, 20, rate).map(|[v, _]| v);
        noise.with(&inputs, speeds, 0.01)
    };
    let rig = Rig::that_turns_at_speeds((0..2).map(|_| recording()).collect());
    let diagnosis = rig.told(&Verb::Improve);
    let mut names = names(&diagnosis);
    names.sort_unstable();
    let headline = &diagnosis.headline;
    assert_eq!(names, ["actuator_lag", "coulomb_friction"], "{headline}");
    for one in &diagnosis.added {
        let (found, size) = match one.effect.as_str() {
            "actuator_lag" => (one.parameters[0].value, 0.02),
            _ => (one.parameters[0].value, 0.3),
        };
        assert!((found / size - 1.0).abs() < 0.05, "{found} {headline}");
    }
}

/// A motor with dry friction that turns a load by a shaft, its own speed measured: what hangs on it is found with its size, and friction acts
/// on the motor alone. A second mode beside it left twenty times the noise, and a delay that was none.
#[test]
fn a_motor_with_a_load_on_a_shaft_lacks_the_load_and_dry_friction() {
    const SPEED_NOISE: f64 = 0.02;
    let mut noise = Noise(37);
    let mut recording = || {
        let inputs = noise.levels([-4.0, 4.0], 300, 4000);
        let rate = |[x, v, y, w]: [f64; 4], u: f64| {
            let shaft = 8.0 * (x - y) + 0.02 * (v - w);
            let friction = 0.6 * (v / 0.01).tanh();
            [v, (u - 0.02 * v - friction - shaft) / 0.01, w, shaft / 0.02]
        };
        let speeds = moved(&inputs, 20, rate).map(|[_, v, _, _]| v);
        noise.with(&inputs, speeds, SPEED_NOISE)
    };
    let rig = Rig::that_turns_at_speeds((0..2).map(|_| recording()).collect());
    let diagnosis = rig.told(&Verb::Improve);
    let mut names = names(&diagnosis);
    names.sort_unstable();
    let headline = &diagnosis.headline;
    assert_eq!(names, ["attached_mass", "coulomb_friction"], "{headline}");
    // √(8/0.02) rad/s, and 0.02/(2 · 0.02 · 20).
    let sizes = [
        ("attached_kg", 0.02),
        ("attached_hz", 20.0 / TAU),
        ("attached_zeta", 0.025),
        ("fc_n", 0.6),
    ];
    for one in diagnosis.added.iter().flat_map(|one| &one.parameters) {
        let (_, size) = sizes.iter().find(|(name, _)| *name == one.name).unwrap();
        let found = one.value;
        assert!((found / size - 1.0).abs() < 0.03, "{found} {headline}");
    }
    let left = diagnosis.ladder.last().unwrap().rms_fitted_output;
    assert!(left < 1.1 * SPEED_NOISE, "{left}: {headline}");
}

/// A motor that is held to a place by its controller: what pushes it there looks like what moves a speed, and dry friction explains all of
/// it as a place.
#[test]
fn a_servo_in_its_loop_lacks_dry_friction_and_is_no_speed() {
    let mut noise = Noise(31);
    let mut recording = || -> Vec<[f64; 2]> {
        let wanted = noise.levels([-1.0, 1.0], 500, 4000);
        let (mut state, mut sum) = ([0.0, 0.0], 0.0);
        let mut rows = Vec::new();
        for place in wanted {
            let seen = state[0] + 2e-3 * noise.draw();
            sum += 1e-3 * (place - seen);
            let input = (30.0 * (place - seen) + 20.0 * sum - 1.2 * state[1]).clamp(-10.0, 10.0);
            rows.push([input, seen]);
            let rate =
                |[_, v]: [f64; 2], u: f64| [v, (u - 0.3 * v - 1.5 * (v / 2e-3).tanh()) / 0.05];
            state = moved_from(state, input, 80, rate);
        }
        rows
    };
    let rig = Rig::that_turns((0..2).map(|_| recording()).collect());
    let diagnosis = rig.told(&Verb::Improve);
    let headline = &diagnosis.headline;
    assert_eq!(names(&diagnosis), ["coulomb_friction"], "{headline}");
    // Restarted from noise again and again, it is known to a twelfth.
    let friction = diagnosis.added[0].parameters[0].value;
    assert!((friction / 1.5 - 1.0).abs() < 0.1, "{friction} {headline}");
}

/// The force factor of a magnet falls by the square of how far its coil leaves it, by a quarter at 0.1 rad here.
#[test]
fn an_input_that_acts_less_off_rest_is_no_spring() {
    let diagnosis = commanded(0.9, |u, x| u * (1.0 - 25.0 * x * x));
    lacks(&diagnosis, "torque_x2_law", 25.0);
}

/// Samples every millisecond of what pushes itself away by `away` \[1/s²\] and is led along `goals` by a controller with these gains, with
/// what that exerts.
fn held(
    goals: Vec<f64>,
    mass: f64,
    gains: [f64; 2],
    away: impl Fn(f64, f64) -> f64,
) -> Vec<[f64; 2]> {
    const STEPS: u32 = 20;
    let (mut x, mut v) = (0.0, 0.0);
    let h = 1e-3 / f64::from(STEPS);
    let sample = |goal: f64| {
        let seen = [-gains[0] * (x - goal) - gains[1] * v, x];
        for _ in 0..STEPS {
            let rate = |x: f64, v: f64| seen[0] / mass + away(x, v);
            let (half_x, half_v) = (x + 0.5 * h * v, v + 0.5 * h * rate(x, v));
            v += h * rate(half_x, half_v);
            x += h * half_v;
        }
        seen
    };
    goals.into_iter().map(sample).collect()
}

fn with_noise(noise: &mut Noise, recording: Vec<[f64; 2]>, size: f64) -> Vec<[f64; 2]> {
    let noisy = recording.into_iter();
    noisy.map(|[u, x]| [u, x + size * noise.draw()]).collect()
}

/// An armature near a magnet: input and output go against each other, as with a wrong sign, and it is none.
#[test]
fn what_pushes_itself_away_has_no_wrong_sign() {
    let mut noise = Noise(28);
    let mut recording = || {
        let goals = noise.levels([-1e-4, 1e-4], 60, 2500);
        let clean = held(goals, 2.0, [3.2e5, 800.0], |x, v| 7.5e4 * x - 2.5 * v);
        with_noise(&mut noise, clean, 1e-7)
    };
    let rig = Rig::that_slides((0..2).map(|_| recording()).collect());
    let diagnosis = rig.told(&Verb::Diagnose);
    let headline = diagnosis.headline.to_string();
    assert_eq!(diagnosis.verdict, Verdict::NotFitted, "{headline}");
    assert!(headline.contains("pushes itself away"), "{headline}");
    assert!(
        says(&diagnosis, "constraints: []"),
        "{:?}",
        diagnosis.reasons
    );
}

/// An armature near a magnet that is led by a controller with these gains, a goal for so many samples: its study lets it push itself away, and
/// restarts the model before it falls, as Snug advises. Dry friction may rub on it.
fn near_a_magnet(samples: usize, gains: [f64; 2], noise_m: f64, rubs_n: f64) -> Rig {
    let mut noise = Noise(2611);
    let mut recording = || {
        let goals = noise.levels([-1e-3, 1e-3], samples, 6000);
        let clean = held(goals, 0.4, gains, |x, v| {
            300.0 * x - 0.75 * v - rubs_n / 0.4 * (v / 2e-4).tanh()
        });
        with_noise(&mut noise, clean, noise_m)
    };
    Rig {
        identified: "constraints: [], simulation: Restarted(every_s: 5.8e-2)",
        ..Rig::that_slides((0..3).map(|_| recording()).collect())
    }
}

/// Where a plain regression of it ends.
const STARTS: &str = r#"parameters: {
    "mass_kg": (value: 0.4), "damping_kg_per_s": (value: 0.3), "stiffness_n_per_m": (value: -120.0),
}"#;

/// Who goes on as Snug says is not told that it failed: averaged as long as a regression asks for, force and spring all but cancel, and a share of the
/// acceleration that is left says next to nothing.
#[test]
fn what_pushes_itself_away_is_followed_as_advised() {
    let rig = near_a_magnet(100, [400.0, 12.0], 2e-6, 0.0);
    let diagnosis = rig.told_with(STARTS, &Verb::Diagnose);
    let headline = &diagnosis.headline;
    assert_ne!(diagnosis.verdict, Verdict::NotFitted, "{headline}");
    assert!(!says(&diagnosis, "the fit failed"), "{headline}");
}

/// Dry friction would stop what is taken up with a velocity that it does not have: it rests at every goal, and nothing rubs.
#[test]
fn what_rests_at_its_goals_has_no_dry_friction() {
    let rig = near_a_magnet(300, [1600.0, 30.0], 1e-5, 0.0);
    let diagnosis = rig.told_with(
        &format!("intersample: ZeroOrder, {STARTS}"),
        &Verb::Diagnose,
    );
    let headline = &diagnosis.headline;
    assert_eq!(diagnosis.verdict, Verdict::Adequate, "{headline}");
    let left = diagnosis.ladder.last().unwrap().rms_fitted_output;
    assert!((left / 1e-5 - 1.0).abs() < 0.03, "{left}");
}

/// Errors of the motion taken up grow as it falls: a model that is restarted after three e-foldings of that is not asked what is missing, and told.
#[test]
fn what_is_restarted_after_it_has_fallen_away_is_to_be_restarted_sooner() {
    let rig = Rig {
        identified: "constraints: [], simulation: Restarted(every_s: 0.2)",
        ..near_a_magnet(100, [400.0, 12.0], 2e-6, 0.0)
    };
    let diagnosis = rig.told_with(STARTS, &Verb::Improve);
    let headline = diagnosis.headline.to_string();
    assert_eq!(diagnosis.verdict, Verdict::NotFitted, "{headline}");
    assert!(headline.contains("restarted too seldom"), "{headline}");
    assert!(diagnosis.added.is_empty() && diagnosis.ranking.is_empty());
    // 0.4 kg and -120 N/m.
    let reasons = &diagnosis.reasons;
    assert!(says(&diagnosis, "every_s: 5.8e-2"), "{reasons:?}");
}

/// Forty samples tell no mass, damping and stiffness: a recording that broke off beside two that did not makes three machines of none.
#[test]
fn a_recording_that_broke_off_is_of_the_same_machine() {
    let mut rig = near_a_magnet(300, [1600.0, 30.0], 1e-5, 0.15);
    rig.recordings[1].truncate(4000);
    rig.recordings[2].truncate(40);
    let diagnosis = rig.told_with(
        &format!("intersample: ZeroOrder, {STARTS}"),
        &Verb::Diagnose,
    );
    let headline = &diagnosis.headline;
    assert_eq!(diagnosis.verdict, Verdict::MissingEffect, "{headline}");
    let first = &diagnosis.ranking[0];
    assert_eq!(first.effect, "coulomb_friction", "{headline}");
    let friction_n = first.parameters[0].value;
    assert!((friction_n / 0.15 - 1.0).abs() < 0.05, "{friction_n}");
}

/// One that is restarted again and again is predicted well enough by anything: no friction, mode or law is to stand for a stiffness below 0.
#[test]
fn what_is_held_near_a_magnet_is_not_pieced_together() {
    let mut noise = Noise(35);
    let mut recording = || {
        let goals = noise.levels([-1e-3, 1e-3], 300, 5000);
        let clean = held(goals, 0.1, [1800.0, 12.0], |x, v| {
            4500.0 * x + 1e8 * x.powi(3) - 4.0 * v
        });
        with_noise(&mut noise, clean, 1e-6)
    };
    let rig = Rig::that_slides((0..3).map(|_| recording()).collect());
    let diagnosis = rig.told(&Verb::Improve);
    let headline = diagnosis.headline.to_string();
    assert_eq!(diagnosis.verdict, Verdict::NotFitted, "{headline}");
    assert!(headline.contains("pushes itself away"), "{headline}");
    assert!(diagnosis.added.is_empty() && diagnosis.ranking.is_empty());
}

/// A pendulum that stands upright: its weight may be anything by its interval beside a stiffness that may not be below 0, and is needed.
#[test]
fn a_pendulum_that_is_held_upright_lacks_its_weight_and_dry_friction() {
    if !snug_tests::long("a pendulum that is held upright") {
        return;
    }
    let mut noise = Noise(31);
    let mut recording = || {
        let away = |x: f64, v: f64| (9.0 * x.sin() - 0.02 * v - 0.3 * (v / 0.05).tanh()) / 0.005;
        let goals = noise.levels([-0.4, 0.4], 150, 2500);
        let clean = held(goals, 0.005, [30.0, 0.6], away);
        with_noise(&mut noise, clean, 1e-4)
    };
    let rig = Rig::that_turns((0..2).map(|_| recording()).collect());
    let diagnosis = rig.told_with("intersample: ZeroOrder", &Verb::Improve);
    let headline = &diagnosis.headline;
    let mut first = names(&diagnosis);
    first.truncate(2);
    first.sort_unstable();
    assert_eq!(first, ["coulomb_friction", "gravity_torque"], "{headline}");
    assert_ne!(diagnosis.verdict, Verdict::UnlistedEffect, "{headline}");
    for (effect, made) in [("coulomb_friction", 0.3), ("gravity_torque", 9.0)] {
        let mut added = diagnosis.added.iter();
        let size = &added.find(|one| one.effect == effect).unwrap().parameters[0];
        assert!((size.value / made - 1.0).abs() < 0.1, "{size:?}");
    }
}

/// Oil acts on less area beside a cylinder's rod. Alone, the law leaves no less than a damper that is stronger one way, which is known and comes
/// in first; an offset came in beside it, and the verdict was open.
#[test]
fn a_cylinder_that_pulls_with_less_than_it_pushes_is_told_so_beside_its_friction() {
    const SPEED_NOISE: f64 = 5e-3;
    let mut noise = Noise(58);
    let mut recording = || {
        let inputs = noise.levels([-200.0, 200.0], 80, 1600);
        let rate = |[v]: [f64; 1], u: f64| {
            let acts = if u > 0.0 { u } else { 0.65 * u };
            [(acts - 40.0 * v - 30.0 * (v / 2e-3).tanh()) / 2.4]
        };
        let speeds = moved(&inputs, 80, rate).map(|[v]| v);
        noise.with(&inputs, speeds, SPEED_NOISE)
    };
    let rig = Rig::that_slides_at_speeds((0..3).map(|_| recording()).collect());
    let diagnosis = rig.told_with("intersample: ZeroOrder", &Verb::Improve);
    let headline = &diagnosis.headline;
    assert_eq!(
        names(&diagnosis),
        ["abs_torque_law", "coulomb_friction"],
        "{headline}"
    );
    // Of the mean of both gains, 0.825.
    for (one, size) in diagnosis.added.iter().zip([-0.175 / 0.825, 30.0 / 0.825]) {
        let found = one.parameters[0].value;
        assert!((found / size - 1.0).abs() < 0.01, "{found}: {headline}");
    }
    let left = diagnosis.ladder.last().unwrap().rms_fitted_output;
    assert!(left < 1.1 * SPEED_NOISE, "{left}: {headline}");
}
