//! Unused dependencies: what is declared is named somewhere in the sources of the package that declares it.
//!
//! The search is textual: a dependency is used where its name stands as a path (`name::`), an import (`use name`) or a macro
//! (`name!`), outside comments. That finds what nobody names; a name of the same spelling may hide one.

use crate::outcome::{Outcome, Problem};
use crate::reading::{Error, read, read_toml};
use cargo_metadata::{DependencyKind, Metadata, Package, TargetKind};
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Dependencies declared once for the workspace.
pub fn shared(root: &Path) -> Result<BTreeSet<String>, Error> {
    #[derive(Deserialize)]
    struct Manifest {
        workspace: Workspace,
    }
    #[derive(Deserialize)]
    struct Workspace {
        dependencies: BTreeMap<String, toml::Value>,
    }
    let manifest: Manifest = read_toml(&root.join("Cargo.toml"))?;
    Ok(manifest.workspace.dependencies.into_keys().collect())
}

/// One package of the workspace.
#[derive(Debug)]
pub struct Member {
    /// Its manifest, from the workspace's folder.
    pub manifest: String,
    /// What it declares.
    pub dependencies: Vec<Declared>,
    /// Its sources: of the library and programs, of the build script, of all with tests, benchmarks and examples.
    pub sources: Sources,
}

/// A declared dependency.
#[derive(Debug)]
pub struct Declared {
    /// Its name in the manifest.
    pub name: String,
    /// What it is for.
    pub kind: DependencyKind,
}

/// Sources by what they are for.
#[derive(Debug, Default)]
pub struct Sources {
    /// Library and programs, their unit tests included.
    pub normal: String,
    /// Build script.
    pub build: String,
    /// Every Rust file of the package and its README, whose examples are tests.
    pub all: String,
}

/// Every package of the workspace with its sources.
pub fn members(metadata: &Metadata) -> Result<Vec<Member>, Error> {
    let packages = metadata.workspace_packages().into_iter();
    packages.map(|package| member(package, metadata)).collect()
}

fn member(package: &Package, metadata: &Metadata) -> Result<Member, Error> {
    let folder = |file: &cargo_metadata::camino::Utf8Path| {
        file.parent()
            .map(|folder| folder.as_std_path().to_path_buf())
    };
    let mut sources = Sources::default();
    let mut normal = BTreeSet::new();
    for target in &package.targets {
        if target.is_kind(TargetKind::CustomBuild) {
            sources.build = read(target.src_path.as_std_path())?;
        } else if !(target.is_test() || target.is_bench() || target.is_example()) {
            normal.extend(folder(&target.src_path));
        }
    }
    for folder in normal {
        append_rust(&folder, &mut sources.normal)?;
    }
    if let Some(folder) = folder(&package.manifest_path) {
        append_rust(&folder, &mut sources.all)?;
    }
    if let Some(readme) = package.readme() {
        sources.all.push_str(&read(readme.as_std_path())?);
    }
    let own = |name: &str| package.name.as_str() == name;
    let declared = package.dependencies.iter().filter(|d| !own(&d.name));
    let manifest = package.manifest_path.strip_prefix(&metadata.workspace_root);
    Ok(Member {
        manifest: manifest.unwrap_or(&package.manifest_path).to_string(),
        dependencies: declared
            .map(|dependency| Declared {
                name: dependency
                    .rename
                    .clone()
                    .unwrap_or_else(|| dependency.name.clone()),
                kind: dependency.kind,
            })
            .collect(),
        sources,
    })
}

/// Appends every Rust file in a folder and below, but for packages of their own.
fn append_rust(folder: &Path, text: &mut String) -> Result<(), Error> {
    let unreadable = |source| Error::Unreadable {
        path: folder.to_path_buf(),
        source,
    };
    let entries = std::fs::read_dir(folder).map_err(unreadable)?;
    let paths: Result<Vec<PathBuf>, _> = entries
        .map(|entry| entry.map(|entry| entry.path()))
        .collect();
    for path in paths.map_err(unreadable)? {
        if path.is_dir() {
            if !path.join("Cargo.toml").is_file() {
                append_rust(&path, text)?;
            }
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            text.push_str(&read(&path)?);
            text.push('\n');
        }
    }
    Ok(())
}

/// Refuses dependencies that nobody uses.
pub fn check(shared: &BTreeSet<String>, members: &[Member]) -> Outcome {
    let mut problems = Vec::new();
    let declared = || members.iter().flat_map(|member| &member.dependencies);
    let taken: BTreeSet<&str> = declared().map(|dependency| &*dependency.name).collect();
    let idle = shared.iter().filter(|name| !taken.contains(name.as_str()));
    problems.extend(idle.map(|name| Problem {
        file: "Cargo.toml".into(),
        what: format!("{name} is declared for the workspace and no member takes it"),
        remedy: "remove it from [workspace.dependencies]".into(),
    }));
    for member in members {
        let unused = member
            .dependencies
            .iter()
            .filter(|declared| !is_used(declared, &member.sources));
        problems.extend(unused.map(|declared| Problem {
            file: member.manifest.clone(),
            what: format!(
                "{} is declared ({}) and not named in the sources",
                declared.name, declared.kind
            ),
            remedy:
                "remove it, or make it a dev-dependency if only tests or examples name it".into(),
        }));
    }
    Outcome {
        check: "unused dependencies",
        summary: format!(
            "{} dependencies of {} packages are named in their sources, {} of the workspace are taken",
            declared().count(),
            members.len(),
            shared.len()
        ),
        gaps: Vec::new(),
        notes: Vec::new(),
        problems,
    }
}

/// Whether the sources it is for name it. Documentation examples count for dev-dependencies.
fn is_used(declared: &Declared, sources: &Sources) -> bool {
    let identifier = declared.name.replace('-', "_");
    let (text, is_doc_code) = match declared.kind {
        DependencyKind::Build => (&sources.build, false),
        DependencyKind::Development => (&sources.all, true),
        _ => (&sources.normal, false),
    };
    text.lines()
        .any(|line| names(code(line, is_doc_code), &identifier))
}

/// A line without its comment, or with it if it is documentation that may be code.
fn code(line: &str, is_doc_code: bool) -> &str {
    let start = line.trim_start();
    let is_doc = start.starts_with("///") || start.starts_with("//!");
    if is_doc && is_doc_code {
        return start.trim_start_matches(['/', '!']);
    }
    line.split("//").next().unwrap_or(line)
}

/// Whether a line of code names a package.
fn names(line: &str, identifier: &str) -> bool {
    let is_word = |character: char| character.is_alphanumeric() || character == '_';
    line.match_indices(identifier).any(|(start, _)| {
        let (before, after) = (&line[..start], &line[start + identifier.len()..]);
        let is_whole = !before.ends_with(is_word) && !after.starts_with(is_word);
        // `::name`, `.name` and `name` in quotes are other things of the same spelling.
        let is_own = !before.ends_with("::") && !before.ends_with(['.', '"']);
        let is_imported =
            before.trim_end().ends_with("use") || before.trim_end().ends_with("extern crate");
        is_whole && is_own && (is_imported || after.starts_with("::") || after.starts_with('!'))
    })
}

#[cfg(test)]
mod tests;
