//! `cargo xtask test`: cargo's tests, then every example; environment variables switch on what takes long.

use crate::workspace;
use snug_cli::{complain, exit};
use std::path::PathBuf;
use std::process::ExitCode;

/// Every test of the workspace, optimised, documentation examples included; then every example of the crates, run as it is.
pub fn test(many: bool, blind: bool, people: Option<&str>, filter: Option<&str>) -> ExitCode {
    let mut cargo = workspace::cargo();
    cargo.args(["test", "--release", "--workspace", "--no-fail-fast"]);
    if let Some(filter) = filter {
        cargo.arg(filter);
    }
    if many {
        cargo.env("SNUG_MANY", "1");
    }
    if blind {
        cargo.env("SNUG_BLIND", "1");
    }
    if let Some(picked) = people {
        cargo.env("SNUG_PEOPLE", picked);
    }
    let mut is_well = workspace::succeeds(cargo);
    for name in examples() {
        if filter.is_none_or(|filter| name.contains(filter)) {
            let mut cargo = workspace::cargo();
            cargo.args(["run", "--quiet", "--release", "--example", &name]);
            if !workspace::succeeds(cargo) {
                complain(&format!(
                    "example {name} failed: `cargo run --release --example {name}`"
                ));
                is_well = false;
            }
        }
    }
    match is_well {
        true => exit::DONE,
        false => exit::failed(),
    }
}

/// Names of the examples, `crates/*/examples/NAME.rs`, in their order.
fn examples() -> Vec<String> {
    let entries = |folder: PathBuf| std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut names: Vec<String> = entries(workspace::root().join("crates"))
        .flat_map(|one| entries(one.path().join("examples")))
        .filter_map(|file| Some(file.file_name().to_str()?.strip_suffix(".rs")?.to_owned()))
        .collect();
    names.sort();
    names
}
