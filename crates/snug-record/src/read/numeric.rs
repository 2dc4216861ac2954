//! Reads every numeric field of every message, whatever wrote the file.

use super::DEFAULT_LIMIT_BYTES;
use super::channel::NumericChannels;
use super::collector::Collector;
use super::stream::{Item, scan};
use crate::error::RecordError;
use std::ops::ControlFlow;

/// Reads every numeric field of every message: JSON, protobuf, ROS 2 (`cdr` with `ros2msg`) and ROS 1.
///
/// Nested fields are joined with dots, array elements are indexed up to 256 elements, and of a field that stands twice in
/// one message the last value counts. Other encodings and messages that do not fit their schema are listed in
/// [`NumericChannels::unreadable`]. Memory: [`DEFAULT_LIMIT_BYTES`].
///
/// # Errors
/// [`RecordError::NotMcap`] when the data do not begin as an MCAP file. A truncated or damaged file is no error.
pub fn numeric_channels(bytes: &[u8]) -> Result<NumericChannels, RecordError> {
    numeric_channels_within(bytes, DEFAULT_LIMIT_BYTES)
}

/// [`numeric_channels`] in at most about `limit_bytes` of memory beside `bytes`; what does not fit ends the reading as
/// [`Completeness::TooLarge`](crate::read::Completeness::TooLarge). A value takes 16 bytes. The same number bounds the work.
///
/// # Errors
/// As [`numeric_channels`].
pub fn numeric_channels_within(
    bytes: &[u8],
    limit_bytes: u64,
) -> Result<NumericChannels, RecordError> {
    let mut collector = Collector::new(limit_bytes);
    let completeness = scan(bytes, limit_bytes, |item, budget| {
        let taken = match item {
            Item::Channel { id, channel } => collector.declare(id, channel, budget),
            Item::Message {
                id,
                log_time_ns,
                data,
            } => collector.message(id, log_time_ns, data, budget),
            Item::Metadata(_) => Ok(()),
        };
        taken.map_or(ControlFlow::Break(()), ControlFlow::Continue)
    })?;
    Ok(collector.finish(completeness))
}
