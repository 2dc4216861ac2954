//! JSON files of whose values the study declares which are signals.
//!
//! A file is read from start to end; of what is not declared nothing is kept.

mod walk;

use super::{DeclaredLayout, Found, Places, Wanted};
use crate::error::IngestError;
use crate::file::finding_log::{About, FindingLog};
use crate::layout;
use crate::memory::Budget;
use serde::de::DeserializeSeed as _;
use serde::{Deserialize, Serialize};
use snug_files::Input;
use walk::{Search, Walk};

/// Which values of a JSON file are which signals.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct JsonLayout(
    /// The places.
    pub DeclaredLayout,
);

impl Places for JsonLayout {
    const ENDINGS: &[&str] = &["json"];

    fn places(&self) -> &DeclaredLayout {
        &self.0
    }

    fn find(
        wanted: &[Wanted],
        input: &mut dyn Input,
        budget: &Budget,
        log: &mut FindingLog,
    ) -> Result<Found, IngestError> {
        let content = layout::text(input, budget)?;
        let search = Search::new(wanted, budget);
        parse(&content, &search)?;
        let mut found = Vec::new();
        for (place, wanted) in search.finish().into_iter().zip(wanted) {
            if place.gaps > 0 && place.gaps < place.values.len() {
                let message = format!(
                    "{} of {} values are no numbers and are read as NaN (null, for example)",
                    place.gaps,
                    place.values.len()
                );
                let name = wanted.path.to_string();
                log.note("not_a_number", About::Channel(&name), message);
            }
            found.push(place.samples(wanted, budget));
        }
        Ok(found)
    }
}

/// Walks through the content once.
fn parse(content: &[u8], search: &Search<'_>) -> Result<(), IngestError> {
    if content.trim_ascii().is_empty() {
        return Err(IngestError::EmptyFile);
    }
    let mut json = serde_json::Deserializer::from_slice(content);
    let walked = Walk::from_the_top(search).deserialize(&mut json);
    walked
        .and_then(|()| json.end())
        .map_err(|error| search.failed().unwrap_or_else(|| syntax(content, &error)))
}

/// Where the content is no JSON, and why.
pub(crate) fn syntax(content: &[u8], error: &serde_json::Error) -> IngestError {
    let (line, column) = (error.line(), error.column());
    let told = error.to_string();
    let reason = told.split(" at line ").next().unwrap_or(&told).to_owned();
    // Some programs write numbers that JSON does not know.
    let mut lines = content.split(|&byte| byte == b'\n');
    let here = lines.nth(line.saturating_sub(1)).unwrap_or_default();
    let word = &here[column.saturating_sub(1).min(here.len())..];
    let is_word =
        |name: &str| word.starts_with(name.as_bytes()) || word.starts_with(&name.as_bytes()[1..]);
    let reason = match ["NaN", "Infinity", "-Infinity"]
        .into_iter()
        .find(|name| is_word(name))
    {
        Some(name) => {
            format!("{name} is no number in JSON (write null for a sample that is missing)")
        }
        None => reason,
    };
    IngestError::JsonSyntax {
        line,
        column,
        reason,
    }
}

#[cfg(test)]
mod tests;
