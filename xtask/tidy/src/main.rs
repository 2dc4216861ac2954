//! `cargo xtask tidy`: what is wrong with the workspace as a whole, with file and remedy. One check, one file.

mod advisories;
mod check;
mod duplicates;
mod features;
mod headers;
mod licences;
mod lockfile;
mod outcome;
mod packages;
mod reading;
mod sizes;
mod source_files;
mod units;
mod unused;

use outcome::Outcome;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Runs every check; one line per check when all is well. With `--list`, what is worth knowing besides.
fn main() -> ExitCode {
    let is_detailed = std::env::args().any(|argument| argument == "--list");
    let outcomes = match check::check(&root()) {
        Ok(outcomes) => outcomes,
        Err(error) => {
            writeln!(std::io::stderr(), "{error}").ok();
            return ExitCode::FAILURE;
        }
    };
    let told: Vec<String> = (outcomes.iter())
        .flat_map(|outcome| lines(outcome, is_detailed))
        .collect();
    let is_told = writeln!(std::io::stdout(), "{}", told.join("\n")).is_ok();
    let is_well = outcomes.iter().all(|outcome| outcome.problems.is_empty());
    match is_told && is_well {
        true => ExitCode::SUCCESS,
        false => ExitCode::FAILURE,
    }
}

/// The workspace's folder: where cargo says this package is now, else where it was when it was built.
fn root() -> PathBuf {
    let package = std::env::var_os("CARGO_MANIFEST_DIR")
        .map_or_else(|| PathBuf::from(env!("CARGO_MANIFEST_DIR")), PathBuf::from);
    let root = package.parent().and_then(Path::parent);
    root.map_or(package.clone(), Path::to_path_buf)
}

/// A line if all is well; else every problem with its file and remedy, and what is known besides.
fn lines(outcome: &Outcome, is_detailed: bool) -> Vec<String> {
    let mut lines = Vec::new();
    if outcome.problems.is_empty() {
        lines.push(format!("{}: {}", outcome.check, outcome.summary));
    }
    for problem in &outcome.problems {
        lines.push(format!(
            "{}: {}: {}",
            outcome.check, problem.file, problem.what
        ));
        lines.push(format!("    remedy: {}", problem.remedy));
    }
    lines.extend(outcome.gaps.iter().map(|gap| format!("    {gap}")));
    if is_detailed || !outcome.problems.is_empty() {
        lines.extend(outcome.notes.iter().map(|note| format!("    {note}")));
    }
    lines
}
