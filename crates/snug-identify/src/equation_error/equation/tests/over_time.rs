//! What changes along recordings whose equation is known.

use super::*;
use crate::equation_error::equation::over_time::Change;

/// Mass, damping, stiffness or friction that grows by half of its mean from beginning to end, each found for what it is; friction turns over
/// within few samples, and is told less well.
#[test]
fn what_changes_along_the_recordings_is_found() {
    let [i, c, k] = BASE;
    for (index, size, tolerance) in [(0, i, 0.03), (1, c, 0.03), (2, k, 0.03), (3, 3.0, 0.08)] {
        let mut changes = [0.0; 4];
        changes[index] = 0.25;
        let made = Made {
            friction_nm: 3.0,
            change: changes,
            ..Made::default()
        };
        let found = change(&made.tasks());
        assert_eq!(found.index, index);
        near(
            &[found.from, found.to],
            &[0.75 * size, 1.25 * size],
            tolerance,
        );
        assert!(found.taken > 0.85, "{found:?}");
        assert_eq!((found.at, found.recordings), (None, vec![0, 1]));
    }
}

/// Three recordings, the second of `other`.
fn with_one_other(same: &Made, other: &Made) -> [FitTask<'static>; 3] {
    [(same, 1.0), (other, 2.0), (same, 3.0)].map(|(made, seed)| made.task(seed, [1.0; 2], 1.0))
}

