//! The same input gives the same bits, whatever the number of threads.

use crate::campaign::{embedded, run_on, study_on};
use snug_study::Preset;

#[test]
fn every_file_but_none_depends_on_the_threads() {
    let study = study_on(&embedded(), Preset::Snug);
    let (_, one) = run_on(&study, Some(1)).unwrap();
    let (_, three) = run_on(&study, Some(3)).unwrap();
    for name in [
        "tightenings.csv",
        "statistics.json",
        "findings.json",
        "report.html",
        "recording.mcap",
        "study.ron",
    ] {
        let read = |folder: &tempfile::TempDir| std::fs::read(folder.path().join(name)).unwrap();
        assert!(
            read(&one) == read(&three),
            "{name} depends on the number of threads"
        );
    }
}
