//! `verdict.json`: what is missing in the model, how large it is, how sure that is, and how the error fell.

use crate::tables::json;
use serde::Serialize;
use serde_json::Value;
use snug_campaign::words::vocabulary::Vocabulary;
use snug_campaign::{Comparison, Diagnosis, DiagnosisSummary, Location, RankedEffect, Rung};

/// The file's keys, those that other programs rely on first.
#[derive(Serialize)]
struct VerdictFile<'a> {
    format: u32,
    #[serde(flatten)]
    summary: DiagnosisSummary<'a>,
    ladder: &'a [Rung],
    ranking: &'a [RankedEffect],
    comparison: &'a Comparison,
    location: &'a Location,
    final_location: Option<&'a Location>,
}

/// Everything a diagnosis found but the signals of its example tightening, which the report draws.
///
/// `format` is 1; intervals are 95 %; a number that is unknown or not finite is `null`.
///
/// Sentences are told in the words of `vocabulary`; numbers and names are the same in any.
pub fn verdict_json(diagnosis: &Diagnosis, vocabulary: Vocabulary) -> String {
    let told = vocabulary.told(diagnosis);
    let file = VerdictFile {
        format: 1,
        summary: diagnosis.summary_with(&told),
        ladder: &diagnosis.ladder,
        ranking: &diagnosis.ranking,
        comparison: &diagnosis.comparison,
        location: &diagnosis.location,
        final_location: diagnosis.final_location.as_ref(),
    };
    match vocabulary {
        Vocabulary::Hand => json::text(&file),
        machine => json::text(&in_words_of(
            machine,
            serde_json::to_value(&file).expect("plain structs with text keys serialise"),
        )),
    }
}

/// What a program pastes or looks up, and names that are the user's own.
const AS_THEY_ARE: [&str; 4] = ["ron", "expression", "file", "effects"];

/// Every sentence and every few words, but no single word: those are names that programs look up.
fn in_words_of(vocabulary: Vocabulary, value: Value) -> Value {
    match value {
        Value::String(text) if text.contains(' ') => Value::String(vocabulary.says(&text)),
        Value::Array(list) => {
            let told = list.into_iter().map(|one| in_words_of(vocabulary, one));
            Value::Array(told.collect())
        }
        Value::Object(fields) => {
            let told = fields.into_iter().map(|(key, one)| {
                let one = match AS_THEY_ARE.contains(&key.as_str()) {
                    true => one,
                    false => in_words_of(vocabulary, one),
                };
                (key, one)
            });
            Value::Object(told.collect())
        }
        other => other,
    }
}
