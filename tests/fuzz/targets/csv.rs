//! Delimited text with declared columns.

use super::Target;
use crate::mutation::Mutation;
use snug_ingest::Source;
use snug_study::Study;
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
    .map(|format| {
        let text = format!("(source: (format: {format}))");
        Study::parse(&text, Path::new("study.ron")).unwrap().source
    })
});

fn attempt(file: &Path, _: &[u8]) {
    let _ = snug_ingest::survey::survey(file);
    for source in SOURCES.iter() {
        let _ = snug_ingest::read(source, file, 0.33);
    }
}
