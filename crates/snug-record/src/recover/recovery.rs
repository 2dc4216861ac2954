//! What came of recovering a recording.

use crate::read::Completeness;
use snug_campaign::TighteningId;
use std::fmt::{Display, Formatter};

/// Different reasons that are listed.
const MOST_REASONS: usize = 100;

/// What was saved of a recording, and what is missing. Its text is a few lines for a person.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Recovery {
    /// Nothing was missing, the index included; what was written is a copy.
    pub was_complete: bool,
    /// How far the file could be read.
    pub completeness: Completeness,
    /// The end of the data was there: if anything is missing at the end, it is the index only.
    pub data_complete: bool,
    /// Messages written.
    pub messages: u64,
    /// Of them: messages out of a chunk whose end is missing, which could not be held against its checksum.
    pub torn_messages: u64,
    /// Attachments written.
    pub attachments: u64,
    /// Metadata records written, without `snug.recovered`.
    pub metadata: u64,
    /// Bytes at the end of the file behind the last record or chunk that is whole. The torn messages are out of them.
    pub dropped_bytes: u64,
    /// What was left out in the middle, by reason; at most 100 reasons.
    pub left_out: Vec<LeftOut>,
    /// Tightenings all of whose samples are there.
    pub tightenings: u64,
    /// The last of them.
    pub last_tightening: Option<TighteningId>,
    /// Tightenings of which samples are missing; at most 100.
    pub incomplete_tightenings: Vec<TighteningId>,
    /// Measurement files that were kept whole and are there whole.
    pub files: u64,
    /// The last of them.
    pub last_file: Option<String>,
    /// Measurement files of which samples are missing; at most 100.
    pub incomplete_files: Vec<String>,
}

/// Records or chunks that could not be kept.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LeftOut {
    /// Why.
    pub reason: String,
    /// How many records or chunks.
    pub count: u64,
    /// Their bytes, as the file has them.
    pub bytes: u64,
}

impl Recovery {
    pub(super) fn leave_out(&mut self, reason: String, bytes: usize) {
        let bytes = bytes as u64;
        let known = self.left_out.iter().position(|one| one.reason == reason);
        match known {
            Some(place) => {
                self.left_out[place].count += 1;
                self.left_out[place].bytes += bytes;
            }
            None if self.left_out.len() < MOST_REASONS => self.left_out.push(LeftOut {
                reason,
                count: 1,
                bytes,
            }),
            None => {
                let last = &mut self.left_out[MOST_REASONS - 1];
                "further reasons".clone_into(&mut last.reason);
                last.count += 1;
                last.bytes += bytes;
            }
        }
    }
}

impl Display for Recovery {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        if self.was_complete {
            return write!(
                f,
                "the recording is complete: {} messages, {} attachments",
                self.messages, self.attachments
            );
        }
        write!(
            f,
            "saved {} messages, {} attachments, {} metadata records",
            self.messages, self.attachments, self.metadata
        )?;
        if self.tightenings > 0 || !self.incomplete_tightenings.is_empty() {
            write!(f, "; {} whole tightenings", self.tightenings)?;
        }
        if let Some(last) = &self.last_tightening {
            write!(f, ", the last {} #{}", last.file, last.number)?;
        }
        if let Some(last) = &self.last_file {
            write!(f, "; {} whole files, the last {last}", self.files)?;
        }
        for tightening in &self.incomplete_tightenings {
            let (file, number) = (&tightening.file, tightening.number);
            write!(f, "\nincomplete: tightening {file} #{number}")?;
        }
        for file in &self.incomplete_files {
            write!(f, "\nincomplete: file {file}")?;
        }
        if let Completeness::TooLarge { .. } = self.completeness {
            write!(f, "\nthe reading stopped at its memory limit")?;
        }
        let bytes = self.dropped_bytes;
        match (self.data_complete, bytes) {
            (true, _) => write!(f, "\nthe data were whole, the index was not")?,
            (false, 0) => write!(f, "\nthe file ends between two records, without its end")?,
            (false, _) => write!(f, "\nthe last {bytes} bytes are no whole record or chunk")?,
        }
        if self.torn_messages > 0 {
            write!(
                f,
                "\n{} messages come from a torn chunk and could not be checked",
                self.torn_messages
            )?;
        }
        for left_out in &self.left_out {
            let LeftOut {
                reason,
                count,
                bytes,
            } = left_out;
            write!(f, "\nleft out: {reason} ({count} times, {bytes} bytes)")?;
        }
        Ok(())
    }
}
