//! Rigs of which nobody says where mass, damping and stiffness begin, nor in which unit anything was measured.

use snug_campaign::{Diagnosis, Verdict};
use snug_study::{RunSettings, Study, Verb, diagnose};
use std::path::Path;
use std::sync::atomic::AtomicBool;

/// A study as README teaches it: two channels of a table, one output, nothing else.
fn study(data: &Path, [input, output]: [&str; 2], signals: &str, hz: f64, fitted: &str) -> Study {
    let text = format!(
        r#"(
            source: (path: {data:?}, format: Csv(
                channels: [
                    (column: Name("{input}"), signal: Torque, unit: Volt),
                    (column: Name("{output}"), {signals}),
                ],
                sampling: Rate(hz: {hz}),
            )),
            preprocess: (window: Whole, rig: (lever_arm_m: 1.0, known_inertia: Fixed(0.0))),
            identify: (fitted_output: {fitted}, constraints: [Positive]),
        )"#
    );
    Study::parse(&text, Path::new("rig.ron")).unwrap()
}

/// The diagnosis, and how well the study's own model fits \[%\].
fn told(study: &Study, verb: &Verb) -> (Diagnosis, f64) {
    let out = tempfile::tempdir().unwrap();
    let quiet = |_: snug_study::ProgressEvent<'_>| ();
    let never = AtomicBool::new(false);
    let outcome = diagnose(study, verb, &RunSettings::new(out.path()), &quiet, &never).unwrap();
    let fit = outcome.result.tightenings[0]
        .measures
        .fit_percent_fitted_output;
    (outcome.result.diagnosis.unwrap(), fit.unwrap())
}

/// One mode leaves 13 % of the arm's power, as a fit to the spectra with NumPy says: 1 − √0.1316 = 64 % of its size. In which
/// unit of time does not matter.
#[test]
fn a_robot_arm_of_unknown_rate_is_fitted_by_its_resonance() {
    let Some(data) = snug_tests::data("DaISy") else {
        return;
    };
    let arm = data.join("daisy/robot-arm.csv");
    let signals = "signal: Acceleration, unit: RadianPerSecondSquared";
    let fits = [1.0, 500.0, 1e6].map(|hz| {
        let study = study(&arm, ["u", "y"], signals, hz, "Acceleration");
        told(&study, &Verb::Compare).1
    });
    for fit in fits {
        assert!((62.0..67.0).contains(&fit), "{fits:?}");
        assert!((fit - fits[0]).abs() < 0.01, "{fits:?}");
    }
}

/// A second mode that is driven and measured at different places: with one of free residue a fit to the spectra with SciPy leaves
/// 0.7 % of the arm's power, at 29.1 Hz for 500 samples a second, against the torque (r < 0).
#[test]
fn a_robot_arm_asks_for_a_second_mode() {
    let Some(data) = snug_tests::data("DaISy") else {
        return;
    };
    let arm = data.join("daisy/robot-arm.csv");
    let signals = "signal: Acceleration, unit: RadianPerSecondSquared";
    let (diagnosis, _) = told(
        &study(&arm, ["u", "y"], signals, 500.0, "Acceleration"),
        &Verb::Improve,
    );
    let mode = &diagnosis.added[0];
    assert_eq!(mode.effect, "second_mode", "{}", diagnosis.headline);
    let [residue, hz] = [0, 1].map(|index| mode.parameters[index].value);
    assert!(residue < 0.0, "{residue}");
    assert!((hz - 29.1).abs() < 0.3, "{hz}");
}

/// Whoever swaps the columns, or takes an acceleration for a velocity, is told so, whatever was asked; nothing is called adequate
/// or missing.
#[test]
fn a_robot_arm_declared_wrongly_is_no_model() {
    let Some(data) = snug_tests::data("DaISy") else {
        return;
    };
    let arm = data.join("daisy/robot-arm.csv");
    let acceleration = "signal: Acceleration, unit: RadianPerSecondSquared";
    let velocity = "signal: Velocity, unit: RadianPerSecond";
    for (columns, signals, fitted, expected) in [
        (
            ["y", "u"],
            acceleration,
            "Acceleration",
            "which column is which",
        ),
        (
            ["u", "y"],
            velocity,
            "Velocity",
            "were what is declared as velocity the acceleration",
        ),
    ] {
        for verb in [Verb::Compare, Verb::Diagnose, Verb::Improve] {
            let (diagnosis, _) = told(&study(&arm, columns, signals, 1.0, fitted), &verb);
            let reasons: Vec<String> = diagnosis.reasons.iter().map(ToString::to_string).collect();
            let is_named = reasons.iter().any(|reason| reason.contains(expected));
            assert_eq!(
                diagnosis.verdict,
                Verdict::NotFitted,
                "{verb:?}: {reasons:#?}"
            );
            assert!(is_named, "{verb:?}: {reasons:#?}");
        }
    }
}

/// A drive is braked by dry friction; in one direction of turning that is a constant torque, and nothing tells them apart.
#[test]
fn a_drive_lacks_dry_friction() {
    let Some(data) = snug_tests::data("HSM150 two-motor rig") else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let table = folder.path().join("drive.csv");
    std::fs::write(
        &table,
        drive(&data.join("hsm150-two-motor/idf_pos_0.06_1.mat")),
    )
    .unwrap();
    let signals = "signal: Velocity, unit: RadianPerSecond";
    let study = study(&table, ["torque", "velocity"], signals, 1000.0, "Velocity");
    let (diagnosis, _) = told(&study, &Verb::Diagnose);
    assert_eq!(
        diagnosis.verdict,
        Verdict::MissingEffect,
        "{}",
        diagnosis.headline
    );
    let first = &diagnosis.ranking[0];
    let named: Vec<&String> = first.twins.iter().chain([&first.effect]).collect();
    assert!(
        named.iter().any(|name| *name == "coulomb_friction"),
        "{named:?}"
    );
}

/// Its torque and speed as a table.
fn drive(file: &Path) -> String {
    let read = snug_ingest::mat::MatFile::read(file).unwrap();
    let data = read.variable("data").unwrap().to_f64().unwrap();
    let columns: Vec<&[f64]> = data.chunks(data.len() / 7).collect();
    let (velocity, torque) = (columns[3], columns[4]);
    let rows = velocity.iter().zip(torque);
    let rows = rows.map(|(velocity, torque)| format!("{velocity},{torque}\n"));
    std::iter::once("velocity,torque\n".to_owned())
        .chain(rows)
        .collect()
}

/// Two tanks are no oscillator: candidates run away, and are not believed.
#[test]
fn cascaded_tanks_are_searched_to_the_end() {
    let Some(data) = snug_tests::data("cascaded tanks") else {
        return;
    };
    let tanks = data.join("cascaded-tanks/dataBenchmark.csv");
    let signals = "signal: Displacement, unit: Volt";
    let study = study(&tanks, ["uEst", "yEst"], signals, 0.25, "Displacement");
    let (diagnosis, _) = told(&study, &Verb::Improve);
    assert!(!diagnosis.interrupted);
}
