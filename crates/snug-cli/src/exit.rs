//! Exit codes that other programs rely on.

use std::process::{ExitCode, ExitStatus};

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

/// That of another program, handed on; a failure's where it was ended by a signal.
pub fn of(status: ExitStatus) -> ExitCode {
    (status.code())
        .and_then(|code| u8::try_from(code).ok())
        .map_or_else(failed, ExitCode::from)
}
