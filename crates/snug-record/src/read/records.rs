//! The file's framing: records one after another, some of them packed into chunks.
//!
//! The walk over records and plain chunks is done here rather than by the MCAP library, whose reader subtracts beyond
//! zero when a damaged record is longer than its plain chunk; only compressed chunks are unpacked by it.

use crate::wire::{take, take_fixed32, take_fixed64};
use mcap::McapError;
use mcap::records::op;
use mcap::sans_io::{LinearReadEvent, LinearReader, LinearReaderOptions};

/// Longest single record that is unpacked from a compressed chunk \[bytes\]; garbage must not ask for more memory.
const LONGEST_RECORD_BYTES: usize = 64 << 20;
/// Operation code and length.
const FRAME_BYTES: usize = 9;

/// Why reading ended before the footer.
#[derive(Debug)]
pub(super) enum Stop {
    /// The bytes end within a record.
    Truncated,
    /// A record is damaged.
    Fault(McapError),
    /// The visitor has enough.
    Limit,
}

impl From<McapError> for Stop {
    fn from(error: McapError) -> Self {
        Self::Fault(error)
    }
}

/// Gives every record outside and inside chunks to `each`, up to and including the footer.
pub(super) fn walk(
    bytes: &[u8],
    each: &mut impl FnMut(u8, &[u8]) -> Result<(), Stop>,
) -> Result<(), Stop> {
    let mut rest = bytes;
    while !rest.is_empty() {
        let record = rest;
        let (opcode, length) = frame(&mut rest).ok_or(Stop::Truncated)?;
        let body = usize::try_from(length)
            .ok()
            .and_then(|length| take(&mut rest, length));
        match (opcode, body) {
            (op::CHUNK, Some(body)) => {
                chunk(&record[..FRAME_BYTES + body.len()], body, true, each)?;
            }
            (op::CHUNK, None) => {
                chunk(record, rest, false, each)?;
                return Err(Stop::Truncated);
            }
            (_, None) => return Err(Stop::Truncated),
            (opcode, Some(body)) => each(opcode, body)?,
        }
        if opcode == op::FOOTER {
            return Ok(());
        }
    }
    // Without a footer the writer was stopped between two records.
    Err(Stop::Truncated)
}

fn frame(bytes: &mut &[u8]) -> Option<(u8, u64)> {
    let opcode = take(bytes, 1)?[0];
    Some((opcode, take_fixed64(bytes)?))
}

/// `record` is the chunk with its frame; `whole` says whether all of it is there.
fn chunk(
    record: &[u8],
    body: &[u8],
    whole: bool,
    each: &mut impl FnMut(u8, &[u8]) -> Result<(), Stop>,
) -> Result<(), Stop> {
    let short = || {
        if whole {
            Stop::Fault(McapError::UnexpectedEoc)
        } else {
            Stop::Truncated
        }
    };
    let (compression, crc, records) = chunk_header(body).ok_or_else(short)?;
    if !compression.is_empty() {
        return compressed(record, each);
    }
    let size = usize::try_from(records.size).unwrap_or(usize::MAX);
    let all_there = size <= records.data.len();
    if whole && !all_there {
        return Err(short());
    }
    let mut rest = &records.data[..size.min(records.data.len())];
    let calculated = crc32(rest);
    if all_there && crc != 0 && crc != calculated {
        let saved = crc;
        return Err(McapError::BadChunkCrc { saved, calculated }.into());
    }
    while !rest.is_empty() {
        let (opcode, length) = frame(&mut rest).ok_or_else(short)?;
        let length = usize::try_from(length).map_err(|_| short())?;
        each(opcode, take(&mut rest, length).ok_or_else(short)?)?;
    }
    Ok(())
}

struct ChunkRecords<'a> {
    /// Size the header states.
    size: u64,
    /// Bytes after the header.
    data: &'a [u8],
}

/// Compression, checksum and content.
fn chunk_header(mut body: &[u8]) -> Option<(&[u8], u32, ChunkRecords<'_>)> {
    let (_start_ns, _end_ns) = (take_fixed64(&mut body)?, take_fixed64(&mut body)?);
    let _unpacked_size = take_fixed64(&mut body)?;
    let crc = take_fixed32(&mut body)?;
    let name_length = take_fixed32(&mut body)? as usize;
    let compression = take(&mut body, name_length)?;
    let size = take_fixed64(&mut body)?;
    Some((compression, crc, ChunkRecords { size, data: body }))
}

/// Unpacks as much of a compressed chunk as is there.
fn compressed(
    mut record: &[u8],
    each: &mut impl FnMut(u8, &[u8]) -> Result<(), Stop>,
) -> Result<(), Stop> {
    let mut reader = LinearReader::new_with_options(
        LinearReaderOptions::default()
            .with_skip_start_magic(true)
            .with_skip_end_magic(true)
            .with_validate_chunk_crcs(true)
            .with_record_length_limit(record.len().max(LONGEST_RECORD_BYTES)),
    );
    while let Some(event) = reader.next_event() {
        match event {
            Ok(LinearReadEvent::ReadRequest(wanted)) => {
                let length = wanted.min(record.len());
                reader.insert(length).copy_from_slice(&record[..length]);
                reader.notify_read(length);
                record = &record[length..];
            }
            Ok(LinearReadEvent::Record { opcode, data }) => each(opcode, data)?,
            Err(McapError::UnexpectedEof) => return Err(Stop::Truncated),
            Err(error) => return Err(error.into()),
        }
    }
    Ok(())
}

/// CRC-32 as in ISO 3309 (reflected polynomial 0xEDB88320), with which MCAP guards its chunks.
fn crc32(bytes: &[u8]) -> u32 {
    const TABLE: [u32; 256] = {
        let mut table = [0; 256];
        let mut index = 0;
        while index < 256 {
            let mut value = index as u32;
            let mut bit = 0;
            while bit < 8 {
                value = if value & 1 == 1 {
                    value >> 1 ^ 0xedb8_8320
                } else {
                    value >> 1
                };
                bit += 1;
            }
            table[index] = value;
            index += 1;
        }
        table
    };
    !bytes.iter().fold(!0, |crc, &byte| {
        TABLE[usize::from(crc as u8 ^ byte)] ^ crc >> 8
    })
}

#[cfg(test)]
mod tests {
    #[test]
    fn crc_of_the_standard_check_string() {
        // The published check value of CRC-32/ISO-HDLC.
        assert_eq!(super::crc32(b"123456789"), 0xcbf4_3926);
    }
}
