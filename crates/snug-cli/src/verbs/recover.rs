//! `recover`: has a cut recording repaired and prints what came of it.

use crate::exit;
use crate::terminal::say;
use std::path::Path;
use std::process::ExitCode;

/// Makes a recording that was cut short whole.
pub fn recover(file: &Path) -> ExitCode {
    match snug_study::recover(file) {
        Ok(recovered) => say(&format!("{recovered}\n"), exit::DONE),
        Err(error) => super::run::refused(&error.into()),
    }
}
