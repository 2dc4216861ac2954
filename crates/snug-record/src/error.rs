//! Why a recording could not be written or read.

use std::error::Error;
use std::path::PathBuf;

/// Why a recording could not be written or read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RecordError {
    /// A file of that name is there already; nothing is ever replaced.
    #[error(
        "the recording {path} exists already and is not replaced: move it away or choose another name"
    )]
    Exists {
        /// Where the recording was to be.
        path: PathBuf,
    },
    /// The file could not be made.
    #[error("cannot create the recording {path}: {source}")]
    Create {
        /// Where it was to be.
        path: PathBuf,
        /// What the operating system said.
        source: std::io::Error,
    },
    /// Writing failed (disk full, device gone); what was flushed before stays readable. The message is the first cause,
    /// as the operating system names it.
    #[error("cannot write the recording: {}", cause(source))]
    Write {
        /// What the MCAP writer said; the first cause is at the end of its chain of sources.
        #[from]
        source: mcap::McapError,
    },
    /// A message could not be written as JSON.
    #[error("a message for {topic} cannot be written as JSON: {source}")]
    Json {
        /// The topic it was meant for.
        topic: String,
        /// What the serializer said.
        source: serde_json::Error,
    },
    /// A signal does not have as many samples as the torque of the same tightening.
    #[error("{tightening}: signal {signal} has {found} samples, the torque has {expected}")]
    UnequalLengths {
        /// Which tightening, as `file #number`.
        tightening: String,
        /// Name of the signal.
        signal: String,
        /// Samples of the torque.
        expected: usize,
        /// Samples of the signal.
        found: usize,
    },
    /// A setting is outside its range.
    #[error("record setting {field} is {value}; allowed: {allowed}")]
    Setting {
        /// Name of the field.
        field: &'static str,
        /// What it was set to.
        value: f64,
        /// What it may be.
        allowed: &'static str,
    },
    /// The bytes are not an MCAP file: the first eight are not its magic number.
    #[error("not an MCAP file: {length} bytes that begin with {start:02x?}")]
    NotMcap {
        /// Length of the data.
        length: usize,
        /// Its first bytes, at most eight.
        start: Vec<u8>,
    },
}

/// The error of the operating system at the bottom, which says what a person can mend; the layers above it only say that
/// something failed.
fn cause(error: &mcap::McapError) -> String {
    let chain = std::iter::successors(Some(error as &dyn Error), |error| (*error).source());
    let last = chain.filter(|error| error.is::<std::io::Error>()).last();
    last.map_or_else(|| error.to_string(), ToString::to_string)
}
