//! Every numeric field of every message, whatever wrote the file.

use super::DEFAULT_LIMIT_BYTES;
use super::collector::Collector;
use super::stream::{Completeness, Item, scan};
use crate::RecordError;
use std::ops::ControlFlow;

/// One numeric field of one topic over time.
#[derive(Debug, Clone, PartialEq)]
pub struct NumericChannel {
    /// Topic, for example `/tool/torque`.
    pub topic: String,
    /// Path of the field within the message: `wrench.force.x`, `samples[3]`; empty when the message itself is a number.
    pub field: String,
    /// Message encoding: `json`, `protobuf`, `cdr`, `ros1`.
    pub encoding: String,
    /// Name of the schema; empty when there is none.
    pub schema: String,
    /// Log time of each value since [`NumericChannels::start_ns`] \[s\], in file order.
    pub log_time_s: Vec<f64>,
    /// The values, as the file has them, in whatever unit it has them; truth values are 0 and 1.
    pub values: Vec<f64>,
}

/// A topic, or a part of it, that gives no numbers.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnreadableChannel {
    /// Topic.
    pub topic: String,
    /// Message encoding.
    pub encoding: String,
    /// Schema encoding.
    pub schema_encoding: String,
    /// Messages concerned.
    pub messages: u64,
    /// Why, in one sentence.
    pub reason: String,
}

/// All numeric channels of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct NumericChannels {
    /// Earliest log time in the file \[ns\]; times count from it, because nanoseconds since 1970 do not fit a double.
    pub start_ns: u64,
    /// Channels, by topic and field.
    pub channels: Vec<NumericChannel>,
    /// What could not be read, by topic.
    pub unreadable: Vec<UnreadableChannel>,
    /// Whether the file was read to its end.
    pub completeness: Completeness,
}

impl NumericChannels {
    /// The channel of one topic and field.
    pub fn channel(&self, topic: &str, field: &str) -> Option<&NumericChannel> {
        self.channels
            .iter()
            .find(|channel| channel.topic == topic && channel.field == field)
    }
}

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
/// [`Completeness::TooLarge`]. A value takes 16 bytes. The same number bounds the work.
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
