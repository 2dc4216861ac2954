//! MCAP back into numbers: any file's numeric channels, and Snug's own recordings as measurements.
//!
//! Both readers take what is there: a file whose end is missing gives everything before the cut and says so
//! ([`Completeness`]). Nothing depends on the summary at the end of the file, because a killed run has none.

mod decoded;
mod json;
mod numeric;
mod protobuf;
mod recordings;
mod records;
mod ros;
mod stream;

pub use numeric::{NumericChannel, NumericChannels, UnreadableChannel, numeric_channels};
pub use recordings::{Extent, RecordedCampaign, RecordedFile, recordings};
pub use stream::Completeness;

#[cfg(test)]
mod tests;
