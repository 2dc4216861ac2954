//! Regressions of recordings whose equation is known: the motion is written down, the torque follows from it.
#![allow(clippy::unwrap_used)]

use super::*;
use crate::settings::IdentifySettings;
use snug_campaign::{Intersample, Quantity, Rig, Tightening};
use snug_model::{Input, Model};
use std::borrow::Cow;

const RIG: Rig = Rig {
    lever_arm_m: 1.0,
    known_inertia_kg_m2: 0.0,
};
const INTERVAL_S: f64 = 1e-3;
const SAMPLES: usize = 8000;
/// I, C, K.
const BASE: [f64; 3] = [0.4, 1.9, 30.0];
/// Over which the catalogue's dry friction of a hand turns \[m/s\].
const TURN: f64 = 0.01;

/// Between −½ and ½, without any pattern.
fn noise(sample: usize, seed: f64) -> f64 {
    let v = (sample as f64 * 12.9898 + seed).sin() * 43_758.545;
    v - v.floor() - 0.5
}

/// What was made, and what was measured with noise so many times as large as the signal.
struct Made {
    friction_nm: f64,
    offset_nm: f64,
    noise: f64,
    quantity: Quantity,
    base: [f64; 3],
    /// What is added to I, C, K and the friction at the end of a recording and taken off at its beginning, over what they are.
    change: [f64; 4],
    /// Where it does so at once, from −1 at the beginning to 1 at the end; evenly where nowhere.
    at: Option<f64>,
    /// After which it broke off.
    samples: usize,
}

impl Default for Made {
    fn default() -> Self {
        Self {
            friction_nm: 0.0,
            offset_nm: 0.0,
            noise: 0.0,
            quantity: Quantity::Velocity,
            base: BASE,
            change: [0.0; 4],
            at: None,
            samples: SAMPLES,
        }
    }
}

impl Made {
    /// A sum of two sines, from 0, torque and motion in units of `units`, time in those of `time`.
    fn task(&self, seed: f64, units: [f64; 2], time: f64) -> FitTask<'static> {
        let [torque_unit, motion_unit] = units;
        let (mut torque_nm, mut measured) = (Vec::new(), Vec::new());
        for sample in 0..self.samples {
            let t = sample as f64 * INTERVAL_S;
            let (a, b) = (5.0 + 0.3 * seed, 11.0 - 0.2 * seed);
            let along = 2.0 * sample as f64 / SAMPLES as f64 - 1.0;
            let course = self.at.map_or(along, |at| (along - at).signum());
            let now = self.change.map(|change| 1.0 + change * course);
            let [i, c, k] = [0, 1, 2].map(|index| self.base[index] * now[index]);
            let (x, y) = (a * t + seed, b * t);
            let start = (seed.sin(), a * seed.cos(), 0.5);
            let angle = x.sin() + 0.5 * y.sin() - start.0;
            let velocity = a * x.cos() + 0.5 * b * y.cos();
            let acceleration = -a * a * x.sin() - 0.5 * b * b * y.sin();
            let friction = now[3] * self.friction_nm * (velocity / TURN).tanh();
            let torque = i * acceleration + c * velocity + k * angle + friction + self.offset_nm;
            let (value, size) = match self.quantity {
                Quantity::Displacement => (angle, 0.8),
                Quantity::Velocity => (velocity, 5.2),
                Quantity::Acceleration => (acceleration, 46.0),
            };
            torque_nm.push(torque_unit * torque);
            let wrong = self.noise * size * 12.0_f64.sqrt() * noise(sample, seed);
            measured.push(motion_unit * (value + wrong));
        }
        let input = Input::new(&torque_nm, time * INTERVAL_S, Intersample::Linear);
        let tightening = Tightening::from_torque(RIG, time * INTERVAL_S, torque_nm);
        FitTask {
            tightening: Cow::Owned(tightening.with(self.quantity, measured)),
            input: Cow::Owned(input),
            model: Cow::Owned(Model::new(RIG, &[]).unwrap()),
            settings: Cow::Owned(IdentifySettings {
                fitted_output: self.quantity,
                constraints: vec![ConstraintKind::Positive],
                ..IdentifySettings::default()
            }),
        }
    }

    fn tasks(&self) -> Vec<FitTask<'static>> {
        [1.0, 2.0].map(|seed| self.task(seed, [1.0; 2], 1.0)).into()
    }
}

