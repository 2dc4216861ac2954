//! MATLAB files of level 4, 5 (also called 6 and 7) and 7.3 as a tree of values.
//!
//! Which level a file has is decided by its content, never by its name. Values keep their class, shape and MATLAB's
//! column-major order; what the format holds but this reader does not (function handles, opaque class instances) is
//! an explicit [`Content::Unsupported`] value. A broken file is an error that says where: nothing panics, and no
//! count that the file claims is believed before the bytes behind it are there.
//!
//! ```no_run
//! use snug_ingest::mat::MatFile;
//!
//! let file = MatFile::read("TP3_QS_Soft_8.mat".as_ref())?;
//! let torque = file.variable("Inline_Torque").and_then(|value| value.to_f64());
//! # Ok::<(), snug_ingest::IngestError>(())
//! ```

mod cursor;
#[cfg(feature = "hdf5")]
mod hdf5;
mod level4;
mod level5;
mod numbers;
mod value;

pub use numbers::Numbers;
pub use value::{Content, Field, Sparse, Unsupported, Value, Variable};

use crate::IngestError;
use std::path::Path;

/// How deep cells and structs may nest.
pub(crate) const MAXIMUM_DEPTH: usize = 100;

/// Which of MATLAB's file formats a file is written in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MatFormat {
    /// Level 4: matrices and text only.
    Level4,
    /// Level 5, which MATLAB calls version 5, 6 or 7 (7 is compressed).
    Level5,
    /// Version 7.3: HDF5.
    Hdf5,
}

/// A whole MAT file.
#[derive(Debug, Clone, PartialEq)]
pub struct MatFile {
    /// Its format.
    pub format: MatFormat,
    /// Its variables, in file order (7.3: by name).
    pub variables: Vec<Variable>,
}

impl MatFile {
    /// Reads a file.
    ///
    /// # Errors
    /// [`IngestError::File`] around the reason, which names the byte where the file stops making sense.
    pub fn read(path: &Path) -> Result<Self, IngestError> {
        std::fs::read(path)
            .map_err(IngestError::Read)
            .and_then(Self::from_bytes)
            .map_err(|error| error.in_file(path))
    }

    /// Reads a file's content.
    ///
    /// # Errors
    /// The reason, which names the byte where the content stops making sense.
    pub fn from_bytes(bytes: Vec<u8>) -> Result<Self, IngestError> {
        let format = format_of(&bytes)?;
        let variables = match format {
            MatFormat::Level4 => level4::variables(&bytes)?,
            MatFormat::Level5 => level5::variables(&bytes)?,
            MatFormat::Hdf5 => hdf5_variables(bytes)?,
        };
        Ok(Self { format, variables })
    }

    /// The value of the variable with this exact name.
    pub fn variable(&self, name: &str) -> Option<&Value> {
        self.variables
            .iter()
            .find(|variable| variable.name == name)
            .map(|variable| &variable.value)
    }
}

#[cfg(feature = "hdf5")]
fn hdf5_variables(bytes: Vec<u8>) -> Result<Vec<Variable>, IngestError> {
    hdf5::variables(bytes)
}

#[cfg(not(feature = "hdf5"))]
fn hdf5_variables(_: Vec<u8>) -> Result<Vec<Variable>, IngestError> {
    Err(IngestError::FormatNotBuilt {
        format: "MAT 7.3 (HDF5)",
        feature: "hdf5",
    })
}

const HDF5_SIGNATURE: &[u8] = b"\x89HDF\r\n\x1a\n";

fn format_of(bytes: &[u8]) -> Result<MatFormat, IngestError> {
    if bytes.is_empty() {
        return Err(IngestError::EmptyFile);
    }
    // HDF5 allows its signature at 0, 512, 1024, 2048, …; MATLAB puts it at 512.
    let mut offset = 0_usize;
    while let Some(rest) = bytes.get(offset..) {
        if rest.starts_with(HDF5_SIGNATURE) {
            return Ok(MatFormat::Hdf5);
        }
        offset = (2 * offset).max(512);
    }
    // A level 4 file starts with a number below 5000, so one of its four bytes is zero; level 5 starts with text.
    match bytes.first_chunk::<4>() {
        Some(start) if start.contains(&0) => Ok(MatFormat::Level4),
        Some(_) if bytes.len() >= level5::HEADER_BYTES => Ok(MatFormat::Level5),
        _ => Err(IngestError::NotMat {
            bytes: bytes.len(),
            first_bytes: bytes.iter().take(4).copied().collect(),
        }),
    }
}
