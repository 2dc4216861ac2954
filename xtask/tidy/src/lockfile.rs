//! Cargo.lock: every package that any platform may need, at its exact version.

use crate::reading::{Error, read_toml};
use semver::Version;
use serde::Deserialize;
use std::path::Path;

/// The lock file, as far as the checks look at it.
#[derive(Debug, Deserialize)]
pub struct Lockfile {
    /// Every package, the workspace's own included.
    #[serde(rename = "package")]
    pub packages: Vec<Locked>,
}

/// One package at one version.
#[derive(Debug, Clone, Deserialize)]
pub struct Locked {
    /// Its name.
    pub name: String,
    /// Its version.
    pub version: Version,
    /// Where it comes from; nothing for a package in a folder.
    pub source: Option<String>,
}

impl Lockfile {
    /// The lock file of the workspace in this folder.
    ///
    /// # Errors
    /// When there is none or it is not one.
    pub fn read(root: &Path) -> Result<Self, Error> {
        read_toml(&root.join("Cargo.lock"))
    }

    /// Packages that come from outside the workspace.
    pub fn foreign(&self) -> impl Iterator<Item = &Locked> {
        let packages = self.packages.iter();
        packages.filter(|package| package.source.is_some())
    }
}

#[cfg(test)]
impl Lockfile {
    /// A made-up one: names and versions, all from the registry.
    pub fn of(packages: &[(&str, &str)]) -> Self {
        let locked = |&(name, version): &(&str, &str)| Locked {
            name: name.into(),
            version: version.parse().expect("a made-up version is one"),
            source: Some("registry+https://github.com/rust-lang/crates.io-index".into()),
        };
        Self {
            packages: packages.iter().map(locked).collect(),
        }
    }
}
