//! Licences and sources: everything comes from crates.io, under a licence that lets Snug be passed on under its own.

use crate::lockfile::Lockfile;
use crate::outcome::{Outcome, Problem};
use crate::reading::{Error, tree};
use spdx::{Expression, LicenseReq, ParseMode};
use std::collections::BTreeSet;
use std::path::Path;

/// Licences a dependency may have: those that ask for no more than their notice to be kept, so that Snug stays MIT and may be
/// linked into programs whose source is closed. No copyleft; MPL-2.0 is not needed by anything so far. An exception
/// (`WITH …`) only ever permits more and is accepted with its licence.
const ALLOWED: &[&str] = &[
    "MIT",
    "Apache-2.0",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "ISC",
    "Zlib",
    "0BSD",
    "Unlicense",
    "CC0-1.0",
    "Unicode-3.0",
    // BSD in other words: the plant's engine unpacks bzip2 with it.
    "bzip2-1.0.6",
];

/// The one place dependencies come from: published, immutable, with a checksum in the lock file.
const SOURCE: &str = "registry+https://github.com/rust-lang/crates.io-index";

/// A package and its licence.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Licensed {
    /// Name and version.
    package: String,
    /// SPDX expression, if it states one.
    licence: Option<String>,
}

/// Every package cargo builds from on this machine, for tests and build scripts as well.
///
/// # Errors
/// When cargo cannot list them.
pub fn licensed(root: &Path) -> Result<BTreeSet<Licensed>, Error> {
    let options = [
        "--workspace",
        "--edges=normal,build,dev",
        "--prefix=none",
        "--format={l}\t{p}",
    ];
    Ok(parse(&tree(root, &options)?))
}

/// Reads the answer of `cargo tree`, licence and package a line: `MIT\tserde v1.0.229 (*)`.
fn parse(tree: &str) -> BTreeSet<Licensed> {
    let lines = tree.lines().filter_map(|line| line.split_once('\t'));
    lines
        .map(|(licence, package)| Licensed {
            package: package
                .split_whitespace()
                .take(2)
                .collect::<Vec<_>>()
                .join(" "),
            licence: (!licence.is_empty()).then(|| licence.into()),
        })
        .collect()
}

/// Refuses packages without an allowed licence, and packages from elsewhere than crates.io.
pub fn check(packages: &BTreeSet<Licensed>, lockfile: &Lockfile) -> Outcome {
    let mut problems: Vec<Problem> = packages.iter().filter_map(refused).collect();
    problems.extend(lockfile.foreign().filter_map(|locked| {
        let source = locked
            .source
            .as_deref()
            .filter(|&source| source != SOURCE)?;
        Some(Problem {
            file: "Cargo.lock".into(),
            what: format!("{} {} comes from {source}", locked.name, locked.version),
            remedy: "use a version published on crates.io".into(),
        })
    }));
    Outcome {
        check: "licences",
        summary: format!(
            "{} packages have an allowed licence, {} come from crates.io",
            packages.len(),
            lockfile.foreign().count()
        ),
        gaps: Vec::new(),
        notes: Vec::new(),
        problems,
    }
}

/// What is wrong with a package's licence, if anything.
fn refused(package: &Licensed) -> Option<Problem> {
    let problem = |what: String| {
        Some(Problem {
            file: "Cargo.lock".into(),
            what: format!("{} {what}", package.package),
            remedy: "leave it out, or allow the licence in xtask/tidy/src/licences.rs".into(),
        })
    };
    let Some(licence) = &package.licence else {
        return problem("states no licence".into());
    };
    match Expression::parse_mode(licence, ParseMode::LAX) {
        Err(error) => problem(format!("has a licence that is no SPDX expression: {error}")),
        Ok(expression) if expression.evaluate(is_allowed) => None,
        Ok(_) => problem(format!("is licensed {licence}, which is not allowed")),
    }
}

/// Whether a licence is on the list.
fn is_allowed(required: &LicenseReq) -> bool {
    let id = required.license.id();
    id.is_some_and(|id| ALLOWED.contains(&id.name))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn problems(licence: Option<&str>) -> Vec<Problem> {
        let tree = format!("{}\trope v1.0.0 (*)\n", licence.unwrap_or_default());
        check(&parse(&tree), &Lockfile::of(&[])).problems
    }

    #[test]
    fn one_allowed_choice_suffices_and_every_joined_licence_counts() {
        for licence in [
            "MIT",
            "MIT/Apache-2.0",
            "GPL-3.0-only OR MIT",
            "(MIT OR Apache-2.0) AND Unicode-3.0",
            "Apache-2.0 WITH LLVM-exception",
        ] {
            assert_eq!(problems(Some(licence)), [], "{licence}");
        }
        for licence in [
            "GPL-3.0-only",
            "GPL-2.0-only WITH Classpath-exception-2.0",
            "MIT AND GPL-3.0-only",
            "AGPL-3.0-only",
            "MPL-2.0",
        ] {
            let found = problems(Some(licence));
            assert_eq!(found.len(), 1, "{licence}");
            assert!(found[0].what.contains(licence), "{}", found[0].what);
        }
    }

    #[test]
    fn a_package_must_state_a_licence_that_can_be_read() {
        assert!(problems(None)[0].what.contains("states no licence"));
        assert!(problems(Some("as you like"))[0].what.contains("no SPDX"));
    }

    #[test]
    fn packages_from_elsewhere_are_refused() {
        let mut lockfile = Lockfile::of(&[("rope", "1.0.0"), ("cord", "2.0.0")]);
        lockfile.packages[1].source = Some("git+https://example.org/cord#0123".into());
        let found = check(&BTreeSet::new(), &lockfile).problems;
        assert_eq!(found.len(), 1);
        assert!(found[0].what.starts_with("cord 2.0.0 comes from git+"));
    }

    #[test]
    fn every_allowed_licence_has_a_name_spdx_knows() {
        for name in ALLOWED {
            assert!(spdx::license_id(name).is_some(), "{name}");
        }
    }
}
