//! What a format of measurement files has to say and do; a new one implements [`Layout`] in a module of its own.

use crate::memory::Budget;
use crate::range::Range;
use crate::signal::{Signal, Unit};
use crate::{IngestError, Ingested};
use snug_files::Input;
use std::io::{Read as _, SeekFrom};
use std::path::Path;

/// The settings of one format, and how they make recordings of a file.
pub(crate) trait Layout {
    /// Endings of the files it reads, in lower case.
    fn endings(&self) -> &'static [&'static str];

    /// Checks the settings that no type can check.
    ///
    /// # Errors
    /// [`IngestError::Setting`] naming the field.
    fn check(&self) -> Result<(), IngestError>;

    /// The declared ranges, which are the segments 1, 2, … of every recording; none where files name their segments.
    fn ranges(&self) -> &[Range] {
        &[]
    }

    /// What the declared channels measure, in which unit, with which factor; none where the format fixes that.
    fn declared(&self) -> Vec<(Signal, Unit, f64)> {
        Vec::new()
    }

    /// The recordings in a file; `path` names it, `lever_arm_m` turns lengths of the grip into angles. All that is made of
    /// the file is taken from `budget` first.
    ///
    /// # Errors
    /// What keeps the whole file from being read; everything less is a finding.
    fn read(
        &self,
        input: &mut dyn Input,
        path: &Path,
        lever_arm_m: f64,
        budget: &Budget,
    ) -> Result<Ingested, IngestError>;
}

/// Bytes at the start of a file by which it is judged.
pub(crate) const FIRST_BLOCK_BYTES: usize = 1 << 16;

/// The whole content of a file whose start `check` lets pass.
pub(crate) fn content(
    input: &mut dyn Input,
    budget: &Budget,
    check: fn(&[u8]) -> Result<(), IngestError>,
) -> Result<Vec<u8>, IngestError> {
    let length = input.seek(SeekFrom::End(0)).map_err(IngestError::Read)?;
    input.rewind().map_err(IngestError::Read)?;
    let mut start = Vec::new();
    (&mut *input)
        .take(FIRST_BLOCK_BYTES as u64)
        .read_to_end(&mut start)
        .map_err(IngestError::Read)?;
    check(&start)?;
    let mut content: Vec<u8> =
        budget.list("the file", usize::try_from(length).unwrap_or(usize::MAX))?;
    content.extend_from_slice(&start);
    // Not beyond the length for which there is room, should the file grow meanwhile.
    let rest = length.saturating_sub(start.len() as u64);
    input
        .take(rest)
        .read_to_end(&mut content)
        .map_err(IngestError::Read)?;
    Ok(content)
}
