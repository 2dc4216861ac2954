//! Searches that are ended on the way, by a time or by Ctrl-C: what was found by then is told as that.

use super::held::{pendulum, slide};
use super::rig::Rig;
use super::unheld::joint;
use super::{names, says};
use snug_campaign::{Diagnosis, Verdict};
use snug_study::{ProgressEvent, Verb};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// What is told where a search is ended when it begins to rank beside `model` for the so manieth time.
fn ended_at_ranking(number: usize, model: &str, rig: &Rig) -> Diagnosis {
    let (ended, rankings) = (AtomicBool::new(false), AtomicUsize::new(0));
    let (beside, stages) = (format!("beside {model}"), Mutex::new(Vec::new()));
    let progress = |event: ProgressEvent<'_>| {
        if let ProgressEvent::Stage { what } = event {
            stages.lock().unwrap().push(what.to_string());
            if what.ends_with(&beside) {
                let is_it = rankings.fetch_add(1, Ordering::Relaxed) + 1 == number;
                ended.fetch_or(is_it, Ordering::Relaxed);
            }
        }
    };
    let diagnosis = rig.told_until("", &Verb::Improve, &progress, &ended);
    assert!(ended.load(Ordering::Relaxed), "{:?}", stages.lock());
    assert!(diagnosis.interrupted, "{}", diagnosis.headline);
    assert_eq!(diagnosis.verdict, Verdict::Undecided);
    let headline = diagnosis.headline.to_string();
    assert!(headline.starts_with("Stopped"), "{headline}");
    diagnosis
}

/// What restarts found is not passed off as all where the free run that goes on from there, the second to rank beside it, is ended.
#[test]
fn a_free_run_after_restarts_says_that_it_was_ended() {
    let found = "cubic_stiffness + torque_offset + stribeck_friction";
    ended_at_ranking(2, found, &joint());
}

/// What a straight force told, a delay or what bends for half an interval, is not passed off as the rig's.
#[test]
fn a_search_with_a_held_force_says_that_it_was_ended() {
    let diagnosis = ended_at_ranking(3, "the base model", &slide());
    let reasons = &diagnosis.reasons;
    assert!(says(&diagnosis, "half a sampling interval"), "{reasons:?}");
}

/// Beside the weight, the first thing found, half an interval is known to be a hold before anything more is looked for.
#[test]
fn a_search_that_is_ended_after_a_hold_was_found_tells_no_delay() {
    let diagnosis = ended_at_ranking(2, "gravity_torque", &pendulum());
    assert_eq!(names(&diagnosis), ["gravity_torque"]);
    assert!(says(&diagnosis, "held from sample to sample"));
}
