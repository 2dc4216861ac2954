//! A diagnosis as its topics hold it: every field in its schema, and the ladder readable as numbers.

use super::small_chunks;
use crate::recorder::Recorder;
use crate::{read, topic};
use serde_json::Value;
use snug_campaign::words::headline::{Headline, Left};
use snug_campaign::words::reason::Reason;
use snug_campaign::words::remark::Remark;
use snug_campaign::*;

fn rung(effects: &[&str], error: Option<f64>, target: Option<f64>) -> Rung {
    Rung {
        effects: effects.iter().map(|name| (*name).into()).collect(),
        error_over_noise: error,
        heldout_error_over_noise: error,
        heldout_target_error_over_noise: target,
        heldout_participant_error_over_noise: None,
        rms_fitted_output: 1.25,
        rms_displacement_rad: Some(1.0 / 3.0),
        fit_percent_median: Some(f64::NAN),
        selected_fraction: 0.96,
        ranking: vec![],
    }
}

fn candidate(effect: &str, gain: f64) -> RankedEffect {
    RankedEffect {
        effect: effect.into(),
        kind: "mechanical".into(),
        unlisted: false,
        expression: None,
        parameters: vec![EffectParameter {
            name: "k3_n_per_m3".into(),
            meaning: "cubic stiffness".into(),
            unit: "N/m^3".into(),
            value: 9.9e5,
            low: Some(9.6e5),
            high: None,
            standard_error: None,
            per_tightening: false,
            spread: None,
            minimum: -5e6,
            maximum: 5e6,
            by_group: None,
        }],
        score: 11.0,
        p_family: 0.001,
        heldout_gain: gain,
        heldout_gain_error: 0.04,
        error_over_noise: None,
        behind_first: 0.0,
        supported: true,
        twins: vec!["quadratic_stiffness".into()],
        plausible: true,
        explanation: vec!["A spring that hardens.".into()],
    }
}

fn diagnosis() -> Diagnosis {
    Diagnosis {
        verb: "improve".into(),
        verdict: Verdict::MissingEffect,
        headline: Headline::Unexplained(Left::over_noise(6.4)),
        reasons: vec![Reason::NoiseUnknown {
            left: Left::of_output(0.5, Quantity::Velocity, &SignalUnits::default()),
            beside_lines: false,
        }],
        level: 0.05,
        stopped: None,
        interrupted: false,
        tightenings: 24,
        noise: NoiseStatement {
            source: "pre_roll".into(),
            acceleration_rad_per_s2: Some(0.5),
        },
        compared_output: "acceleration".into(),
        added: vec![],
        corrected: vec![],
        ladder: vec![
            rung(&[], Some(6.42), None),
            rung(&["cubic_stiffness"], Some(1.38), Some(1.4)),
            rung(&["cubic_stiffness", "torque_delay"], None, None),
        ],
        ranking: vec![
            candidate("cubic_stiffness", 0.83),
            candidate("coulomb_friction", -0.1),
        ],
        removals: vec![],
        comparison: Comparison::default(),
        location: Location {
            remarks: vec![Remark::SpreadOut],
            ..Location::default()
        },
        final_location: None,
        drift: vec![],
        detectability: vec![],
        control: None,
        unlisted: None,
        experiment: None,
        work: WorkDone::default(),
    }
}

/// Every JSON message of a topic with its schema and its time in seconds.
fn messages(bytes: &[u8], wanted: &str) -> Vec<(Value, Value, f64)> {
    mcap::MessageStream::new(bytes)
        .unwrap()
        .map(Result::unwrap)
        .filter(|message| message.channel.topic == wanted)
        .map(|message| {
            let schema = message.channel.schema.clone().unwrap();
            assert_eq!(schema.encoding, "jsonschema");
            (
                serde_json::from_slice(&message.data).unwrap(),
                serde_json::from_slice(&schema.data).unwrap(),
                message.log_time as f64 * 1e-9,
            )
        })
        .collect()
}

fn recorded() -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut recorder = Recorder::new(&mut bytes, small_chunks()).unwrap();
    recorder.diagnosis(&diagnosis()).unwrap();
    recorder.finish().unwrap();
    bytes
}

