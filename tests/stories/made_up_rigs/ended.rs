//! Searches that are ended on the way, by a time or by Ctrl-C: what was found by then is told as that.

use super::held::pendulum;
use super::rig::Rig;
use super::says;
use super::unheld::joint;
use snug_campaign::{Diagnosis, Verdict};
use snug_study::{ProgressEvent, Verb};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// What is told where a search is ended when it begins from the base model for the so manieth time.
fn ended_at_beginning(number: usize, rig: &Rig) -> Diagnosis {
    let (ended, beginnings) = (AtomicBool::new(false), AtomicUsize::new(0));
    let progress = |event: ProgressEvent<'_>| {
        if let ProgressEvent::Stage { what } = event
            && what.ends_with("beside the base model")
        {
            let is_it = beginnings.fetch_add(1, Ordering::Relaxed) + 1 == number;
            ended.fetch_or(is_it, Ordering::Relaxed);
        }
    };
    let diagnosis = rig.told_until("", &Verb::Improve, &progress, &ended);
    assert!(ended.load(Ordering::Relaxed), "{}", diagnosis.headline);
    diagnosis
}

/// What restarts found is not passed off as all. The second time restarts are to find all, as a free run from what they found first leaves more
/// than noise; the third time it is the held torque that is tried, the fourth time the free run.
#[test]
fn a_free_run_after_restarts_says_that_it_was_ended() {
    let diagnosis = ended_at_beginning(4, &joint());
    assert!(diagnosis.interrupted, "{}", diagnosis.headline);
    assert_eq!(diagnosis.verdict, Verdict::Undecided);
}

/// What a straight torque told, a delay or what bends for half an interval, is not passed off as the rig's.
#[test]
fn a_search_with_a_held_torque_says_that_it_was_ended() {
    let diagnosis = ended_at_beginning(3, &pendulum());
    let headline = diagnosis.headline.to_string();
    assert!(diagnosis.interrupted, "{headline}");
    assert!(headline.starts_with("Stopped"), "{headline}");
    assert_eq!(diagnosis.verdict, Verdict::Undecided);
    assert!(
        says(&diagnosis, "half a sampling interval"),
        "{:?}",
        diagnosis.reasons
    );
}
