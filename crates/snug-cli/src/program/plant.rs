//! `snug plant`: starts an installed `snug-plant`.

use snug_campaign::words::program;
use snug_cli::{Front, complain, exit};
use std::ffi::OsString;
use std::io::ErrorKind;
use std::path::PathBuf;
use std::process::{Command, ExitCode};

/// Starts the plant's program; what it is given goes on as it is, and so does the code that it ends with.
pub fn start(front: &Front, arguments: &[OsString]) -> ExitCode {
    let ended = Command::new(path())
        .args(arguments)
        .env(program::VARIABLE, front.program)
        .status();
    match ended {
        Ok(status) => exit::of(status),
        Err(error) if error.kind() == ErrorKind::NotFound => {
            complain(
                "snug-plant lies neither beside this program nor in PATH; in a checkout of Snug\n  \
                 cargo install --locked --path crates/snug-plant\n\
                 installs it, which takes some ten minutes",
            );
            exit::failed()
        }
        Err(error) => {
            complain(&format!("snug-plant cannot be started: {error}"));
            exit::failed()
        }
    }
}

/// Beside this program, else wherever PATH leads.
fn path() -> PathBuf {
    let name = format!("snug-plant{}", std::env::consts::EXE_SUFFIX);
    let beside = std::env::current_exe().ok();
    (beside.and_then(|program| Some(program.parent()?.join(&name))))
        .filter(|path| path.is_file())
        .unwrap_or_else(|| name.into())
}
