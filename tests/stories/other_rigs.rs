//! Rigs that are no nutrunner, described in a study file: an electronic oscillator and a pendulum.

use crate::campaign::{run_study, study_file};
use snug_campaign::words::headline::Headline;
use snug_campaign::{Rejection, Verdict};
use snug_identify::Simulation;
use snug_study::{Outcome, RunSettings, Study, Verb, diagnose};
use std::sync::atomic::AtomicBool;
use std::time::Instant;
use tempfile::TempDir;

/// Root-mean-square errors in a free run \[V\], on multisine test, arrow without extrapolation, full arrow: published for linear
/// models, and of a cubic spring with both offsets as an independent program found them.
const WITHOUT_OFFSET: [f64; 3] = [8.63e-3, 8.41e-3, 15.32e-3];
const WITH_OFFSET: [f64; 3] = [6.96e-3, 6.58e-3, 14.41e-3];
const WITH_SPRING: [f64; 3] = [0.33e-3, 0.32e-3, 0.39e-3];

#[test]
fn silverbox_is_predicted_as_well_as_published() {
    let Some(data) = snug_tests::data("Silverbox") else {
        return;
    };
    for (effects, expected) in [
        (vec![], WITHOUT_OFFSET),
        (vec!["output_offset"], WITH_OFFSET),
        (
            vec!["cubic_stiffness", "torque_offset", "output_offset"],
            WITH_SPRING,
        ),
    ] {
        let mut study = Study::read(&study_file("silverbox.ron")).unwrap();
        study.set_data(&data.join("silverbox/SNLS80mV.csv"));
        study.model.effects = effects.into_iter().map(str::to_owned).collect();
        let (outcome, out) = run_study(&study).unwrap();
        volts_are_no_torques(&outcome, &out);
        let errors = errors_of_predictions(&outcome);
        assert_eq!(errors.len(), 3);
        for (error, expected) in errors.iter().zip(expected) {
            // The figures have two digits where they are small.
            let rounding = if expected < 1e-3 { 0.015 } else { 0.0 };
            assert!(
                (error / expected - 1.0).abs() < 0.01 + rounding,
                "{error} against {expected}"
            );
        }
    }
}

/// Root-mean-square errors of the ranges that are kept for validation, in a free run \[V\].
fn errors_of_predictions(outcome: &Outcome) -> Vec<f64> {
    let tightenings = outcome.result.tightenings.iter();
    tightenings
        .filter(|t| t.selection.rejections.contains(&Rejection::Validation))
        .map(|t| t.validation.unwrap().free_run.rms.unwrap())
        .collect()
}

/// What is told of it, and predicted with it, within two minutes on two cores.
#[test]
fn silverbox_lacks_a_cubic_spring_and_an_offset() {
    if !snug_tests::long("what Silverbox lacks") {
        return;
    }
    let Some(data) = snug_tests::data("Silverbox") else {
        return;
    };
    let mut study = Study::read(&study_file("silverbox.ron")).unwrap();
    study.set_data(&data.join("silverbox/SNLS80mV.csv"));
    let (out, began) = (tempfile::tempdir().unwrap(), Instant::now());
    let (settings, never) = (RunSettings::new(out.path()), AtomicBool::new(false));
    let outcome = diagnose(&study, &Verb::Improve, &settings, &|_| (), &never).unwrap();
    let took_s = began.elapsed().as_secs_f64();
    let errors = errors_of_predictions(&outcome);
    let diagnosis = outcome.result.diagnosis.unwrap();
    let added: Vec<&str> = diagnosis
        .added
        .iter()
        .map(|one| one.effect.as_str())
        .collect();
    assert_eq!(
        added[..2],
        ["cubic_stiffness", "torque_offset"],
        "{}",
        diagnosis.headline
    );
    assert_eq!(
        diagnosis.verdict,
        Verdict::Adequate,
        "{}",
        diagnosis.headline
    );
    assert_eq!(errors.len(), 3);
    let mut beside = errors.iter().zip(WITH_SPRING);
    assert!(
        beside.all(|(error, with_spring)| *error < with_spring),
        "{errors:?}"
    );
    assert!(took_s < 120.0, "{took_s} s");
}

fn volts_are_no_torques(outcome: &Outcome, out: &TempDir) {
    let by_target = |factor: &str| factor == "target_torque_nm";
    assert!(
        !outcome
            .result
            .conditions
            .iter()
            .any(|c| by_target(&c.factor))
    );
    let page = std::fs::read_to_string(out.path().join("report.html")).unwrap();
    assert!(page.contains("output [V]") && !page.contains("angle θ [rad]"));
    assert!(!page.contains("target torque [Nm]"));
    let table = std::fs::read_to_string(out.path().join("tightenings.csv")).unwrap();
    for row in table.lines().skip(1) {
        assert_eq!(row.split(',').nth(6), Some(""), "target torque of {row}");
    }
}

