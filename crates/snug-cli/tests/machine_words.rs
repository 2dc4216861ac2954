//! Of a rig that nobody holds nothing is said of hands, joints or tightenings, whatever the verb, wherever it is read.
#![allow(clippy::unwrap_used, reason = "a failing test should say where")]

use std::path::Path;
use std::process::Command;

/// What no machine has.
const FORBIDDEN: [&str; 13] = [
    "hand",
    "forearm",
    "tightening",
    "tightenings",
    "joint",
    "joints",
    "target torque",
    "grip",
    "glove",
    "gloves",
    "rebound",
    "operator",
    "torque",
];

/// 2 kg on a spring of 800 N/m with 6 kg/s and a dry friction of 2 N under a force of three tones, by small steps of the midpoint rule, in
/// which friction slows it and stops it; u in N, x in m.
fn carriage() -> String {
    let force = |t: f64| 10.0 * ((5.0 * t).sin() + (17.0 * t).sin() + (31.0 * t).sin());
    let pushed = |t: f64, x: f64, v: f64| (force(t) - 6.0 * v - 800.0 * x) / 2.0;
    let (steps, h) = (50, 1.0 / 200.0 / 50.0);
    let slowed = |v: f64, for_s: f64| v.signum() * (v.abs() - for_s * 2.0 / 2.0).max(0.0);
    let (mut x, mut v) = (0.0, 0.0);
    let mut table = "u,x\n".to_owned();
    for row in 0..1200 {
        let start = f64::from(row) / 200.0;
        table += &format!("{:?},{x:?}\n", force(start));
        for step in 0..steps {
            let t = start + f64::from(step) * h;
            let v_mid = slowed(v + 0.5 * h * pushed(t, x, v), 0.5 * h);
            let pushed_mid = pushed(t + 0.5 * h, x + 0.5 * h * v, v_mid);
            let ends = slowed(v + h * pushed_mid, h);
            (x, v) = (x + 0.5 * h * (v + ends), ends);
        }
    }
    table
}

/// What a reader sees of a page: no addresses, scripts, quotations.
fn seen(page: &str) -> String {
    let mut text = String::new();
    let mut rest = page;
    while let Some(start) = rest.find('<') {
        text += &rest[..start];
        text.push('\n');
        rest = &rest[start..];
        let quoted = ["style", "script", "pre", "code"];
        let closing = (quoted.iter())
            .find(|name| rest[1..].starts_with(**name))
            .map_or(">".to_owned(), |name| format!("</{name}>"));
        rest = &rest[rest.find(&closing).unwrap() + closing.len()..];
    }
    text
}

/// Lines that hold a forbidden word by itself, not as part of a name or a path.
fn slips(text: &str) -> Vec<&str> {
    let has = |line: &&str| {
        let line = line.to_lowercase();
        FORBIDDEN.iter().any(|word| {
            line.match_indices(word).any(|(at, word)| {
                let before = line[..at].chars().next_back();
                let mut after = line[at + word.len()..].chars();
                let name = |one: char| one.is_alphanumeric() || "_/".contains(one);
                let is_name = |one: Option<char>| one.is_some_and(name);
                let next = after.next();
                let is_file = next == Some('.') && is_name(after.next());
                !is_name(before) && !is_name(next) && !is_file
            })
        })
    };
    text.lines().filter(has).collect()
}

/// The sentences of a JSON file.
fn sentences(value: &serde_json::Value, all: &mut String) {
    use serde_json::Value::{Array, Object, String};
    match value {
        String(text) if text.contains(' ') => {
            *all += text;
            all.push('\n');
        }
        Array(list) => list.iter().for_each(|one| sentences(one, all)),
        Object(fields) => fields.values().for_each(|one| sentences(one, all)),
        _ => {}
    }
}

fn run(folder: &Path, words: &[&str]) -> String {
    let out = Command::new(env!("CARGO_BIN_EXE_snug"))
        .args(words)
        .args(["--study", "rig.ron", "--out", "out"])
        .current_dir(folder)
        .output()
        .unwrap();
    assert!(out.status.success(), "{words:?}: {out:?}");
    String::from_utf8(out.stdout).unwrap()
}

#[test]
fn a_carriage_has_no_hand() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    std::fs::write(path.join("carriage.csv"), carriage()).unwrap();
    let study = r#"(
        source: (path: "carriage.csv", format: Csv(
            channels: [
                (column: Name("u"), signal: Force, unit: Newton),
                (column: Name("x"), signal: Displacement, unit: Metre),
            ],
            sampling: Rate(hz: 200.0),
        )),
        preprocess: (window: Whole, rig: (lever_arm_m: 0.5, known_inertia: Fixed(0.0))),
        identify: (fitted_output: Displacement, constraints: [Positive]),
    )"#;
    std::fs::write(path.join("rig.ron"), study).unwrap();
    let verbs: [&[&str]; 5] = [
        &["run"],
        &["compare"],
        &["diagnose"],
        &["add", "coulomb_friction"],
        &["improve"],
    ];
    for words in verbs {
        let printed = run(path, words);
        assert_eq!(slips(&printed), [""; 0], "{words:?} prints");
        for told in [": mass ", "; damping ", "; stiffness ", "[95 % interval]"] {
            assert!(printed.contains(told), "{words:?}: {told} in {printed}");
        }
        let page = std::fs::read_to_string(path.join("out/report.html")).unwrap();
        assert_eq!(slips(&seen(&page)), [""; 0], "{words:?} reports");
        if let Ok(verdict) = std::fs::read_to_string(path.join("out/verdict.json")) {
            let mut told = String::new();
            sentences(&serde_json::from_str(&verdict).unwrap(), &mut told);
            assert_eq!(slips(&told), [""; 0], "{words:?} files");
        }
    }
}
