//! Whether a file's own index is there and right.

use super::Recovery;
use crate::encoding::wire::{take, take_fixed16, take_fixed32, take_fixed64};
use crate::read::chunk::Place;
use mcap::records::op;

/// Footer with its frame, and magic number.
const END_BYTES: usize = 9 + 20 + 8;

/// Counts what the summary at the end of a file states.
#[derive(Default)]
pub(super) struct Index {
    /// The record was met with which the data end.
    pub(super) data_end: bool,
    data_checksum: u32,
    /// Messages, attachments, metadata, chunks.
    statistics: Option<[u64; 4]>,
    chunks: u64,
    attachments: u64,
    metadata: u64,
}

impl Index {
    pub(super) fn count(&mut self, opcode: u8, mut body: &[u8], place: Place) {
        if place != Place::File {
            return;
        }
        match opcode {
            op::DATA_END => {
                self.data_end = true;
                self.data_checksum = take_fixed32(&mut body).unwrap_or(0);
            }
            op::STATISTICS => self.statistics = statistics(&mut body),
            op::CHUNK_INDEX => self.chunks += 1,
            op::ATTACHMENT_INDEX => self.attachments += 1,
            op::METADATA_INDEX => self.metadata += 1,
            _ => {}
        }
    }

    /// Whether the index lists what was found, and the file's checksums are right.
    pub(super) fn is_right(&self, file: &[u8], found: &Recovery) -> bool {
        let Some([messages, attachments, metadata, chunks]) = self.statistics else {
            return false;
        };
        let counted = messages == found.messages
            && (attachments, metadata) == (found.attachments, found.metadata)
            && (chunks, attachments, metadata) == (self.chunks, self.attachments, self.metadata);
        counted && self.checksums(file).unwrap_or(false)
    }

    fn checksums(&self, file: &[u8]) -> Option<bool> {
        let summary = summary(file)?;
        let data_bytes = (file.len() - END_BYTES - summary.len()).checked_sub(9 + 4)?;
        let found = crc32fast::hash(&file[..data_bytes]);
        Some(self.data_checksum == 0 || self.data_checksum == found)
    }
}

/// The records between the data and the footer, when the footer and their checksum are right.
pub(super) fn summary(file: &[u8]) -> Option<&[u8]> {
    let end = file.len().checked_sub(END_BYTES)?;
    let mut footer = &file[end..];
    let opcode = take(&mut footer, 1)?[0];
    let length = take_fixed64(&mut footer)?;
    let start = usize::try_from(take_fixed64(&mut footer)?).ok()?;
    let _offsets_start = take_fixed64(&mut footer)?;
    let checksum = take_fixed32(&mut footer)?;
    // The checksum covers the footer up to itself.
    let checked = file.get(start..end + 9 + 16)?;
    let right = (opcode, length) == (op::FOOTER, 20)
        && footer == mcap::MAGIC
        && start > 0
        && (checksum == 0 || checksum == crc32fast::hash(checked));
    right.then(|| file.get(start..end)).flatten()
}

fn statistics(body: &mut &[u8]) -> Option<[u64; 4]> {
    let messages = take_fixed64(body)?;
    let (_schemas, _channels) = (take_fixed16(body)?, take_fixed32(body)?);
    let attachments = take_fixed32(body)?.into();
    let metadata = take_fixed32(body)?.into();
    let chunks = take_fixed32(body)?.into();
    Some([messages, attachments, metadata, chunks])
}
