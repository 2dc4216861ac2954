//! The content of the records that are used. Every length is held against the bytes that are there.

use super::fault::Fault;
use crate::encoding::wire::{take, take_fixed16, take_fixed32, take_fixed64, take_framed};
use std::collections::BTreeMap;

/// A name and the bytes that describe the messages of a channel.
pub(crate) struct Schema<'a> {
    pub(crate) id: u16,
    pub(crate) name: &'a str,
    pub(crate) encoding: &'a str,
    pub(crate) data: &'a [u8],
}

/// A channel as the file declares it.
pub(crate) struct Channel<'a> {
    pub(crate) id: u16,
    /// 0 for none.
    pub(crate) schema_id: u16,
    pub(crate) topic: &'a str,
    pub(crate) message_encoding: &'a str,
    pub(crate) metadata: Entries<'a>,
}

/// A message with its header.
pub(crate) struct Message<'a> {
    pub(crate) channel_id: u16,
    pub(crate) sequence: u32,
    pub(crate) log_time_ns: u64,
    pub(crate) publish_time_ns: u64,
    pub(crate) data: &'a [u8],
}

/// A metadata record.
pub(crate) struct Metadata<'a> {
    pub(crate) name: &'a str,
    pub(crate) entries: Entries<'a>,
}

/// An attached file.
pub(crate) struct Attachment<'a> {
    pub(crate) log_time_ns: u64,
    pub(crate) create_time_ns: u64,
    pub(crate) name: &'a str,
    pub(crate) media_type: &'a str,
    pub(crate) data: &'a [u8],
}

/// The file's first record.
#[derive(Default)]
pub(crate) struct Header<'a> {
    pub(crate) profile: &'a str,
    pub(crate) library: &'a str,
}

/// Pairs of a name and a text, checked to be well formed.
#[derive(Clone, Copy)]
pub(crate) struct Entries<'a>(&'a [u8]);

impl<'a> Entries<'a> {
    fn take(bytes: &mut &'a [u8]) -> Option<Self> {
        let entries = take_framed(bytes)?;
        let mut rest = entries;
        while !rest.is_empty() {
            take_text(&mut rest)?;
            take_text(&mut rest)?;
        }
        Some(Self(entries))
    }

    fn iter(self) -> impl Iterator<Item = (&'a str, &'a str)> {
        let mut rest = self.0;
        std::iter::from_fn(move || Some((take_text(&mut rest)?, take_text(&mut rest)?)))
    }

    pub(crate) fn to_map(self) -> BTreeMap<String, String> {
        self.iter()
            .map(|(name, text)| (name.to_owned(), text.to_owned()))
            .collect()
    }

    /// The last entry of that name.
    pub(crate) fn get(self, name: &str) -> Option<&'a str> {
        self.iter()
            .filter(|(entry, _)| *entry == name)
            .last()
            .map(|(_, text)| text)
    }
}

fn take_text<'a>(bytes: &mut &'a [u8]) -> Option<&'a str> {
    std::str::from_utf8(take_framed(bytes)?).ok()
}

/// Reads one kind of record, or says which one is malformed.
macro_rules! read {
    ($kind:ident, $record:literal, $read:expr) => {
        impl<'a> $kind<'a> {
            /// # Errors
            /// [`Fault::Malformed`] when a length leads beyond the record or a text is not UTF-8.
            pub(crate) fn read(body: &'a [u8]) -> Result<Self, Fault> {
                let read: fn(&mut &'a [u8]) -> Option<Self> = $read;
                read(&mut { body }).ok_or(Fault::Malformed {
                    record: $record,
                    bytes: body.len(),
                })
            }
        }
    };
}

read!(Schema, "schema", |rest| Some(Self {
    id: take_fixed16(rest)?,
    name: take_text(rest)?,
    encoding: take_text(rest)?,
    data: take_framed(rest)?,
}));

read!(Channel, "channel", |rest| Some(Self {
    id: take_fixed16(rest)?,
    schema_id: take_fixed16(rest)?,
    topic: take_text(rest)?,
    message_encoding: take_text(rest)?,
    metadata: Entries::take(rest)?,
}));

read!(Message, "message", |rest| Some(Self {
    channel_id: take_fixed16(rest)?,
    sequence: take_fixed32(rest)?,
    log_time_ns: take_fixed64(rest)?,
    publish_time_ns: take_fixed64(rest)?,
    data: rest,
}));

read!(Metadata, "metadata", |rest| Some(Self {
    name: take_text(rest)?,
    entries: Entries::take(rest)?,
}));

read!(Header, "header", |rest| Some(Self {
    profile: take_text(rest)?,
    library: take_text(rest)?,
}));

impl<'a> Attachment<'a> {
    /// # Errors
    /// [`Fault::Malformed`], and [`Fault::AttachmentChecksum`] when the record is not what was written.
    pub(crate) fn read(body: &'a [u8]) -> Result<Self, Fault> {
        let parts = |rest: &mut &'a [u8]| {
            let attachment = Self {
                log_time_ns: take_fixed64(rest)?,
                create_time_ns: take_fixed64(rest)?,
                name: take_text(rest)?,
                media_type: take_text(rest)?,
                data: {
                    let length = usize::try_from(take_fixed64(rest)?).ok()?;
                    take(rest, length)?
                },
            };
            let checked = body.len() - rest.len();
            Some((attachment, checked, take_fixed32(rest)?))
        };
        let (attachment, checked, expected) = parts(&mut { body }).ok_or(Fault::Malformed {
            record: "attachment",
            bytes: body.len(),
        })?;
        let found = crc32fast::hash(&body[..checked]);
        if expected != 0 && expected != found {
            return Err(Fault::AttachmentChecksum { expected, found });
        }
        Ok(attachment)
    }
}
