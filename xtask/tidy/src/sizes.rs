//! Sizes: files, functions and folders stay small enough to be read at one go.
//!
//! Functions are found by their indentation, which holds for sources that rustfmt has been over: from the line with `fn`
//! to the first closing brace that stands as far in as that line.

use crate::outcome::{Outcome, Problem};
use crate::source_files::SourceFile;
use std::collections::BTreeMap;

/// Most lines of a file, tests in it included.
///
/// From the house rules (xtask/README.md). Measured on programs that read well, the median is 132 to 228 (Clarabel,
/// gitoxide, nyx); where one file in twenty passes 1000 lines, one of them knows everything.
const FILE_LINES: usize = 500;

/// Most lines of a function, from its first line to its closing brace.
///
/// From the house rules: about what a screen shows.
const FUNCTION_LINES: usize = 70;

/// The same of a test: tables of cases and of expected values are read line by line, not at a glance.
const TEST_LINES: usize = 110;

/// Most Rust files side by side in one folder of sources.
///
/// Sixteen are about as many names as one takes in at a glance, and three crates had once come to forty; this is where the
/// fullest folder (pooled fits in snug-diagnose) stands, to be lowered as folders get rooms.
const FOLDER_FILES: usize = 22;

/// Folders that may hold any number of files, each with the reason: one file is one entry of a list, and none needs
/// another to be understood.
const CATALOGUES: &[(&str, &str)] = &[
    ("effects", "one physical effect per file"),
    ("section", "one section of the report per file"),
    ("tests", "one subject of tests per file"),
];

/// A function and how long it is.
#[derive(Debug, PartialEq, Eq)]
struct Function<'a> {
    name: &'a str,
    /// 1-based line of its `fn`.
    line: usize,
    lines: usize,
}

/// Holds every file, function and folder to its budget.
pub fn check(files: &[SourceFile]) -> Outcome {
    let mut problems: Vec<Problem> = files.iter().filter_map(too_long).collect();
    let mut count = 0;
    for file in files {
        let functions = functions(&file.text);
        count += functions.len();
        problems.extend(functions.iter().filter_map(|one| endless(file, one)));
    }
    let folders = folders(files);
    let mut notes = Vec::new();
    for (&folder, &held) in folders.iter().filter(|(_, held)| **held > FOLDER_FILES) {
        match catalogue(folder) {
            Some(reason) => notes.push(format!("{folder} holds {held} files; accepted: {reason}")),
            None => problems.push(crowded(folder, held)),
        }
    }
    Outcome {
        check: "sizes",
        summary: format!(
            "{} files of at most {FILE_LINES} lines, {count} functions of at most {FUNCTION_LINES}, {} folders of at most \
             {FOLDER_FILES} files",
            files.len(),
            folders.len()
        ),
        gaps: Vec::new(),
        notes,
        problems,
    }
}

/// A file over its budget.
fn too_long(file: &SourceFile) -> Option<Problem> {
    let lines = file.text.lines().count();
    (lines > FILE_LINES).then(|| Problem {
        file: file.path.clone(),
        what: format!("has {lines} lines, {FILE_LINES} may be"),
        remedy: "give each of its subjects a file; long tests go into a file beside it".into(),
    })
}

/// A function over its budget.
fn endless(file: &SourceFile, function: &Function<'_>) -> Option<Problem> {
    let Function { name, line, lines } = function;
    let is_test = file.path.split(['/', '.']).any(|part| part == "tests");
    let most = if is_test { TEST_LINES } else { FUNCTION_LINES };
    (*lines > most).then(|| Problem {
        file: format!("{}:{line}", file.path),
        what: format!("function {name} has {lines} lines, {most} may be"),
        remedy: "give each of its phases a function that is named after what it does; tables become constants".into(),
    })
}

/// A folder over its budget.
fn crowded(folder: &str, held: usize) -> Problem {
    Problem {
        file: folder.into(),
        what: format!("holds {held} Rust files side by side, {FOLDER_FILES} may be"),
        remedy: "put those of one subject into a folder named after it, or into a crate of their own; a list of like \
                 things goes into CATALOGUES of xtask/tidy/src/sizes.rs"
            .into(),
    }
}

/// Rust files directly in each folder of sources: one called `src`, or below one.
fn folders(files: &[SourceFile]) -> BTreeMap<&str, usize> {
    let mut folders = BTreeMap::new();
    for folder in files.iter().map(SourceFile::folder) {
        if folder.split('/').any(|name| name == "src") {
            *folders.entry(folder).or_default() += 1;
        }
    }
    folders
}

/// Why a folder may hold any number of files, if it may.
fn catalogue(folder: &str) -> Option<&'static str> {
    let name = folder.rsplit('/').next()?;
    let known = CATALOGUES.iter().find(|(known, _)| *known == name);
    known.map(|(_, reason)| *reason)
}

/// Every function with a body.
fn functions(text: &str) -> Vec<Function<'_>> {
    let lines: Vec<&str> = text.lines().collect();
    let begun = (0..lines.len()).filter_map(|at| Some((at, name(lines[at])?)));
    begun
        .filter_map(|(at, name)| {
            Some(Function {
                name,
                line: at + 1,
                lines: length(&lines[at..])?,
            })
        })
        .collect()
}

/// The name of the function that begins in a line.
fn name(line: &str) -> Option<&str> {
    let (before, after) = line.split_once("fn ")?;
    let is_modifier = |word: &str| {
        matches!(word, "pub" | "const" | "async" | "unsafe" | "extern")
            || word.starts_with("pub(")
            || (word.len() > 1 && word.starts_with('"') && word.ends_with('"'))
    };
    let end = after.find(|letter: char| !letter.is_alphanumeric() && letter != '_')?;
    before
        .split_whitespace()
        .all(is_modifier)
        .then(|| &after[..end])
}

/// How many lines the function takes that begins in the first; `None` for a declaration without a body.
fn length(lines: &[&str]) -> Option<usize> {
    let first = lines.first()?;
    if first.ends_with('}') {
        return Some(1);
    }
    // The signature ends where its body opens; a declaration ends before one does.
    let is_end = |line: &&str| line.ends_with(['{', ';']);
    let opening = lines.iter().position(is_end)?;
    if lines[opening].ends_with(';') {
        return None;
    }
    let indentation = &first[..first.len() - first.trim_start().len()];
    let closes = |line: &&str| {
        let rest = line.strip_prefix(indentation);
        rest.is_some_and(|rest| rest.starts_with('}'))
    };
    let body = lines[opening + 1..].iter().position(closes)?;
    Some(opening + body + 2)
}

#[cfg(test)]
mod tests;