/// The regression with these effects of size 1.
fn fit(tasks: &[FitTask<'_>], effects: &[Effect]) -> EquationFit {
    let equation = MotionEquation::of(tasks, effects).unwrap();
    let terms = effects
        .iter()
        .map(|&one| equation.term(one, &[1.0]).unwrap());
    equation.fit(&terms.collect::<Vec<_>>()).unwrap()
}

#[track_caller]
fn near(found: &[f64], expected: &[f64], tolerance: f64) {
    for (found_one, expected_one) in found.iter().zip(expected) {
        let off = (found_one - expected_one).abs();
        assert!(
            off <= tolerance * expected_one.abs(),
            "{found:?} for {expected:?}"
        );
    }
}

/// A velocity integrated begins at 0 and angles that are measured do too, so that nothing but averages is approximate.
#[test]
fn sizes_are_found_whatever_is_measured() {
    for quantity in Quantity::ALL {
        let made = Made {
            quantity,
            ..Made::default()
        };
        let found = fit(&made.tasks(), &[]);
        near(&found.base, &BASE, 5e-3);
        assert!(found.explained > 0.9999 && found.is_driven(), "{found:?}");
    }
}

#[test]
fn friction_and_an_offset_are_terms_like_any_other() {
    let made = Made {
        friction_nm: 3.0,
        offset_nm: 2.0,
        ..Made::default()
    };
    let found = fit(&made.tasks(), Effect::PLAIN);
    near(&found.base, &BASE, 0.01);
    near(&found.times[..1], &[3.0], 0.02);
    near(&found.times[1..], &[2.0], 0.02);
    let without = fit(&made.tasks(), &[]);
    assert!(
        1.0 - without.explained > 20.0 * (1.0 - found.explained),
        "{without:?}"
    );
}

/// Noise a fifth of the acceleration, a hundredth of the angle: the same sizes within what so much noise leaves open.
#[test]
fn noise_in_the_regressors_does_not_bias() {
    for (quantity, noise, tolerance) in [
        (Quantity::Acceleration, 0.2, 0.03),
        (Quantity::Velocity, 0.05, 0.03),
        (Quantity::Displacement, 0.01, 0.03),
    ] {
        let made = Made {
            quantity,
            noise,
            ..Made::default()
        };
        near(&fit(&made.tasks(), &[]).base, &BASE, tolerance);
    }
}

/// I of torque over motion times time², C times time, K: in any units the same regression.
#[test]
fn units_are_only_units() {
    let made = Made {
        friction_nm: 0.0,
        offset_nm: 2.0,
        noise: 0.01,
        ..Made::default()
    };
    let usual = fit(&[made.task(1.0, [1.0; 2], 1.0)], &[Effect::TorqueOffset]);
    for [torque, motion, time] in [
        [1e6, 1.0, 1.0],
        [1.0, 1e-6, 1.0],
        [1.0, 1.0, 1e6],
        [1e-6, 1e6, 1e-6],
    ] {
        let found = fit(
            &[made.task(1.0, [torque, motion], time)],
            &[Effect::TorqueOffset],
        );
        let [m, c, k] = usual.base;
        // A velocity in other units of time: its integral is that much larger.
        let unit = torque / motion;
        near(
            &found.base,
            &[m * unit * time, c * unit, k * unit / time],
            1e-6,
        );
        near(&found.times, &[usual.times[0] * torque], 1e-5);
        assert!((found.explained - usual.explained).abs() < 1e-9);
    }
}

/// What the study knows is taken as known.
#[test]
fn fixed_parameters_stay() {
    for fixed in [vec![2], vec![0], vec![1], vec![0, 2]] {
        let mut tasks = Made::default().tasks();
        for task in &mut tasks {
            for &index in &fixed {
                let parameter = &mut task.model.to_mut().parameters_mut()[index];
                (parameter.value, parameter.fixed) = (BASE[index], true);
            }
        }
        near(&fit(&tasks, &[]).base, &BASE, 5e-3);
    }
}

/// A damping below 0 is none, and what the data do not show begins small.
#[test]
fn sizes_that_physics_forbids_are_not_told() {
    let made = Made {
        base: [0.4, -0.5, 30.0],
        ..Made::default()
    };
    let found = fit(&made.tasks(), &[]);
    assert!(found.base.iter().all(|value| *value > 0.0), "{found:?}");
    assert!(found.base[1] < 0.1, "{found:?}");
}

/// The numbers of a fit explain as much as the regression with them; others less.
#[test]
fn a_fit_is_asked_with_its_own_numbers() {
    let made = Made {
        friction_nm: 3.0,
        ..Made::default()
    };
    let tasks = made.tasks();
    let equation = MotionEquation::of(&tasks, &[]).unwrap();
    let effects = [Effect::CoulombFriction];
    let right = [BASE.as_slice(), &[3.0]].concat();
    let kept =
        |values: &[f64]| equation.explained_by(&effects, &[values.to_vec(), values.to_vec()]);
    assert!(kept(&right).unwrap() > 0.999);
    assert!(kept(&[4.0, 19.0, 300.0, 3.0]).unwrap() < 0.5);
    let sensed = [Effect::AccelerationLag];
    assert!(
        equation
            .explained_by(&sensed, &[right.clone(), right])
            .is_none()
    );
}

/// A drive that has gone a long way: what is large and does not change has no part in what is averaged.
#[test]
fn a_long_way_is_no_acceleration() {
    let mut tasks = Made {
        quantity: Quantity::Displacement,
        base: [0.4, 1.9, 0.0],
        ..Made::default()
    }
    .tasks();
    for task in &mut tasks {
        let angles = task
            .tightening
            .to_mut()
            .motion
            .displacement_rad
            .as_mut()
            .unwrap();
        angles.iter_mut().for_each(|angle| *angle += 1e4);
        let stiffness = &mut task.model.to_mut().parameters_mut()[2];
        (stiffness.value, stiffness.fixed) = (0.0, true);
    }
    near(&fit(&tasks, &[]).base[..2], &[0.4, 1.9], 0.01);
}

/// Dry friction holds a rig that rests against any smaller torque; what no motion shows takes no part.
#[test]
fn what_rests_takes_no_part() {
    let mut tasks = Made {
        friction_nm: 3.0,
        noise: 1e-3,
        ..Made::default()
    }
    .tasks();
    for task in &mut tasks {
        // It stands still for as long again, under a torque that is not enough.
        let tightening = task.tightening.to_mut();
        let held = (0..SAMPLES).map(|sample| 2.5 * (sample as f64 / SAMPLES as f64).sin());
        tightening.torque_nm = held.chain(tightening.torque_nm.iter().copied()).collect();
        let velocity = tightening.motion.velocity_rad_per_s.take().unwrap();
        let still = (0..SAMPLES).map(|sample| 5e-3 * noise(sample, 9.0));
        tightening.motion.velocity_rad_per_s = Some(still.chain(velocity).collect());
        task.input = Cow::Owned(Input::new(
            &tightening.torque_nm,
            INTERVAL_S,
            Intersample::Linear,
        ));
    }
    let found = fit(&tasks, &[Effect::CoulombFriction]);
    // The averages across the jump into the motion hold an equation that nothing obeys.
    near(&found.base, &BASE, 0.02);
    near(&found.times, &[3.0], 0.05);
}

/// Two signals that know nothing of each other: an equation without torque may hold, and says nothing.
#[test]
fn what_no_torque_moves_says_nothing() {
    let mut tasks = Made::default().tasks();
    for (seed, task) in tasks.iter_mut().enumerate() {
        let torques = &mut task.tightening.to_mut().torque_nm;
        for (sample, torque) in torques.iter_mut().enumerate() {
            *torque = noise(sample, 40.0 + seed as f64);
        }
    }
    assert!(MotionEquation::of(&tasks, &[]).is_none());
}

/// A bound that even a busy machine keeps: two recordings of 8000 samples take some 10 ms.
#[test]
fn a_regression_takes_milliseconds() {
    let tasks = Made {
        friction_nm: 3.0,
        ..Made::default()
    }
    .tasks();
    let begun = std::time::Instant::now();
    fit(&tasks, Effect::PLAIN);
    assert!(begun.elapsed().as_secs_f64() < 1.0);
}

mod over_time;