/// The plant is a pendulum of known inertia and damping; a linear spring cannot be right, but the run must say so calmly: it is
/// rejected, run freely as the study that says nothing of it settles, since with gravity it would follow.
#[test]
fn a_pendulum_runs_and_is_told_apart_from_a_spring() {
    let Some(data) = snug_tests::data("pendulum") else {
        return;
    };
    let mut study = Study::read(&study_file("pendulum.ron")).unwrap();
    study.set_data(&data.join("pendulum-torque/pd_sysid_measured.csv"));
    let (settled, _out) = run_study(&study).unwrap();
    study.identify.simulation = Simulation::FreeRun;
    let (freely, _out) = run_study(&study).unwrap();
    for outcome in [settled, freely] {
        let tightening = &outcome.result.tightenings[0];
        assert!(tightening.estimate.is_some());
        assert_eq!(tightening.selection.rejections, [Rejection::PoorFit]);
    }
}

/// Where no one effect makes a free run follow, the run restarts the model and tells how much the free one misses.
#[test]
fn a_pendulum_that_nothing_follows_freely_is_restarted_and_told() {
    let Some(data) = snug_tests::data("pendulum") else {
        return;
    };
    let mut study = Study::read(&study_file("pendulum.ron")).unwrap();
    study.set_data(&data.join("pendulum-torque/ilqr_measured.csv"));
    let (outcome, _out) = run_study(&study).unwrap();
    assert!(outcome.result.tightenings[0].estimate.is_some());
    let notes = outcome.result.findings.iter();
    let settled: Vec<_> = notes.filter(|note| note.code == "settled").collect();
    let [note] = settled.as_slice() else {
        panic!("{settled:?}")
    };
    assert!(note.message.starts_with("Run freely"), "{}", note.message);
}

/// Three recordings of the published set, driven by three different controllers: each says that gravity is missing, a
/// force that goes with the sine of the angle, and no spring of any other shape.
#[test]
fn a_pendulum_asks_for_gravity() {
    let Some(data) = snug_tests::data("pendulum") else {
        return;
    };
    for recording in ["pd_sysid", "direct_collocation", "ilqr"] {
        let mut study = Study::read(&study_file("pendulum.ron")).unwrap();
        study.set_data(&data.join(format!("pendulum-torque/{recording}_measured.csv")));
        let out = tempfile::tempdir().unwrap();
        let settings = RunSettings::new(out.path());
        let quiet = |_: snug_study::ProgressEvent<'_>| ();
        let outcome = diagnose(
            &study,
            &Verb::Improve,
            &settings,
            &quiet,
            &AtomicBool::new(false),
        );
        let diagnosis = outcome.unwrap().result.diagnosis.unwrap();
        assert_eq!(diagnosis.added[0].effect, "gravity_torque", "{recording}");
        // With gravity in its place the spring is at its least, which is no fault of the fit.
        let selected = |rung: usize| diagnosis.ladder[rung].selected_fraction;
        assert!(selected(1) >= selected(0), "{recording}");
        let error = |rung: usize| diagnosis.ladder[rung].rms_displacement_rad.unwrap();
        assert!(
            error(1) < error(0) / 3.0,
            "{recording}: {} to {}",
            error(0),
            error(1)
        );
        // A body of some 0.5 kg at 0.5 m, as the rig's authors say: m g l of 2 to 3 Nm. The logged torque is too large
        // for it by a factor that nobody has explained (see the set's provenance), so no more than this is asked.
        let torque_nm = -diagnosis.added[0].parameters[0].value;
        assert!(
            (1.5..6.0).contains(&torque_nm),
            "{recording}: {torque_nm} Nm"
        );
        let Headline::Adequate { explained, .. } = &diagnosis.headline else {
            panic!("{recording}: {}", diagnosis.headline)
        };
        assert!(explained.is_some_and(|all| all.share > 0.98), "{recording}");
        let written = std::fs::read_to_string(out.path().join("study.ron")).unwrap();
        // Two are followed over the whole record at once; the third is taken up again and again, and that is said.
        let is_restarted = recording == "ilqr";
        let simulation = ["simulation: FreeRun", "simulation: Restarted"];
        assert!(written.contains(simulation[usize::from(is_restarted)]));
        let mut reasons = diagnosis.reasons.iter().map(ToString::to_string);
        let is_told = reasons.any(|reason| reason.contains("Restarted"));
        assert_eq!(is_told, is_restarted, "{recording}");
    }
}
