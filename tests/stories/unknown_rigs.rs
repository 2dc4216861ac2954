//! Rigs of which nobody says where mass, damping and stiffness begin, nor in which unit anything was measured.

use crate::campaign::run_study;
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

/// In both directions of turning friction and an offset of its torque are told apart, and nothing more is told: not where it began, which
/// its speed shows, and no ripple.
#[test]
fn a_drive_turned_both_ways_lacks_dry_friction_and_an_offset() {
    let Some(data) = snug_tests::data("HSM150 two-motor rig") else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    for name in ["neg_0.045_1", "neg_0.04_1", "pos_0.065_1", "pos_0.06_1"] {
        let table = drive(&data.join(format!("hsm150-two-motor/idf_{name}.mat")));
        std::fs::write(folder.path().join(format!("{name}.csv")), table).unwrap();
    }
    let signals = "signal: Velocity, unit: RadianPerSecond";
    let columns = ["torque", "velocity"];
    let study = study(folder.path(), columns, signals, 1000.0, "Velocity");
    let (diagnosis, _) = told(&study, &Verb::Improve);
    let mut added: Vec<&str> = (diagnosis.added.iter())
        .map(|one| one.effect.as_str())
        .collect();
    added.sort_unstable();
    assert_eq!(
        added,
        ["coulomb_friction", "torque_offset"],
        "{}",
        diagnosis.headline
    );
    assert_ne!(diagnosis.verdict, Verdict::UnlistedEffect);
}

/// The same drive, read as it was recorded, has the bits that it has as a table.
#[test]
fn a_drive_is_read_as_it_was_recorded() {
    let Some(data) = snug_tests::data("HSM150 two-motor rig") else {
        return;
    };
    let file = data.join("hsm150-two-motor/idf_pos_0.06_1.mat");
    let text = r#"(source: (format: Mat(
        channels: [
            (path: "data", part: Column(4), signal: Torque, unit: NewtonMetre),
            (path: "data", part: Column(3), signal: Velocity, unit: RadianPerSecond),
            (path: "data", part: Column(2), signal: Displacement, unit: Radian),
        ],
        sampling: Times(path: "data", part: Column(0)),
    )))"#;
    let source = Study::parse(text, Path::new("rig.ron")).unwrap().source;
    source.check().unwrap();
    let recording = snug_ingest::read(&source, &file, 1.0)
        .unwrap()
        .recordings
        .remove(0);
    assert!((recording.time_base.interval_s - 1e-3).abs() < 1e-12);
    let velocity = recording.motion.velocity_rad_per_s.unwrap();
    let rows = velocity.iter().zip(&recording.torque_nm);
    let rows = rows.map(|(velocity, torque)| format!("{velocity},{torque}\n"));
    let table: String = std::iter::once("velocity,torque\n".to_owned())
        .chain(rows)
        .collect();
    assert!(table == drive(&file));
}

/// A nutrunner's own log: angle, torque and time as lists in the first step's graph. Expected numbers as Python's json reads
/// them.
#[test]
fn a_nutrunners_json_is_read() {
    let Some(data) = snug_tests::data("nutrunner unfastening") else {
        return;
    };
    let folder = data.join("nutrunner-unfastening/dataset1/test/nicht_loesbar");
    let text = r#"(source: (format: Json(
        channels: [
            (path: "tightening steps[0].graph.torque values", signal: Torque, unit: NewtonMetre),
            (path: "tightening steps[0].graph.angle values", signal: Displacement, unit: Degree),
        ],
        sampling: Times(path: "tightening steps[0].graph.time values"),
    )))"#;
    let source = Study::parse(text, Path::new("rig.ron")).unwrap().source;
    source.check().unwrap();
    let files = snug_ingest::list(&source, &folder).unwrap().files;
    assert_eq!(files.len(), 46);
    for file in &files {
        let read = snug_ingest::read(&source, file, 1.0).unwrap();
        assert_eq!(read.recordings.len(), 1, "{}", file.display());
    }
    let known = folder.join("Cycle_8856.json");
    let recording = snug_ingest::read(&source, &known, 1.0)
        .unwrap()
        .recordings
        .remove(0);
    let angles = recording.motion.displacement_rad.unwrap();
    assert_eq!(recording.torque_nm[0], 0.029);
    assert_eq!(angles[0], 0.0);
    assert!((angles[angles.len() - 1].to_degrees() - LAST_ANGLE_DEG).abs() < 10.0);
}

