//! A hidden spring that stiffens, found by hand: the error falls to the noise, step by step.

use super::cases::LiveCases;
use super::focus::{Counted, Focus};
use crate::data::follower::FitStep;
use crate::error::DiagnoseError;
use crate::question::{Goal, Question};
use crate::settings::DiagnoseSettings;
use crate::tests::made_up::{SAMPLES, close, custom_force, hand, noisy, silent};
use snug_identify::FitTask;
use snug_model::Effect::{self, CubicStiffness, TorqueOffset};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

/// Of the hidden spring \[N/m³\].
const SIZE: f64 = 2e6;

fn live() -> LiveCases {
    let cases: Vec<FitTask<'static>> = (0..10)
        .map(|number| noisy(number, &[CubicStiffness], &[SIZE]))
        .collect();
    let question = Question::new(&[], Goal::Compare);
    LiveCases::new(&question, cases, DiagnoseSettings::default()).expect("they can be compared")
}

fn never() -> AtomicBool {
    AtomicBool::new(false)
}

#[test]
fn the_error_falls_step_by_step_to_where_the_fit_ends() {
    let live = live();
    let base = live
        .fit(&[], None, &|_| (), &never())
        .expect("it can be fitted");
    assert!(
        base.is_over_noise() && base.error() > 1.1,
        "{}",
        base.error()
    );
    let steps: Mutex<Vec<FitStep>> = Mutex::default();
    let tell = |step| steps.lock().expect("nobody panics").push(step);
    let with = live
        .fit(&[CubicStiffness], Some(&base), &tell, &never())
        .expect("it can be fitted");
    assert!(with.is_at_noise() && with.has_converged());
    let steps = steps.into_inner().expect("nobody panics");
    assert!(steps.windows(2).all(|pair| pair[1].error <= pair[0].error));
    let last = steps.last().expect("there were steps");
    close(last.error, with.error(), 1e-12);
    let (effect, sizes) = &with.sizes()[0];
    assert_eq!(*effect, CubicStiffness);
    let (low, high) = (sizes[0].low, sizes[0].high);
    assert!(low < Some(SIZE) && high > Some(SIZE), "{low:?} {high:?}");
    // Taken out again, it is the model without it again.
    let without = live
        .fit(&[], Some(&with), &|_| (), &never())
        .expect("it can be fitted");
    close(without.error(), base.error(), 1e-6);
}

#[test]
fn a_fit_that_is_ended_says_so_after_the_step_at_hand() {
    let live = live();
    let base = live
        .fit(&[], None, &|_| (), &never())
        .expect("it can be fitted");
    let (end, heard) = (never(), Mutex::new(0));
    let tell = |_| {
        *heard.lock().expect("nobody panics") += 1;
        end.store(true, Ordering::Relaxed);
    };
    let ended = live.fit(&[CubicStiffness], Some(&base), &tell, &end);
    assert!(matches!(ended, Err(DiagnoseError::Interrupted)));
    assert_eq!(heard.into_inner().expect("nobody panics"), 1);
}

#[test]
fn what_is_missing_promises_most_and_others_lose_their_share_once_it_is_in() {
    let live = live();
    let base = live
        .fit(&[], None, &|_| (), &never())
        .expect("it can be fitted");
    let all = live.candidates(&base).expect("there are some");
    let others: Vec<Effect> = all
        .iter()
        .copied()
        .filter(|e| *e != CubicStiffness)
        .collect();
    let promises = |fit, of: &[Effect]| live.promises(fit, &base, of).expect("they can be scored");
    let of_it = promises(&base, &[CubicStiffness])[0];
    assert!(of_it > 0.9, "{of_it}");
    let before = promises(&base, &others);
    let with = live
        .fit(&[CubicStiffness], Some(&base), &|_| (), &never())
        .expect("it can be fitted");
    let after = promises(&with, &others);
    let sum = |shares: &[f64]| shares.iter().sum::<f64>();
    assert!(sum(&after) < 0.2 * sum(&before), "{after:?} {before:?}");
}

