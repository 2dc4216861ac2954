//! The layering: which crate may know which, checked against what cargo says.

use crate::campaign::{embedded, run_study, study_on};
use cargo_metadata::{DependencyKind, MetadataCommand};
use snug_model::Effect;
use snug_study::Preset;
use std::collections::BTreeSet;

/// Every allowed edge between Snug's crates. An edge that is not here is a design change: change it here on purpose.
const ALLOWED: &[(&str, &[&str])] = &[
    ("snug-campaign", &[]),
    ("snug-files", &[]),
    ("snug-signal", &[]),
    ("snug-tidy", &[]),
    ("snug-statistics", &[]),
    ("snug-record", &["snug-campaign"]),
    (
        "snug-ingest",
        &["snug-campaign", "snug-files", "snug-record"],
    ),
    ("snug-preprocess", &["snug-campaign"]),
    ("snug-model", &["snug-campaign", "snug-signal"]),
    (
        "snug-identify",
        &[
            "snug-campaign",
            "snug-least-squares",
            "snug-model",
            "snug-signal",
        ],
    ),
    ("snug-least-squares", &[]),
    (
        "snug-diagnose",
        &[
            "snug-campaign",
            "snug-identify",
            "snug-least-squares",
            "snug-model",
            "snug-signal",
            "snug-statistics",
        ],
    ),
    ("snug-report", &["snug-campaign"]),
    ("snug-synthetic", &["snug-campaign"]),
    (
        "snug-study",
        &[
            "snug-campaign",
            "snug-diagnose",
            "snug-files",
            "snug-identify",
            "snug-ingest",
            "snug-least-squares",
            "snug-model",
            "snug-preprocess",
            "snug-record",
            "snug-report",
            "snug-statistics",
        ],
    ),
    (
        "snug-plant",
        &[
            "snug-campaign",
            "snug-diagnose",
            "snug-identify",
            "snug-least-squares",
            "snug-model",
            "snug-preprocess",
            "snug-report",
            "snug-statistics",
            "snug-study",
            "snug-synthetic",
        ],
    ),
    (
        "snug-workbench",
        &[
            "snug-campaign",
            "snug-diagnose",
            "snug-model",
            "snug-report",
            "snug-study",
        ],
    ),
    (
        "snug-cli",
        &[
            "snug-campaign",
            "snug-model",
            "snug-study",
            "snug-synthetic",
            "snug-workbench",
        ],
    ),
    ("xtask", &["snug-campaign", "snug-cli", "snug-synthetic"]),
];

#[test]
fn crates_know_only_whom_they_may() {
    // The plant is a workspace of its own.
    let workspaces = ["/../Cargo.toml", "/../crates/snug-plant/Cargo.toml"].map(|manifest| {
        MetadataCommand::new()
            .manifest_path(format!("{}{manifest}", env!("CARGO_MANIFEST_DIR")))
            .no_deps()
            .exec()
            .unwrap()
    });
    let packages = workspaces.iter().flat_map(|one| one.workspace_packages());
    let mut checked = BTreeSet::new();
    for package in packages {
        if package.name.as_str() == "snug-tests" {
            continue;
        }
        let (_, allowed) = ALLOWED
            .iter()
            .find(|(name, _)| *name == package.name.as_str())
            .unwrap_or_else(|| panic!("{} has no line in the list of layers", package.name));
        for dependency in &package.dependencies {
            let shipped = dependency.kind == DependencyKind::Normal;
            if shipped && dependency.name.starts_with("snug-") {
                assert!(
                    allowed.contains(&dependency.name.as_str()),
                    "{} must not know {}",
                    package.name,
                    dependency.name
                );
            }
        }
        checked.insert(package.name.to_string());
    }
    assert_eq!(checked.len(), ALLOWED.len(), "a listed crate is gone");
}

/// Preparation knows no model and speaks of the catalogue's effects by name only.
#[test]
fn what_preparation_takes_out_is_in_the_catalogue() {
    let (outcome, _out) = run_study(&study_on(&embedded(), Preset::Snug)).unwrap();
    let tightenings = outcome.result.tightenings.iter();
    let names: BTreeSet<&str> = tightenings
        .flat_map(|tightening| &tightening.corrections)
        .map(|correction| correction.effect.as_str())
        .collect();
    assert!(!names.is_empty());
    for name in names {
        assert!(Effect::named(name).is_some(), "{name}");
    }
}
