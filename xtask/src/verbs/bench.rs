use crate::{exit, workspace};
use std::process::{Command, ExitCode};

/// The benchmarks of `tests/benches`, in one table: the named sections or all, with the long rows or without.
pub fn bench(sections: &[String], is_long: bool) -> ExitCode {
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo
        .current_dir(workspace::root())
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
    match cargo.status() {
        Ok(status) if status.success() => exit::DONE,
        Ok(_) => exit::failed(),
        Err(error) => {
            eprintln!("cargo cannot be started: {error}");
            exit::failed()
        }
    }
}
