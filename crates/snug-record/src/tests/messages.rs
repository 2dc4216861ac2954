//! Every JSON message against the schema that stands beside it, as viewers read it.

use super::tightenings;
use crate::recorder::Recorder;
use crate::settings::RecordSettings;
use crate::topic;
use serde_json::Value;
use snug_campaign::*;
use std::collections::HashMap;

/// Checks a value against a schema of the kind viewers read: one type per property, every property described.
fn conforms(value: &Value, schema: &Value, path: &str) {
    let kind = schema["type"]
        .as_str()
        .unwrap_or_else(|| panic!("{path}: no single type"));
    let fits = match kind {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "boolean" => value.is_boolean(),
        "number" => value.is_number(),
        "integer" => value.is_u64(),
        other => panic!("{path}: type {other}"),
    };
    assert!(fits, "{path}: {value} is no {kind}");
    if let Value::Object(fields) = value {
        for (name, field) in fields {
            let path = format!("{path}.{name}");
            let property = &schema["properties"][name];
            assert!(property.is_object(), "{path} is not in the schema");
            assert!(property["title"].is_string(), "{path}: no title");
            assert!(
                property["description"].is_string(),
                "{path}: no description"
            );
            conforms(field, property, &path);
        }
    }
    for (index, item) in value.as_array().into_iter().flatten().enumerate() {
        conforms(item, &schema["items"], &format!("{path}[{index}]"));
    }
}

#[derive(serde::Serialize)]
struct Verdict {
    verdict: &'static str,
    ranking: Vec<(&'static str, f64)>,
    noise: Option<f64>,
    later: Option<Vec<u32>>,
}

fn full_recording() -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut recorder = Recorder::new(&mut bytes, RecordSettings::default()).unwrap();
    for (result, traces) in &tightenings() {
        recorder.tightening(result, traces, Some(3)).unwrap();
    }
    for severity in [Severity::Note, Severity::LeftOut] {
        let finding = Finding {
            severity,
            code: "saturation".into(),
            file: "a.mat".into(),
            tightening: (severity == Severity::LeftOut).then_some(4),
            channel: Some("Inline".into()),
            message: "12 samples at 40 N m".into(),
        };
        recorder.finding(&finding).unwrap();
    }
    let moments = Moments {
        count: 3,
        mean: 2.3,
        standard_deviation: Some(1.3),
        mean_interval: Some(Interval {
            low: 1.0,
            high: 3.0,
        }),
        median: 2.2,
    };
    let condition = ConditionSummary {
        factor: "joint".into(),
        level: "Soft".into(),
        tightenings: 5,
        selected: 3,
        selected_share_interval: Some(Interval {
            low: 0.2,
            high: 0.9,
        }),
        quantities: vec![QuantitySummary {
            quantity: "mass_kg".into(),
            selected: Some(moments),
            rejected: None,
        }],
    };
    let test = TestRow {
        quantity: "mass_kg".into(),
        factor: "joint".into(),
        method: "welch_t".into(),
        respects_participants: false,
        statistic_name: "t".into(),
        statistic: Some(-2.1),
        degrees_of_freedom: vec![7.3],
        p: Some(0.07),
        p_adjusted: Some(0.1),
        effect_size: Some(EffectSize {
            name: "hedges_g".into(),
            value: -0.8,
            interval: None,
        }),
        assumptions: vec![AssumptionCheck {
            assumption: "normal_residuals".into(),
            method: "shapiro_wilk".into(),
            statistic_name: "W".into(),
            statistic: Some(0.97),
            degrees_of_freedom: vec![],
            p: Some(0.4),
            values: 21,
            groups: 2,
            tied: 0,
            note: None,
        }],
        note: Some("few values".into()),
    };
    recorder.statistics(&[condition], &[test]).unwrap();
    for later in [None, Some(vec![1, 2])] {
        let verdict = Verdict {
            verdict: "undecided",
            ranking: vec![("cubic_stiffness", 0.4)],
            noise: None,
            later,
        };
        recorder.json("/verdict", "snug.Verdict", &verdict).unwrap();
    }
    recorder.json("/count", "snug.Count", &3).unwrap();
    recorder.finish().unwrap();
    bytes
}

#[test]
fn every_json_message_fits_its_schema() {
    let mut messages: HashMap<String, Vec<Value>> = HashMap::new();
    let bytes = full_recording();
    for message in mcap::MessageStream::new(&bytes).unwrap() {
        let message = message.unwrap();
        let schema = message
            .channel
            .schema
            .clone()
            .expect("every channel has a schema");
        if message.channel.message_encoding == "json" {
            assert_eq!(schema.encoding, "jsonschema");
            let value: Value = serde_json::from_slice(&message.data).unwrap();
            let schema: Value = serde_json::from_slice(&schema.data).unwrap();
            conforms(&value, &schema, &message.channel.topic);
            let topic = message.channel.topic.clone();
            messages.entry(topic).or_default().push(value);
        }
    }
    assert_eq!(messages.len(), 8);
    let estimates = &messages[topic::ESTIMATE];
    assert_eq!(estimates[0]["parameters"][0]["high"], 1.8);
    assert_eq!(estimates[0]["status"], "converged_at_constraint");
    assert_eq!(
        estimates[0]["identifiability"]["strongest_correlation"]["correlation"],
        -0.9
    );
    assert!(
        estimates[0]["measures"].get("peak_force_f1_n").is_none(),
        "infinite"
    );
    assert!(estimates[3].get("parameters").is_none(), "no estimate");
    assert_eq!(estimates[3]["rejections"][1], "goes_up");
    assert_eq!(messages[topic::LOG][1]["level"], 4);
    assert_eq!(messages[topic::LOG][1]["timestamp"]["sec"], 2);
    assert_eq!(messages["/verdict"][1]["later"][1], 2);
    assert_eq!(messages["/count"][0]["value"], 3);
}

#[test]
fn settings_keep_their_defaults_and_refuse_typos() {
    let settings: RecordSettings = serde_json::from_str("{\"gap_s\": 1.0}").unwrap();
    assert_eq!(settings.samples, RecordSettings::default().samples);
    assert!(serde_json::from_str::<RecordSettings>("{\"gap\": 1.0}").is_err());
}
