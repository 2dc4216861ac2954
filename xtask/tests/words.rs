//! In a checkout every command that is recommended is one of `cargo xtask`, on the terminal, in files and in help.
#![allow(clippy::unwrap_used, reason = "a failing test should say where")]

use std::path::Path;
use std::process::{Command, Output};

fn xtask(folder: &Path, words: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_xtask"))
        .args(words)
        .current_dir(folder)
        .output()
        .unwrap()
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

/// No command of the installed program.
fn assert_no_snug(said: &str) {
    for verb in [
        "run", "init", "compare", "diagnose", "add", "improve", "effects", "recover",
    ] {
        assert!(
            !said.contains(&format!("snug {verb}")),
            "snug {verb} in {said}"
        );
    }
}

#[test]
fn summaries_reports_and_drafts_recommend_the_checkout_s_program() {
    let folder = tempfile::tempdir().unwrap();
    let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fixtures");
    let mystery = fixtures.join("mystery");
    let mystery = mystery.to_str().unwrap();
    let compared = xtask(folder.path(), &["compare", "--data", mystery]);
    assert!(compared.status.success(), "{compared:?}");
    let said = text(&compared.stdout);
    let next = format!("    cargo xtask diagnose --data {mystery}\n");
    assert!(said.contains(&next), "{said}");
    assert_no_snug(said);
    let page = std::fs::read_to_string(folder.path().join("out/report.html")).unwrap();
    assert!(page.contains("“cargo xtask effects”"));
    assert_no_snug(&page);

    let rows: String = (0..400)
        .map(|row| f64::from(row) / 100.0)
        .map(|t| format!("{t},{},{}\n", (7.0 * t).sin(), (7.0 * t - 0.4).sin()))
        .collect();
    let table = format!("time_s,torque_nm,angle_rad\n{rows}");
    std::fs::write(folder.path().join("rig.csv"), table).unwrap();
    let drafted = xtask(folder.path(), &["init", "rig.csv"]);
    assert!(drafted.status.success(), "{drafted:?}");
    let said = text(&drafted.stdout);
    assert!(
        said.ends_with("\n  cargo xtask compare --study rig.ron\n"),
        "{said}"
    );
    let study = std::fs::read_to_string(folder.path().join("rig.ron")).unwrap();
    assert!(
        study.starts_with("// Written by `cargo xtask init`: "),
        "{study}"
    );

    let failed = xtask(
        folder.path(),
        &["run", "--data", "rig.csv", "--out", "none"],
    );
    let said = text(&failed.stderr);
    assert!(said.contains("\n  cargo xtask init rig.csv\n"), "{said}");
    assert_no_snug(said);
}

#[test]
fn help_lists_verbs_and_chores_under_its_name() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let help = xtask(folder, &["-h"]);
    let help = text(&help.stdout);
    assert!(
        help.contains("Usage: cargo xtask [OPTIONS] <COMMAND>"),
        "{help}"
    );
    assert_no_snug(help);
    let verbs = [
        "run", "improve", "plant", "recover", "fixtures", "test", "tidy", "fuzz", "bench",
    ];
    for verb in verbs {
        assert!(help.contains(&format!("\n  {verb} ")), "{verb} in {help}");
        let page = xtask(folder, &["help", verb]);
        let page = text(&page.stdout);
        let usage = format!("Usage: cargo xtask {verb}");
        assert!(
            page.contains(&usage) && !page.contains(['{', '}']),
            "{page}"
        );
    }
}
