//! A file that is read from start to end, and over most of which one skips.

use super::cursor::check_room;
use crate::error::IngestError;
use crate::memory::Budget;
use snug_files::Input;
use std::io::{BufReader, Read as _, Seek, SeekFrom};

/// A place in a file that never reads past the end which the file had when it was opened.
pub(super) struct Stream<'a> {
    input: BufReader<&'a mut dyn Input>,
    position: u64,
    length: u64,
}

impl<'a> Stream<'a> {
    /// From the start of the file.
    pub(super) fn new(input: &'a mut dyn Input) -> Result<Self, IngestError> {
        let length = input.seek(SeekFrom::End(0)).map_err(IngestError::Read)?;
        input.rewind().map_err(IngestError::Read)?;
        Ok(Self {
            input: BufReader::new(input),
            position: 0,
            length,
        })
    }

    pub(super) fn length(&self) -> u64 {
        self.length
    }

    /// Offset for error messages.
    pub(super) fn offset(&self) -> usize {
        usize::try_from(self.position).unwrap_or(usize::MAX)
    }

    pub(super) fn remaining(&self) -> usize {
        usize::try_from(self.length - self.position).unwrap_or(usize::MAX)
    }

    /// Moves to a place from the start.
    pub(super) fn seek(&mut self, position: u64) -> Result<(), IngestError> {
        let to = position.min(self.length);
        self.input
            .seek(SeekFrom::Start(to))
            .map_err(IngestError::Read)?;
        self.position = to;
        Ok(())
    }

    /// Makes sure that `count` more bytes are there; `what` names them in the error.
    pub(super) fn expect(&self, count: usize, what: &'static str) -> Result<(), IngestError> {
        check_room(what, self.offset(), count, self.remaining())
    }

    /// Fills `bytes`.
    pub(super) fn fill(&mut self, bytes: &mut [u8], what: &'static str) -> Result<(), IngestError> {
        self.expect(bytes.len(), what)?;
        self.input.read_exact(bytes).map_err(IngestError::Read)?;
        self.position += bytes.len() as u64;
        Ok(())
    }

    /// The next `count` bytes, taken from the budget.
    pub(super) fn take(
        &mut self,
        count: usize,
        what: &'static str,
        budget: &Budget,
    ) -> Result<Vec<u8>, IngestError> {
        let mut bytes = Vec::new();
        self.extend(&mut bytes, count, what, budget)?;
        Ok(bytes)
    }

    /// Puts the next `count` bytes behind others, taken from the budget.
    pub(super) fn extend(
        &mut self,
        bytes: &mut Vec<u8>,
        count: usize,
        what: &'static str,
        budget: &Budget,
    ) -> Result<(), IngestError> {
        self.expect(count, what)?;
        let mut longer = budget.list(what, bytes.len() + count)?;
        longer.extend_from_slice(bytes);
        let wanted = longer.len() + count;
        self.input
            .by_ref()
            .take(count as u64)
            .read_to_end(&mut longer)
            .map_err(IngestError::Read)?;
        if longer.len() != wanted {
            // The file was cut while it was read.
            return Err(IngestError::Read(std::io::ErrorKind::UnexpectedEof.into()));
        }
        self.position += count as u64;
        *bytes = longer;
        Ok(())
    }

    /// Passes over `count` bytes.
    pub(super) fn skip(&mut self, count: usize, what: &'static str) -> Result<(), IngestError> {
        self.expect(count, what)?;
        let distance = i64::try_from(count).unwrap_or(i64::MAX);
        self.input
            .seek_relative(distance)
            .map_err(IngestError::Read)?;
        self.position += count as u64;
        Ok(())
    }
}
