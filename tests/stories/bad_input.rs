//! Bad input gives a clear error or a named finding, and everything else is still evaluated.

use crate::campaign::{embedded, run_study, study_file, study_on};
use snug_campaign::{Finding, Severity};
use snug_model::ParameterSettings;
use snug_study::{Outcome, Preset, RunSettings, Study, StudyError, Verb, diagnose};
use snug_synthetic::{CampaignPlan, Fault, MatStyle, PlannedFault, simulate};
use std::path::Path;
use std::sync::atomic::AtomicBool;
use tempfile::TempDir;

const GOOD: &str = "TP1_QS_Soft_5_01.mat";

/// A folder with one good file and whatever `add` puts beside it.
fn beside_a_good_file(add: impl FnOnce(&Path)) -> (Outcome, TempDir, TempDir) {
    let data = tempfile::tempdir().unwrap();
    std::fs::copy(embedded().join(GOOD), data.path().join(GOOD)).unwrap();
    add(data.path());
    let (outcome, out) = run_study(&study_on(data.path(), Preset::Snug)).unwrap();
    assert_eq!(
        outcome.result.presets[0].selected, 4,
        "the good file's tightenings are all evaluated"
    );
    (outcome, data, out)
}

fn left_out<'a>(outcome: &'a Outcome, file: &str) -> Vec<&'a Finding> {
    outcome
        .result
        .findings
        .iter()
        .filter(|f| f.severity == Severity::LeftOut && f.file == file)
        .collect()
}

#[test]
fn a_garbage_file_is_a_finding() {
    let (outcome, _data, _out) = beside_a_good_file(|folder| {
        std::fs::write(
            folder.join("garbage.mat"),
            b"not a MAT file at all, only text".repeat(9),
        )
        .unwrap();
    });
    assert_eq!(left_out(&outcome, "garbage.mat").len(), 1);
    assert_eq!(outcome.left_out, 1);
}

#[test]
fn a_truncated_file_keeps_what_it_holds_or_says_why_not() {
    let (outcome, _data, _out) = beside_a_good_file(|folder| {
        let bytes = std::fs::read(embedded().join("TP2_QS_Hard_8_02.mat")).unwrap();
        std::fs::write(folder.join("cut.mat"), &bytes[..bytes.len() / 2]).unwrap();
    });
    assert!(!left_out(&outcome, "cut.mat").is_empty());
}

#[test]
fn zero_torque_and_nan_are_named() {
    use snug_synthetic::{MatValue, mat5};
    let samples = 20_000;
    let noise = |index: usize| ((index * 7919) % 1000) as f64 / 1000.0 - 0.5;
    let acceleration: Vec<f64> = (0..samples).map(noise).collect();
    let events = [
        "1", "Start", "0,0", "1", "Torque", "1,48", "1", "Stop", "2,0",
    ];
    let write = |folder: &Path, name: &str, torque: &[f64], acceleration: &[f64]| {
        let texts = events.map(str::to_owned).to_vec();
        let variables = [
            ("Events", MatValue::CellOfText { columns: 3, texts }),
            ("Inline_Torque", MatValue::Double(torque)),
            ("angle_acc_Acc_FIR150", MatValue::Double(acceleration)),
        ];
        std::fs::write(folder.join(name), mat5(&variables, true).unwrap()).unwrap();
    };
    let (outcome, _data, _out) = beside_a_good_file(|folder| {
        write(
            folder,
            "TP1_QS_Soft_5_zero.mat",
            &vec![0.0; samples],
            &acceleration,
        );
        write(
            folder,
            "TP1_QS_Soft_5_nan.mat",
            &vec![f64::NAN; samples],
            &acceleration,
        );
        write(
            folder,
            "TP1_QS_Soft_5_still.mat",
            &vec![0.0; samples],
            &vec![0.0; samples],
        );
    });
    for file in [
        "TP1_QS_Soft_5_zero.mat",
        "TP1_QS_Soft_5_nan.mat",
        "TP1_QS_Soft_5_still.mat",
    ] {
        assert_eq!(left_out(&outcome, file).len(), 1, "{file}");
    }
}

