//! The mystery that ships with Snug, solved as the README does: compare, diagnose, add, improve.

use crate::campaign::{diagnose_study, run_study};
use snug_campaign::{Became, Diagnosis, Motion, Verdict};
use snug_study::{Outcome, Study, Verb};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

fn fixtures() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../fixtures")
}

fn json(path: &Path) -> serde_json::Value {
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// What is hidden, and its numbers.
fn truth() -> (String, Vec<f64>) {
    let truth = json(&fixtures().join("mystery.truth.json"));
    let effect = truth["effects"][0].as_str().unwrap().to_owned();
    let numbers = truth["tightenings"][0]["used"][&effect].as_array().unwrap();
    let numbers = numbers
        .iter()
        .map(|number| number.as_f64().unwrap())
        .collect();
    (effect, numbers)
}

fn asked(verb: &Verb) -> (Outcome, TempDir) {
    diagnose_study(&Study::on(fixtures().join("mystery")), verb)
}

fn diagnosis(outcome: &Outcome) -> &Diagnosis {
    outcome.result.diagnosis.as_ref().unwrap()
}

fn errors(diagnosis: &Diagnosis) -> Vec<f64> {
    let ladder = diagnosis.ladder.iter();
    ladder.map(|rung| rung.error_over_noise.unwrap()).collect()
}

#[test]
fn comparing_shows_misfit_above_the_floor() {
    let (outcome, out) = asked(&Verb::Compare);
    let diagnosis = diagnosis(&outcome);
    assert_eq!(diagnosis.tightenings, 24);
    assert!((1.4..3.0).contains(&errors(diagnosis)[0]));
    assert!(diagnosis.ranking.is_empty(), "a comparison does not guess");
    assert_ne!(diagnosis.verdict, Verdict::Adequate);
    assert!(!diagnosis.location.force_over_time.at.is_empty());
    let file = json(&out.path().join("verdict.json"));
    assert_eq!(file["verb"], "compare");
}

#[test]
fn diagnosing_names_the_hidden_effect_alone() {
    let (effect, _) = truth();
    let (outcome, out) = asked(&Verb::Diagnose);
    let diagnosis = diagnosis(&outcome);
    assert_eq!(diagnosis.verdict, Verdict::MissingEffect);
    assert_eq!(diagnosis.ranking[0].effect, effect);
    assert!(diagnosis.ranking[0].twins.is_empty());
    let file = json(&out.path().join("verdict.json"));
    assert_eq!(file["verdict"], "missing_effect");
    assert_eq!(file["ranking"][0]["effect"], effect.as_str());
    let sizes = file["ranking"][0]["parameters"].as_array().unwrap();
    let meanings: Vec<_> = sizes.iter().map(|size| size["meaning"].clone()).collect();
    assert_eq!(meanings, ["stiffness of the reflex", "delay of the reflex"]);
    assert!(outcome.result.effects.is_empty(), "nothing is changed");
}

/// The error comes down to the floor, the intervals hold the truth, and the study that comes of it runs again.
#[test]
fn adding_it_brings_the_error_to_the_floor() {
    let (effect, numbers) = truth();
    let (outcome, out) = asked(&Verb::Add(vec![effect.clone()]));
    let errors = errors(diagnosis(&outcome));
    assert!(errors[0] > 1.4 && errors[1] < 1.05, "{errors:?}");
    let file = json(&out.path().join("verdict.json"));
    let added = &file["added"][0];
    assert_eq!(added["effect"], effect.as_str());
    let parameters = added["parameters"].as_array().unwrap();
    assert_eq!(parameters.len(), numbers.len());
    for (parameter, truth) in parameters.iter().zip(numbers) {
        let end = |key: &str| parameter[key].as_f64().unwrap();
        assert!(
            end("low") < truth && truth < end("high"),
            "{parameter}: {truth}"
        );
        assert!(end("high") - end("low") < 0.1 * truth, "{parameter}");
    }

    let study = Study::read(&out.path().join("study.ron")).unwrap();
    assert_eq!(study.model.effects, [effect]);
    let (again, _out) = run_study(&study).unwrap();
    assert_eq!(again.result.presets[0].selected, 24);
}

#[test]
fn improving_finds_it_unasked_and_stops() {
    let (effect, _) = truth();
    let (outcome, out) = asked(&Verb::Improve);
    let diagnosis = diagnosis(&outcome);
    assert_eq!(diagnosis.verdict, Verdict::Adequate);
    assert_eq!(outcome.result.effects, [effect.as_str()]);
    assert!(*errors(diagnosis).last().unwrap() < 1.05);
    assert!(diagnosis.stopped.is_some());
    let file = json(&out.path().join("verdict.json"));
    assert_eq!(file["verdict"], "adequate");
    let last = file["ladder"].as_array().unwrap().last().unwrap();
    assert!(last["selected_fraction"].as_f64().unwrap() > 0.95);
    assert_eq!(
        file["ladder"][0]["ranking"][0]["effect"],
        effect.as_str(),
        "why it was taken is kept"
    );
    let recording = std::fs::read(out.path().join("recording.mcap")).unwrap();
    let channels = snug_record::read::numeric_channels(&recording).unwrap();
    let before = channels.channel("/tightening/signals", "before.acceleration_rad_per_s2");
    assert!(before.unwrap().values.iter().all(|value| value.is_finite()));
    let began = channels.channel("/tightening/window", "started_at_s");
    assert!(began.unwrap().values.iter().any(|time_s| *time_s > 0.0));
}

/// Beside the base model many seem to help; beside what was hidden none does.
#[test]
fn what_no_longer_holds_is_told_and_every_tightening_shows_what_was_gained() {
    let (effect, _) = truth();
    let (outcome, _out) = asked(&Verb::Add(vec![effect.clone()]));
    let diagnosis = diagnosis(&outcome);
    assert_eq!(diagnosis.became(0, &effect), Became::Added);
    let first = diagnosis.ladder[0].ranking.iter();
    let helped: Vec<_> = first
        .filter(|one| one.supported && one.effect != effect)
        .collect();
    assert!(helped.len() > 3, "{}", helped.len());
    for one in helped {
        let Became::Ranked { share, supported } = diagnosis.became(0, &one.effect) else {
            continue;
        };
        assert!(!supported && share < 0.05, "{}: {share}", one.effect);
    }
    let left = |measured: &Motion, model: &Motion| -> f64 {
        let [measured, model] =
            [measured, model].map(|motion| motion.acceleration_rad_per_s2.as_ref().unwrap());
        let pairs = measured.iter().zip(model);
        pairs
            .map(|(measured, model)| (measured - model).powi(2))
            .sum()
    };
    let examples = &outcome.result.examples;
    assert_eq!(examples.len(), 24);
    for (_, traces) in examples {
        let (before, after) = (
            left(&traces.measured, &traces.before),
            left(&traces.measured, &traces.simulated),
        );
        assert!(before > after, "{before} {after}");
    }
}

/// The README's example of a law of one's own is an effect like any other; it is not what the mystery hides.
#[test]
fn a_law_of_one_s_own_takes_part() {
    let mut study = Study::read(&crate::campaign::study_file("own_law.ron")).unwrap();
    study.model.effects = vec!["grip_damping".into()];
    let (outcome, _out) = diagnose_study(&study, &Verb::Compare);
    assert_eq!(outcome.result.effects, ["grip_damping"]);
    assert!(errors(diagnosis(&outcome))[0] > 1.1);
}
