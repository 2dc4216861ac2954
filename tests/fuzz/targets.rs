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
