//! Conditions out of a label such as `TP3_QS_Soft_8`.

mod template;

pub use template::Template;

use crate::file::finding_log::{About, FindingLog};
use serde::{Deserialize, Serialize};
use snug_campaign::Conditions;
use snug_campaign::excerpt;
use template::Field;

/// How a file's label names its conditions.
///
/// A label that does not follow the pattern gives no conditions and a finding; nothing is guessed. Letter case never
/// matters, and what follows the last field behind `_`, `-`, `.` or a blank is ignored (`TP1_QS_Soft_5_01`).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ConditionPattern {
    /// The fields `{participant}`, `{strategy}`, `{joint}`, `{pace}` (tightenings per minute) and `{skip}` (anything)
    /// with the text between them. Default `{participant}_{strategy}_{joint}_{pace}`.
    pub template: Template,
    /// Words that a strategy may be, as they shall be written; empty for any word. Default `QS`, `TT`.
    pub strategies: Vec<String>,
    /// Words that a joint may be, as they shall be written; empty for any word. Default `Soft`, `Hard`.
    pub joints: Vec<String>,
}

impl Default for ConditionPattern {
    fn default() -> Self {
        let words = |list: [&str; 2]| list.map(str::to_owned).to_vec();
        Self {
            template: Template::default(),
            strategies: words(["QS", "TT"]),
            joints: words(["Soft", "Hard"]),
        }
    }
}

impl ConditionPattern {
    /// The conditions that `label` names; `None` when it does not follow the pattern with known words.
    ///
    /// ```
    /// use snug_ingest::ConditionPattern;
    ///
    /// let conditions = ConditionPattern::default().conditions("tp3_qs_SOFT_8").expect("follows the pattern");
    /// assert_eq!(conditions.participant.as_deref(), Some("tp3"));
    /// assert_eq!(conditions.strategy.as_deref(), Some("QS"));
    /// assert_eq!(conditions.joint.as_deref(), Some("Soft"));
    /// assert_eq!(conditions.pace_per_min, Some(8.0));
    /// assert!(ConditionPattern::default().conditions("TP3_QQ_Soft_8").is_none());
    /// ```
    pub fn conditions(&self, label: &str) -> Option<Conditions> {
        let fields = self
            .template
            .capture(label, &|field, word| self.known(field, word))?;
        Some(self.assemble(&fields).0)
    }

    /// The conditions that the first of `labels` to follow the pattern names. Words that are not known give `None` for
    /// their field, and a finding.
    pub(crate) fn read(&self, labels: &[&str], log: &mut FindingLog) -> Conditions {
        if let Some(conditions) = labels.iter().find_map(|label| self.conditions(label)) {
            return conditions;
        }
        let plausible = |field, word: &str| field != Field::Pace || number(word).is_some();
        for label in labels {
            if let Some(fields) = self.template.capture(label, &plausible) {
                let (conditions, unknown) = self.assemble(&fields);
                for Unknown { field, word, known } in unknown {
                    log.note(
                        "unknown_condition",
                        About::File,
                        format!(
                            "label {:?}: {field} {:?} is none of {}; left without {field}",
                            excerpt(label),
                            excerpt(word),
                            known.join(", ")
                        ),
                    );
                }
                return conditions;
            }
        }
        log.note(
            "label_not_understood",
            About::File,
            format!(
                "{} does not follow the pattern {}; the file has no conditions",
                excerpt(&labels.join(", ")),
                String::from(self.template.clone())
            ),
        );
        Conditions::default()
    }

    fn known(&self, field: Field, word: &str) -> bool {
        match field {
            Field::Strategy => accepted(&self.strategies, word).is_some(),
            Field::Joint => accepted(&self.joints, word).is_some(),
            Field::Pace => number(word).is_some(),
            Field::Participant | Field::Skip => true,
        }
    }

    /// Conditions from captured words, and the words that are not known with what would be.
    fn assemble<'a>(&'a self, fields: &[(Field, &'a str)]) -> (Conditions, Vec<Unknown<'a>>) {
        let mut conditions = Conditions::default();
        let mut unknown = Vec::new();
        for &(field, word) in fields {
            let (place, name, known) = match field {
                Field::Strategy => (&mut conditions.strategy, "strategy", &self.strategies),
                Field::Joint => (&mut conditions.joint, "joint", &self.joints),
                Field::Participant => {
                    conditions.participant = Some(word.to_owned());
                    continue;
                }
                Field::Pace => {
                    conditions.pace_per_min = number(word);
                    continue;
                }
                Field::Skip => continue,
            };
            *place = accepted(known, word);
            if place.is_none() {
                unknown.push(Unknown {
                    field: name,
                    word,
                    known,
                });
            }
        }
        (conditions, unknown)
    }
}

/// A word that its field does not know.
struct Unknown<'a> {
    field: &'static str,
    word: &'a str,
    known: &'a [String],
}

/// The word as the list writes it.
fn accepted(list: &[String], word: &str) -> Option<String> {
    if list.is_empty() {
        return Some(word.to_owned());
    }
    list.iter()
        .find(|known| known.to_lowercase() == word.to_lowercase())
        .cloned()
}

fn number(word: &str) -> Option<f64> {
    let number: f64 = word.replace(',', ".").parse().ok()?;
    (number.is_finite() && number >= 0.0).then_some(number)
}

#[cfg(test)]
mod tests;
