//! JSON with declared paths.

use super::{Target, look_and_read, source};
use crate::mutation::Mutation;
use snug_ingest::Source;
use std::path::Path;
use std::sync::LazyLock;

pub const TARGET: Target = Target {
    name: "json",
    file: "input.json",
    mutate: Mutation::bytes,
    attempt,
};

/// Lists and times by name, a table's columns and a rate, one value of every object.
static SOURCES: LazyLock<[Source; 3]> = LazyLock::new(|| {
    [
        r#"Json(channels: [(path: "run.graph.torque values", signal: Torque, unit: NewtonMetre), (path: "run.graph.angle values", signal: Displacement, unit: Degree)], sampling: Times(path: "run.graph.time values"))"#,
        r#"Json(channels: [(path: "data", part: Column(1), signal: Force, unit: Newton), (path: "data", part: Column(0), signal: Velocity, unit: MetrePerSecond)], sampling: Rate(hz: 100.0))"#,
        r#"Json(channels: [(path: "samples[].t", signal: Torque, unit: NewtonMetre), (path: "samples[].w", signal: Velocity, unit: RadianPerSecond)], sampling: RateAt(path: "fs"))"#,
    ]
    .map(source)
});

fn attempt(file: &Path, _: &[u8]) {
    look_and_read(file, SOURCES.as_slice());
}
