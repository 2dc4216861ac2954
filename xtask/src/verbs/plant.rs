//! `cargo xtask plant`: builds and starts `snug-plant`.

use crate::exit;
use crate::terminal::complain;
use crate::workspace;
use std::ffi::OsString;
use std::process::ExitCode;

/// The program of `crates/snug-plant`, a workspace of its own: nothing else is built with the engine. What it is given goes on as
/// it is, and so does the code that it ends with.
pub fn plant(arguments: &[OsString]) -> ExitCode {
    let manifest = workspace::root().join("crates/snug-plant/Cargo.toml");
    let mut cargo = workspace::cargo();
    // Paths are the user's, who may be in another folder than the workspace's.
    if let Ok(here) = std::env::current_dir() {
        cargo.current_dir(here);
    }
    cargo.args(["run", "--quiet", "--release", "--manifest-path"]);
    cargo.arg(manifest).arg("--").args(arguments);
    match cargo.status() {
        Ok(status) => status
            .code()
            .and_then(|code| u8::try_from(code).ok())
            .map_or_else(exit::failed, ExitCode::from),
        Err(error) => {
            complain(&format!("cargo cannot be started: {error}"));
            exit::failed()
        }
    }
}
