//! Values of numeric channels as they come, message by message.

use super::budget::{Budget, Exhausted};
use super::channel::{NumericChannel, NumericChannels, UnreadableChannel};
use super::decoded::{LONGEST_SCHEMA_BYTES, WORK_SPENT};
use super::stream::{Channel, Completeness, Schema};
use super::{json, protobuf, ros};
use std::borrow::Cow;
use std::collections::{BTreeMap, HashMap};
use std::rc::Rc;

/// Distinct fields of one topic.
const MOST_FIELDS: usize = 4096;
const TOO_MANY_FIELDS: &str = "fields beyond 4096 were left out";
/// Longest path of a field \[bytes\]; every value looks its field up by it.
const LONGEST_PATH_BYTES: usize = 1024;
const PATH_TOO_LONG: &str = "fields with paths longer than 1024 bytes were left out";
/// A topic or field without its texts and values \[bytes\].
const ENTRY_BYTES: usize = 256;
/// Memory of an understood schema per byte of its text.
const SCHEMA_GROWTH: usize = 24;
const SCHEMA_TOO_LONG: &str = "the schema is longer than 4 MiB";

/// A file may cost a step of work for so many bytes of the limit.
const BYTES_PER_STEP: u64 = 4;

/// How the messages of one channel become numbers.
enum Decoder {
    Json,
    Protobuf(protobuf::Decoder),
    Ros(ros::Decoder),
    Unreadable(Cow<'static, str>),
}

impl Decoder {
    fn of(channel: &Channel) -> Self {
        let unreadable = |reason: &'static str| Self::Unreadable(reason.into());
        let schema = &channel.schema;
        let (encoding, schema_encoding) = (&*channel.message_encoding, &*schema.encoding);
        if encoding == "json" {
            return Self::Json;
        }
        if schema.data.len() > LONGEST_SCHEMA_BYTES {
            return unreadable(SCHEMA_TOO_LONG);
        }
        let wire = match (encoding, schema_encoding) {
            ("protobuf", "protobuf") => {
                return protobuf::Decoder::new(&schema.data, &schema.name).map_or_else(
                    || unreadable("the protobuf schema cannot be understood"),
                    Self::Protobuf,
                );
            }
            ("cdr", "ros2msg") => ros::Wire::Cdr,
            ("ros1", "ros1msg") => ros::Wire::Ros1,
            _ => {
                let reason = format!(
                    "messages in {:?} with a schema in {:?} are not supported",
                    beginning(encoding),
                    beginning(schema_encoding)
                );
                return Self::Unreadable(reason.into());
            }
        };
        ros::Decoder::new(&schema.data, &schema.name, wire).map_or_else(
            || unreadable("the ROS message definition cannot be understood"),
            Self::Ros,
        )
    }
}

/// The first letters of a text that may be very long.
fn beginning(text: &str) -> &str {
    text.char_indices()
        .nth(64)
        .map_or(text, |(end, _)| &text[..end])
}

/// A schema's decoder.
struct Understood {
    decoder: Rc<Decoder>,
    /// Kept so that its place in memory stays its own.
    _schema: Rc<Schema>,
}

/// A channel of the file.
struct Source {
    /// Place in [`Collector::topics`].
    topic: usize,
    message_encoding: String,
    schema: Rc<Schema>,
    decoder: Rc<Decoder>,
    /// Why messages were left out, and how many; there are only a few different reasons.
    complaints: Vec<(Cow<'static, str>, u64)>,
}

impl Source {
    fn complain(&mut self, reason: impl Into<Cow<'static, str>>) {
        let reason = reason.into();
        match self
            .complaints
            .iter_mut()
            .find(|(known, _)| *known == reason)
        {
            Some((_, messages)) => *messages += 1,
            None => self.complaints.push((reason, 1)),
        }
    }
}

#[derive(Default)]
struct Field {
    log_time_ns: Vec<u64>,
    values: Vec<f64>,
    /// Number of the message that gave the last value, counted from 1.
    message: u64,
}

/// Fields of one topic, in the order of their names.
struct Topic {
    name: String,
    encoding: String,
    schema: String,
    fields: BTreeMap<String, Field>,
}

/// What is gathered over the length of a file.
pub(super) struct Collector {
    /// By channel id.
    sources: HashMap<u16, Source>,
    /// In the order of their first declaration.
    topics: Vec<Topic>,
    topic_of: HashMap<String, usize>,
    /// By the place of the schema in memory and the message encoding.
    decoders: HashMap<(*const Schema, String), Understood>,
    /// Steps of work that are left.
    work: Budget,
    messages: u64,
    start_ns: Option<u64>,
}

impl Collector {
    pub(super) fn new(limit_bytes: u64) -> Self {
        Self {
            sources: HashMap::new(),
            topics: Vec::new(),
            topic_of: HashMap::new(),
            decoders: HashMap::new(),
            work: Budget::new(limit_bytes / BYTES_PER_STEP),
            messages: 0,
            start_ns: None,
        }
    }

