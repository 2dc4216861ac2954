//! Headers: every Rust file begins with a sentence that says what it is for.
//!
//! Whoever opens a file among hundreds learns from its first line whether it is the one. Of a crate's root, that is its
//! README (`#![doc = include_str!(…)]`).

use crate::outcome::{Outcome, Problem};
use crate::source_files::SourceFile;

/// Refuses files without a first line that says something.
pub fn check(files: &[SourceFile]) -> Outcome {
    let headless = files.iter().filter(|file| !begins_with_words(&file.text));
    let problems = headless.map(|file| Problem {
        file: file.path.clone(),
        what: "does not begin with what it is for".into(),
        remedy: "put `//!` and one sentence first, above attributes, too: what the file is for, what to beware of"
            .into(),
    });
    Outcome {
        check: "headers",
        summary: format!("{} Rust files begin with what they are for", files.len()),
        gaps: Vec::new(),
        notes: Vec::new(),
        problems: problems.collect(),
    }
}

/// Whether documentation of the file itself comes first, and is not empty.
fn begins_with_words(text: &str) -> bool {
    let first = text.lines().next().unwrap_or_default();
    let is_sentence = |words: &str| !words.trim().is_empty();
    first.starts_with("#![doc") || first.strip_prefix("//!").is_some_and(is_sentence)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn problems(text: &str) -> usize {
        check(&[SourceFile::of("crates/swing/src/rope.rs", text)])
            .problems
            .len()
    }

    #[test]
    fn a_sentence_or_a_readme_comes_first() {
        assert_eq!(problems("//! Ropes that hold.\n\npub struct Rope;\n"), 0);
        assert_eq!(problems("#![doc = include_str!(\"../README.md\")]\n"), 0);
    }

    #[test]
    fn nothing_stands_above_the_sentence_and_it_is_not_empty() {
        for text in [
            "",
            "use rope::Knot;\n",
            "//!\n//! Ropes that hold.\n",
            "#![allow(clippy::unwrap_used)]\n//! Ropes that hold.\n",
            "// Ropes that hold.\n",
            "/// Ropes that hold.\npub struct Rope;\n",
            "\n//! Ropes that hold.\n",
        ] {
            assert_eq!(problems(text), 1, "{text}");
        }
    }

    #[test]
    fn the_file_is_named() {
        let outcome = check(&[
            SourceFile::of("a.rs", "//! A rope.\n"),
            SourceFile::of("b.rs", "fn swing() {}\n"),
        ]);
        assert_eq!(outcome.problems.len(), 1);
        assert_eq!(outcome.problems[0].file, "b.rs");
    }
}
