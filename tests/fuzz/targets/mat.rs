//! MAT files of every level, as a tree and in the layout of the thesis.

use super::Target;
use crate::mutation::Mutation;
use snug_ingest::{Source, mat::MatFile};
use std::path::Path;

pub const MAT4: Target = level("mat4");
pub const MAT5: Target = level("mat5");
pub const HDF5: Target = level("hdf5");

const fn level(name: &'static str) -> Target {
    Target {
        name,
        file: "input.mat",
        mutate: Mutation::bytes,
        attempt,
    }
}

/// Length of the lever arm \[m\], by which lengths become angles.
const LEVER_ARM_M: f64 = 0.33;

pub fn attempt(file: &Path, input: &[u8]) {
    if let Ok(read) = MatFile::from_bytes(input.to_vec()) {
        for variable in &read.variables {
            let value = &variable.value;
            let _ = (value.to_f64(), value.text(), value.rows(), value.describe());
        }
    }
    if let Ok(read) = snug_ingest::read(&Source::default(), file, LEVER_ARM_M) {
        for recording in read.recordings {
            assert!(!recording.torque_nm.is_empty());
        }
    }
}
