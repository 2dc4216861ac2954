//! What is read of the workspace, by itself or through cargo, and why it may not be.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Why the workspace cannot be checked.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A file cannot be read.
    #[error("{path} cannot be read: {source}")]
    Unreadable {
        /// The file or folder.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// A file is not the TOML that is expected.
    #[error("{path} is not as expected: {source}")]
    Malformed {
        /// The file.
        path: PathBuf,
        /// Where and why.
        source: toml::de::Error,
    },
    /// Cargo does not describe the workspace.
    #[error("cargo cannot describe the workspace: {0}")]
    Metadata(#[from] cargo_metadata::Error),
    /// Cargo cannot be started.
    #[error("{command} cannot be started: {source}")]
    NotStarted {
        /// The command.
        command: String,
        /// Why.
        source: std::io::Error,
    },
    /// Cargo fails, or says nothing.
    #[error("{command} failed: {answer}")]
    Refused {
        /// The command.
        command: String,
        /// What it says.
        answer: String,
    },
}

/// What cargo builds on this machine, as `cargo tree` lists it: a package a line, with its depth first or none.
///
/// Not asked of `cargo metadata`, which counts optional packages that no feature in use asks for.
pub fn tree(root: &Path, options: &[&str]) -> Result<String, Error> {
    cargo(
        root,
        &[&["tree", "--locked", "--offline"], options].concat(),
    )
}

/// What cargo answers; to answer nothing is to fail.
fn cargo(root: &Path, arguments: &[&str]) -> Result<String, Error> {
    let command = || format!("cargo {}", arguments.join(" "));
    let output = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
        .current_dir(root)
        .args(arguments)
        .output();
    let output = output.map_err(|source| Error::NotStarted {
        command: command(),
        source,
    })?;
    if !output.status.success() || output.stdout.is_empty() {
        return Err(Error::Refused {
            command: command(),
            answer: String::from_utf8_lossy(&output.stderr).into_owned(),
        });
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// A text file of the workspace.
pub fn read(path: &Path) -> Result<String, Error> {
    std::fs::read_to_string(path).map_err(|source| Error::Unreadable {
        path: path.to_path_buf(),
        source,
    })
}

/// A TOML file of the workspace.
pub fn read_toml<T: serde::de::DeserializeOwned>(path: &Path) -> Result<T, Error> {
    toml::from_str(&read(path)?).map_err(|source| Error::Malformed {
        path: path.to_path_buf(),
        source,
    })
}
