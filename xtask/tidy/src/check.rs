//! What must hold of the workspace as a whole and can be checked without a network: one check, one file.

use crate::lockfile::Lockfile;
use crate::outcome::Outcome;
use crate::reading::Error;
use crate::{
    advisories, duplicates, features, headers, licences, packages, sizes, source_files, units,
    unused,
};
use cargo_metadata::{Metadata, MetadataCommand};
use std::collections::BTreeSet;
use std::path::Path;

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
        features::check(&features::built(root)?),
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
