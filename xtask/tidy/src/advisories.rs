//! Security advisories: no locked package is one that a known advisory says to leave or to update.
//!
//! Compared with a snapshot that is committed (`fixtures/advisories.toml`), for the check needs no network: what was
//! published after the snapshot, it cannot know.

use crate::lockfile::{Locked, Lockfile};
use crate::outcome::{Outcome, Problem};
use crate::reading::{Error, read_toml};
use semver::VersionReq;
use serde::Deserialize;
use std::collections::BTreeSet;
use std::path::Path;

/// The snapshot, from the workspace's folder.
const SNAPSHOT: &str = "fixtures/advisories.toml";

/// Advisories that apply and are lived with, each with the reason. One that no longer applies must go.
const EXCEPTIONS: &[(&str, &str)] = &[(
    "RUSTSEC-2024-0436",
    "paste is finished rather than flawed: a macro that runs while gemm (under faer) is compiled, and nothing of it is linked",
)];

/// Known advisories of the packages that were looked up.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Snapshot {
    /// Latest date seen in an advisory of the copy that was looked at, YYYY-MM-DD.
    pub copy_date: String,
    /// The highest id seen in that copy.
    pub newest_id: String,
    /// When the packages were looked up, YYYY-MM-DD.
    pub looked_up_on: String,
    /// Packages that were looked up, with or without an advisory.
    pub looked_up: BTreeSet<String>,
    /// The advisories found.
    #[serde(rename = "advisory")]
    pub advisories: Vec<Advisory>,
}

/// One advisory, in the fields of the RustSec database.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Advisory {
    /// RUSTSEC-YYYY-NNNN.
    pub id: String,
    /// The package it is about.
    pub package: String,
    /// When it was made known, YYYY-MM-DD.
    pub date: String,
    /// What is wrong.
    pub title: String,
    /// What it is when it is no vulnerability.
    pub informational: Option<Informational>,
    /// When it was taken back, YYYY-MM-DD; it then applies to nothing.
    pub withdrawn: Option<String>,
    /// Versions in which it is put right.
    pub patched: Vec<VersionReq>,
    /// Versions that never had it.
    #[serde(default)]
    pub unaffected: Vec<VersionReq>,
}

/// Kinds of advisory that are no vulnerability.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Informational {
    /// Nobody looks after it.
    Unmaintained,
    /// Safe code can misuse it.
    Unsound,
    /// Something to know.
    Notice,
}

impl Snapshot {
    /// The snapshot of the workspace in this folder.
    ///
    /// # Errors
    /// When it cannot be read or is not one.
    pub fn read(root: &Path) -> Result<Self, Error> {
        read_toml(&root.join(SNAPSHOT))
    }
}

impl Advisory {
    /// Whether it is about this package at this version.
    fn applies_to(&self, locked: &Locked) -> bool {
        let is_spared = |ranges: &[VersionReq]| {
            let mut ranges = ranges.iter();
            ranges.any(|range| range.matches(&locked.version))
        };
        self.package == locked.name
            && self.withdrawn.is_none()
            && !is_spared(&self.patched)
            && !is_spared(&self.unaffected)
    }

    /// What to do about it.
    fn remedy(&self) -> String {
        let patched: Vec<String> = self.patched.iter().map(VersionReq::to_string).collect();
        let otherwise = "or give a reason in EXCEPTIONS of xtask/tidy/src/advisories.rs";
        if patched.is_empty() {
            return format!("no version puts it right: replace the package, {otherwise}");
        }
        format!("update it to {}, {otherwise}", patched.join(" or "))
    }
}

/// Compares the lock file with the snapshot.
pub fn check(snapshot: &Snapshot, lockfile: &Lockfile) -> Outcome {
    check_except(snapshot, lockfile, EXCEPTIONS)
}

/// The same, with these exceptions.
fn check_except(snapshot: &Snapshot, lockfile: &Lockfile, exceptions: &[(&str, &str)]) -> Outcome {
    let mut problems = Vec::new();
    let mut accepted = Vec::new();
    let mut idle: BTreeSet<&str> = exceptions.iter().map(|&(id, _)| id).collect();
    for (advisory, locked) in applying(snapshot, lockfile) {
        let what = describe(advisory, locked);
        if let Some((id, reason)) = exceptions.iter().find(|(id, _)| *id == advisory.id) {
            idle.remove(id);
            accepted.push(format!("{what}; accepted: {reason}"));
        } else {
            problems.push(Problem {
                file: "Cargo.lock".into(),
                what,
                remedy: advisory.remedy(),
            });
        }
    }
    let applies = match (problems.len(), accepted.len()) {
        (0, 0) => "none applies".into(),
        (0, accepted) => format!("{accepted} applies and is accepted"),
        (problems, accepted) => format!("{} apply, {accepted} accepted", problems + accepted),
    };
    problems.extend(idle.into_iter().map(|id| Problem {
        file: "xtask/tidy/src/advisories.rs".into(),
        what: format!("{id} is excepted and applies to nothing"),
        remedy: "take it out of EXCEPTIONS".into(),
    }));
    let (coverage, unseen) = coverage(snapshot, lockfile);
    Outcome {
        check: "advisories",
        summary: format!("{coverage}; {applies}"),
        gaps: unseen.into_iter().collect(),
        notes: accepted,
        problems,
    }
}

/// Every advisory with every locked package it applies to.
fn applying<'a>(
    snapshot: &'a Snapshot,
    lockfile: &'a Lockfile,
) -> impl Iterator<Item = (&'a Advisory, &'a Locked)> {
    snapshot.advisories.iter().flat_map(|advisory| {
        let packages = lockfile.foreign();
        packages
            .filter(|locked| advisory.applies_to(locked))
            .map(move |locked| (advisory, locked))
    })
}

/// What the snapshot knows of, and which packages it does not.
fn coverage(snapshot: &Snapshot, lockfile: &Lockfile) -> (String, Option<String>) {
    let names: BTreeSet<&str> = lockfile.foreign().map(|locked| &*locked.name).collect();
    let is_unseen = |name: &&str| !snapshot.looked_up.contains(*name);
    let unseen: Vec<&str> = names.iter().copied().filter(is_unseen).collect();
    let note = format!(
        "not looked up, so nothing is known of them: {} (renew the snapshot: xtask/README.md)",
        unseen.join(", ")
    );
    let coverage = format!(
        "{} known for {} of {} packages, from a copy of {} (up to {}) looked at on {}",
        snapshot.advisories.len(),
        names.len() - unseen.len(),
        names.len(),
        snapshot.copy_date,
        snapshot.newest_id,
        snapshot.looked_up_on
    );
    (coverage, (!unseen.is_empty()).then_some(note))
}

/// One advisory and the package it applies to, in words.
fn describe(advisory: &Advisory, locked: &Locked) -> String {
    let kind = match advisory.informational {
        None => "vulnerable",
        Some(Informational::Unmaintained) => "unmaintained",
        Some(Informational::Unsound) => "unsound",
        Some(Informational::Notice) => "noted",
    };
    format!(
        "{} {} is {kind}: {} ({}, {})",
        locked.name, locked.version, advisory.title, advisory.id, advisory.date
    )
}

#[cfg(test)]
mod tests;