    pub(super) fn declare(
        &mut self,
        id: u16,
        channel: &Channel,
        budget: &mut Budget,
    ) -> Result<(), Exhausted> {
        if self.sources.contains_key(&id) {
            return Ok(());
        }
        let decoder = self.decoder(channel, budget)?;
        let text = channel.topic.len() + channel.message_encoding.len();
        budget.spend((4 * text + channel.schema.name.len() + ENTRY_BYTES) as u64)?;
        let known = self.topic_of.entry(channel.topic.clone());
        let topic = *known.or_insert_with(|| {
            self.topics.push(Topic {
                name: channel.topic.clone(),
                encoding: channel.message_encoding.clone(),
                schema: channel.schema.name.clone(),
                fields: BTreeMap::new(),
            });
            self.topics.len() - 1
        });
        let source = Source {
            topic,
            message_encoding: channel.message_encoding.clone(),
            schema: Rc::clone(&channel.schema),
            decoder,
            complaints: Vec::new(),
        };
        self.sources.insert(id, source);
        Ok(())
    }

    /// Channels of one schema share a decoder.
    fn decoder(
        &mut self,
        channel: &Channel,
        budget: &mut Budget,
    ) -> Result<Rc<Decoder>, Exhausted> {
        let key = (
            Rc::as_ptr(&channel.schema),
            channel.message_encoding.clone(),
        );
        if let Some(understood) = self.decoders.get(&key) {
            return Ok(Rc::clone(&understood.decoder));
        }
        let schema_bytes = channel.schema.data.len().min(LONGEST_SCHEMA_BYTES);
        budget.spend((SCHEMA_GROWTH * schema_bytes + key.1.len() + ENTRY_BYTES) as u64)?;
        let decoder = Rc::new(Decoder::of(channel));
        let understood = Understood {
            decoder: Rc::clone(&decoder),
            _schema: Rc::clone(&channel.schema),
        };
        self.decoders.insert(key, understood);
        Ok(decoder)
    }

    pub(super) fn message(
        &mut self,
        id: u16,
        log_time_ns: u64,
        data: &[u8],
        budget: &mut Budget,
    ) -> Result<(), Exhausted> {
        self.start_ns = Some(self.start_ns.map_or(log_time_ns, |t| t.min(log_time_ns)));
        self.messages += 1;
        let Some(source) = self.sources.get_mut(&id) else {
            return Ok(());
        };
        let mut values = Values {
            topic: &mut self.topics[source.topic],
            budget,
            log_time_ns,
            message: self.messages,
            full: Ok(()),
            left_out: None,
        };
        let mut put = |path: &str, value: f64| values.put(path, value);
        let decoder = Rc::clone(&source.decoder);
        let work = &mut self.work;
        let decoded = match &*decoder {
            Decoder::Json => json::decode(data, &mut put),
            Decoder::Protobuf(decoder) => decoder.decode(data, work, &mut put),
            Decoder::Ros(decoder) => decoder.decode(data, work, &mut put),
            Decoder::Unreadable(reason) => {
                source.complain(reason.clone());
                return Ok(());
            }
        };
        let (full, left_out) = (values.full, values.left_out);
        match decoded {
            Err(WORK_SPENT) => return Err(Exhausted),
            Err(reason) => source.complain(reason),
            Ok(()) => {}
        }
        if let Some(reason) = left_out {
            source.complain(reason);
        }
        full
    }

