//! The numeric channels of a file.

use super::stream::Completeness;

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
