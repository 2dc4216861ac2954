//! What the stories share: running a study in a folder of its own, and campaigns to run it on.

use snug_study::{Outcome, Preset, RunSettings, Study, StudyError, Verb, diagnose, run};
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use tempfile::TempDir;

/// The campaign that ships with Snug.
pub fn embedded() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../fixtures/campaign")
}

/// The study file of that name that ships with Snug.
pub fn study_file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../fixtures/studies")
        .join(name)
}

/// Runs `study`; the results are in the folder that comes back, for as long as it lives.
pub fn run_study(study: &Study) -> Result<(Outcome, TempDir), StudyError> {
    run_on(study, None)
}

/// The same on a given number of threads.
pub fn run_on(study: &Study, threads: Option<usize>) -> Result<(Outcome, TempDir), StudyError> {
    let out = tempfile::tempdir().unwrap();
    let settings = RunSettings {
        threads,
        ..RunSettings::new(out.path())
    };
    let outcome = run(study, &settings, &|_| (), &AtomicBool::new(false))?;
    Ok((outcome, out))
}

/// Asks for a diagnosis; the results are in the folder that comes back, for as long as it lives.
pub fn diagnose_study(study: &Study, verb: &Verb) -> (Outcome, TempDir) {
    let out = tempfile::tempdir().unwrap();
    let settings = RunSettings::new(out.path());
    let outcome = diagnose(study, verb, &settings, &|_| (), &AtomicBool::new(false)).unwrap();
    for file in ["report.html", "verdict.json", "recording.mcap", "study.ron"] {
        assert!(out.path().join(file).is_file(), "{verb:?}: {file}");
    }
    (outcome, out)
}

/// The default study on `data` under a preset.
pub fn study_on(data: &Path, preset: Preset) -> Study {
    let mut study = Study::on(data.to_path_buf());
    study.set_preset(preset);
    study
}
