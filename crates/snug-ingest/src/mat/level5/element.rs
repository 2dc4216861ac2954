//! The tagged element of level 5: type, size and data, checked against the bytes that are there.

use crate::error::IngestError;
use crate::mat::cursor::{ByteOrder, Cursor, until_zero};
use crate::mat::numbers::{NumberKind, Numbers};
use crate::mat::stream::Stream;

/// Type and size before an element's data.
pub(super) const TAG_BYTES: usize = 8;

/// What an element holds (the format's `mi` types).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ElementType {
    Number(NumberKind),
    Array,
    Compressed,
    Utf8,
    Utf16,
    Utf32,
    Unknown(u32),
}

impl ElementType {
    /// Every type with its number in the file.
    const NUMBERED: [(u32, Self); 15] = [
        (1, Self::Number(NumberKind::I8)),
        (2, Self::Number(NumberKind::U8)),
        (3, Self::Number(NumberKind::I16)),
        (4, Self::Number(NumberKind::U16)),
        (5, Self::Number(NumberKind::I32)),
        (6, Self::Number(NumberKind::U32)),
        (7, Self::Number(NumberKind::F32)),
        (9, Self::Number(NumberKind::F64)),
        (12, Self::Number(NumberKind::I64)),
        (13, Self::Number(NumberKind::U64)),
        (14, Self::Array),
        (15, Self::Compressed),
        (16, Self::Utf8),
        (17, Self::Utf16),
        (18, Self::Utf32),
    ];

    fn from_number(number: u32) -> Self {
        let known = Self::NUMBERED
            .into_iter()
            .find(|(known, _)| *known == number);
        known.map_or(Self::Unknown(number), |(_, kind)| kind)
    }

    /// What the tag of a top-level element says: its type, and the length of its data.
    pub(super) fn of_tag(tag: [u8; TAG_BYTES], order: ByteOrder) -> (Self, usize) {
        let word = |at: usize| order.u32([tag[at], tag[at + 1], tag[at + 2], tag[at + 3]]);
        (Self::from_number(word(0)), word(4) as usize)
    }

    /// The number in the file.
    pub(super) fn number(self) -> u32 {
        if let Self::Unknown(number) = self {
            return number;
        }
        let known = Self::NUMBERED.into_iter().find(|(_, kind)| *kind == self);
        known.map_or(0, |(number, _)| number)
    }
}

/// Reads the tag of an array or a compressed element, whose data must all be there; these carry no padding of their own.
pub(super) fn top_level(
    stream: &mut Stream<'_>,
    order: ByteOrder,
) -> Result<(ElementType, usize), IngestError> {
    let offset = stream.offset();
    let mut tag = [0; TAG_BYTES];
    stream.fill(&mut tag, "element tag")?;
    let (kind, size) = ElementType::of_tag(tag, order);
    if !matches!(kind, ElementType::Array | ElementType::Compressed) {
        return Err(IngestError::ElementType {
            what: "variable",
            offset,
            expected: "14 (array) or 15 (compressed array)",
            found: kind.number(),
        });
    }
    stream.expect(size, "variable")?;
    Ok((kind, size))
}

/// A tagged stretch of bytes.
pub(super) struct Element<'a> {
    pub(super) kind: ElementType,
    pub(super) data: &'a [u8],
    /// Where its data start.
    pub(super) offset: usize,
}

impl<'a> Element<'a> {
    /// Reads any element inside an array, and the padding to the next multiple of 8.
    pub(super) fn read(cursor: &mut Cursor<'a>, what: &'static str) -> Result<Self, IngestError> {
        let tag_offset = cursor.offset();
        let first = cursor.u32(what)?;
        let small_size = (first >> 16) as usize;
        if small_size == 0 {
            let size = cursor.u32(what)? as usize;
            let offset = cursor.offset();
            let data = cursor.take(size, what)?;
            cursor.skip_at_most(size.next_multiple_of(8) - size);
            return Ok(Self {
                kind: ElementType::from_number(first),
                data,
                offset,
            });
        }
        if small_size > 4 {
            return Err(IngestError::ElementSize {
                what,
                offset: tag_offset,
                expected: "at most 4 bytes in a small element",
                found: small_size,
            });
        }
        let offset = cursor.offset();
        let data = cursor.take(4, what)?;
        Ok(Self {
            kind: ElementType::from_number(first & 0xFFFF),
            data: &data[..small_size],
            offset,
        })
    }

    /// That its type cannot stand in its place.
    pub(super) fn of_wrong_type(&self, what: &'static str, expected: &'static str) -> IngestError {
        IngestError::ElementType {
            what,
            offset: self.offset,
            expected,
            found: self.kind.number(),
        }
    }

    /// That its size cannot be right.
    pub(super) fn of_wrong_size(&self, what: &'static str, expected: &'static str) -> IngestError {
        IngestError::ElementSize {
            what,
            offset: self.offset,
            expected,
            found: self.data.len(),
        }
    }

    /// The kind of the numbers inside, and how many there are.
    pub(super) fn number_kind(
        &self,
        what: &'static str,
    ) -> Result<(NumberKind, usize), IngestError> {
        let ElementType::Number(kind) = self.kind else {
            return Err(self.of_wrong_type(what, "a number type"));
        };
        if !self.data.len().is_multiple_of(kind.bytes()) {
            return Err(self.of_wrong_size(what, "a whole number of numbers"));
        }
        Ok((kind, self.data.len() / kind.bytes()))
    }

    /// The numbers inside, taken from the budget.
    pub(super) fn numbers(
        &self,
        what: &'static str,
        within: &Cursor<'_>,
    ) -> Result<Numbers, IngestError> {
        let (kind, _) = self.number_kind(what)?;
        within.budget.spend(what, self.data.len() as u64)?;
        Ok(Numbers::decode(kind, self.data, within.order))
    }

    /// The numbers inside as doubles, taken from the budget.
    pub(super) fn doubles(
        &self,
        what: &'static str,
        within: &Cursor<'_>,
    ) -> Result<Vec<f64>, IngestError> {
        let numbers = self.numbers(what, within)?;
        within.budget.spend_on::<f64>(what, numbers.len())?;
        within.budget.give_back(self.data.len() as u64);
        Ok(numbers.into_f64())
    }

    /// A name: 8-bit text, ended by its length or a zero byte. Some writers mark it as UTF-8.
    pub(super) fn name(&self, what: &'static str) -> Result<String, IngestError> {
        if !matches!(
            self.kind,
            ElementType::Number(NumberKind::I8 | NumberKind::U8) | ElementType::Utf8
        ) {
            return Err(self.of_wrong_type(what, "8-bit text"));
        }
        let name = until_zero(self.data);
        if !name.is_ascii() {
            return Err(IngestError::NameNotAscii {
                what,
                offset: self.offset,
            });
        }
        Ok(name.iter().map(|&byte| char::from(byte)).collect())
    }
}
