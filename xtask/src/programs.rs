//! Programs that are built only when they are asked for: the workbench's server and the plant's engine.

use crate::workspace;
use snug_campaign::words::program::VARIABLE;
use snug_cli::{Front, WorkbenchOptions, complain, exit};
use std::ffi::OsString;
use std::process::{Command, ExitCode};

/// `cargo xtask workbench`: builds `snug` with the page's server and has it open the page.
pub fn workbench(front: &Front, options: &WorkbenchOptions) -> ExitCode {
    let mut cargo = cargo(front, "Cargo.toml");
    cargo.args(["--package", "snug-cli", "--", "workbench"]);
    if let Some(study) = &options.study {
        cargo.arg("--study").arg(study);
    }
    let embedded = (options.study.is_none()).then(workspace::embedded_campaign);
    if let Some(data) = options.data.clone().or(embedded) {
        cargo.arg("--data").arg(data);
    }
    if let Some(port) = options.port {
        cargo.args(["--port", &port.to_string()]);
    }
    cargo.args(options.no_open.then_some("--no-open"));
    ended(cargo)
}

/// `cargo xtask plant`: builds and starts `snug-plant`, the program of a workspace of its own; what it is given goes on as it is.
pub fn plant(front: &Front, arguments: &[OsString]) -> ExitCode {
    let mut cargo = cargo(front, "crates/snug-plant/Cargo.toml");
    cargo.arg("--").args(arguments);
    ended(cargo)
}

/// Cargo that builds and starts a program of the manifest, which recommends what people type here.
fn cargo(front: &Front, manifest: &str) -> Command {
    let mut cargo = workspace::cargo();
    // Paths are the user's, who may be in another folder than the workspace's.
    if let Ok(here) = std::env::current_dir() {
        cargo.current_dir(here);
    }
    cargo.args(["run", "--quiet", "--release", "--manifest-path"]);
    cargo.arg(workspace::root().join(manifest));
    cargo.env(VARIABLE, front.program);
    cargo
}

/// The code that the program ended with.
fn ended(mut cargo: Command) -> ExitCode {
    match cargo.status() {
        Ok(status) => exit::of(status),
        Err(error) => {
            complain(&format!("cargo cannot be started: {error}"));
            exit::failed()
        }
    }
}
