//! MAT files of every level, as a tree and in the layout of the thesis.

use super::{LEVER_ARM_M, Target, look_and_read, source};
use crate::mutation::Mutation;
use snug_ingest::{Source, mat::MatFile};
use std::path::Path;
use std::sync::LazyLock;

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

/// Variables that the inputs hold, declared in every way: a sparse one, a field, a row and a column.
static DECLARED: LazyLock<Source> = LazyLock::new(|| {
    source(
        r#"Mat(
        channels: [
            (path: "Inline_Torque", signal: Torque, unit: NewtonMetre),
            (path: "angle_acc_Acc_FIR150", part: Column(0), signal: Acceleration, unit: RadianPerSecondSquared),
            (path: "sparse", part: Row(0), signal: Displacement, unit: Metre),
            (path: "s[0].a", signal: Velocity, unit: MetrePerSecond),
            (path: "c[]", signal: GripForce, unit: Newton),
        ],
        sampling: Rate(hz: 1000.0),
    )"#,
    )
});

pub fn attempt(file: &Path, input: &[u8]) {
    if let Ok(read) = MatFile::from_bytes(input.to_vec()) {
        for variable in &read.variables {
            let value = &variable.value;
            let _ = (value.to_f64(), value.text(), value.rows(), value.describe());
        }
    }
    look_and_read(file, std::slice::from_ref(&DECLARED));
    if let Ok(read) = snug_ingest::read(&Source::default(), file, LEVER_ARM_M) {
        for recording in read.recordings {
            assert!(!recording.torque_nm.is_empty());
        }
    }
}
