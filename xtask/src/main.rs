//! Snug's command line: `cargo xtask run`, `cargo xtask test`, and what else `cargo xtask --help` lists.
//!
//! It parses arguments, shows progress and prints summaries; every equation lives in the crates.

mod arguments;
mod diagnosis_summary;
mod logging;
mod progress;
mod signals;
mod summary;
mod terminal;
mod verbs;
mod workspace;

use arguments::{Arguments, Verb};
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
    let arguments = Arguments::parse();
    if let Err(error) = logging::start(&arguments.log) {
        terminal::complain(&error);
        return exit::bad_arguments();
    }
    match arguments.verb {
        Verb::Run(options) => verbs::run(&options),
        Verb::Compare(options) => verbs::diagnose(&options, &snug_study::Verb::Compare),
        Verb::Diagnose(options) => verbs::diagnose(&options, &snug_study::Verb::Diagnose),
        Verb::Add { effects, options } => {
            verbs::diagnose(&options, &snug_study::Verb::Add(effects))
        }
        Verb::Remove { effect, study } => verbs::remove(&study, &effect),
        Verb::Improve(options) => verbs::diagnose(&options, &snug_study::Verb::Improve),
        Verb::Effects { name } => verbs::effects(name.as_deref()),
        Verb::Recover { file } => verbs::recover(&file),
        Verb::Fixtures => verbs::fixtures(),
        Verb::Test {
            many,
            blind,
            filter,
        } => verbs::test(many, blind, filter.as_deref()),
        Verb::Tidy { list } => verbs::tidy(list),
        Verb::Fuzz {
            target,
            input,
            seconds,
            seed,
        } => verbs::fuzz(target.as_deref(), input.as_deref(), seconds, seed),
        Verb::Bench { sections, long } => verbs::bench(&sections, long),
    }
}
