//! `cargo xtask tidy`: what is wrong with the workspace as a whole, with file and remedy.

use crate::tidy::{self, Outcome};
use crate::{exit, workspace};
use std::process::ExitCode;

/// Runs every check; one line per check when all is well.
pub fn tidy(is_detailed: bool) -> ExitCode {
    match tidy::check(&workspace::root()) {
        Ok(outcomes) => {
            for outcome in &outcomes {
                print(outcome, is_detailed);
            }
            if outcomes.iter().all(|outcome| outcome.problems.is_empty()) {
                exit::DONE
            } else {
                exit::failed()
            }
        }
        Err(error) => {
            eprintln!("{error}");
            exit::failed()
        }
    }
}

/// A line if all is well; else every problem with its file and remedy, and what is known besides.
fn print(outcome: &Outcome, is_detailed: bool) {
    if outcome.problems.is_empty() {
        println!("{}: {}", outcome.check, outcome.summary);
    }
    for problem in &outcome.problems {
        println!("{}: {}: {}", outcome.check, problem.file, problem.what);
        println!("    remedy: {}", problem.remedy);
    }
    for gap in &outcome.gaps {
        println!("    {gap}");
    }
    if is_detailed || !outcome.problems.is_empty() {
        for note in &outcome.notes {
            println!("    {note}");
        }
    }
}
