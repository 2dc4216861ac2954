//! `verdict.json` as other programs read it.
#![allow(clippy::unwrap_used, missing_docs)]

mod diagnosed;
mod specimen;

use serde_json::Value;
use snug_campaign::words::vocabulary::Vocabulary;
use snug_campaign::{CampaignResult, EffectParameter};
use snug_report::{files, verdict_json};

fn verdict(result: &CampaignResult) -> Value {
    serde_json::from_str(&verdict_json(
        result.diagnosis.as_ref().unwrap(),
        result.vocabulary,
    ))
    .unwrap()
}

#[derive(Clone, Copy)]
enum Kind {
    Text,
    Names,
    Number,
    NumberOrNull,
}

fn holds(object: &Value, keys: &[(&str, Kind)]) {
    for (key, kind) in keys {
        let value = object
            .get(key)
            .unwrap_or_else(|| panic!("{key} is not in {object}"));
        let good = match kind {
            Kind::Text => value.is_string(),
            Kind::Names => value
                .as_array()
                .is_some_and(|items| items.iter().all(Value::is_string)),
            Kind::Number => value.is_number(),
            Kind::NumberOrNull => value.is_number() || value.is_null(),
        };
        assert!(good, "{key}: {value}");
    }
}

/// The agreed keys and kinds; further keys may follow.
fn as_agreed(file: &Value) {
    use Kind::{Names, Number, NumberOrNull, Text};
    let items = |key: &str| file[key].as_array().unwrap_or_else(|| panic!("{key}"));
    assert_eq!(file["format"], 1);
    holds(
        file,
        &[("verdict", Text), ("headline", Text), ("reasons", Names)],
    );
    for added in items("added") {
        holds(
            added,
            &[
                ("effect", Text),
                ("kind", Text),
                ("twins", Names),
                ("p_family", NumberOrNull),
                ("heldout_gain", NumberOrNull),
            ],
        );
        for parameter in added["parameters"].as_array().unwrap() {
            holds(
                parameter,
                &[
                    ("name", Text),
                    ("unit", Text),
                    ("value", Number),
                    ("low", NumberOrNull),
                    ("high", NumberOrNull),
                ],
            );
        }
    }
    for corrected in items("corrected") {
        holds(
            corrected,
            &[
                ("effect", Text),
                ("share", Number),
                ("size", Number),
                ("unit", Text),
            ],
        );
    }
    for rung in items("ladder") {
        holds(
            rung,
            &[
                ("effects", Names),
                ("error_over_noise", NumberOrNull),
                ("heldout_error_over_noise", NumberOrNull),
                ("rms_displacement_rad", NumberOrNull),
                ("fit_percent_median", NumberOrNull),
                ("selected_fraction", Number),
            ],
        );
    }
    for candidate in items("ranking") {
        holds(
            candidate,
            &[
                ("effect", Text),
                ("heldout_gain", Number),
                ("p_family", Number),
                ("twins", Names),
            ],
        );
    }
    holds(
        &file["noise"],
        &[("source", Text), ("acceleration_rad_per_s2", NumberOrNull)],
    );
}

#[test]
fn the_keys_are_those_agreed() {
    for (result, name) in [
        (diagnosed::improve(), "adequate"),
        (diagnosed::diagnose(), "missing_effect"),
        (diagnosed::unlisted(), "unlisted_effect"),
    ] {
        let file = verdict(&result);
        as_agreed(&file);
        assert_eq!(file["verdict"], name);
    }
}

/// A verdict of an earlier version says nothing of what a parameter is.
#[test]
fn a_size_without_a_meaning_can_still_be_read() {
    let mut file = verdict(&diagnosed::improve());
    let size = &mut file["added"][0]["parameters"][0];
    size.as_object_mut().unwrap().remove("meaning").unwrap();
    let size: EffectParameter = serde_json::from_value(size.clone()).unwrap();
    assert_eq!((size.meaning.as_str(), size.value), ("", 9.9e5));
}

#[test]
fn the_numbers_are_those_found_to_the_last_digit() {
    let result = diagnosed::improve();
    let file = verdict(&result);
    let cubic = &file["added"][0];
    assert_eq!(cubic["effect"], "cubic_stiffness");
    let size = &cubic["parameters"][0];
    assert_eq!(size["name"], "k3_n_per_m3");
    assert_eq!(size["meaning"], "cubic stiffness");
    assert_eq!(size["unit"], "N/m^3");
    assert_eq!(size["value"], 9.9e5);
    assert_eq!(size["low"], 9.9e5 - 1.96 * 1.5e4);
    assert_eq!(size["high"], 9.9e5 + 1.96 * 1.5e4);
    assert_eq!(file["ladder"][2]["heldout_error_over_noise"], 1.021);
    assert_eq!(file["ladder"][0]["effects"], serde_json::json!([]));
    assert_eq!(file["corrected"][0]["size"], 0.31);
    assert_eq!(file["noise"]["acceleration_rad_per_s2"], 0.9);
    assert_eq!(file["control"]["false_alarms"], 2);
    assert_eq!(file["work"]["linearizations"], 29_616);
    assert!(file["experiment"].is_null());
    let experiment = &verdict(&diagnosed::diagnose())["experiment"];
    assert_eq!(experiment["tightenings"], 9);
    assert!(file["unlisted"].is_null());
    assert_eq!(
        file["comparison"]["tightenings"].as_array().unwrap().len(),
        24
    );
    assert!(
        file.get("showcase").is_none(),
        "signals are drawn, not listed"
    );
}

#[test]
fn what_is_not_finite_is_null() {
    let mut result = diagnosed::improve();
    let diagnosis = result.diagnosis.as_mut().unwrap();
    diagnosis.ladder[0].error_over_noise = Some(f64::NAN);
    diagnosis.ladder[0].rms_fitted_output = f64::INFINITY;
    diagnosis.added[0].parameters[0].high = Some(f64::INFINITY);
    diagnosis.location.force_map.force_n[30] = Some(f64::NAN);
    let text = verdict_json(diagnosis, Vocabulary::Hand);
    for word in ["NaN", "inf", "Infinity"] {
        assert!(!text.contains(&format!(": {word}")), "{word}");
    }
    let file: Value = serde_json::from_str(&text).unwrap();
    as_agreed(&file);
    assert!(file["ladder"][0]["error_over_noise"].is_null());
    assert!(file["added"][0]["parameters"][0]["high"].is_null());
}

#[test]
fn it_is_there_only_with_a_diagnosis() {
    let without = files(&specimen::empty());
    assert!(without.iter().all(|(name, _)| *name != "verdict.json"));
    let (name, text) = files(&diagnosed::improve()).pop().unwrap();
    assert_eq!(name, "verdict.json");
    as_agreed(&serde_json::from_str(&text).unwrap());
}