    pub(super) fn finish(self, completeness: Completeness) -> NumericChannels {
        let start_ns = self.start_ns.unwrap_or(0);
        let unreadable = unreadable(&self.sources, &self.topics);
        let mut topics = self.topics;
        topics.sort_by(|one, other| one.name.cmp(&other.name));
        let mut channels = Vec::new();
        for topic in topics {
            for (field, samples) in topic.fields {
                channels.push(NumericChannel {
                    topic: topic.name.clone(),
                    field,
                    encoding: topic.encoding.clone(),
                    schema: topic.schema.clone(),
                    log_time_s: samples
                        .log_time_ns
                        .into_iter()
                        .map(|time_ns| (time_ns - start_ns) as f64 * 1e-9)
                        .collect(),
                    values: samples.values,
                });
            }
        }
        NumericChannels {
            start_ns,
            channels,
            unreadable,
            completeness,
        }
    }
}

/// By topic and reason; channels of one topic are counted together.
fn unreadable(sources: &HashMap<u16, Source>, topics: &[Topic]) -> Vec<UnreadableChannel> {
    let mut ids: Vec<&u16> = sources.keys().collect();
    ids.sort_unstable();
    let mut unreadable = BTreeMap::new();
    for id in ids {
        let source = &sources[id];
        let topic = &topics[source.topic].name;
        for (reason, messages) in &source.complaints {
            unreadable
                .entry((topic, reason))
                .or_insert_with(|| UnreadableChannel {
                    topic: topic.clone(),
                    encoding: source.message_encoding.clone(),
                    schema_encoding: source.schema.encoding.clone(),
                    messages: 0,
                    reason: reason.to_string(),
                })
                .messages += messages;
        }
    }
    unreadable.into_values().collect()
}

/// Where the values of one message go.
struct Values<'a> {
    topic: &'a mut Topic,
    budget: &'a mut Budget,
    log_time_ns: u64,
    message: u64,
    full: Result<(), Exhausted>,
    left_out: Option<&'static str>,
}

impl Values<'_> {
    fn put(&mut self, path: &str, value: f64) {
        if self.full.is_ok() {
            self.full = self.try_put(path, value);
        }
    }

    fn try_put(&mut self, path: &str, value: f64) -> Result<(), Exhausted> {
        if path.len() > LONGEST_PATH_BYTES {
            self.left_out = Some(PATH_TOO_LONG);
            return Ok(());
        }
        let fields = &mut self.topic.fields;
        let field = if let Some(field) = fields.get_mut(path) {
            field
        } else if fields.len() < MOST_FIELDS {
            // The channel that comes of it repeats the topic's texts.
            let topic = &self.topic;
            let text = topic.name.len() + topic.encoding.len() + topic.schema.len();
            self.budget
                .spend((text + path.len() + ENTRY_BYTES) as u64)?;
            self.topic.fields.entry(path.to_owned()).or_default()
        } else {
            self.left_out = Some(TOO_MANY_FIELDS);
            return Ok(());
        };
        if field.message == self.message {
            // Of a field that stands twice the last value counts.
            if let Some(last) = field.values.last_mut() {
                *last = value;
            }
            return Ok(());
        }
        field.message = self.message;
        self.budget.grow(&mut field.log_time_ns)?;
        self.budget.grow(&mut field.values)?;
        field.log_time_ns.push(self.log_time_ns);
        field.values.push(value);
        Ok(())
    }
}