/// Where the acceleration at rest was not logged, its noise is unknown: the other tightenings are still judged by theirs.
#[test]
fn a_tightening_without_a_measured_noise_does_not_take_the_others_theirs() {
    let mut plan = CampaignPlan::of_size(2, 4);
    plan.faults.push(PlannedFault {
        file: 1,
        tightening: 2,
        fault: Fault::SilentRest,
    });
    let folder = tempfile::tempdir().unwrap();
    let data = folder.path().join("data");
    let campaign = simulate(&plan, 5).unwrap();
    campaign.write(&data, MatStyle::default()).unwrap();
    let settings = RunSettings::new(folder.path().join("out"));
    let study = Study::on(data);
    let never = AtomicBool::new(false);
    let outcome = diagnose(&study, &Verb::Compare, &settings, &|_| (), &never).unwrap();
    assert_eq!(outcome.result.tightenings.len(), 8, "nothing is lost");
    let diagnosis = outcome.result.diagnosis.unwrap();
    assert_eq!(diagnosis.tightenings, 7);
    assert!(diagnosis.ladder[0].error_over_noise.is_some());
    let said = diagnosis
        .reasons
        .iter()
        .map(ToString::to_string)
        .find(|reason| reason.contains("took no part"));
    let said = said.expect("the diagnosis says that one is missing");
    assert!(said.contains("1 of 8"), "{said}");
    let mut findings = outcome.result.findings.iter();
    assert!(findings.any(|finding| finding.code == "silent_quiet_part"));
}

#[test]
fn a_missing_channel_is_named_with_what_is_there() {
    let (outcome, _data, _out) = beside_a_good_file(|folder| {
        let bytes = snug_synthetic::mat5(
            &[(
                "Inline_Torque",
                snug_synthetic::MatValue::Double(&[0.0; 100]),
            )],
            false,
        )
        .unwrap();
        std::fs::write(folder.join("TP9_QS_Soft_5.mat"), bytes).unwrap();
    });
    let findings = left_out(&outcome, "TP9_QS_Soft_5.mat");
    let message = &findings[0].message;
    assert!(
        message.contains("angle_acc_Acc_FIR150"),
        "names what is wanted: {message}"
    );
    assert!(
        message.contains("Inline_Torque"),
        "names what is there: {message}"
    );
}

#[test]
fn an_empty_or_missing_folder_is_an_error_that_names_it() {
    let empty = tempfile::tempdir().unwrap();
    for folder in [empty.path().to_path_buf(), empty.path().join("nowhere")] {
        let error = run_study(&study_on(&folder, Preset::Snug)).unwrap_err();
        let text = error.to_string();
        assert!(text.contains(&*folder.to_string_lossy()), "{text}");
        assert!(!error.is_bad_argument(), "the study itself is fine");
    }
}

#[test]
fn a_typo_in_the_study_is_told_with_line_and_column() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("study.ron");
    std::fs::write(&path, "(\n    preprocess: (windw: Whole),\n)\n").unwrap();
    let error = Study::read(&path).unwrap_err();
    let StudyError::Syntax { line, .. } = &error else {
        panic!("{error}");
    };
    assert_eq!(*line, 2);
    let text = error.to_string();
    assert!(
        text.contains("windw") && text.ends_with("(did you mean `window`?)"),
        "{text}"
    );
    assert!(error.is_bad_argument());
}

#[test]
fn a_value_of_the_wrong_kind_is_told_with_its_field() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("study.ron");
    for (text, told) in [
        (
            "(\n  selection: (minimum_fit_percent: high),\n)",
            "2:35: minimum_fit_percent is high; allowed is a number",
        ),
        (
            "(\n  seed: 3,\n  preprocess: (preset: Tesis),\n)",
            "3:24: preset is `Tesis`; allowed is `Snug` or `Thesis`",
        ),
        (
            "(seed: -1)",
            "seed is -1; allowed is a whole number, 0 or more",
        ),
    ] {
        std::fs::write(&path, text).unwrap();
        let error = Study::read(&path).unwrap_err();
        let found = error.to_string();
        assert!(found.contains(told), "{found}");
        assert!(error.is_bad_argument());
    }
}

#[test]
fn an_effect_named_twice_is_refused_before_any_work() {
    let study = study_on(&embedded(), Preset::Snug);
    let twice = ["backlash".to_owned(), "backlash".to_owned()];
    let error = study.check_effects(&twice).unwrap_err();
    assert!(error.to_string().contains("`backlash` is named twice"));
    assert!(error.is_bad_argument());
}

