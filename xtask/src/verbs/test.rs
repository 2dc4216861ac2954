//! `cargo xtask test`: cargo's tests; environment variables switch on what takes long.

use crate::workspace;
use std::process::ExitCode;

/// Every test of the workspace, optimised, documentation examples included.
pub fn test(many: bool, blind: bool, filter: Option<&str>) -> ExitCode {
    let mut cargo = workspace::cargo();
    cargo.args(["test", "--release", "--workspace", "--no-fail-fast"]);
    if let Some(filter) = filter {
        cargo.arg(filter);
    }
    if many {
        cargo.env("SNUG_MANY", "1");
    }
    if blind {
        cargo.env("SNUG_BLIND", "1");
    }
    workspace::run(cargo)
}
