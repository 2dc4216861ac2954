//! Bounded reading of a MAT file's bytes in either byte order: every error names the offset.

use crate::error::IngestError;
use crate::memory::Budget;

/// The order of the bytes of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ByteOrder {
    Little,
    Big,
}

impl ByteOrder {
    pub(crate) fn u32(self, bytes: [u8; 4]) -> u32 {
        match self {
            Self::Little => u32::from_le_bytes(bytes),
            Self::Big => u32::from_be_bytes(bytes),
        }
    }
}

/// Makes sure that `needed` bytes are there.
pub(crate) fn check_room(
    what: &'static str,
    offset: usize,
    needed: usize,
    available: usize,
) -> Result<(), IngestError> {
    if needed <= available {
        return Ok(());
    }
    Err(IngestError::Truncated {
        what,
        offset,
        needed,
        available,
    })
}

/// A name's bytes: all, or those before the first zero.
pub(crate) fn until_zero(bytes: &[u8]) -> &[u8] {
    bytes.split(|&byte| byte == 0).next().unwrap_or_default()
}

/// A place in a stretch of bytes that never reads past its end.
#[derive(Debug, Clone)]
pub(crate) struct Cursor<'a> {
    bytes: &'a [u8],
    position: usize,
    /// Where the stretch starts in its file, or in its inflated element.
    base: usize,
    pub(crate) order: ByteOrder,
    /// What is made of the bytes is taken from here.
    pub(crate) budget: &'a Budget,
}

impl<'a> Cursor<'a> {
    pub(crate) fn new(bytes: &'a [u8], base: usize, order: ByteOrder, budget: &'a Budget) -> Self {
        Self {
            bytes,
            position: 0,
            base,
            order,
            budget,
        }
    }

    /// Another stretch of the same file.
    pub(crate) fn within(&self, bytes: &'a [u8], base: usize) -> Self {
        Self::new(bytes, base, self.order, self.budget)
    }

    /// Offset for error messages.
    pub(crate) fn offset(&self) -> usize {
        self.base + self.position
    }

    pub(crate) fn remaining(&self) -> usize {
        self.bytes.len() - self.position
    }

    /// The next `count` bytes; `what` names them in the error.
    pub(crate) fn take(
        &mut self,
        count: usize,
        what: &'static str,
    ) -> Result<&'a [u8], IngestError> {
        check_room(what, self.offset(), count, self.remaining())?;
        let taken = &self.bytes[self.position..self.position + count];
        self.position += count;
        Ok(taken)
    }

    /// Skips up to `count` bytes; less where the stretch ends before.
    pub(crate) fn skip_at_most(&mut self, count: usize) {
        self.position += count.min(self.remaining());
    }

    pub(crate) fn u32(&mut self, what: &'static str) -> Result<u32, IngestError> {
        let bytes = self
            .take(4, what)?
            .try_into()
            .expect("take returns the count asked for");
        Ok(self.order.u32(bytes))
    }
}
