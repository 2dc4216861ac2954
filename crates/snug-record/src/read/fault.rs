//! What can be wrong with a record or chunk, and why reading ended.

use super::budget::Exhausted;
use thiserror::Error;

/// A fault in the file's framing or in a record that is used.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub(crate) enum Fault {
    /// A length leads beyond the bytes that are there.
    #[error("a {record} record of {bytes} bytes does not hold what its lengths claim")]
    Malformed { record: &'static str, bytes: usize },
    #[error("a record runs beyond the end of the file")]
    BeyondFile,
    #[error("a record runs beyond the end of its chunk of {bytes} bytes")]
    BeyondChunk { bytes: usize },
    #[error("chunk checksum failed (expected {expected:08x}, found {found:08x})")]
    ChunkChecksum { expected: u32, found: u32 },
    #[error("attachment checksum failed (expected {expected:08x}, found {found:08x})")]
    AttachmentChecksum { expected: u32, found: u32 },
    #[error("chunk compression {name:?} is not supported")]
    Compression { name: String },
    #[error("a chunk cannot be unpacked: {reason}")]
    Unpack { reason: String },
    #[error("a chunk unpacks to {found} bytes in place of {expected}")]
    UnpackedLength { expected: u64, found: u64 },
    #[error("message {sequence} belongs to channel {channel}, which is not declared")]
    UnknownChannel { channel: u16, sequence: u32 },
}

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
