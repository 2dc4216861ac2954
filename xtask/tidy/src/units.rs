//! Units: a public number says what it counts, by the suffix of its name or in its documentation.
//!
//! Looked at are floating-point fields of public structs in the libraries (`crates/*/src`). Fields without documentation
//! are passed over: those that another crate can see, the compiler denies (`missing_docs`).

use crate::outcome::{Outcome, Problem};
use crate::source_files::SourceFile;

/// Crates whose numbers belong to no field of engineering, each with the reason.
const DOMAIN_FREE: &[(&str, &str)] = &[
    (
        "snug-statistics",
        "its numbers have the unit of what is put in, or none: statistics, shares, p-values",
    ),
    (
        "snug-least-squares",
        "its residuals are weighted, and its parameters have the unit of the problem that is put in",
    ),
    (
        "snug-signal",
        "its numbers have the unit of the signal that is put in; time counts in samples",
    ),
];

/// Suffixes of names that are units: SI and radians, as the house rules (xtask/README.md) ask for. `_nm` is newton metre.
const SUFFIXES: &[&str] = &[
    "_s",
    "_m",
    "_rad",
    "_rad_per_s",
    "_rad_per_s2",
    "_n",
    "_nm",
    "_kg",
    "_kg_m2",
    "_kg_per_s",
    "_n_per_m",
    "_n_per_m2",
    "_n_per_m3",
    "_hz",
    "_ratio",
    "_percent",
    "_per_s",
    "_per_min",
    "_bytes",
];

/// Words of names whose numbers are pure in every field.
const PURE: &[&str] = &[
    "ratio",
    "percent",
    "share",
    "fraction",
    "p",
    "correlation",
    "over_noise",
    "statistic",
    "degrees_of_freedom",
];

/// What documentation says that gives the unit, or says that there is none or that it is another's.
const TELLING: &[&str] = &[
    "\\[",
    "unit",
    "share",
    "standard errors",
    "standard deviations",
];

/// A struct, as far as the check looks at it.
#[derive(Debug, Default)]
struct Record {
    /// Its documentation.
    words: String,
    /// Its fields, the private ones included.
    fields: Vec<Field>,
}

/// A field.
#[derive(Debug)]
struct Field {
    /// 1-based line.
    line: usize,
    name: String,
    kind: String,
    /// Its documentation; empty where it has none.
    words: String,
    is_public: bool,
}

/// Refuses numbers of which nobody can tell the unit.
pub fn check(files: &[SourceFile]) -> Outcome {
    let mut problems = Vec::new();
    let mut count = 0;
    for file in files.iter().filter(|file| is_of_a_library(&file.path)) {
        for record in records(&file.text) {
            let numbers = record
                .fields
                .iter()
                .filter(|field| field.is_public_number());
            count += numbers.clone().count();
            let untold = numbers.filter(|field| !record.says_unit_of(field));
            problems.extend(untold.map(|field| problem(file, field)));
        }
    }
    Outcome {
        check: "units",
        summary: format!("{count} numbers in public structs say their unit"),
        gaps: Vec::new(),
        notes: DOMAIN_FREE
            .iter()
            .map(|(name, reason)| format!("{name} is not looked at: {reason}"))
            .collect(),
        problems,
    }
}

/// Whether a file belongs to a library with numbers of a field.
fn is_of_a_library(path: &str) -> bool {
    let mut folders = path.split('/');
    let is_crate = folders.next() == Some("crates");
    let name = folders.next().unwrap_or_default();
    let is_free = DOMAIN_FREE.iter().any(|(free, _)| *free == name);
    is_crate && folders.next() == Some("src") && !is_free
}

fn problem(file: &SourceFile, field: &Field) -> Problem {
    Problem {
        file: format!("{}:{}", file.path, field.line),
        what: format!("{} is a number without a unit", field.name),
        remedy: "end its name with the unit (_s, _rad_per_s, _n_per_m, _ratio, …), or name it in the documentation: \
                 \\[N/m\\], \"in the signal's unit\", \"no unit\", there or for the whole struct"
            .into(),
    }
}

impl Record {
    /// Whether the field, its struct or a field beside it that is called `unit` gives the unit.
    fn says_unit_of(&self, field: &Field) -> bool {
        let is_beside = self.fields.iter().any(|beside| beside.name == "unit");
        is_beside || self.words.contains("unit") || field.says_unit()
    }
}

impl Field {
    /// Whether it is a number, or several, that other crates see.
    fn is_public_number(&self) -> bool {
        let is_letter = |letter: char| letter.is_alphanumeric() || letter == '_';
        let words = || {
            let words = self.kind.split(|letter| !is_letter(letter));
            words.filter(|word| !word.is_empty())
        };
        let is_float = |word: &str| matches!(word, "f64" | "f32");
        // Lengths of arrays are numbers or constants; lifetimes have one letter.
        let is_frame = |word: &str| {
            matches!(word, "Option" | "Vec" | "Box" | "Cow" | "mut" | "static")
                || word.len() == 1
                || !word.contains(char::is_lowercase)
        };
        let is_documented = !self.words.is_empty();
        self.is_public
            && is_documented
            && words().any(is_float)
            && words().all(|word| is_float(word) || is_frame(word))
    }

    /// Whether its name or its documentation gives the unit.
    fn says_unit(&self) -> bool {
        let framed = format!("_{}_", self.name);
        let words = self.words.to_lowercase();
        SUFFIXES.iter().any(|suffix| self.name.ends_with(suffix))
            || PURE
                .iter()
                .any(|pure| framed.contains(&format!("_{pure}_")))
            || TELLING.iter().any(|telling| words.contains(telling))
    }
}

/// Every public struct with named fields, as rustfmt writes them: a field a line.
fn records(text: &str) -> Vec<Record> {
    let mut found = Vec::new();
    let mut open: Option<(&str, Record)> = None;
    let mut words = String::new();
    for (at, line) in text.lines().enumerate() {
        let code = line.trim_start();
        let indentation = &line[..line.len() - code.len()];
        if let Some(comment) = code.strip_prefix("///") {
            words.push_str(comment);
        } else if code.starts_with("pub struct ") && code.ends_with('{') {
            let words = std::mem::take(&mut words);
            let fields = Vec::new();
            open = Some((indentation, Record { words, fields }));
        } else if let Some((outer, record)) = open.as_mut() {
            if code == "}" && indentation == *outer {
                found.extend(open.take().map(|(_, record)| record));
            } else if let Some((name, kind, is_public)) = field(code) {
                record.fields.push(Field {
                    line: at + 1,
                    name: name.into(),
                    kind: kind.into(),
                    words: std::mem::take(&mut words),
                    is_public,
                });
            }
        } else if !code.starts_with('#') {
            words.clear();
        }
    }
    found
}

/// Name and type of the field in a line, and whether it is public; `None` for an attribute or what continues one.
fn field(code: &str) -> Option<(&str, &str, bool)> {
    let (name, kind) = code.split_once(": ")?;
    let (visibility, name) = name.rsplit_once(' ').unwrap_or(("", name));
    let is_name = |letter: char| letter.is_alphanumeric() || letter == '_';
    let is_field =
        name.chars().all(is_name) && (visibility.is_empty() || visibility.starts_with("pub"));
    is_field.then_some((name, kind, visibility == "pub"))
}

#[cfg(test)]
mod tests;
