//! MATLAB files of level 4, 5 (also called 6 and 7) and 7.3 as a tree of values.
//!
//! Which level a file has is decided by its content, never by its name. Values keep their class, shape and MATLAB's
//! column-major order; what the format holds but this reader does not (function handles, opaque class instances) is
//! an explicit [`Content::Unsupported`] value. A broken file is an error that says where: nothing panics, and no
//! count that the file claims is believed before the bytes behind it are there. A file is read from start to end, variable
//! by variable; what is not asked for is not read, and not inflated.
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
mod selection;
mod stream;
mod value;

pub use numbers::Numbers;
pub use selection::{MatSelection, UnreadableVariable};
pub use value::{Content, Field, Sparse, Unsupported, Value, Variable};

use crate::error::IngestError;
use crate::memory::Budget;
use selection::Wanted;
use snug_files::{Disk, Host, Input};
use std::io::Cursor;
use std::path::Path;
use stream::Stream;

/// How deep cells and structs may nest.
pub(crate) const MAXIMUM_DEPTH: usize = 100;

/// Which of MATLAB's file formats a file is written in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
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
    /// Reads a file whole; the memory it may take is what `Source` gives a file by default.
    ///
    /// # Errors
    /// [`IngestError::File`] around the reason, which names the byte where the file stops making sense.
    pub fn read(path: &Path) -> Result<Self, IngestError> {
        Host.open(path)
            .map_err(IngestError::Read)
            .and_then(|mut input| select(input.as_mut(), &|_| true, &Budget::new(None))?.whole())
            .map_err(|error| error.in_file(path))
    }

    /// Reads a file's content.
    ///
    /// # Errors
    /// The reason, which names the byte where the content stops making sense.
    pub fn from_bytes(bytes: Vec<u8>) -> Result<Self, IngestError> {
        select(&mut Cursor::new(bytes), &|_| true, &Budget::new(None))?.whole()
    }

    /// The value of the variable with this exact name.
    pub fn variable(&self, name: &str) -> Option<&Value> {
        self.variables
            .iter()
            .find(|variable| variable.name == name)
            .map(|variable| &variable.value)
    }
}

impl MatSelection {
    /// Reads the variables whose names `wanted` takes. A damaged variable that is not wanted costs nothing; one that is
    /// wanted is listed with its reason.
    ///
    /// # Errors
    /// The reason why the file as a whole makes no sense: where a variable's extent or name cannot be known, what
    /// follows is lost.
    pub fn read(input: &mut dyn Input, wanted: &dyn Fn(&str) -> bool) -> Result<Self, IngestError> {
        select(input, wanted, &Budget::new(None))
    }
}

/// The wanted variables of a file, within its budget.
pub(crate) fn select(
    input: &mut dyn Input,
    wanted: Wanted<'_>,
    budget: &Budget,
) -> Result<MatSelection, IngestError> {
    let mut stream = Stream::new(input)?;
    let format = format_of(&mut stream)?;
    stream.seek(0)?;
    match format {
        MatFormat::Level4 => level4::select(&mut stream, wanted, budget),
        MatFormat::Level5 => level5::select(&mut stream, wanted, budget),
        MatFormat::Hdf5 => hdf5_select(&mut stream, wanted, budget),
    }
}

#[cfg(feature = "hdf5")]
fn hdf5_select(
    stream: &mut Stream<'_>,
    wanted: Wanted<'_>,
    budget: &Budget,
) -> Result<MatSelection, IngestError> {
    let content = stream.take(stream.remaining(), "the file", budget)?;
    hdf5::select(content, wanted, budget)
}

#[cfg(not(feature = "hdf5"))]
fn hdf5_select(_: &mut Stream<'_>, _: Wanted<'_>, _: &Budget) -> Result<MatSelection, IngestError> {
    Err(IngestError::FormatNotBuilt {
        format: "MAT 7.3 (HDF5)",
        feature: "hdf5",
    })
}

const HDF5_SIGNATURE: [u8; 8] = *b"\x89HDF\r\n\x1a\n";

fn format_of(stream: &mut Stream<'_>) -> Result<MatFormat, IngestError> {
    if stream.length() == 0 {
        return Err(IngestError::EmptyFile);
    }
    let mut start = [0; 4];
    let known = stream.remaining().min(start.len());
    stream.fill(&mut start[..known], "the file")?;
    // HDF5 allows its signature at 0, 512, 1024, 2048, …; MATLAB puts it at 512.
    let mut offset = 0_u64;
    while offset + HDF5_SIGNATURE.len() as u64 <= stream.length() {
        let mut bytes = [0; HDF5_SIGNATURE.len()];
        stream.seek(offset)?;
        stream.fill(&mut bytes, "the file")?;
        if bytes == HDF5_SIGNATURE {
            return Ok(MatFormat::Hdf5);
        }
        offset = (2 * offset).max(512);
    }
    // A level 4 file starts with a number below 5000, so one of its four bytes is zero; level 5 starts with text.
    if known == start.len() && start.contains(&0) {
        return Ok(MatFormat::Level4);
    }
    if stream.length() >= level5::HEADER_BYTES as u64 {
        return Ok(MatFormat::Level5);
    }
    Err(IngestError::NotMat {
        bytes: stream.length(),
        first_bytes: start[..known].to_vec(),
    })
}
