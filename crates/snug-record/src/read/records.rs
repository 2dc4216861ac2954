//! The file's framing: records one after another, some of them packed into chunks.
//!
//! The walk is done here rather than by the MCAP library, whose reader believes the lengths that a file claims. A whole
//! chunk is checked before anything of it is given.

use super::budget::{Budget, Exhausted, Limits};
use super::fault::Fault;
use super::unpack::{Unpacker, Unpacking};
use crate::wire::{take, take_fixed32, take_fixed64, take_framed};
use mcap::records::op;

/// Operation code and length.
const FRAME_BYTES: usize = 9;
/// Least that is unpacked at once.
const PIECE_BYTES: usize = 128 << 10;

/// Why reading ended before the footer.
#[derive(Debug)]
pub(crate) enum Stop {
    /// The bytes end within a record.
    Truncated,
    /// A record is damaged.
    Fault(Fault),
    /// The content costs more than the caller allows.
    TooLarge,
}

impl From<Fault> for Stop {
    fn from(fault: Fault) -> Self {
        Self::Fault(fault)
    }
}

impl From<Exhausted> for Stop {
    fn from(_: Exhausted) -> Self {
        Self::TooLarge
    }
}

/// Where a record stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Place {
    File,
    /// A whole chunk whose checksum is right, or that has none.
    Chunk,
    /// The beginning of a chunk whose end is missing, and with it the means to check it.
    TornChunk,
}

/// What the walk comes to.
pub(crate) enum Found<'a> {
    Record {
        opcode: u8,
        body: &'a [u8],
        place: Place,
    },
    /// A chunk of which nothing (more) is given; the walk goes on behind it.
    Damage {
        position: usize,
        bytes: usize,
        fault: Fault,
    },
}

/// How the walk ended, and up to which byte the records of the file are whole.
pub(crate) struct Walked {
    pub(crate) end: Result<(), Stop>,
    pub(crate) whole_bytes: usize,
}

/// Gives every record outside and inside chunks to `each`, up to and including the footer.
///
/// `file` begins with MCAP's magic number.
pub(crate) fn walk(
    file: &[u8],
    limits: Limits,
    each: &mut impl FnMut(Found<'_>) -> Result<(), Stop>,
) -> Walked {
    let mut walk = Walk {
        limits,
        unpacked: Budget::new(limits.unpacked_bytes),
        buffer: Vec::new(),
        each,
    };
    let mut whole_bytes = mcap::MAGIC.len();
    let end = walk.file(file, &mut whole_bytes);
    Walked { end, whole_bytes }
}

struct Walk<'e, E> {
    limits: Limits,
    unpacked: Budget,
    /// Content of one compressed chunk; kept for the next.
    buffer: Vec<u8>,
    each: &'e mut E,
}

/// Records of a chunk as they stand in the file, and what its header says of them.
struct Chunk<'a> {
    compression: &'a [u8],
    /// 0 when there is none.
    checksum: u32,
    unpacked_bytes: u64,
    records: &'a [u8],
    /// Whether all of it is there.
    whole: bool,
}

