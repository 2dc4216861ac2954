//! Rigs that are no nutrunner, described in a study file: an electronic oscillator and a pendulum.

use crate::campaign::{run_study, study_file};
use snug_campaign::Rejection;
use snug_study::{Outcome, Study};
use tempfile::TempDir;

/// Published root-mean-square errors of linear models \[V\], on multisine test, arrow without extrapolation, full arrow.
const WITHOUT_OFFSET: [f64; 3] = [8.63e-3, 8.41e-3, 15.32e-3];
const WITH_OFFSET: [f64; 3] = [6.96e-3, 6.58e-3, 14.41e-3];

#[test]
fn silverbox_reaches_the_published_linear_result() {
    let Some(data) = snug_tests::data("Silverbox") else {
        return;
    };
    for (effects, expected) in [
        (vec![], WITHOUT_OFFSET),
        (vec!["output_offset"], WITH_OFFSET),
    ] {
        let mut study = Study::read(&study_file("silverbox.ron")).unwrap();
        study.set_data(&data.join("silverbox/SNLS80mV.csv"));
        study.model.effects = effects.into_iter().map(str::to_owned).collect();
        let (outcome, out) = run_study(&study).unwrap();
        volts_are_no_torques(&outcome, &out);
        let errors: Vec<f64> = outcome
            .result
            .tightenings
            .iter()
            .filter(|t| t.selection.rejections.contains(&Rejection::Validation))
            .map(|t| t.measures.rms_displacement_rad.unwrap())
            .collect();
        assert_eq!(errors.len(), 3);
        for (error, expected) in errors.iter().zip(expected) {
            assert!(
                (error / expected - 1.0).abs() < 0.01,
                "{error} against {expected}"
            );
        }
    }
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

/// The plant is a pendulum of known inertia and damping; a linear spring cannot be right, but the run must say so calmly.
#[test]
fn a_pendulum_runs_and_is_told_apart_from_a_spring() {
    let Some(data) = snug_tests::data("pendulum") else {
        return;
    };
    let mut study = Study::read(&study_file("pendulum.ron")).unwrap();
    study.set_data(&data.join("pendulum-torque/pd_sysid_measured.csv"));
    let (outcome, _out) = run_study(&study).unwrap();
    let tightening = &outcome.result.tightenings[0];
    assert!(tightening.estimate.is_some());
    assert_eq!(tightening.selection.rejections, [Rejection::PoorFit]);
}
