//! Chunks: what their header says, whether it is right, and their content piece by piece.

use super::budget::{Budget, Exhausted, Limits};
use super::fault::{Fault, Stop};
use super::unpack::{Unpacker, Unpacking};
use crate::encoding::wire::{take_fixed32, take_fixed64, take_framed};

/// Least that is unpacked at once \[bytes\].
pub(super) const PIECE_BYTES: usize = 128 << 10;

/// Where a record stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Place {
    File,
    /// A whole chunk whose checksum is right, or that has none.
    Chunk,
    /// The beginning of a chunk whose end is missing, and with it the means to check it.
    TornChunk,
}

/// Records of a chunk as they stand in the file, and what its header says of them.
pub(super) struct Chunk<'a> {
    pub(super) compression: &'a [u8],
    /// 0 when there is none.
    checksum: u32,
    pub(super) unpacked_bytes: u64,
    pub(super) records: &'a [u8],
    /// Whether all of it is there.
    pub(super) whole: bool,
}

impl<'a> Chunk<'a> {
    /// `whole` says whether `body` is all that the record's length states.
    pub(super) fn read(body: &'a [u8], whole: bool) -> Result<Self, Stop> {
        let mut rest = body;
        let chunk = Self::header(&mut rest).and_then(|(mut chunk, packed_bytes)| {
            let there = usize::try_from(packed_bytes).is_ok_and(|bytes| bytes <= rest.len());
            if whole && !there {
                return None;
            }
            let bytes = usize::try_from(packed_bytes).map_or(rest.len(), |b| b.min(rest.len()));
            chunk.records = &rest[..bytes];
            chunk.whole = there;
            Some(chunk)
        });
        chunk.ok_or(if whole {
            Stop::Fault(Fault::Malformed {
                record: "chunk",
                bytes: body.len(),
            })
        } else {
            Stop::Truncated
        })
    }

    fn header(body: &mut &'a [u8]) -> Option<(Self, u64)> {
        let (_start_ns, _end_ns) = (take_fixed64(body)?, take_fixed64(body)?);
        let unpacked_bytes = take_fixed64(body)?;
        let checksum = take_fixed32(body)?;
        let compression = take_framed(body)?;
        let packed_bytes = take_fixed64(body)?;
        let chunk = Self {
            compression,
            checksum,
            unpacked_bytes,
            records: &[],
            whole: false,
        };
        Some((chunk, packed_bytes))
    }

    pub(super) fn place(&self) -> Place {
        if self.whole {
            Place::Chunk
        } else {
            Place::TornChunk
        }
    }

    pub(super) fn unpacker(&self, limits: &Limits) -> Result<Unpacker<'a>, Fault> {
        Unpacker::new(self.compression, self.records, limits.chunk_bytes).ok_or_else(|| {
            let name = &self.compression[..self.compression.len().min(32)];
            Fault::Compression {
                name: String::from_utf8_lossy(name).into_owned(),
            }
        })
    }

    pub(super) fn check(&self, found: u32) -> Result<(), Fault> {
        let expected = self.checksum;
        if expected == 0 || expected == found {
            return Ok(());
        }
        Err(Fault::ChunkChecksum { expected, found })
    }

    /// Whether unpacking ended as it should; of a torn chunk its beginning is enough.
    pub(super) fn ended(&self, pieces: &Pieces<'_>) -> Result<(), Stop> {
        let found = self.unpacked_bytes - pieces.left;
        match &pieces.ended {
            Err(Unpacking::Fault(fault)) => Err(fault.clone().into()),
            Err(Unpacking::TooLarge) => Err(Stop::TooLarge),
            _ if self.whole && found < self.unpacked_bytes => Err(Fault::UnpackedLength {
                expected: self.unpacked_bytes,
                found,
            }
            .into()),
            _ => Ok(()),
        }
    }

    /// What is left when no further record is whole.
    pub(super) fn rest(&self, rest: &[u8]) -> Result<(), Stop> {
        if rest.is_empty() || !self.whole {
            return Ok(());
        }
        let bytes = usize::try_from(self.unpacked_bytes).unwrap_or(usize::MAX);
        Err(Fault::BeyondChunk { bytes }.into())
    }
}

/// The content of a long chunk, of which only a part is in memory.
pub(super) struct Pieces<'a> {
    unpacker: Unpacker<'a>,
    pub(super) buffer: Vec<u8>,
    start: usize,
    /// Bytes that are still to come, by the chunk's header.
    left: u64,
    ended: Result<(), Unpacking>,
}

impl<'a> Pieces<'a> {
    /// Unpacks into the memory of `buffer`.
    pub(super) fn new(
        chunk: &Chunk<'a>,
        limits: &Limits,
        mut buffer: Vec<u8>,
    ) -> Result<Self, Fault> {
        buffer.clear();
        Ok(Self {
            unpacker: chunk.unpacker(limits)?,
            buffer,
            start: 0,
            left: chunk.unpacked_bytes,
            ended: Ok(()),
        })
    }

    pub(super) fn content(&self) -> &[u8] {
        &self.buffer[self.start..]
    }

    pub(super) fn skip(&mut self, bytes: usize) {
        self.start += bytes;
        if self.start >= PIECE_BYTES {
            self.buffer.drain(..self.start);
            self.start = 0;
        }
    }

    /// Unpacks until `wanted` bytes are there; false when the chunk ends before that.
    pub(super) fn more(&mut self, wanted: usize, budget: &mut Budget) -> Result<bool, Exhausted> {
        while self.content().len() < wanted {
            let filled = self.buffer.len();
            let room = usize::try_from(self.left).map_or(PIECE_BYTES, |left| left.min(PIECE_BYTES));
            if room == 0 || self.ended.is_err() {
                return Ok(false);
            }
            self.buffer.resize(filled + room, 0);
            let read = self.unpacker.read(&mut self.buffer[filled..]);
            let length = *read.as_ref().unwrap_or(&0);
            self.buffer.truncate(filled + length);
            self.left -= length as u64;
            budget.spend(length as u64)?;
            match read {
                Ok(0) => self.ended = Err(Unpacking::Ended),
                Ok(_) => {}
                Err(error) => self.ended = Err(error),
            }
        }
        Ok(true)
    }
}
