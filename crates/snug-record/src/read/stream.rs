//! Channels, messages and metadata from first to last, within a budget.

use super::budget::{Budget, Limits};
use super::content;
use super::fault::{Fault, Stop};
use super::records::{Found, walk};
use crate::error::RecordError;
use std::collections::HashMap;
use std::ops::ControlFlow;
use std::rc::Rc;

/// How much of the file could be read.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Completeness {
    /// Everything, up to the footer.
    Complete,
    /// The file ends early, as after a killed run or a broken copy; everything before the cut was read.
    #[default]
    Truncated,
    /// A record or chunk is damaged; everything before it was read, and nothing of a chunk whose checksum is wrong.
    Damaged {
        /// Messages read before the damage.
        messages: u64,
        /// What is wrong with the record.
        fault: String,
    },
    /// Reading stopped at the limit for one file's memory; everything before it was read.
    TooLarge {
        /// Messages read before the limit.
        messages: u64,
    },
}

/// What describes the messages of a channel; channels of one schema share it.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct Schema {
    pub(super) name: String,
    pub(super) encoding: String,
    pub(super) data: Vec<u8>,
}

/// A channel with its schema, as the file declares them.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Channel {
    pub(super) topic: String,
    pub(super) message_encoding: String,
    pub(super) schema: Rc<Schema>,
}

/// What the scan meets, in file order.
pub(super) enum Item<'a> {
    /// A channel is declared, or declared differently; messages of this id follow.
    Channel { id: u16, channel: &'a Channel },
    /// One message of a declared channel.
    Message {
        id: u16,
        log_time_ns: u64,
        data: &'a [u8],
    },
    /// A metadata record.
    Metadata(content::Metadata<'a>),
}

/// Checks that the data begin with MCAP's magic number.
///
/// # Errors
/// [`RecordError::NotMcap`].
pub(crate) fn check_magic(bytes: &[u8]) -> Result<(), RecordError> {
    if bytes.starts_with(mcap::MAGIC) {
        return Ok(());
    }
    Err(RecordError::NotMcap {
        length: bytes.len(),
        start: bytes[..bytes.len().min(8)].to_vec(),
    })
}

/// What the end of a walk means for a file.
pub(crate) fn completeness(bytes: &[u8], end: Result<(), Stop>, messages: u64) -> Completeness {
    let damaged = |fault: Fault| Completeness::Damaged {
        messages,
        fault: fault.to_string(),
    };
    match end {
        Ok(()) => Completeness::Complete,
        Err(Stop::TooLarge) => Completeness::TooLarge { messages },
        // A file that ends as it should but whose records do not add up is damaged, not cut.
        Err(Stop::Truncated) if bytes.len() > 8 && bytes.ends_with(mcap::MAGIC) => {
            damaged(Fault::BeyondFile)
        }
        Err(Stop::Truncated) => Completeness::Truncated,
        Err(Stop::Fault(fault)) => damaged(fault),
    }
}

/// Visits channels, messages and metadata from first to last. The visitor pays for what it keeps, and its `Break` ends the
/// scan as [`Completeness::TooLarge`].
///
/// # Errors
/// [`RecordError::NotMcap`] when the first eight bytes are not MCAP's magic number; every later fault is a
/// [`Completeness`].
pub(super) fn scan(
    bytes: &[u8],
    limit_bytes: u64,
    mut visit: impl FnMut(Item<'_>, &mut Budget) -> ControlFlow<()>,
) -> Result<Completeness, RecordError> {
    check_magic(bytes)?;
    let limits = Limits::new(limit_bytes, bytes.len());
    let mut state = Scan {
        budget: Budget::new(limits.kept_bytes),
        schemas: HashMap::new(),
        channels: HashMap::new(),
        messages: 0,
    };
    let walked = walk(bytes, limits, &mut |found| match found {
        Found::Record { opcode, body, .. } => state.record(opcode, body, &mut visit),
        Found::Damage { fault, .. } => Err(fault.into()),
    });
    Ok(completeness(bytes, walked.end, state.messages))
}

/// What a schema or channel takes beside its texts \[bytes\].
const DECLARATION_BYTES: usize = 256;

struct Scan {
    budget: Budget,
    schemas: HashMap<u16, Rc<Schema>>,
    channels: HashMap<u16, Channel>,
    messages: u64,
}

impl Scan {
    fn record(
        &mut self,
        opcode: u8,
        body: &[u8],
        visit: &mut impl FnMut(Item<'_>, &mut Budget) -> ControlFlow<()>,
    ) -> Result<(), Stop> {
        use mcap::records::op;
        // Only what is used is parsed: an index or attachment with a fault costs no message.
        let flow = match opcode {
            op::SCHEMA => return self.schema(&content::Schema::read(body)?),
            op::CHANNEL => {
                let declared = content::Channel::read(body)?;
                if !self.channel(&declared)? {
                    return Ok(());
                }
                let item = Item::Channel {
                    id: declared.id,
                    channel: &self.channels[&declared.id],
                };
                visit(item, &mut self.budget)
            }
            op::MESSAGE => {
                let message = content::Message::read(body)?;
                if !self.channels.contains_key(&message.channel_id) {
                    return Err(Stop::Fault(Fault::UnknownChannel {
                        channel: message.channel_id,
                        sequence: message.sequence,
                    }));
                }
                self.messages += 1;
                let item = Item::Message {
                    id: message.channel_id,
                    log_time_ns: message.log_time_ns,
                    data: message.data,
                };
                visit(item, &mut self.budget)
            }
            op::METADATA => visit(
                Item::Metadata(content::Metadata::read(body)?),
                &mut self.budget,
            ),
            _ => return Ok(()),
        };
        match flow {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(Stop::TooLarge),
        }
    }

    /// Keeps a schema. Many writers repeat it in every chunk, which costs nothing.
    fn schema(&mut self, declared: &content::Schema<'_>) -> Result<(), Stop> {
        let known = self.schemas.get(&declared.id).is_some_and(|schema| {
            schema.name == declared.name
                && schema.encoding == declared.encoding
                && schema.data == declared.data
        });
        if !known {
            let text = declared.name.len() + declared.encoding.len() + declared.data.len();
            self.budget.spend((text + DECLARATION_BYTES) as u64)?;
            let schema = Schema {
                name: declared.name.to_owned(),
                encoding: declared.encoding.to_owned(),
                data: declared.data.to_vec(),
            };
            self.schemas.insert(declared.id, Rc::new(schema));
        }
        Ok(())
    }

    /// Keeps a channel; false when it is known already.
    fn channel(&mut self, declared: &content::Channel<'_>) -> Result<bool, Stop> {
        let schema = self.schemas.get(&declared.schema_id);
        let known = self.channels.get(&declared.id).is_some_and(|channel| {
            channel.topic == declared.topic
                && channel.message_encoding == declared.message_encoding
                && schema.map_or(*channel.schema == Schema::default(), |schema| {
                    Rc::ptr_eq(schema, &channel.schema)
                })
        });
        if !known {
            let text = declared.topic.len() + declared.message_encoding.len();
            self.budget.spend((text + DECLARATION_BYTES) as u64)?;
            let channel = Channel {
                topic: declared.topic.to_owned(),
                message_encoding: declared.message_encoding.to_owned(),
                schema: schema.cloned().unwrap_or_default(),
            };
            self.channels.insert(declared.id, channel);
        }
        Ok(!known)
    }
}
