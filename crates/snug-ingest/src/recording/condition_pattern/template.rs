//! Splits a label at a template's fields, backtracking, because words may hold the text that separates them.

use crate::error::IngestError;
use serde::{Deserialize, Serialize};

/// A named place in a label.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Field {
    Participant,
    Strategy,
    Joint,
    Pace,
    Skip,
}

/// Every field with its name in a template.
const FIELDS: [(Field, &str); 5] = [
    (Field::Participant, "participant"),
    (Field::Strategy, "strategy"),
    (Field::Joint, "joint"),
    (Field::Pace, "pace"),
    (Field::Skip, "skip"),
];

#[derive(Debug, Clone, PartialEq, Eq)]
enum Part {
    Text(String),
    Field(Field),
}

/// Named fields with fixed text between them, `{participant}_{strategy}_{joint}_{pace}`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Template {
    parts: Vec<Part>,
}

impl Default for Template {
    fn default() -> Self {
        Self::try_from("{participant}_{strategy}_{joint}_{pace}".to_owned())
            .expect("the default template is well formed")
    }
}

impl TryFrom<String> for Template {
    type Error = IngestError;

    fn try_from(text: String) -> Result<Self, IngestError> {
        let allowed = "{participant}, {strategy}, {joint}, {pace} (each once) and {skip}, with text between them";
        let refused = || IngestError::setting("conditions.template", &text, allowed);
        let mut parts: Vec<Part> = Vec::new();
        let mut rest = text.as_str();
        while !rest.is_empty() {
            if let Some(field) = rest.strip_prefix('{') {
                let (name, behind) = field.split_once('}').ok_or_else(refused)?;
                let known = FIELDS.into_iter().find(|(_, known)| *known == name);
                let (field, _) = known.ok_or_else(refused)?;
                let part = Part::Field(field);
                let repeated = field != Field::Skip && parts.contains(&part);
                // Two fields without text between them have no border.
                if repeated || matches!(parts.last(), Some(Part::Field(_))) {
                    return Err(refused());
                }
                parts.push(part);
                rest = behind;
            } else {
                let end = rest.find('{').unwrap_or(rest.len());
                if rest[..end].contains('}') {
                    return Err(refused());
                }
                parts.push(Part::Text(rest[..end].to_owned()));
                rest = &rest[end..];
            }
        }
        Ok(Self { parts })
    }
}

impl From<Template> for String {
    fn from(template: Template) -> Self {
        let text = |part: &Part| match part {
            Part::Text(text) => text.clone(),
            Part::Field(field) => (FIELDS.iter().filter(|(known, _)| known == field))
                .map(|(_, name)| format!("{{{name}}}"))
                .collect(),
        };
        template.parts.iter().map(text).collect()
    }
}

impl Template {
    /// The words of a label's fields: the first way to split it in which `accepts` agrees to every word.
    pub(super) fn capture<'a>(
        &self,
        label: &'a str,
        accepts: &dyn Fn(Field, &str) -> bool,
    ) -> Option<Vec<(Field, &'a str)>> {
        let mut words = Vec::new();
        capture(&self.parts, label.trim(), accepts, &mut words).then_some(words)
    }
}

fn capture<'a>(
    parts: &[Part],
    label: &'a str,
    accepts: &dyn Fn(Field, &str) -> bool,
    words: &mut Vec<(Field, &'a str)>,
) -> bool {
    let Some((part, parts)) = parts.split_first() else {
        return label.is_empty() || label.starts_with(['_', '-', '.', ' ']);
    };
    match part {
        Part::Text(text) => {
            strip(label, text).is_some_and(|rest| capture(parts, rest, accepts, words))
        }
        Part::Field(field) => (0..=label.len())
            .skip(1)
            .filter(|&end| label.is_char_boundary(end))
            .any(|end| {
                let (word, rest) = label.split_at(end);
                // "8.5" is not pace 8 with the suffix ".5".
                let cut_number = rest.starts_with(['.', ','])
                    && rest[1..].starts_with(|c: char| c.is_ascii_digit());
                if (*field == Field::Pace && cut_number) || !accepts(*field, word) {
                    return false;
                }
                words.push((*field, word));
                let fits = capture(parts, rest, accepts, words);
                if !fits {
                    words.pop();
                }
                fits
            }),
    }
}

/// What follows `prefix`, whatever the letter case.
fn strip<'a>(label: &'a str, prefix: &str) -> Option<&'a str> {
    let mut rest = label.chars();
    for expected in prefix.chars() {
        let found = rest.next()?;
        if found != expected && !found.to_lowercase().eq(expected.to_lowercase()) {
            return None;
        }
    }
    Some(rest.as_str())
}
