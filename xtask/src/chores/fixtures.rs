//! `cargo xtask fixtures`: writes the embedded campaigns over those in `fixtures/`.

use crate::workspace;
use snug_cli::{complain, exit, say};
use std::process::ExitCode;

/// Makes the embedded campaigns anew; the same bits every time.
pub fn fixtures() -> ExitCode {
    match snug_synthetic::fixtures::write(&workspace::root().join("fixtures")) {
        Ok(files) => {
            let lines: Vec<String> = (files.iter())
                .map(|file| format!("{}\n", file.display()))
                .collect();
            say(&lines.concat(), exit::DONE)
        }
        Err(error) => {
            complain(&error.to_string());
            exit::failed()
        }
    }
}
