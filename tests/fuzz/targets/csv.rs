//! Delimited text with declared columns.

use super::{Target, look_and_read, source};
use crate::mutation::Mutation;
use snug_ingest::Source;
use std::path::Path;
use std::sync::LazyLock;

pub const TARGET: Target = Target {
    name: "csv",
    file: "input.csv",
    mutate: Mutation::bytes,
    attempt,
};

/// One layout by names and a column of times, one by places and a rate.
static SOURCES: LazyLock<[Source; 2]> = LazyLock::new(|| {
    [
        r#"Csv(channels: [(column: Name("torque"), signal: Torque, unit: NewtonMetre), (column: Name("angle"), signal: Displacement, unit: Radian)])"#,
        r#"Csv(channels: [(column: Index(1), signal: Torque, unit: NewtonMetre), (column: Index(2), signal: Displacement, unit: Degree)], sampling: Rate(hz: 100.0), ranges: [(name: "a", start: 2, end: 9)])"#,
    ]
    .map(source)
});

fn attempt(file: &Path, _: &[u8]) {
    look_and_read(file, SOURCES.as_slice());
}
