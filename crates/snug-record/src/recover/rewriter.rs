//! The records of one file into another that has an index.

use super::contents::Contents;
use super::{Recovery, index};
use crate::error::RecordError;
use crate::read::budget::{Budget, Exhausted};
use crate::read::content::{Attachment, Channel, Header, Message, Metadata, Schema};
use crate::read::fault::Fault;
use crate::read::records::framed;
use crate::recorder::until_failure;
use crate::recorder::until_failure::{LastingWriter, UntilFailure};
use crate::topic;
use mcap::McapError;
use mcap::records::{MessageHeader, op};
use mcap::write::NoSeek;
use mcap::write::PrivateRecordOptions::IncludeInChunks;
use std::borrow::Cow;
use std::collections::HashMap;
use std::io::Write;

/// Size of a chunk before compression \[bytes\], as [`crate::RecordSettings`] has it by default.
const CHUNK_BYTES: u64 = 262_144;
/// What the writer keeps of a declaration, beside some copies of its texts \[bytes\].
const DECLARATION_BYTES: usize = 512;
const DECLARATION_COPIES: usize = 5;
/// What the writer keeps of an attachment, metadata record or chunk for the index \[bytes\].
const INDEX_BYTES: usize = 512;
/// What it keeps of a channel in a chunk \[bytes\].
const PLACE_BYTES: u64 = 24;

/// Why a record was not written.
pub(super) enum Unwritten {
    LeftOut(String),
    TooLarge,
    Failed(RecordError),
}

impl From<Exhausted> for Unwritten {
    fn from(_: Exhausted) -> Self {
        Self::TooLarge
    }
}

impl From<Fault> for Unwritten {
    fn from(fault: Fault) -> Self {
        Self::LeftOut(fault.to_string())
    }
}

impl From<McapError> for Unwritten {
    fn from(error: McapError) -> Self {
        Self::Failed(error.into())
    }
}

type Written = Result<(), Unwritten>;

/// A schema or channel under the number that the file gives it.
struct Declared {
    /// Its number in what is written.
    written: u16,
    /// The number of its schema there; 0 for none.
    schema: u16,
    name: String,
    body: Vec<u8>,
    /// The chunk that its last message was written to, counted by bytes.
    chunk: u64,
}

/// Numbers that are taken.
struct Numbers {
    taken: Vec<bool>,
    /// Every number above it is taken.
    free: u16,
}

impl Numbers {
    fn new() -> Self {
        Self {
            taken: vec![false; 1 << 16],
            free: u16::MAX,
        }
    }

    /// The wanted number, or the highest that is free when the file gives it a second time; `None` when none is left.
    fn take(&mut self, wanted: u16) -> Option<u16> {
        let mut number = wanted;
        if self.taken[usize::from(wanted)] {
            while self.taken[usize::from(self.free)] {
                self.free = self.free.checked_sub(1).filter(|&free| free > 0)?;
            }
            number = self.free;
        }
        self.taken[usize::from(number)] = true;
        Some(number)
    }
}

/// What the summary at the end of the file repeats, for messages whose own declarations were damaged.
#[derive(Default)]
struct Repeated<'a> {
    schemas: HashMap<u16, &'a [u8]>,
    channels: HashMap<u16, (u16, &'a [u8])>,
}

impl<'a> Repeated<'a> {
    fn of(file: &'a [u8]) -> Self {
        let mut repeated = Self::default();
        let mut summary = index::summary(file).unwrap_or_default();
        while let Some((opcode, body)) = framed(&mut summary) {
            if opcode == op::SCHEMA
                && let Ok(schema) = Schema::read(body)
            {
                repeated.schemas.insert(schema.id, body);
            }
            if opcode == op::CHANNEL
                && let Ok(channel) = Channel::read(body)
            {
                let declared = (channel.schema_id, body);
                repeated.channels.insert(channel.id, declared);
            }
        }
        repeated
    }
}

