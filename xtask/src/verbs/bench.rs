//! `cargo xtask bench`: hands over to the benchmark in `tests/benches`, or to the plant's own.

use super::plant::plant;
use crate::workspace;
use std::process::ExitCode;

/// The benchmarks of `tests/benches`, in one table: the named sections or all, with the long rows or without.
///
/// `plant` is a benchmark of its own, of a program that nothing else is built with.
pub fn bench(sections: &[String], is_long: bool) -> ExitCode {
    if sections == ["plant"] {
        return plant(&["bench".into()]);
    }
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
