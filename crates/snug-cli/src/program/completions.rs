//! `snug completions`: what a shell must read, so that it asks this program how a line goes on.
//!
//! Because the program answers, names of effects are those of the version that is installed, and behind a comma, too.

use clap::ValueEnum;
use clap_complete::env::{Bash, Elvish, EnvCompleter, Fish, Powershell, Zsh};
use snug_cli::{complain, exit, say};
use std::path::Path;
use std::process::ExitCode;

/// The environment variable by which a shell asks for completions.
pub const VARIABLE: &str = "SNUG_COMPLETE";

/// Shells that can be taught.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub enum Shell {
    /// GNU Bash.
    Bash,
    /// Elvish.
    Elvish,
    /// Fish.
    Fish,
    /// PowerShell.
    Powershell,
    /// Z shell.
    Zsh,
}

impl Shell {
    fn completer(self) -> &'static dyn EnvCompleter {
        match self {
            Self::Bash => &Bash,
            Self::Elvish => &Elvish,
            Self::Fish => &Fish,
            Self::Powershell => &Powershell,
            Self::Zsh => &Zsh,
        }
    }
}

/// Prints what the shell must read; it asks the program that printed it, wherever that lies.
pub fn print(shell: Shell) -> ExitCode {
    let program = std::env::current_exe().ok();
    let program = program.as_deref().and_then(Path::to_str).unwrap_or("snug");
    let mut script = Vec::new();
    let written =
        (shell.completer()).write_registration(VARIABLE, "snug", "snug", program, &mut script);
    match written {
        Ok(()) => say(&String::from_utf8_lossy(&script), exit::DONE),
        Err(error) => {
            complain(&format!("no completions can be printed: {error}"));
            exit::failed()
        }
    }
}
