//! Estimate here, validate there: files that take no part in the fit, by name or pattern, and how well the others predict them.

use crate::campaign::{diagnose_study, embedded, run_study};
use snug_campaign::{Rejection, TighteningResult};
use snug_study::{Study, Verb};
use std::path::Path;

fn study(data: &Path, settings: &str) -> Study {
    let text = format!("(source: (path: {data:?}), validation: (files: {settings}))");
    Study::parse(&text, Path::new("study.ron")).unwrap()
}

fn kept(all: &[TighteningResult]) -> Vec<&TighteningResult> {
    let is_kept =
        |one: &&TighteningResult| one.selection.rejections.contains(&Rejection::Validation);
    all.iter().filter(is_kept).collect()
}

/// Whoever is kept for validation has no say in what is fitted: the others come out as in a campaign without them.
#[test]
fn the_others_are_fitted_as_if_a_kept_file_were_not_there() {
    let (outcome, out) = run_study(&study(&embedded(), r#"["TP6_*"]"#)).unwrap();
    let without = tempfile::tempdir().unwrap();
    for entry in std::fs::read_dir(embedded()).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap();
        if !name.to_string_lossy().starts_with("TP6_") {
            std::fs::copy(&path, without.path().join(name)).unwrap();
        }
    }
    let (alone, _out) = run_study(&study(without.path(), "[]")).unwrap();
    let all = &outcome.result.tightenings;
    let (fitted, last) = all.split_at(alone.result.tightenings.len());
    assert!(fitted == alone.result.tightenings);
    assert!(outcome.result.conditions == alone.result.conditions);
    // One of the eight is cut off and cannot be used.
    assert_eq!((last.len(), kept(all).len()), (8, 8));
    for one in kept(all).iter().filter(|one| one.estimate.is_some()) {
        // People differ; with the mean hand of the others most of the motion is predicted, and no restart hides the rest.
        let validation = one.validation.unwrap();
        let fit = validation.free_run.fit_percent.unwrap();
        assert!((60.0..99.0).contains(&fit), "{}: {fit}", one.id);
        assert_eq!(validation.restarted, None);
    }
    let statistics = std::fs::read_to_string(out.path().join("statistics.json")).unwrap();
    let statistics: serde_json::Value = serde_json::from_str(&statistics).unwrap();
    assert_eq!(statistics["validation"].as_array().unwrap().len(), 7);
    let page = std::fs::read_to_string(out.path().join("report.html")).unwrap();
    assert!(page.contains("How well it predicts what took no part in the fit"));
    let written = Study::read(&out.path().join("study.ron")).unwrap();
    assert_eq!(written.validation.files, ["TP6_*"]);
}

#[test]
fn a_name_that_stands_for_no_file_and_one_that_stands_for_all_are_refused() {
    for (settings, expected) in [
        (r#"["TP66_*"]"#, "`TP66_*` stands for none of the files"),
        (r#"["TP*"]"#, "keeps all 12 files"),
    ] {
        let refused = run_study(&study(&embedded(), settings)).unwrap_err();
        assert!(refused.is_bad_argument());
        assert!(refused.to_string().contains(expected), "{refused}");
    }
}

/// An arm with gravity that the study does not know, by small steps; four records under different torques.
fn arm(number: u32) -> String {
    let (h, steps) = (0.01 / 40.0, 40);
    let torque = |t: f64| {
        let n = f64::from(number);
        2.0 * (1.1 * t + n).sin() + 1.5 * ((2.3 + 0.3 * n) * t).sin()
    };
    let acceleration = |t: f64, x: f64, v: f64| (torque(t) - 0.4 * v - 4.0 * x.sin()) / 0.3;
    let (mut x, mut v) = (0.0_f64, 0.0_f64);
    let mut rows = String::from("torque,angle\n");
    for sample in 0..1500 {
        let start = f64::from(sample) * 0.01;
        rows += &format!("{:?},{x:?}\n", torque(start));
        for step in 0..steps {
            let t = start + f64::from(step) * h;
            let (x_mid, v_mid) = (x + 0.5 * h * v, v + 0.5 * h * acceleration(t, x, v));
            let a_mid = acceleration(t + 0.5 * h, x_mid, v_mid);
            (x, v) = (x + h * v_mid, v + h * a_mid);
        }
    }
    rows
}

fn arm_study(folder: &Path) -> Study {
    for number in 1..=4 {
        std::fs::write(folder.join(format!("run-{number}.csv")), arm(number)).unwrap();
    }
    let text = format!(
        r#"(
            source: (path: {folder:?}, format: Csv(
                channels: [
                    (column: Name("torque"), signal: Torque, unit: NewtonMetre),
                    (column: Name("angle"), signal: Displacement, unit: Radian),
                ],
                sampling: Rate(hz: 100.0),
            )),
            preprocess: (window: Whole, rig: (lever_arm_m: 1.0, known_inertia: Fixed(0.0))),
            identify: (fitted_output: Displacement, constraints: [Positive]),
            validation: (files: ["run-4.csv"]),
        )"#
    );
    Study::parse(&text, Path::new("arm.ron")).unwrap()
}

/// A spring in gravity's place goes astray in a free run and less over an eighth of a swing; with gravity both predict the file that
/// nobody fitted, and so does the study that was written.
#[test]
fn a_file_that_is_kept_is_predicted_freely_and_restarted() {
    let folder = tempfile::tempdir().unwrap();
    let study = arm_study(folder.path());
    let fits = |all: &[TighteningResult]| {
        let validation = kept(all)[0].validation.unwrap();
        let restarted = validation.restarted.unwrap();
        let fits = [validation.free_run, restarted.prediction];
        fits.map(|one| one.fit_percent.unwrap())
    };
    let (before, _out) = run_study(&study).unwrap();
    let [free, restarted] = fits(&before.result.tightenings);
    assert!(free < 90.0 && restarted > free, "{free} {restarted}");
    let verb = Verb::Add(vec!["gravity_torque".into()]);
    let (after, out) = diagnose_study(&study, &verb);
    let [free, restarted] = fits(&after.result.tightenings);
    assert!(free > 97.0 && restarted > 97.0, "{free} {restarted}");
    let diagnosis = after.result.diagnosis.as_ref().unwrap();
    let compared = &diagnosis.comparison.tightenings;
    assert!(compared.iter().all(|one| one.id.file != "run-4.csv"));
    let written = Study::read(&out.path().join("study.ron")).unwrap();
    let (again, _out) = run_study(&written).unwrap();
    assert_eq!(again.result.tightenings, after.result.tightenings);
}
