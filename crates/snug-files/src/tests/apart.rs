//! Inputs in the place of results, by every kind of path.

use crate::{FilesError, Host, Inputs, Results, keep_apart};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tempfile::TempDir;

const NAMES: &[&str] = &["recording.mcap", "tightenings.csv", "study.ron"];

fn refused(folder: &Path, inputs: Inputs<'_>) -> bool {
    match keep_apart(&Host, folder, NAMES, inputs) {
        Ok(()) => false,
        Err(error) => {
            assert!(error.is_bad_argument(), "{error}");
            true
        }
    }
}

fn measurements(files: &[PathBuf]) -> Inputs<'_> {
    Inputs {
        measurements: files,
        ..Inputs::default()
    }
}

/// A folder of data with a recording, and one for results.
fn folders() -> (TempDir, PathBuf, PathBuf) {
    let top = tempfile::tempdir().unwrap();
    let (data, out) = (top.path().join("data"), top.path().join("out"));
    fs::create_dir(&data).unwrap();
    fs::create_dir(&out).unwrap();
    fs::write(data.join("recording.mcap"), "measured").unwrap();
    (top, data, out)
}

#[test]
fn a_recording_is_not_recorded_over() {
    let (_top, data, out) = folders();
    let input = [data.join("recording.mcap")];
    assert!(!refused(&out, measurements(&input)));
    assert!(refused(&data, measurements(&input)), "in its own folder");
    let roundabout = [data.join("../data/./recording.mcap")];
    assert!(refused(&data, measurements(&roundabout)));
    fs::hard_link(&input[0], out.join("tightenings.csv")).unwrap();
    assert!(refused(&out, measurements(&input)), "by a second name");
    let error = keep_apart(&Host, &out, NAMES, measurements(&input)).unwrap_err();
    let text = error.to_string();
    assert!(matches!(error, FilesError::OutputIsInput { .. }));
    assert!(text.contains("data/recording.mcap") && text.contains("out/tightenings.csv"));
}

#[cfg(unix)]
#[test]
fn links_are_seen_through() {
    use std::os::unix::fs::symlink;
    let (top, data, out) = folders();
    let input = [data.join("recording.mcap")];
    symlink(&input[0], out.join("recording.mcap")).unwrap();
    assert!(
        refused(&out, measurements(&input)),
        "a result is a link to the input"
    );
    fs::remove_file(out.join("recording.mcap")).unwrap();
    fs::write(out.join("recording.mcap"), "of the last run").unwrap();
    let link = [top.path().join("link.mcap")];
    symlink(out.join("recording.mcap"), &link[0]).unwrap();
    assert!(
        refused(&out, measurements(&link)),
        "the input is a link to a result"
    );
    let other_way = top.path().join("way");
    symlink(&data, &other_way).unwrap();
    let inputs = Inputs {
        data: Some(&data),
        ..Inputs::default()
    };
    assert!(refused(&other_way, inputs), "the folder by another way");
    assert!(!refused(&out, inputs));
    assert!(
        !refused(&data.join("out"), inputs),
        "a folder within, not there yet"
    );
}

#[test]
fn a_study_is_replaced_only_where_it_is_a_result_as_it_was_written() {
    let (_top, _data, out) = folders();
    let study = out.join("study.ron");
    fs::write(&study, "// by hand\n()").unwrap();
    let inputs = Inputs {
        study: Some(&study),
        ..Inputs::default()
    };
    assert!(refused(&out, inputs));
    let mut results = Results::begin(Arc::new(Host), &out, NAMES, None).unwrap();
    results.write("study.ron", b"()").unwrap();
    results.exchange().unwrap();
    assert!(!refused(&out, inputs), "written by a run");
    fs::write(&study, "(/* mine */)").unwrap();
    assert!(refused(&out, inputs), "changed since");
}
