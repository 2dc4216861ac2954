//! The thesis preset against an independent re-implementation of the original program.
//!
//! `thesis_preset/reference.csv` was made from the embedded campaign with NumPy and SciPy alone: cumulative trapezoids
//! from the segment's start, the 2999 samples from sample 14800 on, offset at the first local minimum, `lfilter` on the
//! zero-order-hold discretisation (`expm`), `least_squares` under I > 0, c ≥ 0, k ≥ 0, and an explicit Euler loop.
//! Empty rows are segments without a pulse or without a complete window.

use crate::campaign::{embedded, run_study, study_on};
use snug_campaign::{Quantity, TighteningResult};
use snug_study::{Preset, Study};

const REFERENCE: &str = include_str!("thesis_preset/reference.csv");

/// Parameters of tightenings that fit are compared; those of others are ill-determined.
const WELL_DETERMINED_FIT_PERCENT: f64 = 90.0;

#[test]
fn agrees_with_an_independent_reimplementation() {
    let (outcome, _out) = run_study(&study_on(&embedded(), Preset::Thesis)).unwrap();
    let results = &outcome.result.tightenings;
    let mut compared = 0;
    for row in REFERENCE.lines().skip(1) {
        let cells: Vec<&str> = row.split(',').collect();
        let result = results
            .iter()
            .find(|t| t.id.file == cells[0] && t.id.number.to_string() == cells[1])
            .unwrap();
        if cells[2].is_empty() {
            assert!(
                !result.selection.selected(),
                "{} has no usable window",
                result.id
            );
            continue;
        }
        let expected: Vec<f64> = cells[2..]
            .iter()
            .map(|cell| cell.parse().unwrap())
            .collect();
        compared += usize::from(compare(result, &expected));
    }
    assert!(compared >= 25, "only {compared} tightenings were compared");
}

/// Whether the tightening is well determined; then everything must agree.
fn compare(result: &TighteningResult, expected: &[f64]) -> bool {
    let [m, c, k, fit, accuracy, f1, f2, f3, target] = expected else {
        panic!("the reference has nine numbers a row");
    };
    let near = |what: &str, value: Option<f64>, expected: f64, relative: f64| {
        let value = value.unwrap_or(f64::NAN);
        assert!(
            (value - expected).abs() <= relative * expected.abs(),
            "{} {what}: {value} against {expected}",
            result.id
        );
    };
    assert_eq!(result.target_torque_nm, *target, "{}", result.id);
    near("F2", result.measures.peak_force_f2_n, *f2, 1e-9);
    let measures = &result.measures;
    let (here, there) = (measures.fit_percent.unwrap(), *fit);
    assert!(
        here > there - 1e-3,
        "{}: fit {here} against {there}",
        result.id
    );
    if there <= WELL_DETERMINED_FIT_PERCENT || *m <= 0.0 {
        return false;
    }
    let estimate = result.estimate.as_ref().unwrap();
    near("mass", estimate.value("mass_kg"), *m, 1e-3);
    near("damping", estimate.value("damping_kg_per_s"), *c, 1e-3);
    near("stiffness", estimate.value("stiffness_n_per_m"), *k, 1e-3);
    near("fit", measures.fit_percent, *fit, 1e-5);
    near("accuracy", measures.euler_accuracy_percent, *accuracy, 1e-5);
    near("F1", measures.peak_force_f1_n, *f1, 1e-3);
    near("F3", measures.peak_force_f3_n, *f3, 1e-3);
    assert!(
        result.selection.selected()
            || measures.thesis_damping_ratio.unwrap() > 1.0
            || result
                .selection
                .rejections
                .contains(&snug_campaign::Rejection::GoesDown),
        "{}: {:?}",
        result.id,
        result.selection.rejections
    );
    true
}

#[test]
fn naming_the_preset_in_a_study_file_is_the_same_as_asking_for_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("study.ron");
    std::fs::write(&path, "(preprocess: (preset: Thesis))").unwrap();
    let mut from_file = Study::read(&path).unwrap();
    from_file.set_data(&embedded());
    assert_eq!(from_file, study_on(&embedded(), Preset::Thesis));
}

#[test]
fn a_preset_keeps_what_the_study_states_itself() {
    let mut study = study_on(&embedded(), Preset::Snug);
    study.identify.fitted_output = Quantity::Velocity;
    let stated = study.clone();
    study.set_preset(Preset::Snug);
    assert_eq!(study, stated);
    study.set_preset(Preset::Thesis);
    assert_eq!(study.identify.fitted_output, Quantity::Velocity);
}
