//! Features: whatever a run is built from has the features that the tests build it with, so that nothing is compiled twice.

use crate::outcome::{Outcome, Problem};
use crate::reading::{Error, tree};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Packages by name and version, each with the sets of features it is built with.
#[derive(Debug, Default)]
pub struct Features(BTreeMap<String, BTreeSet<String>>);

/// What the command line is built from, and what all tests are.
///
/// # Errors
/// When cargo cannot list them.
pub fn built(root: &Path) -> Result<[Features; 2], Error> {
    let listed = |of: &str, edges: &str| -> Result<Features, Error> {
        let options = [of, edges, "--prefix=none", "--format={p}|{f}"];
        Ok(Features::parse(&tree(root, &options)?))
    };
    Ok([
        listed("--package=xtask", "--edges=normal,build")?,
        listed("--workspace", "--edges=normal,build,dev")?,
    ])
}

impl Features {
    /// Reads the answer of `cargo tree --prefix none --format '{p}|{f}'`, a line a package: `serde v1.0.229|derive,std (*)`. Packages in a
    /// folder are left out: Snug's own differ where one has a program that a run does without.
    fn parse(tree: &str) -> Self {
        let mut features = Self::default();
        for line in tree.lines() {
            let Some((package, with)) = line.split_once('|') else {
                continue;
            };
            let package = package.trim_end_matches(" (proc-macro)");
            if !package.contains('(') {
                let with = with.trim_end_matches(" (*)").to_owned();
                features
                    .0
                    .entry(package.to_owned())
                    .or_default()
                    .insert(with);
            }
        }
        features
    }
}

/// Refuses packages that a run and the tests build with other features.
pub fn check([run, tests]: &[Features; 2]) -> Outcome {
    let of_tests = |package: &str| tests.0.get(package).cloned().unwrap_or_default();
    let differing = run.0.iter().filter_map(|(package, with)| {
        let of_tests = of_tests(package);
        (!with.is_subset(&of_tests)).then_some((package, with, of_tests))
    });
    let told = |sets: &BTreeSet<String>| {
        let sets: Vec<&str> = sets.iter().map(String::as_str).collect();
        sets.join("; ")
    };
    let problems = differing.map(|(package, with, of_tests)| Problem {
        file: "Cargo.toml".into(),
        what: format!(
            "a run builds {package} with {}, the tests with {}: it and all that uses it are compiled twice",
            told(with),
            told(&of_tests)
        ),
        remedy: "name the features that only the tests ask for in [workspace.dependencies], as for serde_json".into(),
    });
    let problems: Vec<Problem> = problems.collect();
    Outcome {
        check: "features",
        summary: format!(
            "{} packages are built once, for a run and its tests",
            run.0.len()
        ),
        gaps: Vec::new(),
        notes: Vec::new(),
        problems,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is wrong where a run is built from rope alone.
    fn problems(of_run: &str, of_tests: &str) -> Vec<Problem> {
        check(&[of_run, of_tests].map(Features::parse)).problems
    }

    #[test]
    fn a_package_with_more_features_in_the_tests_is_refused() {
        let told = problems(
            "rope v1.0.0|std (*)\nknot v1.0.0 (proc-macro)|",
            "rope v1.0.0|loop,std\nknot v1.0.0 (proc-macro)|",
        );
        let [problem] = told.as_slice() else {
            panic!("{told:?}")
        };
        assert!(
            problem
                .what
                .contains("rope v1.0.0 with std, the tests with loop,std")
        );
    }

    /// What macros are made of may be built otherwise than what runs; the tests may build more; Snug's own crates are not looked at.
    #[test]
    fn what_both_build_alike_is_well() {
        let tests =
            "rope v1.0.0|std\nrope v1.0.0|loop,std\ncord v1.0.0|\nsnug v0.1.0 (/somewhere)|program";
        assert_eq!(
            problems("rope v1.0.0|std\nsnug v0.1.0 (/somewhere)|", tests),
            []
        );
        assert_eq!(problems("rope v1.0.0|loop,std (*)", tests), []);
    }
}
