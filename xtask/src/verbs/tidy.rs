//! `cargo xtask tidy`: what is wrong with the workspace as a whole, with file and remedy.

use crate::terminal::{complain, say};
use crate::tidy::{self, Outcome};
use crate::{exit, workspace};
use std::process::ExitCode;

/// Runs every check; one line per check when all is well.
pub fn tidy(is_detailed: bool) -> ExitCode {
    match tidy::check(&workspace::root()) {
        Ok(outcomes) => {
            let told: Vec<String> = (outcomes.iter())
                .map(|outcome| lines(outcome, is_detailed).join("\n") + "\n")
                .collect();
            let is_well = outcomes.iter().all(|outcome| outcome.problems.is_empty());
            let code = match is_well {
                true => exit::DONE,
                false => exit::failed(),
            };
            say(&told.concat(), code)
        }
        Err(error) => {
            complain(&error.to_string());
            exit::failed()
        }
    }
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
