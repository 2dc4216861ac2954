//! `cargo xtask tidy`: starts `snug-tidy`.

use crate::workspace;
use std::process::ExitCode;

/// The checks of `xtask/tidy`, a program of its own: a run needs nothing of what it is built from.
pub fn tidy(is_detailed: bool) -> ExitCode {
    let mut cargo = workspace::cargo();
    cargo.args([
        "run",
        "--quiet",
        "--release",
        "--package",
        "snug-tidy",
        "--",
    ]);
    cargo.args(is_detailed.then_some("--list"));
    workspace::run(cargo)
}
