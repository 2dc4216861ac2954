use crate::IngestError;

/// The order of the bytes of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ByteOrder {
    Little,
    Big,
}

/// A place in a stretch of bytes that never reads past its end.
#[derive(Debug, Clone)]
pub(crate) struct Cursor<'a> {
    bytes: &'a [u8],
    position: usize,
    /// Where the stretch starts in its file, or in its inflated element.
    base: usize,
    pub(crate) order: ByteOrder,
}

impl<'a> Cursor<'a> {
    pub(crate) fn new(bytes: &'a [u8], base: usize, order: ByteOrder) -> Self {
        Self {
            bytes,
            position: 0,
            base,
            order,
        }
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
        if count > self.remaining() {
            return Err(IngestError::Truncated {
                what,
                offset: self.offset(),
                needed: count,
                available: self.remaining(),
            });
        }
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
        Ok(match self.order {
            ByteOrder::Little => u32::from_le_bytes(bytes),
            ByteOrder::Big => u32::from_be_bytes(bytes),
        })
    }
}
