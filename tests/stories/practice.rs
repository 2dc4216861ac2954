//! The practice campaigns with known truth: nothing hidden (A), and the thesis' disaster (D).

use crate::campaign::{run_study, study_on};
use snug_study::Preset;

#[test]
fn without_a_hidden_effect_only_noise_is_left() {
    let Some(practice) = snug_tests::practice("campaign A") else {
        return;
    };
    for preset in [Preset::Snug, Preset::Thesis] {
        let (outcome, _out) = run_study(&study_on(&practice.join("A"), preset)).unwrap();
        assert_eq!(outcome.result.presets[0].selected, 24, "{preset:?}");
        assert!(outcome.result.findings.is_empty());
    }
}

/// A bias that the original integrates rejects everything; measured in the quiet part, nothing is lost and it is named.
#[test]
fn an_accelerometer_bias_is_measured_corrected_and_named() {
    let Some(practice) = snug_tests::practice("campaign D") else {
        return;
    };
    let (outcome, _out) = run_study(&study_on(&practice.join("D"), Preset::Snug)).unwrap();
    let [snug, thesis] = &outcome.result.presets[..] else {
        panic!("both presets are reported");
    };
    assert_eq!((snug.selected, thesis.selected), (24, 0));
    let truth = std::fs::read_to_string(practice.join("D.truth.json")).unwrap();
    let truth: serde_json::Value = serde_json::from_str(&truth).unwrap();
    for (tightening, truth) in outcome
        .result
        .tightenings
        .iter()
        .zip(truth["tightenings"].as_array().unwrap())
    {
        let bias = tightening
            .corrections
            .iter()
            .find(|correction| correction.effect == "acceleration_bias")
            .unwrap();
        let error = bias.value - truth["bias"].as_f64().unwrap();
        assert!(bias.significant, "{}", tightening.id);
        assert!(
            error.abs() < 4.0 * bias.standard_error,
            "{}: {error}",
            tightening.id
        );
    }
}
