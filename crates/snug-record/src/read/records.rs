//! The file's framing: records one after another, some of them packed into chunks.
//!
//! The walk is done here rather than by the MCAP library, whose reader believes the lengths that a file claims. A whole
//! chunk is checked before anything of it is given.

use super::budget::{Budget, Limits};
use super::chunk::{Chunk, PIECE_BYTES, Pieces, Place};
use super::fault::{Fault, Stop};
use crate::encoding::wire::{take, take_fixed64};
use mcap::records::op;

/// Operation code and length.
const FRAME_BYTES: usize = 9;

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
    /// Content of one compressed chunk; its memory is kept for the next.
    buffer: Vec<u8>,
    each: &'e mut E,
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
        let wanted = usize::try_from(chunk.unpacked_bytes).map_err(|_| Stop::TooLarge)?;
        let mut pieces = Pieces::new(chunk, &self.limits, std::mem::take(&mut self.buffer))?;
        pieces.more(wanted, &mut self.unpacked)?;
        chunk.ended(&pieces)?;
        if chunk.whole {
            chunk.check(crc32fast::hash(pieces.content()))?;
        }
        let given = self.records(pieces.content(), chunk);
        self.buffer = pieces.buffer;
        given
    }

    /// Unpacks a chunk twice in pieces: once for its checksum, once for its records.
    fn long_chunk(&mut self, chunk: &Chunk<'_>) -> Result<(), Stop> {
        if chunk.whole {
            let mut checksum = crc32fast::Hasher::new();
            let mut pieces = Pieces::new(chunk, &self.limits, Vec::new())?;
            while pieces.more(PIECE_BYTES, &mut self.unpacked)? {
                checksum.update(pieces.content());
                pieces.skip(pieces.content().len());
            }
            checksum.update(pieces.content());
            chunk.ended(&pieces)?;
            chunk.check(checksum.finalize())?;
        }
        let longest = usize::try_from(self.limits.chunk_bytes).unwrap_or(usize::MAX);
        let mut pieces = Pieces::new(chunk, &self.limits, Vec::new())?;
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