#[test]
fn one_tightening_has_its_own_numbers_and_curve() {
    let live = live();
    let fit = |effects: &[Effect]| {
        live.fit(effects, None, &|_| (), &never())
            .expect("it can be fitted")
    };
    let with = fit(&[CubicStiffness]);
    let seen = live.tightening(&with, 3).expect("it can be fitted");
    let names: Vec<&str> = seen.base.iter().map(|one| one.name.as_str()).collect();
    assert_eq!(names, ["mass_kg", "damping_kg_per_s", "stiffness_n_per_m"]);
    for (found, truth) in seen.base.iter().zip(hand(3)) {
        close(found.value, truth, 0.15);
        assert!(found.interval.is_some());
    }
    let case = &live.tasks()[3];
    let squares = |output: &[f64]| -> f64 {
        let pairs = output.iter().zip(case.measured());
        pairs.map(|(s, m)| (m - s).powi(2)).sum()
    };
    let other = live
        .tightening(&fit(&[TorqueOffset]), 3)
        .expect("it can be fitted");
    assert!(squares(&seen.output) < squares(&other.output));
}

fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), v| (sum + v * v, count + 1.0));
    (sum / count).sqrt()
}

#[test]
fn a_closer_look_leaves_what_the_fit_left_there() {
    let live = live();
    let base = live
        .fit(&[], None, &|_| (), &never())
        .expect("it can be fitted");
    let closer = |members: &[usize], counted| {
        let focus = Focus {
            members: members.to_vec(),
            counted,
        };
        live.closer(&focus, &base, &base)
    };
    let error = |members: &[usize], counted| {
        let look = closer(members, counted).expect("it can be looked at");
        look.errors()[0]
    };
    for member in [2, 7] {
        close(error(&[member], Counted::All), base.errors()[member], 1e-9);
    }
    // The spring is missed where the tool turns furthest, not as it begins to move.
    let stretch = |samples| error(&[2, 7], Counted::Stretch(samples));
    assert!(stretch(60..SAMPLES) > 1.05 * stretch(0..30));
    assert!(closer(&[], Counted::All).is_err());
    assert!(closer(&[0], Counted::Stretch(10..11)).is_err());
}

/// What is missing is promised to take most of what is left there, and a wrong effect less: in a tenth of the window, about where the
/// tool turns furthest, and where the grip is in the last fifth of its way. A spring that stiffens has no force near rest.
#[test]
fn a_part_of_the_samples_tells_what_is_missing_there() {
    let live = live();
    let base = live
        .fit(&[], None, &|_| (), &never())
        .expect("it can be fitted");
    let tasks = live.tasks();
    let way = |task: &FitTask<'_>| -> f64 {
        let angles = task.tightening.motion.displacement_rad.iter().flatten();
        angles.fold(0.0, |most, angle| angle.max(most)) * task.tightening.rig.lever_arm_m
    };
    let furthest = tasks.iter().map(way).fold(0.0, f64::max);
    let look = |counted| {
        let focus = Focus {
            members: (0..tasks.len()).collect(),
            counted,
        };
        live.closer(&focus, &base, &base)
            .expect("it can be looked at")
    };
    let at = |x_m| Counted::Cell {
        x_m,
        v_m_per_s: -10.0..=10.0,
    };
    let middle = SAMPLES / 2;
    let far = look(at(0.8 * furthest..=furthest));
    for look in [look(Counted::Stretch(middle..middle + SAMPLES / 10)), far] {
        let shares = look
            .promises(&[CubicStiffness, TorqueOffset])
            .expect("they can be scored");
        assert!(shares[0] > 0.8 && shares[0] > 1.5 * shares[1], "{shares:?}");
        assert!(look.samples() < tasks.len() * SAMPLES / 4);
    }
    let all = look(at(-1.0..=1.0));
    assert_eq!(all.samples(), tasks.len() * SAMPLES);
    close(all.errors()[0], look(Counted::All).errors()[0], 1e-9);
}