impl<E: FnMut(Found<'_>) -> Result<(), Stop>> Walk<'_, E> {
    fn file(&mut self, file: &[u8], whole_bytes: &mut usize) -> Result<(), Stop> {
        let mut rest = &file[*whole_bytes..];
        while !rest.is_empty() {
            let (opcode, length) = frame(&mut rest).ok_or(Stop::Truncated)?;
            let body = usize::try_from(length)
                .ok()
                .and_then(|length| take(&mut rest, length));
            match (opcode, body) {
                (op::CHUNK, body) => {
                    let given = match Chunk::read(body.unwrap_or(rest), body.is_some()) {
                        Ok(chunk) => self.chunk(&chunk),
                        Err(stop) => Err(stop),
                    };
                    let bytes = FRAME_BYTES + body.unwrap_or(rest).len();
                    match given {
                        Err(Stop::Fault(fault)) => (self.each)(Found::Damage {
                            position: *whole_bytes,
                            bytes,
                            fault,
                        })?,
                        given => given?,
                    }
                    if body.is_none() {
                        return Err(Stop::Truncated);
                    }
                }
                (_, None) => return Err(Stop::Truncated),
                (opcode, Some(body)) => self.give(opcode, body, Place::File)?,
            }
            *whole_bytes = file.len() - rest.len();
            if opcode == op::FOOTER {
                return Ok(());
            }
        }
        // Without a footer the writer was stopped between two records.
        Err(Stop::Truncated)
    }

    fn give(&mut self, opcode: u8, body: &[u8], place: Place) -> Result<(), Stop> {
        (self.each)(Found::Record {
            opcode,
            body,
            place,
        })
    }

    fn chunk(&mut self, chunk: &Chunk<'_>) -> Result<(), Stop> {
        if chunk.compression.is_empty() {
            if chunk.whole {
                chunk.check(crc32fast::hash(chunk.records))?;
            }
            return self.records(chunk.records, chunk);
        }
        if chunk.unpacked_bytes > self.limits.chunk_bytes {
            return self.long_chunk(chunk);
        }
        let mut buffer = std::mem::take(&mut self.buffer);
        let given = self.short_chunk(chunk, &mut buffer);
        self.buffer = buffer;
        given
    }

    /// Unpacks a chunk at once, checks it and gives its records.
    fn short_chunk(&mut self, chunk: &Chunk<'_>, buffer: &mut Vec<u8>) -> Result<(), Stop> {
        let mut unpacker = chunk.unpacker(&self.limits)?;
        let wanted = usize::try_from(chunk.unpacked_bytes).map_err(|_| Stop::TooLarge)?;
        let mut filled = 0;
        let mut ended = Ok(());
        while filled < wanted {
            if filled == buffer.len() {
                let length = (2 * filled).max(PIECE_BYTES);
                buffer.resize(length, 0);
            }
            let end = buffer.len().min(wanted);
            match unpacker.read(&mut buffer[filled..end]) {
                Ok(0) => break,
                Ok(length) => {
                    self.unpacked.spend(length as u64)?;
                    filled += length;
                }
                Err(error) => {
                    ended = Err(error);
                    break;
                }
            }
        }
        chunk.ended(filled as u64, ended)?;
        if chunk.whole {
            chunk.check(crc32fast::hash(&buffer[..filled]))?;
        }
        self.records(&buffer[..filled], chunk)
    }

    /// Unpacks a chunk twice in pieces: once for its checksum, once for its records.
    fn long_chunk(&mut self, chunk: &Chunk<'_>) -> Result<(), Stop> {
        if chunk.whole {
            let mut checksum = crc32fast::Hasher::new();
            let mut pieces = Pieces::new(chunk, &self.limits)?;
            while pieces.more(PIECE_BYTES, &mut self.unpacked)? {
                checksum.update(pieces.content());
                pieces.skip(pieces.content().len());
            }
            checksum.update(pieces.content());
            chunk.ended(chunk.unpacked_bytes - pieces.left, pieces.ended)?;
            chunk.check(checksum.finalize())?;
        }
        let longest = usize::try_from(self.limits.chunk_bytes).unwrap_or(usize::MAX);
        let mut pieces = Pieces::new(chunk, &self.limits)?;
        loop {
            if !pieces.more(FRAME_BYTES, &mut self.unpacked)? {
                return chunk.rest(pieces.content());
            }
            let Some((opcode, length)) = frame(&mut pieces.content()) else {
                return chunk.rest(pieces.content());
            };
            let length = usize::try_from(length).map_err(|_| Stop::TooLarge)?;
            if length > longest {
                return Err(Stop::TooLarge);
            }
            if !pieces.more(FRAME_BYTES + length, &mut self.unpacked)? {
                return chunk.rest(pieces.content());
            }
            let body = &pieces.content()[FRAME_BYTES..FRAME_BYTES + length];
            self.give(opcode, body, chunk.place())?;
            pieces.skip(FRAME_BYTES + length);
        }
    }

    fn records(&mut self, mut records: &[u8], chunk: &Chunk<'_>) -> Result<(), Stop> {
        while !records.is_empty() {
            let Some((opcode, body)) = framed(&mut records) else {
                return chunk.rest(records);
            };
            self.give(opcode, body, chunk.place())?;
        }
        Ok(())
    }
}

impl<'a> Chunk<'a> {
    /// `whole` says whether `body` is all that the record's length states.
    fn read(body: &'a [u8], whole: bool) -> Result<Self, Stop> {
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

    fn place(&self) -> Place {
        if self.whole {
            Place::Chunk
        } else {
            Place::TornChunk
        }
    }

    fn unpacker(&self, limits: &Limits) -> Result<Unpacker<'a>, Fault> {
        Unpacker::new(self.compression, self.records, limits.chunk_bytes).ok_or_else(|| {
            let name = &self.compression[..self.compression.len().min(32)];
            Fault::Compression {
                name: String::from_utf8_lossy(name).into_owned(),
            }
        })
    }

    fn check(&self, found: u32) -> Result<(), Fault> {
        let expected = self.checksum;
        if expected == 0 || expected == found {
            return Ok(());
        }
        Err(Fault::ChunkChecksum { expected, found })
    }

    /// Whether unpacking ended as it should; of a torn chunk its beginning is enough.
    fn ended(&self, found: u64, ended: Result<(), Unpacking>) -> Result<(), Stop> {
        match ended {
            Err(Unpacking::Fault(fault)) => Err(fault.into()),
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
    fn rest(&self, rest: &[u8]) -> Result<(), Stop> {
        if rest.is_empty() || !self.whole {
            return Ok(());
        }
        let bytes = usize::try_from(self.unpacked_bytes).unwrap_or(usize::MAX);
        Err(Fault::BeyondChunk { bytes }.into())
    }
}

/// The content of a long chunk, of which only a part is in memory.
struct Pieces<'a> {
    unpacker: Unpacker<'a>,
    buffer: Vec<u8>,
    start: usize,
    /// Bytes that are still to come, by the chunk's header.
    left: u64,
    ended: Result<(), Unpacking>,
}

impl<'a> Pieces<'a> {
    fn new(chunk: &Chunk<'a>, limits: &Limits) -> Result<Self, Fault> {
        Ok(Self {
            unpacker: chunk.unpacker(limits)?,
            buffer: Vec::new(),
            start: 0,
            left: chunk.unpacked_bytes,
            ended: Ok(()),
        })
    }

    fn content(&self) -> &[u8] {
        &self.buffer[self.start..]
    }

    fn skip(&mut self, bytes: usize) {
        self.start += bytes;
        if self.start >= PIECE_BYTES {
            self.buffer.drain(..self.start);
            self.start = 0;
        }
    }

    /// Unpacks until `wanted` bytes are there; false when the chunk ends before that.
    fn more(&mut self, wanted: usize, budget: &mut Budget) -> Result<bool, Exhausted> {
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

fn frame(bytes: &mut &[u8]) -> Option<(u8, u64)> {
    let opcode = take(bytes, 1)?[0];
    Some((opcode, take_fixed64(bytes)?))
}

/// One record with its frame; leaves the bytes alone when it is not whole.
pub(crate) fn framed<'a>(bytes: &mut &'a [u8]) -> Option<(u8, &'a [u8])> {
    let mut rest = *bytes;
    let (opcode, length) = frame(&mut rest)?;
    let body = take(&mut rest, usize::try_from(length).ok()?)?;
    *bytes = rest;
    Some((opcode, body))
}
