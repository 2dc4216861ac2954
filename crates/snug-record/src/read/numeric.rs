use super::stream::{Channel, Completeness, Item, scan};
use super::{json, protobuf, ros};
use crate::RecordError;
use std::collections::{BTreeMap, HashMap};
use std::ops::ControlFlow;

/// Distinct fields of one topic.
const MOST_FIELDS: usize = 4096;
/// Values of one file, all channels together (2 GiB with their times).
const MOST_VALUES: usize = 1 << 27;

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
    /// The values, as the file has them; truth values are 0 and 1.
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
/// Nested fields are joined with dots, array elements are indexed up to 256 elements. Other encodings and messages that
/// do not fit their schema are listed in [`NumericChannels::unreadable`].
///
/// # Errors
/// [`RecordError::NotMcap`] when the data do not begin as an MCAP file. A truncated or damaged file is no error.
pub fn numeric_channels(bytes: &[u8]) -> Result<NumericChannels, RecordError> {
    let mut collector = Collector::default();
    let completeness = scan(bytes, |item| {
        match item {
            Item::Channel { id, channel } => collector.declare(id, channel),
            Item::Message {
                id,
                log_time_ns,
                data,
            } => collector.message(id, log_time_ns, data),
            Item::Metadata { .. } => {}
        }
        if collector.values > MOST_VALUES {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    })?;
    Ok(collector.finish(completeness))
}

/// How the messages of one channel become numbers.
enum Decoder {
    Json,
    Protobuf(protobuf::Decoder),
    Ros(ros::Decoder),
    Unreadable(String),
}

impl Decoder {
    fn of(channel: &Channel) -> Self {
        let schema_encoding = channel.schema_encoding.as_str();
        match (channel.message_encoding.as_str(), schema_encoding) {
            ("json", _) => Self::Json,
            ("protobuf", "protobuf") => {
                protobuf::Decoder::new(&channel.schema, &channel.schema_name).map_or_else(
                    || Self::Unreadable("the protobuf schema cannot be understood".into()),
                    Self::Protobuf,
                )
            }
            ("cdr", "ros2msg") | ("ros1", "ros1msg") => {
                let wire = if channel.message_encoding == "cdr" {
                    ros::Wire::Cdr
                } else {
                    ros::Wire::Ros1
                };
                ros::Decoder::new(&channel.schema, &channel.schema_name, wire).map_or_else(
                    || Self::Unreadable("the ROS message definition cannot be understood".into()),
                    Self::Ros,
                )
            }
            (encoding, schema) => Self::Unreadable(format!(
                "messages in {encoding:?} with a schema in {schema:?} are not supported"
            )),
        }
    }
}

struct Source {
    topic: String,
    encoding: String,
    schema: String,
    schema_encoding: String,
    decoder: Decoder,
}

#[derive(Default)]
struct Field {
    log_time_ns: Vec<u64>,
    values: Vec<f64>,
}

/// Fields of one topic, in the order of their names.
#[derive(Default)]
struct Topic {
    encoding: String,
    schema: String,
    fields: BTreeMap<String, Field>,
}

#[derive(Default)]
struct Collector {
    sources: HashMap<u16, Source>,
    topics: BTreeMap<String, Topic>,
    unreadable: BTreeMap<(String, String), UnreadableChannel>,
    values: usize,
    start_ns: Option<u64>,
}

impl Collector {
    fn declare(&mut self, id: u16, channel: &Channel) {
        self.sources.entry(id).or_insert_with(|| Source {
            topic: channel.topic.clone(),
            encoding: channel.message_encoding.clone(),
            schema: channel.schema_name.clone(),
            schema_encoding: channel.schema_encoding.clone(),
            decoder: Decoder::of(channel),
        });
    }

    fn message(&mut self, id: u16, log_time_ns: u64, data: &[u8]) {
        self.start_ns = Some(self.start_ns.map_or(log_time_ns, |t| t.min(log_time_ns)));
        let Some(source) = self.sources.get(&id) else {
            return;
        };
        if !self.topics.contains_key(&source.topic) {
            let topic = Topic {
                encoding: source.encoding.clone(),
                schema: source.schema.clone(),
                ..Topic::default()
            };
            self.topics.insert(source.topic.clone(), topic);
        }
        let topic = self
            .topics
            .get_mut(&source.topic)
            .expect("inserted just above");
        let mut too_many = false;
        let values = &mut self.values;
        let mut put = |path: &str, value: f64| {
            let field = if let Some(field) = topic.fields.get_mut(path) {
                field
            } else if topic.fields.len() < MOST_FIELDS {
                topic.fields.entry(path.to_owned()).or_default()
            } else {
                too_many = true;
                return;
            };
            field.log_time_ns.push(log_time_ns);
            field.values.push(value);
            *values += 1;
        };
        let decoded = match &source.decoder {
            Decoder::Json => json::decode(data, &mut put),
            Decoder::Protobuf(decoder) => decoder.decode(data, &mut put),
            Decoder::Ros(decoder) => decoder.decode(data, &mut put),
            Decoder::Unreadable(reason) => {
                let reason = reason.clone();
                return self.complain(id, reason);
            }
        };
        if let Err(reason) = decoded {
            self.complain(id, reason.to_owned());
        }
        if too_many {
            self.complain(id, format!("fields beyond {MOST_FIELDS} were left out"));
        }
    }

    fn complain(&mut self, id: u16, reason: String) {
        let source = &self.sources[&id];
        self.unreadable
            .entry((source.topic.clone(), reason))
            .or_insert_with_key(|(topic, reason)| UnreadableChannel {
                topic: topic.clone(),
                encoding: source.encoding.clone(),
                schema_encoding: source.schema_encoding.clone(),
                messages: 0,
                reason: reason.clone(),
            })
            .messages += 1;
    }

    fn finish(self, completeness: Completeness) -> NumericChannels {
        let start_ns = self.start_ns.unwrap_or(0);
        let mut channels = Vec::new();
        for (name, topic) in self.topics {
            for (field, samples) in topic.fields {
                channels.push(NumericChannel {
                    topic: name.clone(),
                    field,
                    encoding: topic.encoding.clone(),
                    schema: topic.schema.clone(),
                    log_time_s: samples
                        .log_time_ns
                        .iter()
                        .map(|&time_ns| (time_ns - start_ns) as f64 * 1e-9)
                        .collect(),
                    values: samples.values,
                });
            }
        }
        NumericChannels {
            start_ns,
            channels,
            unreadable: self.unreadable.into_values().collect(),
            completeness,
        }
    }
}
