//! How results are said: numbers, sizes, chances, verdicts and their reasons, for someone who knows nutrunners, not
//! statistics. Terminal, report, recording and verdict.json take their words from here.

pub(crate) mod excerpt;
pub(crate) mod likely_name;
mod over_time;
pub(crate) mod sentence;

pub mod chance;
pub mod effect_name;
pub mod groups;
pub mod number;
pub mod program;
pub mod size;
pub mod vocabulary;

pub use sentence::{explained, headline, reason, remark, statement, stopped, suspicion};

/// `a`, `a and b`, `a, b and c`.
pub fn joined(names: &[String]) -> String {
    match names {
        [some @ .., last] if !some.is_empty() => format!("{} and {last}", some.join(", ")),
        _ => names.concat(),
    }
}

/// `1 effect`, `2 effects`.
pub fn counted(count: usize, what: &str) -> String {
    let ending = if count == 1 { "" } else { "s" };
    format!("{count} {what}{ending}")
}

/// With its first letter as a sentence begins.
pub fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(char::to_uppercase);
    first.into_iter().flatten().chain(letters).collect()
}
