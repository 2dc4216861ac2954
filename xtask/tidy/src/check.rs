//! What must hold of the workspace as a whole and can be checked without a network: one check, one file.

use crate::lockfile::Lockfile;
use crate::{
    advisories, duplicates, headers, licences, packages, sizes, source_files, units, unused,
};
use cargo_metadata::{Metadata, MetadataCommand};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Something that is wrong, and what to do about it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// The file to change, from the workspace's folder.
    pub file: String,
    /// What is wrong.
    pub what: String,
    /// What puts it right.
    pub remedy: String,
}

/// What one check found.
#[derive(Debug)]
pub struct Outcome {
    /// Name of the check.
    pub check: &'static str,
    /// What was looked at, in one line.
    pub summary: String,
    /// What the check could not see; fails nothing, but is always said.
    pub gaps: Vec<String>,
    /// What is worth knowing and fails nothing.
    pub notes: Vec<String>,
    /// What is wrong; none when all is well.
    pub problems: Vec<Problem>,
}

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

/// Every check of the workspace in this folder.
///
/// # Errors
/// When the workspace cannot be described or a file of it cannot be read; what a check finds wrong is no error.
pub fn check(root: &Path) -> Result<Vec<Outcome>, Error> {
    let metadata = describe(root)?;
    let lockfile = Lockfile::read(root)?;
    let files = source_files::all(root)?;
    let mut outcomes = vec![
        licences::check(&licences::licensed(root)?, &lockfile),
        advisories::check(&advisories::Snapshot::read(root)?, &lockfile),
        unused::check(&unused::shared(root)?, &unused::members(&metadata)?),
        duplicates::check(&duplicates::built(root)?),
        packages::check(&packages::published(&metadata)),
        headers::check(&files),
        sizes::check(&files),
        units::check(&files),
    ];
    outcomes.extend(of_plant(root)?);
    Ok(outcomes)
}

/// The workspace that is not built with the others.
const PLANT: &str = "crates/snug-plant";

/// What the plant is built from: its sources are looked at with all others.
fn of_plant(root: &Path) -> Result<Vec<Outcome>, Error> {
    let plant = root.join(PLANT);
    let lockfile = Lockfile::read(&plant)?;
    let licences = match licences::licensed(&plant) {
        Ok(licensed) => licences::check(&licensed, &lockfile),
        // Cargo knows the licences of what it has fetched only.
        Err(Error::Refused { .. }) => Outcome {
            check: "",
            summary: "not looked at".into(),
            gaps: vec![format!(
                "its packages are not here; `cargo fetch --manifest-path {PLANT}/Cargo.toml` brings them"
            )],
            notes: Vec::new(),
            problems: Vec::new(),
        },
        Err(error) => return Err(error),
    };
    let members = unused::members(&describe(&plant)?)?;
    let outcomes = [
        ("licences of the plant", licences),
        (
            "advisories of the plant",
            advisories::check(&advisories::Snapshot::read(root)?, &lockfile),
        ),
        (
            "unused dependencies of the plant",
            unused::check(&BTreeSet::new(), &members),
        ),
    ];
    let named = outcomes.into_iter().map(|(name, mut outcome)| {
        outcome.check = name;
        for problem in &mut outcome.problems {
            if problem.file == "Cargo.lock" {
                problem.file = format!("{PLANT}/Cargo.lock");
            }
        }
        outcome
    });
    Ok(named.collect())
}

/// The packages of the workspace and what they declare.
fn describe(root: &Path) -> Result<Metadata, Error> {
    Ok(MetadataCommand::new().current_dir(root).no_deps().exec()?)
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
