//! The practice campaigns with known truth: nothing hidden (A), the thesis' disaster (D), and effects whose size scatters between
//! people (F) or that three of six have (G).

use crate::campaign::{diagnose_study, run_study, study_on};
use snug_campaign::{EffectParameter, Factor};
use snug_study::{Preset, Verb};
use std::path::Path;

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

/// The hidden effect's size of every participant, 0 for those without it.
fn sizes_of_people(practice: &Path, campaign: &str, effect: &str) -> Vec<f64> {
    let truth = std::fs::read_to_string(practice.join(format!("{campaign}.truth.json"))).unwrap();
    let truth: serde_json::Value = serde_json::from_str(&truth).unwrap();
    let mut sizes = vec![0.0; 6];
    for tightening in truth["tightenings"].as_array().unwrap() {
        let person = tightening["participant"].as_u64().unwrap() as usize;
        sizes[person - 1] = tightening["used"][effect][0].as_f64().unwrap_or(0.0);
    }
    sizes
}

/// Improves, and gives the size of the only effect that was added.
fn improved(practice: &Path, campaign: &str, effect: &str) -> EffectParameter {
    let study = study_on(&practice.join(campaign), Preset::Snug);
    let (outcome, _out) = diagnose_study(&study, &Verb::Improve);
    let diagnosis = outcome.result.diagnosis.as_ref().unwrap();
    let [added] = diagnosis.added.as_slice() else {
        panic!("{:?}", diagnosis.added);
    };
    assert_eq!(added.effect, effect);
    let error = diagnosis.ladder.last().unwrap().error_over_noise.unwrap();
    assert!(error <= 1.02, "{error}");
    added.parameters[0].clone()
}

#[test]
fn people_have_more_or_less_of_an_effect_or_none() {
    let Some(practice) = snug_tests::practice("campaigns F and G") else {
        return;
    };
    for (campaign, effect) in [("F", "maxwell_branch"), ("G", "coulomb_friction")] {
        let size = improved(&practice, campaign, effect);
        let by_group = size.by_group.expect("people differ");
        assert_eq!(by_group.factor, Factor::Participant);
        let truth = sizes_of_people(&practice, campaign, effect);
        for (group, truth) in by_group.groups.iter().zip(truth) {
            assert_eq!(group.present, truth != 0.0, "{campaign}, {}", group.group);
            let error = group.standard_error.unwrap();
            // Of twelve sizes one is further off than 3.5 errors with a chance of 0.6 %.
            assert!(
                (group.value - truth).abs() < 3.5 * error,
                "{campaign}, {}",
                group.group
            );
        }
    }
}
