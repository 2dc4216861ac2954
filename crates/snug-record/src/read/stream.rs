use super::records::{Stop, walk};
use crate::RecordError;
use mcap::records::Record;
use mcap::{McapError, parse_record};
use std::collections::{BTreeMap, HashMap};
use std::ops::ControlFlow;

/// How much of the file could be read.
#[derive(Debug, Clone, PartialEq)]
pub enum Completeness {
    /// Everything, up to the footer.
    Complete,
    /// The file ends early, as after a killed run or a broken copy; everything before the cut was read.
    Truncated,
    /// A record or chunk is damaged; everything before it was read (of a compressed chunk also its beginning, whose
    /// values may be wrong).
    Damaged {
        /// Messages read before the damage.
        messages: u64,
        /// What is wrong with the record.
        fault: String,
    },
    /// Reading stopped at the limit for one file's values; everything before it was read.
    TooLarge {
        /// Messages read before the limit.
        messages: u64,
    },
}

/// A channel with its schema, as the file declares them.
#[derive(Debug, Clone)]
pub(super) struct Channel {
    pub(super) topic: String,
    pub(super) message_encoding: String,
    pub(super) schema_name: String,
    pub(super) schema_encoding: String,
    pub(super) schema: Vec<u8>,
}

/// What the scan meets, in file order.
pub(super) enum Item<'a> {
    /// A channel is declared; messages of this id follow. A file may repeat the declaration.
    Channel { id: u16, channel: &'a Channel },
    /// One message of a declared channel.
    Message {
        id: u16,
        log_time_ns: u64,
        data: &'a [u8],
    },
    /// A metadata record.
    Metadata {
        name: &'a str,
        entries: &'a BTreeMap<String, String>,
    },
}

/// Visits channels, messages and metadata from first to last; a visitor's `Break` ends it as [`Completeness::TooLarge`].
///
/// # Errors
/// [`RecordError::NotMcap`] when the first eight bytes are not MCAP's magic number; every later fault is a
/// [`Completeness`].
pub(super) fn scan(
    bytes: &[u8],
    mut visit: impl FnMut(Item<'_>) -> ControlFlow<()>,
) -> Result<Completeness, RecordError> {
    if !bytes.starts_with(mcap::MAGIC) {
        return Err(RecordError::NotMcap {
            length: bytes.len(),
            start: bytes[..bytes.len().min(8)].to_vec(),
        });
    }
    let mut state = Scan::default();
    let end = walk(&bytes[mcap::MAGIC.len()..], &mut |opcode, data| match state
        .record(opcode, data, &mut visit)?
    {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(Stop::Limit),
    });
    let messages = state.messages;
    Ok(match end {
        Ok(()) => Completeness::Complete,
        Err(Stop::Limit) => Completeness::TooLarge { messages },
        // A file that ends as it should but whose records do not add up is damaged, not cut.
        Err(Stop::Truncated) if bytes.len() > 8 && bytes.ends_with(mcap::MAGIC) => {
            Completeness::Damaged {
                messages,
                fault: "a record runs beyond the end of the file".to_owned(),
            }
        }
        Err(Stop::Truncated) => Completeness::Truncated,
        Err(Stop::Fault(error)) => Completeness::Damaged {
            messages,
            fault: error.to_string(),
        },
    })
}

#[derive(Default)]
struct Scan {
    schemas: HashMap<u16, (String, String, Vec<u8>)>,
    channels: HashMap<u16, Channel>,
    messages: u64,
}

impl Scan {
    fn record(
        &mut self,
        opcode: u8,
        data: &[u8],
        visit: &mut impl FnMut(Item<'_>) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, McapError> {
        use mcap::records::op;
        // Only what is used is parsed: an index or attachment with a fault costs no message.
        match opcode {
            op::SCHEMA | op::CHANNEL | op::MESSAGE | op::METADATA => {}
            _ => return Ok(ControlFlow::Continue(())),
        }
        match parse_record(opcode, data)? {
            Record::Schema { header, data } => {
                let schema = (header.name, header.encoding, data.into_owned());
                self.schemas.insert(header.id, schema);
            }
            Record::Channel(declared) => {
                let (schema_name, schema_encoding, schema) = self
                    .schemas
                    .get(&declared.schema_id)
                    .cloned()
                    .unwrap_or_default();
                let channel = Channel {
                    topic: declared.topic,
                    message_encoding: declared.message_encoding,
                    schema_name,
                    schema_encoding,
                    schema,
                };
                let flow = visit(Item::Channel {
                    id: declared.id,
                    channel: &channel,
                });
                self.channels.insert(declared.id, channel);
                return Ok(flow);
            }
            Record::Message { header, data } => {
                if !self.channels.contains_key(&header.channel_id) {
                    return Err(McapError::UnknownChannel(
                        header.sequence,
                        header.channel_id,
                    ));
                }
                self.messages += 1;
                return Ok(visit(Item::Message {
                    id: header.channel_id,
                    log_time_ns: header.log_time,
                    data: &data,
                }));
            }
            Record::Metadata(metadata) => {
                return Ok(visit(Item::Metadata {
                    name: &metadata.name,
                    entries: &metadata.metadata,
                }));
            }
            _ => {}
        }
        Ok(ControlFlow::Continue(()))
    }
}
