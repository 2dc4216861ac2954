//! `cargo xtask bench`: hands over to the benchmark in `tests/benches`.

use crate::workspace;
use std::process::ExitCode;

/// The benchmarks of `tests/benches`, in one table: the named sections or all, with the long rows or without.
pub fn bench(sections: &[String], is_long: bool) -> ExitCode {
    let mut cargo = workspace::cargo();
    cargo
        .args([
            "bench",
            "--package",
            "snug-tests",
            "--bench",
            "engine",
            "--",
        ])
        .args(sections)
        .args(is_long.then_some("--long"));
    workspace::run(cargo)
}