#[test]
fn a_diagnosis_of_nothing_says_what_was_left_out() {
    let data = tempfile::tempdir().unwrap();
    std::fs::write(data.path().join("garbage.mat"), [7; 300]).unwrap();
    let out = tempfile::tempdir().unwrap();
    let settings = snug_study::RunSettings::new(out.path());
    let outcome = snug_study::diagnose(
        &study_on(data.path(), Preset::Snug),
        &snug_study::Verb::Improve,
        &settings,
        &|_| (),
        &std::sync::atomic::AtomicBool::new(false),
    )
    .unwrap();
    assert_eq!(left_out(&outcome, "garbage.mat").len(), 1);
    assert!(outcome.result.diagnosis.is_none());
    assert!(out.path().join("findings.json").is_file());
}

/// A shaker whose accelerometer ends at 6 m/s²: no recording can be judged, which every verb says with its reason.
#[test]
fn a_rig_of_which_no_recording_can_be_used_is_told_why() {
    let folder = tempfile::tempdir().unwrap();
    let mut rows = "force,acceleration\n".to_owned();
    for k in 0..2000 {
        let force = (0.05 * f64::from(k)).sin() + (0.31 * f64::from(k)).sin();
        rows.push_str(&format!("{force},{}\n", (8.0 * force).clamp(-6.0, 6.0)));
    }
    std::fs::write(folder.path().join("shaker.csv"), rows).unwrap();
    let text = format!(
        r#"(
            source: (path: {:?}, format: Csv(
                channels: [
                    (column: Name("force"), signal: Force, unit: Newton),
                    (column: Name("acceleration"), signal: Acceleration, unit: MetrePerSecondSquared),
                ],
                sampling: Rate(hz: 1000.0),
            )),
            preprocess: (window: Whole, rig: (lever_arm_m: 1.0, known_inertia: Fixed(0.0))),
            identify: (fitted_output: Acceleration),
        )"#,
        folder.path()
    );
    let study = Study::parse(&text, Path::new("shaker.ron")).unwrap();
    let (outcome, _out) = run_study(&study).unwrap();
    let told = left_out(&outcome, "shaker.csv");
    assert!(told.iter().any(|one| one.code == "saturation"), "{told:?}");
    let out = tempfile::tempdir().unwrap();
    let (settings, never) = (RunSettings::new(out.path()), AtomicBool::new(false));
    let refused = diagnose(&study, &Verb::Improve, &settings, &|_| (), &never);
    let why = refused.map(|_| ()).unwrap_err().to_string();
    assert!(
        why.contains("shaker.csv") && why.contains("end of its range"),
        "{why}"
    );
}

#[test]
fn a_value_that_is_not_allowed_is_told_with_line_and_column() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("study.ron");
    for (text, line, column, word) in [
        (
            "(\n  selection: (minimum_fit_percent: 101),\n)",
            2,
            15,
            "101",
        ),
        (
            "(\n  preprocess: (\n    window: Pulse(length_s: -1.0)),\n)",
            3,
            19,
            "length_s",
        ),
        (
            "(\n  model: (effects: [\"cubic_stifness\"]),\n)",
            2,
            11,
            "cubic_stifness",
        ),
        (
            "(identify: (solver: (maximum_iterations: 0)))",
            1,
            22,
            "maximum_iterations",
        ),
        (
            "(source: (format: Csv(channels: [],\nsampling: Rate(hz: 100.0))))",
            1,
            23,
            "Torque",
        ),
        ("(record: (gap_s: -1.0))", 1, 11, "gap_s"),
        ("(validation: (ranges: [\"tset\"]))", 1, 15, "tset"),
    ] {
        std::fs::write(&path, text).unwrap();
        let error = Study::read(&path).unwrap_err();
        let told = error.to_string();
        let place = format!("{}:{line}:{column}: ", path.display());
        assert!(told.starts_with(&place), "{told}");
        assert!(told.contains(word), "{told}");
        assert!(error.is_bad_argument());
    }
}

#[test]
fn a_range_of_which_nothing_is_scored_is_refused_before_any_work() {
    let mut study = Study::read(&study_file("silverbox.ron")).unwrap();
    study.validation.unscored_samples = 21_688;
    let error = study.check().unwrap_err();
    let text = error.to_string();
    assert!(
        text.contains("multisine test") && text.contains("21688"),
        "{text}"
    );
    assert!(error.is_bad_argument());
    study.validation.unscored_samples = 21_687;
    study.check().unwrap();
    study.identify.unscored_samples = 65_062;
    assert!(study.check().unwrap_err().is_bad_argument());
}

