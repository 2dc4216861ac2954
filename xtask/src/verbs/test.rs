use crate::{exit, workspace};
use std::process::{Command, ExitCode};

/// Every test of the workspace, optimised, documentation examples included.
pub fn test(many: bool, blind: bool, filter: Option<&str>) -> ExitCode {
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo.current_dir(workspace::root()).args([
        "test",
        "--release",
        "--workspace",
        "--no-fail-fast",
    ]);
    if let Some(filter) = filter {
        cargo.arg(filter);
    }
    if many {
        cargo.env("SNUG_MANY", "1");
    }
    if blind {
        cargo.env("SNUG_BLIND", "1");
    }
    match cargo.status() {
        Ok(status) if status.success() => exit::DONE,
        Ok(_) => exit::failed(),
        Err(error) => {
            eprintln!("cargo cannot be started: {error}");
            exit::failed()
        }
    }
}
