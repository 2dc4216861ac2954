//! Whatever stands in a task, the answer is an error that says why or an estimate of finite numbers: never a panic, never nonsense.
#![allow(clippy::unwrap_used)]

use snug_campaign::{FitStatus, Intersample, NoiseFloor, Quantity, Rig};
use snug_identify::{FitTask, IdentifyError, identify_all};
use snug_model::{Effect, Input, Model};
use std::borrow::Cow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Duration;

const RIG: Rig = Rig {
    lever_arm_m: 0.33,
    known_inertia_kg_m2: 0.275,
};
const INTERVAL_S: f64 = 5e-4;

/// A pulse of so many samples, and what the hand makes of it.
fn pulse(samples: usize) -> (Vec<f64>, Vec<f64>) {
    let torque: Vec<f64> = (0..samples)
        .map(|i| {
            if i < samples / 3 {
                30.0 * (i + 1) as f64 / samples as f64
            } else {
                0.0
            }
        })
        .collect();
    let input = Input::new(&torque, INTERVAL_S, Intersample::Linear);
    let motion = Model::new(RIG, &[])
        .unwrap()
        .simulate(&[2.1, 104.0, 2450.0], &input);
    let motion = motion.unwrap().acceleration_rad_per_s2.unwrap();
    (torque, motion)
}

fn task(samples: usize) -> FitTask<'static> {
    let (torque, motion) = pulse(samples);
    FitTask::from_arrays(RIG, INTERVAL_S, torque, Quantity::Acceleration, motion).unwrap()
}

/// What is wrong with the answer to a task, if anything is; a task that takes longer than this has none.
fn wrong(
    made: impl FnOnce() -> Result<FitTask<'static>, IdentifyError> + Send + 'static,
) -> Option<String> {
    let (told, hears) = std::sync::mpsc::channel();
    std::thread::spawn(move || told.send(wrong_in_time(made)));
    let answer = hears.recv_timeout(Duration::from_secs(LONGEST_S));
    answer.unwrap_or_else(|_| Some("no answer".to_owned()))
}

/// Longest that a fit of some hundred samples may take \[s\]; it takes milliseconds.
const LONGEST_S: u64 = 20;

fn wrong_in_time(made: impl FnOnce() -> Result<FitTask<'static>, IdentifyError>) -> Option<String> {
    let answer = catch_unwind(AssertUnwindSafe(|| {
        let task = made()?;
        let outcome = identify_all(std::slice::from_ref(&task)).remove(0);
        let values: Vec<f64> = (task.model.parameters().iter()).map(|p| p.value).collect();
        let _ = task.model.simulate(&values, &task.input);
        outcome
    }));
    match answer {
        Err(_) => Some("a panic".to_owned()),
        Ok(Err(error)) => {
            let told = error.to_string();
            (told.len() < 20).then_some(told)
        }
        Ok(Ok(estimate)) => {
            let is_found = matches!(
                estimate.status,
                FitStatus::Converged | FitStatus::ConvergedAtConstraint
            );
            let all = estimate.parameters.iter();
            let is_finite = all.clone().all(|one| one.value.is_finite());
            let ends = all.filter_map(|one| one.interval);
            let is_nan = |end: f64| end.is_nan();
            let has_nan = ends
                .into_iter()
                .any(|one| is_nan(one.low) || is_nan(one.high));
            (is_found && (!is_finite || has_nan)).then(|| format!("{:?}", estimate.parameters))
        }
    }
}