/// Two tightenings one after another in a file that nobody wrote events into.
#[test]
fn a_file_without_events_gives_every_tightening() {
    use snug_synthetic::{MatValue, mat5};
    let source = snug_study::Study::on(embedded()).source;
    let good = snug_ingest::read(&source, &embedded().join(GOOD), 0.33).unwrap();
    let recording = &good.recordings[0];
    let acceleration = recording.motion.acceleration_rad_per_s2.as_ref().unwrap();
    let variables = [
        ("Inline_Torque", MatValue::Double(&recording.torque_nm)),
        ("angle_acc_Acc_FIR150", MatValue::Double(acceleration)),
        (
            "F_op_J",
            MatValue::Double(recording.grip_force_n.as_ref().unwrap()),
        ),
    ];
    let (outcome, _data, _out) = {
        let data = tempfile::tempdir().unwrap();
        let bytes = mat5(&variables, true).unwrap();
        std::fs::write(data.path().join("TP1_QS_Soft_5.mat"), bytes).unwrap();
        let (outcome, out) = run_study(&study_on(data.path(), Preset::Snug)).unwrap();
        (outcome, data, out)
    };
    assert_eq!(outcome.left_out, 0, "{:?}", outcome.result.findings);
    assert_eq!(outcome.result.tightenings.len(), recording.segments.len());
    assert_eq!(outcome.result.presets[0].selected, recording.segments.len());
    let (with_events, _out) = {
        let data = tempfile::tempdir().unwrap();
        std::fs::copy(embedded().join(GOOD), data.path().join(GOOD)).unwrap();
        run_study(&study_on(data.path(), Preset::Snug)).unwrap()
    };
    // The same tightenings, cut a few milliseconds elsewhere: the estimates lie within each other's intervals.
    for (a, b) in std::iter::zip(&outcome.result.tightenings, &with_events.result.tightenings) {
        let (a, b) = (a.estimate.as_ref().unwrap(), b.estimate.as_ref().unwrap());
        let interval = b.parameter("stiffness_n_per_m").unwrap().interval.unwrap();
        let found = a.value("stiffness_n_per_m").unwrap();
        assert!((interval.low..interval.high).contains(&found), "{found}");
    }
}

#[test]
fn settings_that_make_no_sense_are_named() {
    let mut study = study_on(&embedded(), Preset::Snug);
    study.model.effects = vec!["cubic_stifness".to_owned()];
    let text = study.check().unwrap_err().to_string();
    assert!(
        text.contains("`cubic_stifness` (did you mean `cubic_stiffness`?)")
            && text.contains("grip_slip"),
        "{text}"
    );
    let mut study = study_on(&embedded(), Preset::Snug);
    study.validation.ranges = vec!["tset".to_owned()];
    assert!(study.check().unwrap_err().to_string().contains("tset"));
    let mut study = study_on(&embedded(), Preset::Snug);
    study.record.gap_s = -1.0;
    assert!(study.check().unwrap_err().is_bad_argument());
    let mut study = study_on(&embedded(), Preset::Snug);
    let fixed = ParameterSettings {
        value: Some(-1.0),
        fixed: true,
        ..ParameterSettings::default()
    };
    study.model.parameters.insert("mass_kg".to_owned(), fixed);
    assert!(study.check().unwrap_err().to_string().contains("mass_kg"));
    let mut study = study_on(&embedded(), Preset::Snug);
    study.preprocess.rig.lever_arm_m = -0.33;
    assert!(
        study
            .check()
            .unwrap_err()
            .to_string()
            .contains("lever_arm_m")
    );
}

/// Without a spring nothing oscillates: light damping asks nothing, and the default constraints still work.
#[test]
fn a_stiffness_fixed_at_zero_can_be_identified() {
    let mut study = study_on(&embedded(), Preset::Snug);
    let fixed = ParameterSettings {
        value: Some(0.0),
        fixed: true,
        ..ParameterSettings::default()
    };
    study
        .model
        .parameters
        .insert("stiffness_n_per_m".to_owned(), fixed);
    let (outcome, _out) = run_study(&study).unwrap();
    let estimates: Vec<_> = outcome
        .result
        .tightenings
        .iter()
        .filter_map(|t| t.estimate.as_ref())
        .collect();
    assert_eq!(estimates.len(), 46);
    for estimate in estimates {
        assert_eq!(estimate.value("stiffness_n_per_m"), Some(0.0));
        assert!(estimate.value("mass_kg").unwrap() > 0.0);
    }
}
