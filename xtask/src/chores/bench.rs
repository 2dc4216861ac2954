//! `cargo xtask bench`: hands over to the benchmark in `tests/benches`, and to those that live with what they measure.

use crate::workspace;
use std::process::{Command, ExitCode};

/// A benchmark with a program of its own: its section, and what cargo is asked for.
struct Apart {
    section: &'static str,
    cargo: &'static [&'static str],
    /// What asks for its long rows.
    long: &'static [&'static str],
}

const APART: &[Apart] = &[
    Apart {
        section: "workbench",
        cargo: &[
            "bench",
            "--package",
            "snug-workbench",
            "--bench",
            "clicks",
            "--",
        ],
        long: LONG,
    },
    Apart {
        section: "plant",
        cargo: &[
            "run",
            "--quiet",
            "--release",
            "--manifest-path",
            "crates/snug-plant/Cargo.toml",
            "--",
            "bench",
        ],
        long: &["--rows", "100000"],
    },
];

const LONG: &[&str] = &["--long"];

/// The benchmarks of `tests/benches`, in one table: the named sections or all, with the long rows or without; and those named that live
/// elsewhere.
pub fn bench(sections: &[String], is_long: bool) -> ExitCode {
    let of_section = |section: &String| APART.iter().find(|apart| apart.section == section);
    let engine: Vec<&String> = sections
        .iter()
        .filter(|section| of_section(section).is_none())
        .collect();
    let mut commands: Vec<Command> = Vec::new();
    if sections.is_empty() || !engine.is_empty() {
        let engine_only = [
            "bench",
            "--package",
            "snug-tests",
            "--bench",
            "engine",
            "--",
        ];
        let mut cargo = command(&engine_only, is_long, LONG);
        cargo.args(engine);
        commands.push(cargo);
    }
    let apart = sections.iter().filter_map(of_section);
    commands.extend(apart.map(|apart| command(apart.cargo, is_long, apart.long)));
    for cargo in commands {
        let code = workspace::run(cargo);
        if code != ExitCode::SUCCESS {
            return code;
        }
    }
    ExitCode::SUCCESS
}

fn command(arguments: &[&str], is_long: bool, long: &[&str]) -> Command {
    let mut cargo = workspace::cargo();
    cargo.args(arguments);
    if is_long {
        cargo.args(long);
    }
    cargo
}
