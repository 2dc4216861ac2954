//! One settling, one truth: whoever runs the study that a search wrote gets the numbers of its last rung.

use crate::coarse;
use crate::people_sealed::long_files;
use snug_campaign::Factor;
use snug_study::{RunSettings, Study, Verb, diagnose, run};
use snug_synthetic::{CampaignPlan, HiddenEffect, Whose};
use std::path::Path;
use std::sync::atomic::AtomicBool;

fn quiet(_: snug_study::ProgressEvent<'_>) {}

/// The study's data searched, and what came of it run again: table by table.
fn tables(study: &Study, verb: &Verb) -> [String; 2] {
    let (first, again) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let never = AtomicBool::new(false);
    diagnose(study, verb, &RunSettings::new(first.path()), &quiet, &never).unwrap();
    let written = Study::read(&first.path().join("study.ron")).unwrap();
    run(&written, &RunSettings::new(again.path()), &quiet, &never).unwrap();
    let table = |out: &Path| std::fs::read_to_string(out.join("tightenings.csv")).unwrap();
    [table(first.path()), table(again.path())]
}

fn assert_same(study: &Study, verb: &Verb) {
    let [found, again] = tables(study, verb);
    assert_eq!(found, again, "{} by {verb:?}", study.title());
}

fn rig(data: &Path, columns: &str, sampling: &str, fitted: &str) -> Study {
    let text = format!(
        "(source: (path: {data:?}, format: Csv(channels: [{columns}], sampling: {sampling})), \
         preprocess: (window: Whole, rig: (lever_arm_m: 1.0, known_inertia: Fixed(0.0))), \
         identify: (fitted_output: {fitted}, constraints: [Positive]))"
    );
    Study::parse(&text, Path::new("rig.ron")).unwrap()
}

#[test]
fn the_study_of_a_robot_arm_runs_as_it_was_found() {
    let Some(data) = snug_tests::data("DaISy") else {
        return;
    };
    let columns = r#"(column: Name("u"), signal: Torque, unit: One),
        (column: Name("y"), signal: Acceleration, unit: RadianPerSecondSquared)"#;
    let arm = data.join("daisy/robot-arm.csv");
    let study = rig(&arm, columns, "Rate(hz: 500.0)", "Acceleration");
    for verb in [
        Verb::Compare,
        Verb::Add(vec!["torque_delay".into()]),
        Verb::Improve,
    ] {
        assert_same(&study, &verb);
    }
}

#[test]
fn the_study_of_two_tanks_runs_as_it_was_found() {
    let Some(data) = snug_tests::data("cascaded tanks") else {
        return;
    };
    let columns = r#"(column: Name("uEst"), signal: Torque, unit: Volt),
        (column: Name("yEst"), signal: Displacement, unit: Volt)"#;
    let tanks = data.join("cascaded-tanks/dataBenchmark.csv");
    assert_same(
        &rig(&tanks, columns, "Rate(hz: 0.25)", "Displacement"),
        &Verb::Improve,
    );
}

/// A motor with dry friction, from its equation: V = 0.2 sgn v + 1.9 v + 0.11 dv/dt, driven to and fro.
#[test]
fn the_study_of_a_motor_runs_as_it_was_found_and_so_does_the_first_one() {
    let folder = tempfile::tempdir().unwrap();
    let table = folder.path().join("motor.csv");
    std::fs::write(&table, motor()).unwrap();
    let columns = r#"(column: Name("volt"), signal: Torque, unit: Volt),
        (column: Name("speed"), signal: Velocity, unit: RadianPerSecond)"#;
    let study = rig(&table, columns, "Rate(hz: 200.0)", "Velocity");
    assert_same(&study, &Verb::Improve);
    // What the study leaves open is settled for a run as it is for a comparison.
    let never = AtomicBool::new(false);
    let (compared, ran) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let of_compare = RunSettings::new(compared.path());
    let compared = diagnose(&study, &Verb::Compare, &of_compare, &quiet, &never).unwrap();
    let ran = run(&study, &RunSettings::new(ran.path()), &quiet, &never).unwrap();
    assert_eq!(compared.result.study_ron, ran.result.study_ron);
    assert_eq!(compared.result.tightenings, ran.result.tightenings);
}

/// Of four people two brake the tool by dry friction: each group's size stands in the study that was written, and gives the same
/// numbers again; so do ranges that are kept for validation.
#[test]
fn the_study_of_people_who_differ_runs_as_it_was_found() {
    let plan = CampaignPlan::of_size(8, 4).hiding(HiddenEffect::CoulombFriction, 1.0);
    let plan = plan.of(Whose::Participants(vec![1, 3]));
    let folder = tempfile::tempdir().unwrap();
    let study = coarse::study(plan, 5, folder.path());
    let verb = Verb::Add(vec!["coulomb_friction".into()]);
    let out = tempfile::tempdir().unwrap();
    let never = AtomicBool::new(false);
    diagnose(&study, &verb, &RunSettings::new(out.path()), &quiet, &never).unwrap();
    let written = Study::read(&out.path().join("study.ron")).unwrap();
    let by_group = written.model.parameters["fc_n"].by_group.clone().unwrap();
    assert_eq!(by_group.factor, Factor::Participant);
    assert_same(&study, &verb);
}

fn motor() -> String {
    let (interval_s, steps) = (0.005, 50);
    let step_s = interval_s / f64::from(steps);
    let (mut speed, mut rows) = (0.0_f64, String::from("volt,speed\n"));
    for sample in 0..3000 {
        let t_s = f64::from(sample) * interval_s;
        let volt = 3.0 * (1.3 * t_s).sin() + 2.0 * (3.7 * t_s + 1.0).sin();
        rows += &format!("{volt},{speed}\n");
        for _ in 0..steps {
            let drive = volt - 1.9 * speed;
            let friction = match speed.abs() < 1e-4 {
                true => drive.clamp(-0.2, 0.2),
                false => 0.2 * speed.signum(),
            };
            speed += step_s * (drive - friction) / 0.11;
        }
    }
    rows
}

/// Of every form in which a size may depend on time: the study says it so that it means the same again.
#[test]
fn sizes_that_change_in_time_run_as_they_were_found() {
    for (whose, is_it) in [
        (
            Whose::FromNumber(5),
            (|factor| *factor == Factor::FromNumber(5)) as fn(&Factor) -> bool,
        ),
        (
            Whose::Since(3, 4),
            |factor| matches!(factor, Factor::Since(id) if id.number == 4),
        ),
        (Whose::Growing(0.0, 1.5), |factor| {
            *factor == Factor::Course { first: 1, last: 8 }
        }),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let plan = long_files()
            .hiding(HiddenEffect::CoulombFriction, 1.0)
            .of(whose.clone());
        let study = coarse::study(plan, 3, folder.path());
        let add = Verb::Add(vec!["coulomb_friction".into()]);
        let out = folder.path().join("out");
        let never = AtomicBool::new(false);
        let outcome = diagnose(&study, &add, &RunSettings::new(&out), &quiet, &never).unwrap();
        let diagnosis = outcome.result.diagnosis.unwrap();
        let by_group = diagnosis.added[0].parameters[0].by_group.as_ref();
        let factor = &by_group.expect("it changes").factor;
        assert!(is_it(factor), "{whose:?}: {factor:?}");
        let written = Study::read(&out.join("study.ron")).unwrap();
        let again = folder.path().join("again");
        run(&written, &RunSettings::new(&again), &quiet, &never).unwrap();
        let table = |out: &Path| std::fs::read_to_string(out.join("tightenings.csv")).unwrap();
        assert_eq!(table(&out), table(&again), "{whose:?}");
    }
}
