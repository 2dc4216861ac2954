use crate::IngestError;
use crate::mat::cursor::{ByteOrder, Cursor};
use crate::mat::numbers::{NumberKind, Numbers};
use flate2::{Decompress, FlushDecompress, Status};

/// MATLAB itself stores no level 5 variable larger than this.
const LARGEST_VARIABLE_BYTES: usize = 1 << 31;

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
    fn from_number(number: u32) -> Self {
        match number {
            1 => Self::Number(NumberKind::I8),
            2 => Self::Number(NumberKind::U8),
            3 => Self::Number(NumberKind::I16),
            4 => Self::Number(NumberKind::U16),
            5 => Self::Number(NumberKind::I32),
            6 => Self::Number(NumberKind::U32),
            7 => Self::Number(NumberKind::F32),
            9 => Self::Number(NumberKind::F64),
            12 => Self::Number(NumberKind::I64),
            13 => Self::Number(NumberKind::U64),
            14 => Self::Array,
            15 => Self::Compressed,
            16 => Self::Utf8,
            17 => Self::Utf16,
            18 => Self::Utf32,
            other => Self::Unknown(other),
        }
    }

    /// The number in the file.
    pub(super) fn number(self) -> u32 {
        match self {
            Self::Number(NumberKind::I8) => 1,
            Self::Number(NumberKind::U8) => 2,
            Self::Number(NumberKind::I16) => 3,
            Self::Number(NumberKind::U16) => 4,
            Self::Number(NumberKind::I32) => 5,
            Self::Number(NumberKind::U32) => 6,
            Self::Number(NumberKind::F32) => 7,
            Self::Number(NumberKind::F64) => 9,
            Self::Number(NumberKind::I64) => 12,
            Self::Number(NumberKind::U64) => 13,
            Self::Array => 14,
            Self::Compressed => 15,
            Self::Utf8 => 16,
            Self::Utf16 => 17,
            Self::Utf32 => 18,
            Self::Unknown(number) => number,
        }
    }
}

/// A tagged stretch of bytes.
pub(super) struct Element<'a> {
    pub(super) kind: ElementType,
    pub(super) data: &'a [u8],
    /// Where its data start.
    pub(super) offset: usize,
}

impl<'a> Element<'a> {
    /// Reads an array or a compressed element; these carry no padding of their own.
    pub(super) fn read_top_level(cursor: &mut Cursor<'a>) -> Result<Self, IngestError> {
        let offset = cursor.offset();
        let kind = ElementType::from_number(cursor.u32("element tag")?);
        if !matches!(kind, ElementType::Array | ElementType::Compressed) {
            return Err(IngestError::ElementType {
                what: "variable",
                offset,
                expected: "14 (array) or 15 (compressed array)",
                found: kind.number(),
            });
        }
        let size = cursor.u32("element size")? as usize;
        let offset = cursor.offset();
        let data = cursor.take(size, "variable")?;
        Ok(Self { kind, data, offset })
    }

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

    /// The numbers inside.
    pub(super) fn numbers(
        &self,
        what: &'static str,
        order: ByteOrder,
    ) -> Result<Numbers, IngestError> {
        let ElementType::Number(kind) = self.kind else {
            return Err(IngestError::ElementType {
                what,
                offset: self.offset,
                expected: "a number type",
                found: self.kind.number(),
            });
        };
        if !self.data.len().is_multiple_of(kind.bytes()) {
            return Err(IngestError::ElementSize {
                what,
                offset: self.offset,
                expected: "a whole number of numbers",
                found: self.data.len(),
            });
        }
        Ok(Numbers::decode(kind, self.data, order))
    }

    /// A name: 8-bit text, ended by its length or a zero byte. Some writers mark it as UTF-8.
    pub(super) fn name(&self, what: &'static str) -> Result<String, IngestError> {
        if !matches!(
            self.kind,
            ElementType::Number(NumberKind::I8 | NumberKind::U8) | ElementType::Utf8
        ) {
            return Err(IngestError::ElementType {
                what,
                offset: self.offset,
                expected: "8-bit text",
                found: self.kind.number(),
            });
        }
        let end = self
            .data
            .iter()
            .position(|&byte| byte == 0)
            .unwrap_or(self.data.len());
        let name = &self.data[..end];
        if !name.is_ascii() {
            return Err(IngestError::NameNotAscii {
                what,
                offset: self.offset,
            });
        }
        Ok(name.iter().map(|&byte| char::from(byte)).collect())
    }
}

/// Inflates a compressed element. Memory grows with what really comes out, and never beyond the size that the first
/// inflated tag announces.
pub(super) fn inflate(deflated: &[u8], order: ByteOrder) -> Result<Vec<u8>, IngestError> {
    let mut decompress = Decompress::new(true);
    let mut inflated = Vec::new();
    let mut announced = 8;
    loop {
        if inflated.len() == inflated.capacity() {
            inflated.reserve(inflated.len().clamp(4096, 1 << 24));
        }
        let consumed = usize::try_from(decompress.total_in()).expect("no more than the input");
        let before = (consumed, inflated.len());
        let status = decompress
            .decompress_vec(&deflated[consumed..], &mut inflated, FlushDecompress::None)
            .map_err(|_| IngestError::Inflate {
                inflated: before.1,
                reason: "the compressed data or their checksum are damaged",
            })?;
        if inflated.len() >= 8 {
            let mut tag = Cursor::new(&inflated, 0, order);
            tag.u32("element tag")?;
            announced = 8 + tag.u32("element size")? as usize;
        }
        if inflated.len() > announced || announced > LARGEST_VARIABLE_BYTES {
            return Err(IngestError::Inflate {
                inflated: inflated.len(),
                reason: "more comes out than the array inside announces, or than any array may hold",
            });
        }
        let consumed = usize::try_from(decompress.total_in()).expect("no more than the input");
        let full = inflated.len() == inflated.capacity();
        match status {
            Status::StreamEnd => return Ok(inflated),
            _ if !full && before == (consumed, inflated.len()) => {
                return Err(IngestError::Inflate {
                    inflated: inflated.len(),
                    reason: "the compressed data end too early",
                });
            }
            _ => {}
        }
    }
}
