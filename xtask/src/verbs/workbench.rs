//! `cargo xtask workbench`: builds and starts `snug-workbench`.

use crate::workspace;
use std::path::Path;
use std::process::ExitCode;

/// The page of `crates/snug-workbench`, a program of its own: a run needs nothing of what its server is built from.
pub fn workbench(
    study: Option<&Path>,
    data: Option<&Path>,
    port: Option<u16>,
    no_open: bool,
) -> ExitCode {
    let mut cargo = workspace::cargo();
    // Paths are the user's, who may be in another folder than the workspace's.
    if let Ok(here) = std::env::current_dir() {
        cargo.current_dir(here);
    }
    cargo.args(["run", "--quiet", "--release", "--package", "snug-workbench"]);
    cargo.arg("--manifest-path");
    cargo.arg(workspace::root().join("Cargo.toml")).arg("--");
    for (name, path) in [("--study", study), ("--data", data)] {
        if let Some(path) = path {
            cargo.arg(name).arg(path);
        }
    }
    if let Some(port) = port {
        cargo.args(["--port", &port.to_string()]);
    }
    cargo.args(no_open.then_some("--no-open"));
    workspace::run(cargo)
}
