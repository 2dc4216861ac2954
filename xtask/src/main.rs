//! Snug's command line: `cargo xtask run`, `cargo xtask test`, and what else `cargo xtask --help` lists.
//!
//! It parses arguments, shows progress and prints summaries; every equation lives in the crates.

mod arguments;
mod diagnosis_summary;
mod estimates;
mod logging;
mod progress;
mod signals;
mod summary;
mod terminal;
mod verbs;
mod workspace;

use arguments::Arguments;
use clap::Parser;
use std::process::ExitCode;

/// Exit codes other programs rely on.
mod exit {
    use std::process::ExitCode;

    /// Done.
    pub const DONE: ExitCode = ExitCode::SUCCESS;
    /// Failed, or nothing at all was identified.
    pub fn failed() -> ExitCode {
        ExitCode::from(1)
    }
    /// Bad arguments or a bad study file (clap exits with the same code).
    pub fn bad_arguments() -> ExitCode {
        ExitCode::from(2)
    }
    /// Done, but some data was left out, and the run was asked to be strict about it.
    pub fn left_out() -> ExitCode {
        ExitCode::from(3)
    }
    /// Stopped by Ctrl-C or a signal, as shells count it.
    pub const INTERRUPTED: u8 = 130;
    /// The same, as this program's exit code.
    pub fn interrupted() -> ExitCode {
        ExitCode::from(INTERRUPTED)
    }
}

fn main() -> ExitCode {
    snug_campaign::words::program::set_program("cargo xtask");
    let arguments = Arguments::parse();
    if let Err(error) = logging::start(&arguments.log) {
        terminal::complain(&error);
        return exit::bad_arguments();
    }
    arguments.verb.run()
}
