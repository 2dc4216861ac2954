//! Whatever lies in a folder of data is read, or told.

use crate::program::{ended, entries, few_files, results, snug, words};
use std::fs;
use std::os::unix::fs::symlink;
use std::process::Command;

#[test]
fn every_entry_of_a_folder_is_read_or_told() {
    let data = few_files(1);
    let at = |name: &str| data.path().join(name);
    symlink("/nowhere/at/all.mat", at("TP2_QS_Soft_5_dangling.mat")).unwrap();
    symlink(at("TP2_QS_Soft_5_loop.mat"), at("TP2_QS_Soft_5_loop.mat")).unwrap();
    symlink("/dev/zero", at("TP2_QS_Soft_5_device.mat")).unwrap();
    assert!(
        Command::new("mkfifo")
            .arg(at("TP2_QS_Soft_5_pipe.mat"))
            .status()
            .unwrap()
            .success()
    );
    fs::create_dir(at("TP2_QS_Soft_5_folder.mat")).unwrap();
    fs::create_dir(at("deeper")).unwrap();
    fs::hard_link(&entries(data.path())[0], at("TP1_QS_Soft_5_twice.mat")).unwrap();
    for name in [
        "empty.mat",
        "notes.txt",
        ".hidden.mat",
        "=cmd.mat",
        "no ending",
        "a\u{1b}[2J.mat",
    ] {
        fs::write(at(name), "").unwrap();
    }
    let out = tempfile::tempdir().unwrap();
    let words = words("run", data.path(), out.path());
    let (code, said) = ended(&mut snug(&words));
    assert_eq!(code, 0, "{said}");
    assert!(!said.contains("\u{1b}[2J"), "no name steers the terminal");
    let results = results(out.path());
    let findings: serde_json::Value = serde_json::from_slice(&results["findings.json"]).unwrap();
    let told = |name: &str| {
        let mut all = findings["findings"].as_array().unwrap().iter();
        all.any(|finding| finding["file"] == name)
    };
    let table = String::from_utf8_lossy(&results["tightenings.csv"]).into_owned();
    for entry in entries(data.path()) {
        let name = entry.file_name().unwrap().to_str().unwrap().to_owned();
        assert!(told(&name) || table.contains(&name), "{name:?} is nowhere");
    }
    let (code, _) = ended(&mut snug(&[&words[..], &["--strict"]].concat()));
    assert_eq!(code, 3);
}

#[test]
fn a_campaign_of_which_nothing_is_identified_fails_with_the_reason() {
    let data = tempfile::tempdir().unwrap();
    fs::write(data.path().join("garbage.mat"), [7; 300]).unwrap();
    let out = tempfile::tempdir().unwrap();
    for verb in ["run", "compare", "diagnose", "improve"] {
        let words = words(verb, data.path(), out.path());
        let (code, said) = ended(&mut snug(&words));
        assert_eq!(code, 1, "{verb}: {said}");
        assert!(
            said.contains("nothing was identified: garbage.mat: "),
            "{verb}: {said}"
        );
    }
}