fn assert_none(all: Vec<(String, Option<String>)>) {
    let wrong: Vec<String> = (all.into_iter())
        .filter_map(|(what, wrong)| Some(format!("{what}: {}", wrong?)))
        .collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn hardly_any_samples() {
    let lengths = (1..10).map(|samples| (format!("{samples}"), wrong(move || Ok(task(samples)))));
    assert_none(lengths.collect());
}

#[test]
fn samples_beyond_measure() {
    let sizes = [0.0, 1e-320, 1e-300, 1e-150, 1e150, 1e300, f64::MAX, -1e300];
    let made = |input: f64, output: f64| {
        wrong(move || {
            let (torque, motion) = pulse(400);
            let times = |all: Vec<f64>, by: f64| all.into_iter().map(|one| one * by).collect();
            let (torque, motion) = (times(torque, input), times(motion, output));
            FitTask::from_arrays(RIG, INTERVAL_S, torque, Quantity::Acceleration, motion)
        })
    };
    let pairs = sizes
        .into_iter()
        .flat_map(|size| [(size, 1.0), (1.0, size), (size, size)]);
    let all = pairs.map(|(input, output)| (format!("{input:e}, {output:e}"), made(input, output)));
    assert_none(all.collect());
}

#[test]
fn intervals_and_rigs_beyond_measure() {
    let sizes = [
        0.0,
        -1.0,
        1e-320,
        1e-300,
        1e-30,
        1e30,
        1e300,
        f64::INFINITY,
        f64::NAN,
    ];
    let made = |rig: Rig, interval_s: f64| {
        wrong(move || {
            let (torque, motion) = pulse(400);
            FitTask::from_arrays(rig, interval_s, torque, Quantity::Acceleration, motion)
        })
    };
    let mut all = Vec::new();
    for size in sizes {
        all.push((format!("interval {size:e}"), made(RIG, size)));
        let lever = Rig {
            lever_arm_m: size,
            ..RIG
        };
        all.push((format!("lever arm {size:e}"), made(lever, INTERVAL_S)));
        let inertia = Rig {
            known_inertia_kg_m2: size,
            ..RIG
        };
        all.push((format!("inertia {size:e}"), made(inertia, INTERVAL_S)));
    }
    assert_none(all);
}

/// A task that somebody has changed.
fn changed(change: impl FnOnce(&mut FitTask<'static>) + Send + 'static) -> Option<String> {
    wrong(move || {
        let mut task = task(400);
        change(&mut task);
        Ok(task)
    })
}

#[test]
fn settings_and_models_that_cannot_be() {
    let mut all = Vec::new();
    for unscored in [399, 400, 401, usize::MAX] {
        let told = changed(move |task| task.settings.to_mut().unscored_samples = unscored);
        all.push((format!("{unscored} unscored"), told));
    }
    for value in [f64::NAN, f64::INFINITY, 1e300, -1e300, 0.0] {
        for fixed in [true, false] {
            let told = changed(move |task| {
                let parameter = &mut task.model.to_mut().parameters_mut()[2];
                (parameter.value, parameter.fixed) = (value, fixed);
            });
            all.push((format!("stiffness {value:e}, fixed {fixed}"), told));
        }
        let told = changed(move |task| task.model.to_mut().parameters_mut()[0].minimum = value);
        all.push((format!("least mass {value:e}"), told));
        let told = changed(move |task| task.model.to_mut().parameters_mut()[0].maximum = value);
        all.push((format!("largest mass {value:e}"), told));
        let told = changed(move |task| {
            let damping = &mut task.model.to_mut().parameters_mut()[1];
            (damping.fixed, damping.standard_error) = (true, Some(value));
        });
        all.push((format!("damping known to {value:e}"), told));
    }
    let told = changed(move |task| {
        let parameters = task.model.to_mut().parameters_mut();
        parameters
            .iter_mut()
            .for_each(|parameter| parameter.fixed = true);
    });
    all.push(("nothing free".to_owned(), told));
    for &effect in Effect::ALL {
        let told =
            changed(move |task| task.model = Cow::Owned(Model::new(RIG, &[effect]).unwrap()));
        all.push((effect.name().to_owned(), told));
    }
    assert_none(all);
}

#[test]
fn noise_and_inputs_that_cannot_be() {
    let mut all = Vec::new();
    for deviation in [1e-320, 1e-300, 1e300] {
        let noise = NoiseFloor::white(Quantity::Acceleration, deviation);
        let told = wrong(move || Ok(task(400).with_noise(noise)));
        all.push((format!("noise of {deviation:e}"), told));
    }
    for autoregression in [vec![0.1; 600], vec![5.0], vec![1e300], vec![1.0]] {
        let told = format!("{} × {}", autoregression.len(), autoregression[0]);
        let noise = NoiseFloor {
            autoregression,
            ..NoiseFloor::white(Quantity::Acceleration, 0.5)
        };
        all.push((told, wrong(move || Ok(task(400).with_noise(noise)))));
    }
    for at in [f64::NAN, f64::INFINITY, -1e300, 1e300] {
        let told = changed(move |task| {
            task.input = Cow::Owned(task.input.clone().into_owned().with_onset(at))
        });
        all.push((format!("onset {at:e}"), told));
        let told = changed(move |task| {
            task.input = Cow::Owned(task.input.clone().into_owned().with_rest_before(at));
        });
        all.push((format!("rest before {at:e}"), told));
    }
    for (apart, motions) in [(0, 0), (0, 3), (1, 0), (10, 2), (10, 1000), (usize::MAX, 1)] {
        for value in [0.0, f64::NAN, 1e300] {
            let told = changed(move |task| {
                let input = task.input.clone().into_owned();
                task.input = Cow::Owned(input.with_restarts(apart, vec![[value; 2]; motions]));
            });
            all.push((
                format!("{motions} restarts of {value:e} every {apart}"),
                told,
            ));
        }
    }
    for intersample in [
        Intersample::ZeroOrder,
        Intersample::Linear,
        Intersample::BandLimited,
    ] {
        for samples in [1, 2, 3, 400] {
            let told = wrong(move || {
                let mut task = task(samples);
                let torque = task.tightening.torque_nm.clone();
                task.input = Cow::Owned(Input::new(&torque, INTERVAL_S, intersample));
                Ok(task)
            });
            all.push((format!("{samples} samples {intersample:?}"), told));
        }
    }
    assert_none(all);
}
