//! A study file is its writer's: no verb changes it, unless it is told to.

use crate::program::{ended, fixture, snug};
use std::fs;
use std::path::Path;

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

const COMMENT: &str = "// my rig, mended on Monday\n";

#[test]
fn a_study_file_changes_where_that_is_asked_for_only() {
    let folder = tempfile::tempdir().unwrap();
    let (study, out) = (folder.path().join("rig.ron"), folder.path().join("out"));
    let by_hand = format!(
        "{COMMENT}(model: (effects: [\"torque_delay\"]), source: (path: {:?}))",
        fixture("mystery")
    );
    fs::write(&study, &by_hand).unwrap();
    let run = |words: &[&str]| {
        let places = ["--study", text(&study), "--out", text(&out)];
        ended(&mut snug(&[words, &places].concat()))
    };
    let found = || fs::read_to_string(out.join("study.ron")).unwrap();
    for (words, is_in_model) in [
        (["add", "stretch_reflex"].as_slice(), true),
        (&["improve"], true),
        (&["remove", "torque_delay"], false),
    ] {
        let (code, said) = run(words);
        assert_eq!(code, 0, "{words:?}: {said}");
        assert_eq!(fs::read_to_string(&study).unwrap(), by_hand, "{words:?}");
        assert_eq!(found().contains("stretch_reflex"), is_in_model, "{words:?}");
        // Whoever goes on is led to the study that was found.
        assert!(
            said.contains(&format!("--study {}", text(&out.join("study.ron")))),
            "{said}"
        );
    }
    assert!(!found().contains("\"torque_delay\""));
    let (code, said) = run(&["add", "stretch_reflex", "--write"]);
    assert_eq!(code, 0, "{said}");
    let written = fs::read_to_string(&study).unwrap();
    let changed = by_hand.replace(
        "[\"torque_delay\"]",
        "[\"torque_delay\", \"stretch_reflex\"]",
    );
    assert_eq!(written, changed);
}

#[test]
fn nothing_is_written_into_a_study_that_is_not_named_and_only_what_is_there_is_taken_out() {
    let data = fixture("mystery");
    let (code, said) = ended(&mut snug(&["improve", "--write", "--data", text(&data)]));
    assert_eq!(code, 2, "{said}");
    assert!(said.contains("--study"), "{said}");
    let out = tempfile::tempdir().unwrap();
    let words = [
        "remove",
        "backlash",
        "--data",
        text(&data),
        "--out",
        text(out.path()),
    ];
    let (code, said) = ended(&mut snug(&words));
    assert_eq!(code, 2, "{said}");
    assert!(said.contains("backlash"), "{said}");
    assert_eq!(fs::read_dir(out.path()).unwrap().count(), 0);
}
