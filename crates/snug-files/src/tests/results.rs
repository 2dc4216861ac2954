//! What a folder of results holds, and who may write there.

use crate::{FilesError, Host, Results, write_whole};
use std::fs;
use std::io::Write;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

const NAMES: &[&str] = &["study.ron", "recording.mcap"];

fn begin(folder: &Path) -> Result<Results, FilesError> {
    Results::begin(Arc::new(Host), folder, NAMES, None)
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn a_second_run_is_told_since_when_the_first_has_the_folder() {
    let folder = tempfile::tempdir().unwrap();
    let first = begin(folder.path()).unwrap();
    let error = begin(folder.path()).unwrap_err();
    let text = error.to_string();
    assert!(matches!(error, FilesError::Busy { .. }), "{text}");
    for told in [
        "since 20",
        "UTC",
        &std::process::id().to_string(),
        "--wait",
        "--out",
    ] {
        assert!(text.contains(told), "{told}: {text}");
    }
    drop(first);
    begin(folder.path()).unwrap();
    assert!(names(folder.path()).is_empty(), "nothing is left of either");
}

#[test]
fn who_waits_gets_the_folder_next_or_is_interrupted() {
    let folder = tempfile::tempdir().unwrap();
    let first = begin(folder.path()).unwrap();
    let looks = AtomicUsize::new(0);
    let twice = || looks.fetch_add(1, Ordering::Relaxed) < 2;
    let error = Results::begin(Arc::new(Host), folder.path(), NAMES, Some(&twice)).unwrap_err();
    assert!(matches!(error, FilesError::Interrupted));
    std::thread::scope(|scope| {
        let waiting = scope.spawn(|| {
            Results::begin(Arc::new(Host), folder.path(), NAMES, Some(&|| true)).map(drop)
        });
        std::thread::sleep(std::time::Duration::from_millis(50));
        assert!(!waiting.is_finished());
        drop(first);
        waiting.join().unwrap().unwrap();
    });
}

#[test]
fn a_lock_s_file_that_a_killed_run_left_holds_nobody_up() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join(".snug-lock"), "since 1970, process 1").unwrap();
    drop(begin(folder.path()).unwrap());
    assert!(names(folder.path()).is_empty());
}

#[test]
fn what_is_no_result_is_set_aside_under_its_own_name() {
    let folder = tempfile::tempdir().unwrap();
    let study = folder.path().join("study.ron");
    for (content, kept) in [
        ("by hand", "study.kept-1.ron"),
        ("changed", "study.kept-2.ron"),
    ] {
        fs::write(&study, content).unwrap();
        let mut results = begin(folder.path()).unwrap();
        results.write("study.ron", b"by Snug").unwrap();
        let exchanged = results.exchange().unwrap();
        assert_eq!(exchanged.set_aside, [folder.path().join(kept)]);
        assert_eq!(
            fs::read_to_string(&exchanged.set_aside[0]).unwrap(),
            content
        );
        assert_eq!(fs::read_to_string(&study).unwrap(), "by Snug");
    }
    let mut results = begin(folder.path()).unwrap();
    results.write("study.ron", b"by Snug again").unwrap();
    assert!(results.exchange().unwrap().set_aside.is_empty());
    assert_eq!(
        names(folder.path()),
        [
            ".snug-results",
            "study.kept-1.ron",
            "study.kept-2.ron",
            "study.ron"
        ]
    );
}

#[test]
fn the_results_of_the_run_before_go_as_a_whole() {
    let folder = tempfile::tempdir().unwrap();
    let mut results = begin(folder.path()).unwrap();
    results.write("study.ron", b"1").unwrap();
    results.write("recording.mcap", b"1").unwrap();
    results.exchange().unwrap();
    let mut results = begin(folder.path()).unwrap();
    results.write("study.ron", b"2").unwrap();
    results.exchange().unwrap();
    assert_eq!(names(folder.path()), [".snug-results", "study.ron"]);
}

/// A clock that stands still or was set back gives the same time twice.
#[test]
fn unfinished_recordings_never_take_each_other_s_place() {
    let folder = tempfile::tempdir().unwrap();
    for content in ["a", "b", "c"] {
        let mut results = begin(folder.path()).unwrap();
        let mut recording = results.create_lasting("recording.mcap").unwrap();
        recording.write_all(content.as_bytes()).unwrap();
        results.keep_partial();
        assert!(results.partial().unwrap().is_file());
    }
    let mut results = begin(folder.path()).unwrap();
    let unwanted = results.create_lasting("recording.mcap").unwrap();
    drop((unwanted, results));
    let results = begin(folder.path()).unwrap();
    let left = results.exchange().unwrap().unfinished;
    let mut content: Vec<String> = left
        .iter()
        .map(|path| fs::read_to_string(path).unwrap())
        .collect();
    content.sort();
    assert_eq!(content, ["a", "b", "c"]);
}

#[cfg(unix)]
#[test]
fn links_in_the_place_of_results_are_set_aside_and_what_they_lead_to_is_not_touched() {
    let folder = tempfile::tempdir().unwrap();
    let precious = folder.path().join("precious");
    fs::create_dir(&precious).unwrap();
    fs::write(precious.join("study.ron"), "mine").unwrap();
    let out = folder.path().join("out");
    fs::create_dir(&out).unwrap();
    std::os::unix::fs::symlink(precious.join("study.ron"), out.join("study.ron")).unwrap();
    std::os::unix::fs::symlink(&precious, out.join(".snug-new")).unwrap();
    let error = begin(&out).unwrap_err().to_string();
    assert!(error.contains(".snug-new"), "{error}");
    assert_eq!(
        fs::read_to_string(precious.join("study.ron")).unwrap(),
        "mine"
    );
    fs::remove_file(out.join(".snug-new")).unwrap();
    let mut results = begin(&out).unwrap();
    results.write("study.ron", b"Snug's").unwrap();
    results.exchange().unwrap();
    assert_eq!(
        fs::read_to_string(precious.join("study.ron")).unwrap(),
        "mine"
    );
    assert_eq!(fs::read_to_string(out.join("study.ron")).unwrap(), "Snug's");
}

#[test]
fn a_file_is_replaced_whole_or_stays() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("study.ron");
    write_whole(&Host, &path, b"first").unwrap();
    write_whole(&Host, &path, b"second").unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), "second");
    let taken = folder.path().join("taken");
    fs::create_dir(&taken).unwrap();
    write_whole(&Host, &taken, b"no file can stand here").unwrap_err();
    assert_eq!(
        names(folder.path()),
        ["study.ron", "taken"],
        "nothing else is left behind"
    );
}
