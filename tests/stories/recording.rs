//! A recording can be evaluated again, and gives what the measurement files gave.

use crate::campaign::{embedded, run_study, study_on};
use snug_study::{Preset, Study};

#[test]
fn the_recording_of_a_run_is_as_good_as_its_data() {
    let (first, out) = run_study(&study_on(&embedded(), Preset::Snug)).unwrap();
    let recording = out.path().join("recording.mcap");
    let (again, _out) = run_study(&study_on(&recording, Preset::Snug)).unwrap();
    assert_eq!(first.result.tightenings, again.result.tightenings);
}

#[test]
fn the_study_as_run_runs_again() {
    let (first, out) = run_study(&study_on(&embedded(), Preset::Thesis)).unwrap();
    let study = Study::read(&out.path().join("study.ron")).unwrap();
    let (again, _out) = run_study(&study).unwrap();
    assert_eq!(first.result.tightenings, again.result.tightenings);
    assert_eq!(first.result.title, again.result.title);
}
