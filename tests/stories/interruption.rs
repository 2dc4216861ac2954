//! Who stops a long run gets the results of what was evaluated until then.

use crate::campaign::{embedded, run_study, study_on};
use snug_campaign::{Rung, Verdict};
use snug_study::{Outcome, Preset, ProgressEvent, RunSettings, Study, Verb, diagnose, run};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

#[test]
fn a_run_stopped_after_its_first_file_leaves_whole_results() {
    let study = study_on(&embedded(), Preset::Snug);
    let out = tempfile::tempdir().unwrap();
    let settings = RunSettings {
        threads: Some(1),
        ..RunSettings::new(out.path())
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

/// `improve` on the mystery, stopped as soon as it begins `stage`; its results in `out`.
fn improved_until(stage: &str, out: &Path) -> Outcome {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fixtures/mystery");
    let settings = RunSettings::new(out);
    let stop = AtomicBool::new(false);
    let stop_there = |event: ProgressEvent<'_>| {
        if matches!(event, ProgressEvent::Stage { what } if what == stage) {
            stop.store(true, Ordering::Relaxed);
        }
    };
    diagnose(
        &Study::on(data),
        &Verb::Improve,
        &settings,
        &stop_there,
        &stop,
    )
    .unwrap()
}

#[test]
fn a_climb_stopped_on_its_way_tells_the_rungs_it_reached() {
    for (stage, effects, told) in [
        (
            "ranking what is missing beside the base model",
            [].as_slice(),
            "Stopped before an effect was added",
        ),
        (
            "ranking what is missing beside stretch_reflex",
            ["stretch_reflex".to_owned()].as_slice(),
            "Stopped after 1 effect: with stretch reflex the error fell from",
        ),
    ] {
        let out = tempfile::tempdir().unwrap();
        let outcome = improved_until(stage, out.path());
        let diagnosis = outcome.result.diagnosis.as_ref().unwrap();
        assert!(diagnosis.interrupted && diagnosis.ranking.is_empty());
        assert_eq!(diagnosis.verdict, Verdict::Undecided);
        let headline = diagnosis.headline.to_string();
        let stopped = diagnosis.stopped.as_ref().unwrap().to_string();
        assert!(headline.starts_with(told), "{headline}");
        assert!(stopped.starts_with("It was ended"), "{stopped}");
        let rungs = &diagnosis.ladder;
        assert_eq!(rungs.len(), 1 + effects.len());
        let evaluated = |rung: &Rung| rung.rms_displacement_rad.is_some();
        assert!(rungs.iter().all(evaluated));

        assert_eq!(outcome.result.effects, effects);
        assert_eq!(outcome.result.tightenings.len(), 24);
        let verdict = std::fs::read_to_string(out.path().join("verdict.json")).unwrap();
        assert!(verdict.contains("\"interrupted\": true"));
        let report = std::fs::read_to_string(out.path().join("report.html")).unwrap();
        assert!(report.contains("stopped before there was a verdict"));
        let further = Study::read(&out.path().join("study.ron")).unwrap();
        assert_eq!(further.model.effects, effects);
    }
}