#[test]
fn the_verdict_the_ladder_and_the_ranking_come_back() {
    let bytes = recorded();
    let verdict = &messages(&bytes, topic::VERDICT)[0];
    assert_eq!(verdict.0["verdict"], "missing_effect");
    assert_eq!(
        verdict.0["where_it_fails"][0],
        Remark::SpreadOut.to_string()
    );
    assert_eq!(verdict.0["noise"]["acceleration_rad_per_s2"], 0.5);
    let ladder = messages(&bytes, topic::LADDER);
    assert_eq!(ladder.len(), 3);
    assert_eq!(ladder[1].0["place"], 2);
    assert_eq!(ladder[1].0["effects"][0], "cubic_stiffness");
    assert_eq!(ladder[1].0["heldout_target_error_over_noise"], 1.4);
    assert_eq!(ladder[2].0["rms_displacement_rad"], 1.0 / 3.0);
    assert!(ladder[2].0.get("error_over_noise").is_none(), "not known");
    assert!(
        ladder[0].0.get("fit_percent_median").is_none(),
        "not finite"
    );
    let ranking = messages(&bytes, topic::RANKING);
    assert_eq!(ranking[0].0["parameters"][0]["value"], 9.9e5);
    assert_eq!(ranking[0].0["twins"][0], "quadratic_stiffness");
    assert_eq!(ranking[1].0["heldout_gain"], -0.1);
    assert!(ladder[0].2 < ladder[1].2 && ranking[0].2 < ranking[1].2);
    assert_eq!(ladder[0].0["step"], "mass, damper, spring");
    assert_eq!(ladder[2].0["step"], "+ torque delay");
}

/// Friction beside the first model, then beside the last: √(6.42² − 1) and the root mean square of the last, whose noise is not known.
#[test]
fn every_rung_keeps_its_candidates_with_what_became_of_them() {
    let mut found = diagnosis();
    found.ladder[0].ranking = vec![
        candidate("cubic_stiffness", 0.9),
        candidate("coulomb_friction", 0.3),
    ];
    found.ladder[1].ranking = vec![
        candidate("torque_delay", 0.5),
        candidate("coulomb_friction", 0.2),
    ];
    let mut bytes = Vec::new();
    let mut recorder = Recorder::new(&mut bytes, small_chunks()).unwrap();
    recorder.diagnosis(&found).unwrap();
    recorder.finish().unwrap();
    let ranking = messages(&bytes, topic::RANKING);
    let places: Vec<(u64, u64)> = (ranking.iter())
        .map(|(one, ..)| {
            (
                one["rung"].as_u64().unwrap(),
                one["place"].as_u64().unwrap(),
            )
        })
        .collect();
    assert_eq!(places, [(1, 1), (1, 2), (2, 1), (2, 2), (3, 1), (3, 2)]);
    assert_eq!(ranking[0].0["added_next"], true);
    let left = ranking[1].0["gain_beside_next"].as_f64().unwrap();
    let expected = 0.2 * (1.38_f64.powi(2) - 1.0) / (6.42_f64.powi(2) - 1.0);
    assert!((left / expected - 1.0).abs() < 1e-9, "{left} {expected}");
    assert!(
        ranking[5].0.get("gain_beside_next").is_none(),
        "nothing is ranked any more"
    );
    assert!(
        messages(&bytes, topic::LADDER)[0]
            .0
            .get("ranking")
            .is_none()
    );
}

#[test]
fn every_field_is_in_its_schema_with_its_unit() {
    let bytes = recorded();
    for wanted in [topic::VERDICT, topic::LADDER, topic::RANKING] {
        for (message, schema, _) in messages(&bytes, wanted) {
            for name in message.as_object().unwrap().keys() {
                let property = &schema["properties"][name];
                assert!(property["type"].is_string(), "{wanted} {name}");
            }
        }
    }
    let schema = &messages(&bytes, topic::LADDER)[0].1;
    assert_eq!(schema["properties"]["rms_displacement_rad"]["unit"], "rad");
}

#[test]
fn the_ladder_reads_back_as_numbers() {
    let channels = read::numeric_channels(&recorded()).unwrap();
    let error = channels.channel(topic::LADDER, "error_over_noise").unwrap();
    assert_eq!(error.values, [6.42, 1.38]);
    let gain = channels.channel(topic::RANKING, "heldout_gain").unwrap();
    assert_eq!(gain.values, [0.83, -0.1]);
}

#[test]
fn an_empty_diagnosis_is_a_verdict_alone() {
    let mut found = diagnosis();
    found.ladder.clear();
    found.ranking.clear();
    let mut bytes = Vec::new();
    let mut recorder = Recorder::new(&mut bytes, small_chunks()).unwrap();
    recorder.diagnosis(&found).unwrap();
    recorder.finish().unwrap();
    assert_eq!(messages(&bytes, topic::VERDICT).len(), 1);
    assert!(messages(&bytes, topic::LADDER).is_empty());
}
