//! `cargo xtask fuzz`: starts the harness in `tests/fuzz`; time and seed reach it as environment variables.

use crate::workspace;
use std::path::Path;
use std::process::ExitCode;

/// The harness of `tests/fuzz`: the readers named or all, each for so many seconds.
pub fn fuzz(target: Option<&str>, input: Option<&Path>, seconds: u32, seed: u64) -> ExitCode {
    let mut cargo = workspace::cargo();
    cargo.args([
        "test",
        "--release",
        "--package",
        "snug-tests",
        "--test",
        "fuzz",
        "--",
    ]);
    cargo.args(target);
    // Cargo runs in the workspace's folder.
    cargo.args(input.map(|input| std::path::absolute(input).unwrap_or_else(|_| input.into())));
    cargo.env("SNUG_FUZZ_SECONDS", seconds.to_string());
    cargo.env("SNUG_FUZZ_SEED", seed.to_string());
    workspace::run(cargo)
}
