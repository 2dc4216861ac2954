//! MCAP back into numbers: any file's numeric channels, and Snug's own recordings as measurements.
//!
//! Both readers take what is there: a file whose end is missing gives everything before the cut and says so
//! ([`Completeness`]). Nothing depends on the summary at the end of the file, because a killed run has none.
//!
//! No length in a file is believed: memory follows the bytes that are there, and ends at a limit that callers can set.

pub(crate) mod budget;
mod channel;
pub(crate) mod chunk;
mod collector;
pub(crate) mod content;
mod decoded;
pub(crate) mod fault;
mod json;
mod numeric;
mod protobuf;
mod recordings;
pub(crate) mod records;
mod ros;
pub(crate) mod stream;
mod unpack;

pub use channel::{NumericChannel, NumericChannels, UnreadableChannel};
pub use numeric::{numeric_channels, numeric_channels_within};
pub use recordings::{Extent, RecordedCampaign, RecordedFile, recordings, recordings_within};
pub use stream::Completeness;

/// Memory that reading one file may take beside its bytes, unless the caller sets another limit: 1 GiB, or 48 million
/// values with their times.
pub const DEFAULT_LIMIT_BYTES: u64 = 1 << 30;

#[cfg(test)]
mod tests;