/// Of `Cycle_8856.json` \[°\].
const LAST_ANGLE_DEG: f64 = 2161.33;

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

/// A carriage on a rail: force in N and position in m are the torque and the angle about a lever arm of 0.5 m, whatever the
/// unit, to the bit where the unit's factor is a power of two's.
#[test]
fn a_linear_drive_is_declared_as_it_is_measured() {
    let folder = tempfile::tempdir().unwrap();
    let table = folder.path().join("carriage.csv");
    std::fs::write(&table, carriage()).unwrap();
    let fitted = |input: &str, output: &str, lever_arm_m: f64| {
        let text = format!(
            r#"(
                source: (path: {table:?}, format: Csv(
                    channels: [(column: Name("u"), {input}), (column: Name("x"), signal: Displacement, {output})],
                    sampling: Rate(hz: 200.0),
                )),
                preprocess: (window: Whole, rig: (lever_arm_m: {lever_arm_m:?}, known_inertia: Fixed(0.0))),
                identify: (fitted_output: Displacement, constraints: [Positive]),
            )"#
        );
        let study = Study::parse(&text, Path::new("rig.ron")).unwrap();
        let (outcome, out) = run_study(&study).unwrap();
        let estimate = outcome.result.tightenings[0].estimate.as_ref().unwrap();
        let page = std::fs::read_to_string(out.path().join("report.html")).unwrap();
        let values = estimate.parameters.iter().map(|one| one.value);
        (values.collect::<Vec<f64>>(), page.contains("input [N]"))
    };
    // T = 0.5 m · F and θ = x / 0.5 m.
    let as_torque = "signal: Torque, unit: NewtonMetre, scale: 0.5";
    let as_angle = "unit: Radian, scale: 2.0";
    let (by_torque, _) = fitted(as_torque, as_angle, 0.5);
    let (by_force, shown_in_newton) = fitted("signal: Force, unit: Newton", "unit: Metre", 0.5);
    assert_eq!(by_force, by_torque);
    assert!(shown_in_newton);
    assert_eq!(
        fitted("signal: Torque, unit: Newton", "unit: Metre", 0.5).0,
        by_torque
    );
    for (value, truth) in by_force.iter().zip([2.0, 6.0, 800.0]) {
        assert!((value / truth - 1.0).abs() < 0.01, "{by_force:?}");
    }
    let others = [
        fitted(
            "signal: Force, unit: Kilonewton, scale: 0.001",
            "unit: Millimetre, scale: 1000",
            0.33,
        ),
        fitted(
            "signal: Force, unit: PoundForce, scale: 0.224808943",
            "unit: Inch, scale: 39.37007874",
            2.0,
        ),
    ];
    for (values, _) in others {
        for (value, same) in values.iter().zip(&by_force) {
            assert!((value / same - 1.0).abs() < 1e-6, "{values:?} {by_force:?}");
        }
    }
}

/// 2 kg on a spring of 800 N/m with 6 kg/s under a force of three tones, by small steps of the midpoint rule; u in N, x in m.
fn carriage() -> String {
    let force = |t: f64| 10.0 * ((5.0 * t).sin() + (17.0 * t).sin() + (31.0 * t).sin());
    let acceleration = |t: f64, x: f64, v: f64| (force(t) - 6.0 * v - 800.0 * x) / 2.0;
    let (steps, h) = (50, 1.0 / 200.0 / 50.0);
    let (mut x, mut v) = (0.0, 0.0);
    let mut table = "u,x\n".to_owned();
    for row in 0..1200 {
        let start = f64::from(row) / 200.0;
        table += &format!("{:?},{x:?}\n", force(start));
        for step in 0..steps {
            let t = start + f64::from(step) * h;
            let (x_mid, v_mid) = (x + 0.5 * h * v, v + 0.5 * h * acceleration(t, x, v));
            let a_mid = acceleration(t + 0.5 * h, x_mid, v_mid);
            (x, v) = (x + h * v_mid, v + h * a_mid);
        }
    }
    table
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