/// What the equation with friction and an offset says that changes along these recordings.
fn change(tasks: &[FitTask<'_>]) -> Change {
    let equation = MotionEquation::of(tasks, Effect::PLAIN).unwrap();
    let terms = Effect::PLAIN.iter();
    let terms: Option<Vec<Term>> = terms.map(|&one| equation.term(one, &[1.0])).collect();
    equation.change(&terms.unwrap(), f64::INFINITY).unwrap()
}

/// A spring gives way in the second of three recordings only; as much of a change in all is no story then.
#[test]
fn the_recordings_that_change_are_told_from_those_that_do_not() {
    let [same, changes] = [0.0, -0.25].map(|change| Made {
        friction_nm: 3.0,
        change: [0.0, 0.0, change, 0.0],
        ..Made::default()
    });
    let found = change(&with_one_other(&same, &changes));
    assert_eq!(
        (found.index, found.at, &found.recordings[..]),
        (2, None, &[1][..])
    );
    near(
        &[found.from, found.to],
        &[1.25 * BASE[2], 0.75 * BASE[2]],
        0.03,
    );
}

/// A softer spring in one of three recordings, from its beginning to its end, is no change along it.
#[test]
fn recordings_that_only_differ_change_nothing() {
    let (same, other) = (
        Made::default(),
        Made {
            base: [BASE[0], BASE[1], 0.6 * BASE[2]],
            ..Made::default()
        },
    );
    let found = change(&with_one_other(&same, &other));
    assert!(found.taken < 0.5, "{found:?}");
}

/// A mass is put on after five eighths of each recording.
#[test]
fn what_changes_at_once_is_told_from_what_does_so_evenly() {
    let made = Made {
        friction_nm: 3.0,
        change: [0.2, 0.0, 0.0, 0.0],
        at: Some(0.25),
        ..Made::default()
    };
    let found = change(&made.tasks());
    assert_eq!((found.index, &found.recordings[..]), (0, &[0, 1][..]));
    let at = found.at.expect("it does so at once");
    assert!((at - 0.25).abs() < 0.05, "{at}");
    near(
        &[found.from, found.to],
        &[0.8 * BASE[0], 1.2 * BASE[0]],
        0.05,
    );
}

/// Of 0.01 Nm/rad with 1.9 Nms/rad: what it pulls back takes 190 s, of which 8 were recorded, and is as well a load.
#[test]
fn a_spring_that_brings_nothing_back_does_not_change() {
    let made = |stiffness| Made {
        base: [BASE[0], BASE[1], stiffness],
        change: [0.0, 0.0, 0.25, 0.0],
        quantity: Quantity::Displacement,
        ..Made::default()
    };
    assert_eq!(change(&made(1.0).tasks()).index, 2);
    assert_ne!(change(&made(0.01).tasks()).index, 2);
}

/// A velocity that reads 0.01 rad/s too much: its sum runs on against the spring as if a load grew. On a rig without one a load that grows is
/// one.
#[test]
fn what_is_read_too_much_is_no_load_that_grows() {
    const LOAD: usize = 4;
    let mut tasks = Made::default().tasks();
    for task in &mut tasks {
        let motion = &mut task.tightening.to_mut().motion;
        let speed = motion.velocity_rad_per_s.as_mut().unwrap();
        speed.iter_mut().for_each(|speed| *speed += 0.01);
    }
    assert_ne!(change(&tasks).index, LOAD);
    let free = Made {
        base: [BASE[0], BASE[1], 0.0],
        ..Made::default()
    };
    let mut tasks = free.tasks();
    for task in &mut tasks {
        let torque_nm = &mut task.tightening.to_mut().torque_nm;
        let grown = |sample: usize| 0.5 * sample as f64 / SAMPLES as f64;
        let samples = torque_nm.iter_mut().enumerate();
        samples.for_each(|(sample, torque_nm)| *torque_nm -= grown(sample));
    }
    assert_eq!(change(&tasks).index, LOAD);
}

/// Torque and motion that have nothing to do with each other: what instruments make of it may leave more than there is, and a change takes
/// little of what there is.
#[test]
fn a_torque_that_moves_nothing_has_no_change() {
    let smooth = |seed: f64| -> Vec<f64> {
        let noise: Vec<f64> = (0..SAMPLES + 20)
            .map(|sample| noise(sample, seed))
            .collect();
        noise
            .windows(20)
            .take(SAMPLES)
            .map(|some| some.iter().sum())
            .collect()
    };
    let mut tasks = Made::default().tasks();
    for (task, seed) in tasks.iter_mut().zip([7.0, 8.0]) {
        let task = task.tightening.to_mut();
        task.torque_nm = smooth(seed);
        task.motion.set(Quantity::Velocity, smooth(seed + 50.0));
    }
    for half_width in [16, 32, 64, 128] {
        let equation = MotionEquation::averaged(&tasks, half_width).unwrap();
        let terms = Effect::PLAIN.iter();
        let terms: Option<Vec<Term>> = terms.map(|&one| equation.term(one, &[1.0])).collect();
        let found = equation.change(&terms.unwrap(), f64::INFINITY);
        assert!(found.is_none_or(|found| found.taken < 0.02), "{half_width}");
    }
}

/// One that broke off says nothing itself, and keeps the others from nothing.
#[test]
fn a_recording_that_broke_off_takes_nothing_from_the_others() {
    let changes = Made {
        change: [0.0, 0.0, -0.2, 0.0],
        ..Made::default()
    };
    let short = Made {
        samples: 40,
        ..Made::default()
    };
    let tasks = [(&changes, 1.0), (&short, 3.0), (&changes, 2.0)];
    let tasks = tasks.map(|(made, seed)| made.task(seed, [1.0; 2], 1.0));
    let found = change(&tasks);
    assert_eq!(
        (found.index, found.at, found.recordings.len()),
        (2, None, 3)
    );
    near(
        &[found.from, found.to],
        &[1.2 * BASE[2], 0.8 * BASE[2]],
        0.02,
    );
}

/// Under a torque that grows, friction is a smaller part of it at the end, and nothing is said.
#[test]
fn what_is_driven_harder_at_the_end_says_nothing() {
    let made = Made::default();
    let mut task = made.task(1.0, [1.0; 2], 1.0);
    let count = SAMPLES as f64;
    let torque_nm = &mut task.tightening.to_mut().torque_nm;
    for (sample, torque_nm) in torque_nm.iter_mut().enumerate() {
        *torque_nm *= 0.2 + sample as f64 / count;
    }
    let tasks = [task];
    let equation = MotionEquation::averaged(&tasks, 64).unwrap();
    assert_eq!(equation.change(&[], f64::INFINITY), None);
}

/// The numbers that a model was found to have leave what the regression leaves, on an arm of any length.
#[test]
fn a_fitted_model_is_asked_with_its_own_numbers() {
    let made = Made {
        friction_nm: 3.0,
        offset_nm: 40.0,
        ..Made::default()
    };
    let mut tasks = made.tasks();
    for task in &mut tasks {
        let rig = Rig {
            lever_arm_m: 0.5,
            known_inertia_kg_m2: 0.1,
        };
        task.model = Cow::Owned(Model::new(rig, &[]).unwrap());
    }
    let equation = MotionEquation::averaged(&tasks, 64).unwrap();
    let left = |friction: f64, offset: f64| {
        let sizes = vec![0.3 / 0.25, 1.9 / 0.25, 30.0 / 0.25, friction, offset];
        let squares = equation.squares_left(Effect::PLAIN, &[sizes.clone(), sizes]);
        squares.unwrap()
    };
    let all = left(0.0, 0.0);
    assert!(left(6.0, 40.0) < 1e-3 * all, "{} {all}", left(6.0, 40.0));
}
