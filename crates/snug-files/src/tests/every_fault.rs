//! An exchange of results, and a new file, of which every single call fails in turn.

use crate::fault::{Fault, FaultyDisk, Lasting};
use crate::{FilesError, Host, Results, write_new};
use std::collections::BTreeMap;
use std::io::{ErrorKind, Write};
use std::path::Path;
use std::sync::Arc;
use tempfile::TempDir;

const NAMES: &[&str] = &["table.csv", "verdict.json", "recording.mcap", "study.ron"];

/// One run: the old one has a verdict, the new one has a table of its own and none.
fn run(disk: Arc<dyn crate::Disk>, folder: &Path, is_new: bool) -> Result<(), FilesError> {
    let mut results = Results::begin(disk, folder, NAMES, None)?;
    let mut recording = results.create_lasting("recording.mcap")?;
    let content = if is_new { "new " } else { "old " };
    let refused = |source| FilesError::Refused {
        action: "write",
        path: folder.to_path_buf(),
        source,
    };
    for _ in 0..3 {
        recording.write_all(content.as_bytes()).map_err(refused)?;
        results.keep_partial();
    }
    results.seal(recording)?;
    results.write("study.ron", content.as_bytes())?;
    results.write("table.csv", content.as_bytes())?;
    if !is_new {
        results.write("verdict.json", content.as_bytes())?;
    }
    results.exchange().map(|_| ())
}

/// What stands in a folder, partial recordings and Snug's own marks aside, and old results that could not be told from
/// somebody's own files because they could not be read.
fn content(folder: &Path) -> BTreeMap<String, String> {
    let mut content = BTreeMap::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        let text = std::fs::read_to_string(path).unwrap_or_default();
        if name.contains(".kept-") {
            assert!(text.starts_with("old "), "{name}: {text}");
        } else if !name.starts_with(".snug-") && !name.contains(".partial-") {
            content.insert(name, text);
        }
    }
    content
}

/// In memory where that is to be had: hundreds of runs wait for the medium thousands of times.
fn folder() -> TempDir {
    tempfile::tempdir_in("/dev/shm").unwrap_or_else(|_| tempfile::tempdir().unwrap())
}

fn old_results() -> (TempDir, BTreeMap<String, String>) {
    let folder = folder();
    run(Arc::new(Host), folder.path(), false).unwrap();
    let old = content(folder.path());
    assert_eq!(old.len(), 4);
    (folder, old)
}

fn new_results() -> BTreeMap<String, String> {
    let folder = tempfile::tempdir().unwrap();
    run(Arc::new(Host), folder.path(), true).unwrap();
    content(folder.path())
}

fn calls() -> u64 {
    let (folder, _) = old_results();
    let disk = FaultyDisk::counting();
    run(Arc::new(disk.clone()), folder.path(), true).unwrap();
    disk.calls()
}

#[test]
fn a_single_fault_leaves_the_old_results_or_the_new_ones_whole() {
    let new = new_results();
    let calls = calls();
    assert!(calls > 60, "{calls} calls");
    let mut failed = 0;
    for fault in Fault::ALL {
        for at in 0..calls {
            let (folder, old) = old_results();
            let disk = FaultyDisk::new(at, fault, Lasting::Once);
            let outcome = run(Arc::new(disk), folder.path(), true);
            let left = content(folder.path());
            match &outcome {
                Ok(()) => assert_eq!(left, new, "{fault:?} at call {at}"),
                Err(_) => assert_eq!(left, old, "{fault:?} at call {at}"),
            }
            failed += u64::from(outcome.is_err());
            run(Arc::new(Host), folder.path(), true).unwrap();
            assert_eq!(
                content(folder.path()),
                new,
                "{fault:?} at call {at}: run again"
            );
        }
    }
    assert!(failed > calls, "faults were felt: {failed}");
}

/// As a kill or a disk that is taken out: nothing more is done, and the next run finds what is there.
#[test]
fn a_run_that_ends_at_any_call_leaves_the_old_results_or_the_new_ones_for_the_next() {
    let new = new_results();
    for at in 0..calls() {
        let (folder, old) = old_results();
        let disk = FaultyDisk::new(at, Fault::Io, Lasting::FromThenOn);
        let outcome = run(Arc::new(disk), folder.path(), true);
        // The next one takes the folder and writes nothing.
        drop(Results::begin(Arc::new(Host), folder.path(), NAMES, None).unwrap());
        let left = content(folder.path());
        assert!(left == old || left == new, "at call {at}: {left:?}");
        assert!(outcome.is_err() || left == new, "at call {at}");
        let hidden = std::fs::read_dir(folder.path()).unwrap().filter(|entry| {
            let name = entry.as_ref().unwrap().file_name();
            name.to_str().unwrap().starts_with(".snug-")
        });
        assert_eq!(hidden.count(), 1, "only the manifest is left, at call {at}");
    }
}

/// Errors name the file and the reason, and a full disk what to do.
#[test]
fn every_fault_is_told_with_path_and_reason() {
    for at in 0..calls() {
        let (folder, _) = old_results();
        let disk = FaultyDisk::new(at, Fault::NoSpace, Lasting::Once);
        if let Err(error) = run(Arc::new(disk), folder.path(), true) {
            let text = error.to_string();
            assert!(text.contains(folder.path().to_str().unwrap()), "{text}");
            assert!(text.contains("no storage space"), "{text}");
            assert!(text.contains("make room"), "{text}");
        }
    }
}

#[test]
fn a_new_file_is_there_whole_or_not_at_all_and_replaces_none() {
    let folder = folder();
    let path = folder.path().join("rig.ron");
    let names = || std::fs::read_dir(folder.path()).unwrap().count();
    let counting = FaultyDisk::counting();
    write_new(&counting, &path, b"new").unwrap();
    assert_eq!(names(), 1, "the name it was written by is gone");
    let error = write_new(&Host, &path, b"newer").unwrap_err();
    assert!(
        matches!(&error, FilesError::Refused { source, .. } if source.kind() == ErrorKind::AlreadyExists),
        "{error}"
    );
    assert_eq!(std::fs::read(&path).unwrap(), b"new");
    for fault in Fault::ALL {
        for at in 0..counting.calls() {
            std::fs::remove_file(&path).ok();
            let disk = FaultyDisk::new(at, fault, Lasting::Once);
            match write_new(&disk, &path, b"new") {
                Ok(()) => assert_eq!(std::fs::read(&path).unwrap(), b"new", "{fault:?} at {at}"),
                Err(_) => assert!(!path.exists(), "{fault:?} at call {at}"),
            }
        }
    }
}
