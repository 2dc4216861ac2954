//! A recording that was cut short, written again with its index.

mod contents;
mod index;
mod recovery;
mod rewriter;

pub use recovery::{LeftOut, Recovery};

use crate::error::RecordError;
use crate::read::budget::{Budget, Limits};
use crate::read::chunk::Place;
use crate::read::fault::Stop;
use crate::read::records::{Found, walk};
use crate::read::stream::{check_magic, completeness};
use crate::read::{Completeness, DEFAULT_LIMIT_BYTES};
use contents::Contents;
use index::Index;
use mcap::records::op;
use rewriter::Rewriter;
use std::io::Write;

/// Reads a recording whose end is missing (a killed run, a full disk, a copy that was cut) and writes it to `to` with an
/// index, so that every MCAP reader opens it.
///
/// Kept as they are: messages with their times and sequence numbers, schemas and channels, metadata, attachments, private
/// records, all in their order. A channel or schema keeps its number unless the file gives that number twice. Chunks are
/// packed anew.
///
/// Of a chunk that was cut the beginning is kept as far as whole messages come out of it; its checksum was lost with its
/// end, so [`Recovery::torn_messages`] counts them apart. A whole chunk whose checksum is wrong is left out, because no
/// value in it can be trusted, and listed in [`Recovery::left_out`]; the reading goes on behind it, with the channels
/// that the file's summary repeats. So is an attachment with a wrong checksum.
///
/// Unless nothing was missing, the metadata record `snug.recovered` says what happened. Writing to [`std::io::sink`] only
/// looks. Memory: [`DEFAULT_LIMIT_BYTES`].
///
/// # Errors
/// [`RecordError::NotMcap`] for data that do not begin as an MCAP file (none at all, less than its magic number, another
/// kind), [`RecordError::Write`].
pub fn recover(bytes: &[u8], to: impl Write) -> Result<Recovery, RecordError> {
    recover_within(bytes, to, DEFAULT_LIMIT_BYTES)
}

/// [`recover`] in at most about `limit_bytes` of memory beside `bytes`; what does not fit ends the reading as
/// [`Completeness::TooLarge`].
///
/// # Errors
/// As [`recover`].
pub fn recover_within(
    bytes: &[u8],
    mut to: impl Write,
    limit_bytes: u64,
) -> Result<Recovery, RecordError> {
    check_magic(bytes)?;
    let limits = Limits::new(limit_bytes, bytes.len());
    let mut rescue = Rescue {
        rewriter: Rewriter::new(bytes, &mut to, Budget::new(limits.kept_bytes))?,
        contents: Contents::default(),
        index: Index::default(),
        recovery: Recovery::default(),
        failed: None,
    };
    let walked = walk(bytes, limits, &mut |found| rescue.found(found));
    if let Some(error) = rescue.failed {
        return Err(error);
    }
    let mut recovery = rescue.recovery;
    let ended = walked.end.is_ok();
    let magic_bytes = if ended && bytes[walked.whole_bytes..].starts_with(mcap::MAGIC) {
        mcap::MAGIC.len()
    } else {
        0
    };
    recovery.dropped_bytes = (bytes.len() - walked.whole_bytes - magic_bytes) as u64;
    recovery.data_complete = rescue.index.data_end;
    recovery.completeness = match recovery.left_out.first() {
        Some(first) => Completeness::Damaged {
            messages: recovery.messages,
            fault: first.reason.clone(),
        },
        None => completeness(bytes, walked.end, recovery.messages),
    };
    recovery.was_complete =
        recovery.completeness == Completeness::Complete && rescue.index.is_right(bytes, &recovery);
    rescue.contents.tell(&mut recovery);
    if !recovery.was_complete {
        rescue.rewriter.note(&recovery)?;
    }
    rescue.rewriter.finish()?;
    Ok(recovery)
}

struct Rescue<'a> {
    rewriter: Rewriter<'a>,
    contents: Contents,
    index: Index,
    recovery: Recovery,
    /// Why writing ended.
    failed: Option<RecordError>,
}

impl Rescue<'_> {
    fn found(&mut self, found: Found<'_>) -> Result<(), Stop> {
        match found {
            Found::Record {
                opcode,
                body,
                place,
            } => {
                self.index.count(opcode, body, place);
                self.record(opcode, body, place)
            }
            Found::Damage {
                position,
                bytes,
                fault,
            } => {
                let reason = format!("chunk at byte {position}: {fault}");
                self.recovery.leave_out(reason, bytes);
                Ok(())
            }
        }
    }

    fn record(&mut self, opcode: u8, body: &[u8], place: Place) -> Result<(), Stop> {
        let written = match opcode {
            op::SCHEMA => self.rewriter.schema(body),
            op::CHANNEL => self.rewriter.channel(body, &mut self.contents),
            op::MESSAGE => self.rewriter.message(body, &mut self.contents),
            op::METADATA => self.rewriter.metadata(body),
            op::ATTACHMENT => self.rewriter.attachment(body),
            0x80.. => self.rewriter.private(opcode, body, place != Place::File),
            op::HEADER..=op::DATA_END => return Ok(()),
            _ => Err(rewriter::Unwritten::LeftOut(format!(
                "records of the unknown kind {opcode:#04x}"
            ))),
        };
        let recovery = &mut self.recovery;
        match written {
            Ok(()) => {
                let count = match opcode {
                    op::MESSAGE => &mut recovery.messages,
                    op::METADATA => &mut recovery.metadata,
                    op::ATTACHMENT => &mut recovery.attachments,
                    _ => return Ok(()),
                };
                *count += 1;
                recovery.torn_messages +=
                    u64::from(opcode == op::MESSAGE && place == Place::TornChunk);
                Ok(())
            }
            Err(rewriter::Unwritten::LeftOut(reason)) => {
                recovery.leave_out(reason, body.len());
                Ok(())
            }
            Err(rewriter::Unwritten::TooLarge) => Err(Stop::TooLarge),
            Err(rewriter::Unwritten::Failed(error)) => {
                self.failed = Some(error);
                Err(Stop::TooLarge)
            }
        }
    }
}
