//! A hidden spring that stiffens, found by hand: the error falls to the noise, step by step.

use super::cases::LiveCases;
use crate::data::follower::FitStep;
use crate::error::DiagnoseError;
use crate::question::{Goal, Question};
use crate::settings::DiagnoseSettings;
use crate::tests::made_up::{close, hand, noisy};
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
