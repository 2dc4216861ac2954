//! `cargo xtask bench`: hands over to the benchmark in `tests/benches`, and to those that live with what they measure.

use crate::workspace;
use std::process::{Command, ExitCode};

/// A benchmark with a program of its own: its section, and what cargo is asked for.
struct Apart {
    section: &'static str,
    cargo: &'static [&'static str],
}

const APART: &[Apart] = &[Apart {
    section: "workbench",
    cargo: &[
        "bench",
        "--package",
        "snug-workbench",
        "--bench",
        "clicks",
        "--",
    ],
}];

/// The benchmarks of `tests/benches`, in one table: the named sections or all, with the long rows or without; and those named that live
/// elsewhere.
pub fn bench(sections: &[String], is_long: bool) -> ExitCode {
    let of_section = |section: &String| APART.iter().find(|apart| apart.section == section);
    let engine: Vec<&String> = sections
        .iter()
        .filter(|section| of_section(section).is_none())
        .collect();
    let mut commands: Vec<Command> = sections
        .iter()
        .filter_map(of_section)
        .map(|apart| command(apart.cargo))
        .collect();
    if sections.is_empty() || !engine.is_empty() {
        let mut engine_only = command(&["bench", "--package", "snug-tests", "--bench", "engine"]);
        engine_only.arg("--").args(engine);
        commands.insert(0, engine_only);
    }
    for mut cargo in commands {
        if is_long {
            cargo.arg("--long");
        }
        let code = workspace::run(cargo);
        if code != ExitCode::SUCCESS {
            return code;
        }
    }
    ExitCode::SUCCESS
}

fn command(arguments: &[&str]) -> Command {
    let mut cargo = workspace::cargo();
    cargo.args(arguments);
    cargo
}
