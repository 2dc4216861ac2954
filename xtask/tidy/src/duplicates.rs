//! Duplicates: packages built in more than one version for the command line, on this machine.
//!
//! Counted over normal dependencies, macros and what they are made of included (`cargo tree -p xtask -e normal -d`).

use crate::outcome::{Outcome, Problem};
use crate::reading::{Error, tree};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// How many packages may be there in more than one version. All come from two packages that lag behind: Clarabel
/// (derive_builder 0.11: darling, strsim, syn 1; thiserror 1) and nano-gemm (equator 0.2). Only ever to be lowered.
const CEILING: usize = 9;

/// Packages by name, each with its versions, each with the packages that name it.
#[derive(Debug, Default)]
pub struct Versions(BTreeMap<String, BTreeMap<String, BTreeSet<String>>>);

/// Every package the command line is built from on this machine.
///
/// # Errors
/// When cargo cannot list them.
pub fn built(root: &Path) -> Result<Versions, Error> {
    let options = ["--package=xtask", "--edges=normal", "--prefix=depth"];
    Ok(Versions::parse(&tree(root, &options)?))
}

impl Versions {
    /// Reads the answer of `cargo tree --prefix depth`, a line a package: `2serde v1.0.229 (*)`.
    fn parse(tree: &str) -> Self {
        let mut versions = Self::default();
        let mut above: Vec<String> = Vec::new();
        for line in tree.lines() {
            let Some(start) = line.find(|character: char| !character.is_ascii_digit()) else {
                continue;
            };
            let depth: usize = line[..start].parse().unwrap_or(0);
            let mut words = line[start..].split_whitespace();
            let (Some(name), Some(version)) = (words.next(), words.next()) else {
                continue;
            };
            let version = version.trim_start_matches('v');
            above.truncate(depth);
            let versions = versions.0.entry(name.into()).or_default();
            let dependents = versions.entry(version.into()).or_default();
            dependents.extend(above.last().cloned());
            above.push(format!("{name} {version}"));
        }
        versions
    }
}

/// Holds the number of duplicates to its ceiling.
pub fn check(versions: &Versions) -> Outcome {
    check_against(versions, CEILING)
}

/// The same, with this ceiling.
fn check_against(versions: &Versions, ceiling: usize) -> Outcome {
    let packages = versions.0.iter();
    let duplicates: Vec<_> = packages
        .filter(|(_, versions)| versions.len() > 1)
        .collect();
    let listed = duplicates.iter().map(|(name, versions)| {
        let each = versions.iter().map(|(version, dependents)| {
            let dependents: Vec<&str> = dependents.iter().map(String::as_str).collect();
            format!("{version} (for {})", dependents.join(", "))
        });
        format!("{name}: {}", each.collect::<Vec<_>>().join("; "))
    });
    let count = duplicates.len();
    let problem = if count > ceiling {
        Some(Problem {
            file: "Cargo.lock".into(),
            what: format!("{count} packages are there in more than one version, {ceiling} may be"),
            remedy: "choose versions that share their dependencies (the list below says who asks for what)".into(),
        })
    } else if count < ceiling {
        Some(Problem {
            file: "xtask/tidy/src/duplicates.rs".into(),
            what: format!("{ceiling} packages may be there in more than one version, {count} are"),
            remedy: format!("lower CEILING to {count}, so that none comes back"),
        })
    } else {
        None
    };
    Outcome {
        check: "duplicates",
        summary: format!(
            "{count} of {} packages of xtask are there in more than one version, as many as may be",
            versions.0.len()
        ),
        gaps: Vec::new(),
        notes: listed.collect(),
        problems: problem.into_iter().collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn two_ropes() -> Versions {
        Versions::parse(
            "0crane v0.1.0 (/somewhere/crane)\n\
             1rope v2.0.0\n\
             2cord v1.0.0 (proc-macro)\n\
             1swing v0.1.0\n\
             2rope v1.0.0\n\
             3cord v1.0.0 (proc-macro) (*)\n",
        )
    }

    #[test]
    fn one_more_than_may_be_is_refused_and_listed_with_who_asks() {
        let outcome = check_against(&two_ropes(), 0);
        assert_eq!(outcome.problems.len(), 1);
        assert_eq!(
            outcome.notes,
            ["rope: 1.0.0 (for swing 0.1.0); 2.0.0 (for crane 0.1.0)"]
        );
    }

    #[test]
    fn the_ceiling_follows_downwards() {
        assert_eq!(check_against(&two_ropes(), 1).problems, []);
        let loose = check_against(&two_ropes(), 2);
        assert!(loose.problems[0].remedy.contains("CEILING to 1"));
    }
}
