//! From nothing to a model, each command as the one before recommends it.

use crate::machine::{Machine, ended, fixture};
use std::collections::BTreeMap;
use std::path::Path;

/// The files of a folder with what is in them.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = std::fs::read_dir(folder).unwrap();
    let paths = entries.map(|entry| entry.unwrap().path());
    let name = |path: &Path| path.file_name().unwrap().to_str().unwrap().to_owned();
    (paths.map(|path| (name(&path), std::fs::read(&path).unwrap()))).collect()
}

#[test]
fn the_campaign_that_it_holds_is_that_of_the_repository() {
    let machine = Machine::new();
    let (code, said, told) = ended(&mut machine.snug(&["run"]));
    assert_eq!(code, 0, "{told}");
    assert!(said.contains("48 tightenings from 12 files"), "{said}");
    let held = machine
        .path("home/.local/share/snug")
        .join(env!("CARGO_PKG_VERSION"));
    assert!(told.contains(held.to_str().unwrap()), "{told}");
    for name in ["campaign", "mystery"] {
        assert!(files(&held.join(name)) == files(&fixture(name)), "{name}");
    }
    // Data left out is told, and is an error only to who is strict.
    assert!(said.contains("Left out: 2 files or tightenings"), "{said}");
    let again = [
        "run",
        "--study",
        "out/study.ron",
        "--strict",
        "--out",
        "again",
    ];
    let (code, _, told) = ended(&mut machine.snug(&again));
    assert_eq!(code, 3, "{told}");
    let (code, said, told) = ended(&mut machine.snug(&["run", "--quiet", "--out", "quiet"]));
    assert_eq!((code, said.as_str(), told.as_str()), (0, "", ""));
}

#[test]
fn two_that_start_at_once_have_one_campaign() {
    let machine = Machine::new();
    let runs = ["one", "other"].map(|out| machine.snug(&["run", "--out", out]).spawn().unwrap());
    for run in runs {
        let output = run.wait_with_output().unwrap();
        assert!(output.status.success(), "{output:?}");
    }
    let held = files_below(&machine.path("home/.local/share/snug"));
    assert_eq!(held, [env!("CARGO_PKG_VERSION")]);
}

/// Names in a folder.
fn files_below(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    (entries.map(|entry| entry.unwrap().file_name().into_string().unwrap())).collect()
}

#[test]
fn every_command_that_it_recommends_is_its_own() {
    let machine = Machine::new();
    let data = fixture("mystery");
    let data = data.to_str().unwrap();
    let (code, said, _) = ended(&mut machine.snug(&["compare", "--data", data]));
    assert_eq!(code, 0);
    let next = format!("    snug diagnose --data {data}\n");
    assert!(said.contains(&next), "{said}");
    let (code, said, _) = ended(&mut machine.snug(&["diagnose", "--data", data]));
    assert_eq!(code, 0);
    let next = format!("    snug add stretch_reflex --data {data}\n");
    assert!(said.contains(&next), "{said}");
    let page = std::fs::read_to_string(machine.path("work/out/report.html")).unwrap();
    assert!(page.contains("<code>snug add stretch_reflex</code>"));
    assert!(page.contains("“snug effects”"));
    assert!(!page.contains("cargo"), "the page speaks of cargo");
    let (code, said, _) = ended(&mut machine.snug(&["improve", "--data", data]));
    assert_eq!(code, 0);
    assert!(said.contains("\n  + stretch_reflex "), "{said}");
    assert!(
        said.contains("    snug run --study out/study.ron\n"),
        "{said}"
    );
    let (code, said, _) = ended(&mut machine.snug(&["run", "--study", "out/study.ron"]));
    assert_eq!(code, 0);
    assert!(said.contains("stretch_reflex"), "{said}");
}

#[test]
fn where_nothing_can_be_written_it_asks_for_data() {
    let machine = Machine::new();
    let (code, said, told) = ended(machine.snug(&["run"]).env_remove("HOME"));
    assert_eq!((code, said.as_str()), (1, ""));
    assert!(
        told.contains("HOME is not set; name data by --data DIR"),
        "{told}"
    );
    let home = machine.path("work/no-folder");
    std::fs::write(&home, "").unwrap();
    let (code, _, told) = ended(machine.snug(&["run"]).env("HOME", &home));
    assert_eq!(code, 1);
    let place = home.join(".local/share/snug");
    assert!(
        told.contains(&format!("cannot be written to {}", place.display())),
        "{told}"
    );
    assert!(told.ends_with("name data by --data DIR\n"), "{told}");
}

#[test]
fn a_wrong_name_of_an_effect_gets_the_right_one() {
    let machine = Machine::new();
    let data = fixture("mystery");
    let data = data.to_str().unwrap();
    let verbs: [&[&str]; 3] = [
        &["add", "bcklash", "--data", data],
        &["run", "--effects", "torque_lag,bcklash", "--data", data],
        &["effects", "bcklash"],
    ];
    for words in verbs {
        let (code, said, told) = ended(&mut machine.snug(words));
        assert_eq!((code, said.as_str()), (2, ""), "{words:?}");
        let right =
            "there is no effect `bcklash` (did you mean `backlash`?); there are: cubic_stiffness, ";
        assert!(told.contains(right), "{words:?}: {told}");
    }
}