pub(super) struct Rewriter<'a> {
    writer: LastingWriter<'a>,
    budget: Budget,
    library: String,
    repeated: Repeated<'a>,
    schemas: HashMap<u16, Declared>,
    channels: HashMap<u16, Declared>,
    schema_numbers: Numbers,
    channel_numbers: Numbers,
    /// Bytes of messages written, which tell the chunks apart.
    bytes: u64,
}

impl<'a> Rewriter<'a> {
    /// Begins the new file with the profile of the old.
    pub(super) fn new(
        file: &'a [u8],
        to: impl Write + 'a,
        budget: Budget,
    ) -> Result<Self, RecordError> {
        let header = match framed(&mut &file[mcap::MAGIC.len()..]) {
            Some((op::HEADER, body)) => Header::read(body).unwrap_or_default(),
            _ => Header::default(),
        };
        let writer = until_failure::options(CHUNK_BYTES)
            .compression(Some(mcap::Compression::Zstd))
            .profile(header.profile)
            .library(concat!(
                "snug-record ",
                env!("CARGO_PKG_VERSION"),
                " (recovered)"
            ))
            .create(NoSeek::new(UntilFailure::new(to)))?;
        Ok(Self {
            writer,
            budget,
            library: header.library.to_owned(),
            repeated: Repeated::of(file),
            schemas: HashMap::new(),
            channels: HashMap::new(),
            schema_numbers: Numbers::new(),
            channel_numbers: Numbers::new(),
            bytes: 0,
        })
    }

    pub(super) fn schema(&mut self, body: &[u8]) -> Written {
        let schema = Schema::read(body)?;
        let known = self.schemas.get(&schema.id);
        if known.is_some_and(|known| known.body == body) {
            return Ok(());
        }
        if schema.id == 0 {
            return Err(Unwritten::LeftOut("schemas with the number 0".to_owned()));
        }
        self.pay(body)?;
        let Some(written) = self.schema_numbers.take(schema.id) else {
            return Err(Unwritten::LeftOut("more than 65535 schemas".to_owned()));
        };
        self.writer
            .add_schema_with_id(written, schema.name, schema.encoding, schema.data)?;
        let declared = Declared {
            written,
            schema: 0,
            name: schema.name.to_owned(),
            body: body.to_vec(),
            chunk: u64::MAX,
        };
        self.schemas.insert(schema.id, declared);
        Ok(())
    }

    pub(super) fn channel(&mut self, body: &[u8], contents: &mut Contents) -> Written {
        let channel = Channel::read(body)?;
        let schema = self.schemas.get(&channel.schema_id);
        let schema_id = schema.map_or(0, |schema| schema.written);
        let known = self.channels.get(&channel.id);
        if known.is_some_and(|known| known.body == body && known.schema == schema_id) {
            return Ok(());
        }
        contents.channel(
            channel.id,
            channel.topic,
            schema.map_or("", |schema| &schema.name),
        );
        self.pay(body)?;
        let Some(written) = self.channel_numbers.take(channel.id) else {
            return Err(Unwritten::LeftOut("more than 65536 channels".to_owned()));
        };
        self.writer.add_channel_with_id(
            written,
            schema_id,
            channel.topic,
            channel.message_encoding,
            &channel.metadata.to_map(),
        )?;
        let declared = Declared {
            written,
            schema: schema_id,
            name: String::new(),
            body: body.to_vec(),
            chunk: u64::MAX,
        };
        self.channels.insert(channel.id, declared);
        if channel.schema_id != 0 && schema_id == 0 {
            return Err(Unwritten::LeftOut(format!(
                "the schema {} of channel {}, which is not declared; its messages are kept",
                channel.schema_id, channel.id
            )));
        }
        Ok(())
    }

