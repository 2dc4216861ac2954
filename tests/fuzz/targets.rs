//! What is tried, one file each.

mod csv;
mod expression;
mod json;
mod mat;
mod mat_packed;
mod mcap;
mod mcap_packed;
mod pipeline;
mod study;

use crate::mutation::Mutation;
use snug_ingest::Source;
use snug_study::Study;
use std::path::Path;

/// Something that reads a stranger's bytes.
pub struct Target {
    pub name: &'static str,
    /// Name of the file that an input is put into.
    pub file: &'static str,
    /// A new input.
    pub mutate: fn(&mut Mutation) -> Vec<u8>,
    /// Reads the input, which stands in the file, too.
    pub attempt: fn(&Path, &[u8]),
}

pub const TARGETS: &[Target] = &[
    mat::MAT4,
    mat::MAT5,
    mat::HDF5,
    mat_packed::TARGET,
    csv::TARGET,
    json::TARGET,
    mcap::TARGET,
    mcap_packed::TARGET,
    study::TARGET,
    expression::TARGET,
    pipeline::TARGET,
];

/// Length of the lever arm \[m\], by which lengths become angles.
const LEVER_ARM_M: f64 = 0.33;

/// The source of a study that declares this format.
fn source(format: &str) -> Source {
    let text = format!("(source: (format: {format}))");
    Study::parse(&text, Path::new("study.ron")).unwrap().source
}

/// Looks at a file of which nothing is declared, and reads it in every declared way.
fn look_and_read(file: &Path, declared: &[Source]) {
    let _ = snug_ingest::survey::survey(file);
    for source in declared {
        let _ = snug_ingest::read(source, file, LEVER_ARM_M);
    }
}
