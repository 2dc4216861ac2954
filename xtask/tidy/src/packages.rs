//! Packages: whoever takes one crate alone gets its licence and its README, and words to find it by.

use crate::outcome::{Outcome, Problem};
use cargo_metadata::{Metadata, Package};

/// A package that may be published.
#[derive(Debug)]
pub struct Published {
    /// Its manifest, from the workspace's folder.
    pub manifest: String,
    /// Keys that its manifest does not state, and files that are not beside it.
    pub lacks: Vec<&'static str>,
}

/// Every package of the workspace but those that say `publish = false`.
pub fn published(metadata: &Metadata) -> Vec<Published> {
    let packages = metadata.workspace_packages().into_iter();
    packages
        .filter(|package| package.publish.as_ref().is_none_or(|to| !to.is_empty()))
        .map(|package| {
            let manifest = package.manifest_path.strip_prefix(&metadata.workspace_root);
            Published {
                manifest: manifest.unwrap_or(&package.manifest_path).to_string(),
                lacks: lacks(package),
            }
        })
        .collect()
}

fn lacks(package: &Package) -> Vec<&'static str> {
    let is_beside = |file: &str| package.manifest_path.with_file_name(file).is_file();
    let wanted = [
        ("description", package.description.is_some()),
        ("license", package.license.is_some()),
        ("readme", package.readme.is_some()),
        ("keywords", !package.keywords.is_empty()),
        ("categories", !package.categories.is_empty()),
        ("README.md", is_beside("README.md")),
        ("LICENSE", is_beside("LICENSE")),
    ];
    let missing = wanted.into_iter().filter(|(_, is_there)| !is_there);
    missing.map(|(name, _)| name).collect()
}

/// Refuses packages that lack something.
pub fn check(packages: &[Published]) -> Outcome {
    let lacking = packages.iter().filter(|package| !package.lacks.is_empty());
    let problems = lacking.map(|package| Problem {
        file: package.manifest.clone(),
        what: format!("lacks {}", package.lacks.join(", ")),
        remedy: "state keys as the neighbours do (`publish = false` where nobody takes it alone); \
                 LICENSE is a link: `ln -s ../../LICENSE`"
            .into(),
    });
    Outcome {
        check: "packages",
        summary: format!(
            "{} packages bring licence, README and words to find them by",
            packages.len()
        ),
        gaps: Vec::new(),
        notes: Vec::new(),
        problems: problems.collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_package_lacks_is_named_with_its_manifest() {
        let of = |manifest: &str, lacks: &[&'static str]| Published {
            manifest: manifest.into(),
            lacks: lacks.into(),
        };
        let complete = of("crates/rope/Cargo.toml", &[]);
        let bare = of("crates/knot/Cargo.toml", &["keywords", "LICENSE"]);
        let outcome = check(&[complete, bare]);
        let [problem] = outcome.problems.as_slice() else {
            panic!("{:?}", outcome.problems);
        };
        assert_eq!(problem.file, "crates/knot/Cargo.toml");
        assert_eq!(problem.what, "lacks keywords, LICENSE");
    }
}