    /// Takes a channel's declaration from the summary, when it is there.
    fn declare_again(&mut self, id: u16, contents: &mut Contents) -> Written {
        let Some(&(schema_id, channel)) = self.repeated.channels.get(&id) else {
            return Ok(());
        };
        if !self.schemas.contains_key(&schema_id)
            && let Some(schema) = self.repeated.schemas.get(&schema_id)
        {
            self.schema(schema)?;
        }
        self.channel(channel, contents)
    }

    pub(super) fn message(&mut self, body: &[u8], contents: &mut Contents) -> Written {
        let message = Message::read(body)?;
        if !self.channels.contains_key(&message.channel_id) {
            self.declare_again(message.channel_id, contents)?;
        }
        let Some(channel) = self.channels.get_mut(&message.channel_id) else {
            return Err(Unwritten::LeftOut(format!(
                "messages of channel {}, which is not declared",
                message.channel_id
            )));
        };
        self.bytes += body.len() as u64 + 9;
        let chunk = self.bytes / CHUNK_BYTES;
        if channel.chunk != chunk {
            channel.chunk = chunk;
            self.budget.spend(PLACE_BYTES)?;
        }
        let header = MessageHeader {
            channel_id: channel.written,
            sequence: message.sequence,
            log_time: message.log_time_ns,
            publish_time: message.publish_time_ns,
        };
        self.writer.write_to_known_channel(&header, message.data)?;
        contents.message(message.channel_id, message.data);
        Ok(())
    }

    pub(super) fn metadata(&mut self, body: &[u8]) -> Written {
        let metadata = Metadata::read(body)?;
        self.budget
            .spend((metadata.name.len() + INDEX_BYTES) as u64)?;
        self.writer.write_metadata(&mcap::records::Metadata {
            name: metadata.name.to_owned(),
            metadata: metadata.entries.to_map(),
        })?;
        Ok(())
    }

    pub(super) fn attachment(&mut self, body: &[u8]) -> Written {
        let attachment = Attachment::read(body)?;
        let text = attachment.name.len() + attachment.media_type.len();
        self.budget.spend((2 * text + INDEX_BYTES) as u64)?;
        self.writer.attach(&mcap::Attachment {
            log_time: attachment.log_time_ns,
            create_time: attachment.create_time_ns,
            name: attachment.name.to_owned(),
            media_type: attachment.media_type.to_owned(),
            data: Cow::Borrowed(attachment.data),
        })?;
        Ok(())
    }

    pub(super) fn private(&mut self, opcode: u8, body: &[u8], in_chunk: bool) -> Written {
        let options = if in_chunk {
            IncludeInChunks.into()
        } else {
            Default::default()
        };
        self.budget.spend(INDEX_BYTES as u64)?;
        self.writer.write_private_record(opcode, body, options)?;
        Ok(())
    }

    fn pay(&mut self, body: &[u8]) -> Result<(), Exhausted> {
        let cost = DECLARATION_COPIES.saturating_mul(body.len()) + DECLARATION_BYTES;
        self.budget.spend(cost as u64)
    }

    /// Says in the new file what happened to the old.
    pub(super) fn note(&mut self, recovery: &Recovery) -> Result<(), RecordError> {
        let left_out: u64 = recovery.left_out.iter().map(|one| one.count).sum();
        let entries = [
            ("format", "1".to_owned()),
            ("library", self.library.clone()),
            ("messages", recovery.messages.to_string()),
            ("torn_messages", recovery.torn_messages.to_string()),
            ("dropped_bytes", recovery.dropped_bytes.to_string()),
            ("left_out", left_out.to_string()),
            ("text", recovery.to_string()),
        ];
        self.writer.write_metadata(&mcap::records::Metadata {
            name: topic::RECOVERED.to_owned(),
            metadata: entries.map(|(name, text)| (name.to_owned(), text)).into(),
        })?;
        Ok(())
    }

    pub(super) fn finish(self) -> Result<(), RecordError> {
        until_failure::finish(self.writer)?;
        Ok(())
    }
}
