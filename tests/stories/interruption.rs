//! Who stops a long run gets the results of what was evaluated until then.

use crate::campaign::{embedded, run_study, study_on};
use snug_study::{Preset, ProgressEvent, RunSettings, run};
use std::sync::atomic::{AtomicBool, Ordering};

#[test]
fn a_run_stopped_after_its_first_file_leaves_whole_results() {
    let study = study_on(&embedded(), Preset::Snug);
    let out = tempfile::tempdir().unwrap();
    let settings = RunSettings {
        out: out.path().to_path_buf(),
        threads: Some(1),
    };
    let stop = AtomicBool::new(false);
    let stop_after_a_file = |event: ProgressEvent<'_>| {
        if matches!(event, ProgressEvent::FileDone { .. }) {
            stop.store(true, Ordering::Relaxed);
        }
    };
    let outcome = run(&study, &settings, &stop_after_a_file, &stop).unwrap();
    assert!(outcome.interrupted);
    assert_eq!(outcome.result.tightenings.len(), 4);

    let table = std::fs::read_to_string(out.path().join("tightenings.csv")).unwrap();
    assert_eq!(table.lines().count(), 1 + 4);
    let recording = out.path().join("recording.mcap");
    let (again, _out) = run_study(&study_on(&recording, Preset::Snug)).unwrap();
    assert_eq!(again.result.tightenings, outcome.result.tightenings);
}
