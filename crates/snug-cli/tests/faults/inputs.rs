//! Commands that would write a result over what they read.

use crate::program::{ended, few_files, snug, text};
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// A folder with data, one with the results of a run of them, and the run's recording.
struct Place {
    _top: TempDir,
    data: PathBuf,
    out: PathBuf,
    recording: PathBuf,
}

fn place() -> Place {
    let top = tempfile::tempdir().unwrap();
    let (data, out) = (top.path().join("data"), top.path().join("out"));
    fs::rename(few_files(2).path(), &data).unwrap();
    let (code, said) = run(&["--data", text(&data), "--out", text(&out)]);
    assert_eq!(code, 0, "{said}");
    Place {
        recording: out.join("recording.mcap"),
        _top: top,
        data,
        out,
    }
}

fn run(words: &[&str]) -> (i32, String) {
    ended(&mut snug(&[&["run"], words].concat()))
}

/// The command is refused with exit code 2, names both files, and nothing in `folder` has changed.
fn refused(words: &[&str], folder: &Path, names: &[&str]) {
    let before = crate::program::results(folder);
    let (code, said) = run(words);
    assert_eq!(code, 2, "{words:?}: {said}");
    for name in names {
        assert!(said.contains(name), "{name}: {said}");
    }
    assert!(said.contains("--out"), "{said}");
    assert_eq!(crate::program::results(folder), before, "{words:?}");
}

#[test]
fn a_recording_is_not_recorded_over() {
    let place = place();
    let (out, recording) = (text(&place.out), text(&place.recording));
    refused(
        &["--data", recording, "--out", out],
        &place.out,
        &[recording],
    );
    let roundabout = format!("{out}/../out/./recording.mcap");
    refused(
        &["--data", &roundabout, "--out", out],
        &place.out,
        &[recording],
    );
    let elsewhere = place.out.with_file_name("again");
    let (code, said) = run(&["--data", recording, "--out", text(&elsewhere)]);
    assert_eq!(code, 0, "{said}");
}

#[test]
fn a_folder_is_not_both_for_data_and_for_results() {
    let place = place();
    for folder in [&place.data, &place.out] {
        let folder_text = text(folder);
        refused(
            &["--data", folder_text, "--out", folder_text],
            folder,
            &[folder_text],
        );
    }
    let way = place.data.with_file_name("way");
    std::os::unix::fs::symlink(&place.data, &way).unwrap();
    refused(
        &["--data", text(&place.data), "--out", text(&way)],
        &place.data,
        &[text(&way)],
    );
    let inside = place.data.join("out");
    let (code, said) = run(&["--data", text(&place.data), "--out", text(&inside)]);
    assert_eq!(code, 0, "inside it is another folder: {said}");
}

#[test]
fn links_of_both_kinds_are_seen_through() {
    let place = place();
    let elsewhere = place.data.with_file_name("elsewhere");
    fs::create_dir(&elsewhere).unwrap();
    let hard = elsewhere.join("recording.mcap");
    fs::hard_link(&place.recording, &hard).unwrap();
    let names = [text(&hard), text(&place.recording)];
    refused(
        &["--data", names[1], "--out", text(&elsewhere)],
        &elsewhere,
        &names,
    );
    fs::remove_file(&hard).unwrap();
    std::os::unix::fs::symlink(&place.recording, &hard).unwrap();
    refused(
        &["--data", names[1], "--out", text(&elsewhere)],
        &elsewhere,
        &names,
    );
    // The other way round: what is read is a link to a result.
    let link = place.data.with_file_name("link.mcap");
    std::os::unix::fs::symlink(&place.recording, &link).unwrap();
    refused(
        &["--data", text(&link), "--out", text(&place.out)],
        &place.out,
        &[text(&link)],
    );
}

#[test]
fn a_table_is_not_written_over_while_it_is_read() {
    let place = place();
    let table = place.out.join("tightenings.csv");
    let study = place.data.with_file_name("rig.ron");
    fs::write(
        &study,
        r#"(source: (format: Csv(channels: [(column: Index(1), signal: Torque, unit: NewtonMetre), (column: Index(2), signal: Displacement, unit: Radian)], sampling: Rate(hz: 100.0))), preprocess: (window: Whole))"#,
    )
    .unwrap();
    let words = [
        "--study",
        text(&study),
        "--data",
        text(&table),
        "--out",
        text(&place.out),
    ];
    refused(&words, &place.out, &[text(&table)]);
}

#[test]
fn a_study_by_hand_keeps_its_comments() {
    let place = place();
    let here = place.data.with_file_name("here");
    fs::create_dir(&here).unwrap();
    let study = here.join("study.ron");
    let by_hand = format!(
        "// my rig, mended on Monday\n(source: (path: {:?}))",
        place.data
    );
    fs::write(&study, &by_hand).unwrap();
    refused(
        &["--study", text(&study), "--out", text(&here)],
        &here,
        &[text(&study)],
    );
    assert_eq!(fs::read_to_string(&study).unwrap(), by_hand);
    // Not named as the study, it is in the way all the same: it is kept under another name, and that is told.
    let (code, said) = run(&["--data", text(&place.data), "--out", text(&here)]);
    assert_eq!(code, 0, "{said}");
    let kept = here.join("study.kept-1.ron");
    assert!(said.contains(text(&kept)), "{said}");
    assert_eq!(fs::read_to_string(kept).unwrap(), by_hand);
}

/// A study that Snug wrote can be run again in its place; one that somebody changed cannot.
#[test]
fn the_study_as_run_runs_again_where_it_lies_until_it_is_changed() {
    let place = place();
    let study = place.out.join("study.ron");
    let words = ["--study", text(&study), "--out", text(&place.out)];
    let before = crate::program::results(&place.out);
    let (code, said) = run(&words);
    assert_eq!(code, 0, "{said}");
    assert_eq!(crate::program::results(&place.out), before);
    let mut changed = fs::read_to_string(&study).unwrap();
    changed.push_str("// mine");
    fs::write(&study, &changed).unwrap();
    refused(&words, &place.out, &[text(&study)]);
}

#[test]
fn a_study_that_is_no_file_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe");
    assert!(
        std::process::Command::new("mkfifo")
            .arg(&pipe)
            .status()
            .unwrap()
            .success()
    );
    let long = folder.path().join("long.ron");
    fs::write(&long, " ".repeat(2 << 20)).unwrap();
    for study in [
        "/dev/zero",
        text(folder.path()),
        text(&pipe),
        text(&long),
        "/nowhere.ron",
    ] {
        let (code, said) = run(&["--study", study, "--out", text(&folder.path().join("out"))]);
        assert_eq!(code, 2, "{study}: {said}");
        assert!(said.contains(study), "{study}: {said}");
    }
}

#[test]
fn a_message_does_not_repeat_a_book() {
    let folder = tempfile::tempdir().unwrap();
    let study = folder.path().join("rig.ron");
    let endless = "x+".repeat(400_000);
    for text_of in [
        format!(
            "(model: (custom: [(name: \"law\", place: Force, expression: \"{endless}\", parameters: [])]))"
        ),
        format!("(model: (effects: [\"{endless}\"]))"),
        format!("({}: 1)", "a".repeat(800_000)),
        format!("(seed: {endless})"),
        format!("(title: {endless}"),
    ] {
        fs::write(&study, &text_of).unwrap();
        let (code, said) = run(&["--study", text(&study)]);
        assert_eq!(code, 2);
        assert!(said.len() < 3000, "{} bytes: {}", said.len(), &said[..500]);
    }
}
