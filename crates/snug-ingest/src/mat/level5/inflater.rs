//! Compressed elements, inflated as far as one asks.

use super::element::{ElementType, TAG_BYTES};
use crate::error::IngestError;
use crate::mat::cursor::{ByteOrder, check_room};
use crate::mat::stream::Stream;
use crate::memory::Budget;
use flate2::{Decompress, FlushDecompress, Status};

/// MATLAB itself stores no level 5 variable larger than this.
const LARGEST_VARIABLE_BYTES: usize = 1 << 31;

/// Deflate cannot make less than one byte of this many.
const LARGEST_COMPRESSION: usize = 1032;

/// Compressed bytes that are read at once.
const BLOCK_BYTES: usize = 1 << 16;

/// What one element after the other is inflated with.
pub(super) struct Inflater {
    decompress: Decompress,
    block: Vec<u8>,
    /// The array's tag and what came out of its data.
    inflated: Vec<u8>,
    /// What `inflated` took from the budget.
    room: u64,
}

/// An element while it is inflated.
pub(super) struct Inflating<'i, 's, 'f> {
    inflater: &'i mut Inflater,
    stream: &'s mut Stream<'f>,
    /// Compressed bytes that are still in the stream.
    left: usize,
    /// Place in the block, and the block's end.
    at: usize,
    filled: usize,
    size: usize,
    ended: bool,
}

impl Inflater {
    pub(super) fn new() -> Self {
        Self {
            decompress: Decompress::new(true),
            block: vec![0; BLOCK_BYTES],
            inflated: Vec::new(),
            room: 0,
        }
    }

    /// Begins with an element of `size` compressed bytes, at which the stream stands.
    pub(super) fn start<'i, 's, 'f>(
        &'i mut self,
        stream: &'s mut Stream<'f>,
        size: usize,
    ) -> Inflating<'i, 's, 'f> {
        self.decompress.reset(true);
        self.inflated = Vec::with_capacity(TAG_BYTES);
        self.room = 0;
        Inflating {
            inflater: self,
            stream,
            left: size,
            at: 0,
            filled: 0,
            size,
            ended: false,
        }
    }

    /// The array's data, as far as they came out.
    pub(super) fn data(&self) -> &[u8] {
        self.inflated.get(TAG_BYTES..).unwrap_or_default()
    }

    /// What the data took from the budget.
    pub(super) fn room(&self) -> u64 {
        self.room
    }
}

impl Inflating<'_, '_, '_> {
    pub(super) fn data(&self) -> &[u8] {
        self.inflater.data()
    }

    pub(super) fn room(&self) -> u64 {
        self.inflater.room
    }

    /// Inflates the tag of the array inside; the length of the array's data.
    pub(super) fn array_size(&mut self, order: ByteOrder) -> Result<usize, IngestError> {
        self.reach(TAG_BYTES)?;
        let Some(tag) = self.inflater.inflated.first_chunk::<TAG_BYTES>() else {
            return Err(self.fault("they hold no array"));
        };
        let (kind, size) = ElementType::of_tag(*tag, order);
        if kind != ElementType::Array {
            return Err(IngestError::ElementType {
                what: "array in a compressed element",
                offset: 0,
                expected: "14 (array)",
                found: kind.number(),
            });
        }
        let possible = self.size.saturating_mul(LARGEST_COMPRESSION);
        if size > possible.min(LARGEST_VARIABLE_BYTES) {
            return Err(self.fault(
                "the array inside announces more than can come out, or than any array may hold",
            ));
        }
        Ok(size)
    }

    /// Inflates that many bytes of the array's data, or all where there are fewer.
    pub(super) fn at_least(&mut self, count: usize, budget: &Budget) -> Result<(), IngestError> {
        self.make_room(TAG_BYTES + count, budget)?;
        self.reach(TAG_BYTES + count)
    }

    /// Inflates all of an array whose data have `size` bytes; anything more or less is an error.
    pub(super) fn finish(&mut self, size: usize, budget: &Budget) -> Result<(), IngestError> {
        // One byte more than there may be shows that there are more.
        self.make_room(TAG_BYTES + size + 1, budget)?;
        self.reach(TAG_BYTES + size + 1)?;
        let found = self.inflater.inflated.len() - TAG_BYTES;
        if found > size {
            return Err(self.fault("more comes out than the array inside announces"));
        }
        check_room("variable", TAG_BYTES, size, found)
    }

    /// Passes over what was not inflated.
    pub(super) fn skip_rest(&mut self) -> Result<(), IngestError> {
        let left = std::mem::take(&mut self.left);
        self.stream.skip(left, "variable")
    }

    fn make_room(&mut self, bytes: usize, budget: &Budget) -> Result<(), IngestError> {
        let mut larger = budget.list("a variable", bytes)?;
        larger.append(&mut self.inflater.inflated);
        self.inflater.inflated = larger;
        budget.give_back(self.inflater.room);
        self.inflater.room = bytes as u64;
        Ok(())
    }

    /// Inflates until `length` bytes are there, or the compressed data end as they should.
    fn reach(&mut self, length: usize) -> Result<(), IngestError> {
        while self.inflater.inflated.len() < length && !self.ended {
            if self.at == self.filled && self.left > 0 {
                (self.at, self.filled) = (0, self.left.min(BLOCK_BYTES));
                let block = &mut self.inflater.block[..self.filled];
                self.stream.fill(block, "variable")?;
                self.left -= self.filled;
            }
            if !self.step()? && self.at == self.filled && self.left == 0 {
                return Err(self.fault("the compressed data end too early"));
            }
        }
        Ok(())
    }

    /// Inflates into the room there is; whether that brought anything.
    fn step(&mut self) -> Result<bool, IngestError> {
        let Inflater {
            decompress,
            block,
            inflated,
            ..
        } = &mut *self.inflater;
        let (read, before) = (decompress.total_in(), inflated.len());
        let status = decompress.decompress_vec(
            &block[self.at..self.filled],
            inflated,
            FlushDecompress::None,
        );
        let Ok(status) = status else {
            return Err(self.fault("the compressed data or their checksum are damaged"));
        };
        let consumed = usize::try_from(decompress.total_in() - read).expect("a part of a block");
        let brought = consumed > 0 || inflated.len() > before;
        self.at += consumed;
        self.ended = status == Status::StreamEnd;
        if !brought && !self.ended && self.at < self.filled {
            return Err(self.fault("the compressed data or their checksum are damaged"));
        }
        Ok(brought)
    }

    fn fault(&self, reason: &'static str) -> IngestError {
        IngestError::Inflate {
            inflated: self.inflater.inflated.len(),
            reason,
        }
    }
}
