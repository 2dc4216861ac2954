//! The workspace's folders, and cargo started in them on behalf of a chore.

use snug_cli::{complain, exit};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

/// The workspace's folder: where cargo says this package is now, else where it was when it was built.
pub fn root() -> PathBuf {
    let package = std::env::var_os("CARGO_MANIFEST_DIR")
        .map_or_else(|| PathBuf::from(env!("CARGO_MANIFEST_DIR")), PathBuf::from);
    package.parent().map_or(package.clone(), Path::to_path_buf)
}

/// The campaign that ships with Snug.
pub fn embedded_campaign() -> PathBuf {
    root().join("fixtures").join("campaign")
}

/// The cargo that runs this program, in the workspace's folder.
pub fn cargo() -> Command {
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo.current_dir(root());
    cargo
}

/// Runs a command to its end; whatever it ends with but success is a failure.
pub fn run(command: Command) -> ExitCode {
    match succeeds(command) {
        true => exit::DONE,
        false => exit::failed(),
    }
}

/// Whether a command, run to its end, succeeds.
pub fn succeeds(mut command: Command) -> bool {
    command.status().map_or_else(
        |error| {
            complain(&format!("cargo cannot be started: {error}"));
            false
        },
        |status| status.success(),
    )
}