#[test]
fn numbers_set_by_hand_are_simulated_and_fitted_from() {
    let live = live();
    let with = live
        .fit(&[CubicStiffness], None, &|_| (), &never())
        .expect("it can be fitted");
    let seen = live.tightening(&with, 3).expect("it can be fitted");
    let mut values: Vec<f64> = seen.numbers.iter().map(|one| one.value).collect();
    assert_eq!(seen.numbers[3].effect, Some(CubicStiffness));
    assert!(
        seen.numbers
            .iter()
            .all(|one| one.range.contains(&one.value))
    );
    let as_fitted = live
        .by_hand(&with, 3, &values)
        .expect("it can be simulated");
    assert_eq!(as_fitted.output, seen.output);
    close(as_fitted.error, with.errors()[3], 1e-9);
    values[2] *= 1.5;
    values[3] *= 0.2;
    let off = live
        .by_hand(&with, 3, &values)
        .expect("it can be simulated");
    assert!(off.error > 2.0 * as_fitted.error, "{}", off.error);
    let again = live
        .fit_from(&with, 3, &values, &|_| (), &never())
        .expect("it can be fitted");
    close(again.error(), with.error(), 1e-6);
}

/// To first order: most of the residual goes, and what m, c, k can imitate is not counted twice.
#[test]
fn the_missing_effect_s_signature_looks_like_the_residual() {
    let live = live();
    let base = live
        .fit(&[], None, &|_| (), &never())
        .expect("it can be fitted");
    let worst = (0..10).max_by(|&a, &b| base.errors()[a].total_cmp(&base.errors()[b]));
    let member = worst.expect("there are some");
    let seen = live.tightening(&base, member).expect("it can be fitted");
    let measured = live.tasks()[member].measured();
    let residual = || measured.iter().zip(&seen.output).map(|(m, s)| m - s);
    let left = |effect| {
        let signature = live.signature(&base, member, effect);
        let signature = signature.expect("it can be scored").expect("it has a size");
        assert_eq!(signature.len(), measured.len());
        rms(residual().zip(signature).map(|(r, s)| r - s))
    };
    let before = rms(residual());
    let (right, wrong) = (left(CubicStiffness), left(TorqueOffset));
    assert!(right < wrong && right < before, "{right} {wrong} {before}");
}

/// The same spring under another name: once it is in the model, the other would leave nothing.
#[test]
fn what_the_model_s_effects_can_imitate_leaves_no_signature() {
    let live = live();
    let with = live
        .fit(&[CubicStiffness], None, &|_| (), &never())
        .expect("it can be fitted");
    let again = custom_force("cubic_again", "2*p*x^3", 0.0);
    let rms_of = |effect| {
        let signature = live.signature(&with, 3, effect).expect("it can be scored");
        signature.map_or(0.0, |signature| rms(signature.into_iter()))
    };
    let measured = rms(live.tasks()[3].measured().iter().copied());
    assert!(rms_of(again) < 1e-3 * measured, "{}", rms_of(again));
}

#[test]
fn the_hidden_effect_is_real_and_another_beside_it_is_not() {
    let live = live();
    let fit = |effects: &[Effect]| {
        live.fit(effects, None, &|_| (), &never())
            .expect("it can be fitted")
    };
    let watch = silent();
    let test = |without: &[Effect], effect| {
        let tested = live.held_out(&fit(without), effect, &watch);
        tested.expect("it can be tested").expect("it can be run")
    };
    let real = test(&[], CubicStiffness);
    assert!(real.is_supported && real.better.is_none(), "{real:?}");
    assert!(real.share > 0.8 && real.p_family < 0.05 && real.family > 10);
    let idle = test(&[CubicStiffness], TorqueOffset);
    assert!(!idle.is_supported, "{idle:?}");
}

#[test]
fn a_missing_spring_is_a_force_that_fades_once_it_is_in() {
    let live = live();
    let largest = |effects: &[Effect]| {
        let fit = live
            .fit(effects, None, &|_| (), &never())
            .expect("it can be fitted");
        let left = live.what_is_left(&fit).expect("each can be fitted");
        let curve = left.force_over_time;
        assert!(!curve.at.is_empty());
        curve.force_n.iter().fold(0.0_f64, |a, f| a.max(f.abs()))
    };
    assert!(largest(&[CubicStiffness]) < 0.6 * largest(&[]));
}
