use crate::{exit, workspace};
use std::process::{Command, ExitCode};

/// The benchmarks of `tests/benches`, in one table.
pub fn bench(filter: Option<&str>) -> ExitCode {
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
        .args(filter);
    match cargo.status() {
        Ok(status) if status.success() => exit::DONE,
        Ok(_) => exit::failed(),
        Err(error) => {
            eprintln!("cargo cannot be started: {error}");
            exit::failed()
        }
    }
}
