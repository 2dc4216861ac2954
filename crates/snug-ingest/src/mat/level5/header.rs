//! What stands at the start of every array: flags with its class, shape and name.

use super::element::{Element, ElementType};
use crate::error::IngestError;
use crate::mat::cursor::Cursor;
use crate::mat::numbers::NumberKind;
use crate::memory::ALLOCATION_BYTES;

/// No program writes more dimensions; MATLAB itself has no limit.
const MOST_DIMENSIONS: usize = 128;

/// The format's class numbers (`mx` classes).
pub(super) mod class {
    pub(in crate::mat::level5) const CELL: u32 = 1;
    pub(in crate::mat::level5) const STRUCT: u32 = 2;
    pub(in crate::mat::level5) const OBJECT: u32 = 3;
    pub(in crate::mat::level5) const CHAR: u32 = 4;
    pub(in crate::mat::level5) const SPARSE: u32 = 5;
    /// Of [`NumberKind::CLASSES`](super::NumberKind::CLASSES).
    pub(in crate::mat::level5) const FIRST_NUMERIC: u32 = 6;
    pub(in crate::mat::level5) const FUNCTION: u32 = 16;
    pub(in crate::mat::level5) const OPAQUE: u32 = 17;
}

/// Bits of the array flags.
pub(super) mod flag {
    pub(in crate::mat::level5) const LOGICAL: u32 = 0x200;
    pub(in crate::mat::level5) const GLOBAL: u32 = 0x400;
    pub(in crate::mat::level5) const COMPLEX: u32 = 0x800;
}

/// What stands at the start of every array.
pub(super) struct Header {
    pub(super) flags: u32,
    pub(super) dims: Vec<usize>,
    pub(super) count: usize,
    pub(super) name: String,
}

impl Header {
    pub(super) fn class(&self) -> u32 {
        self.flags & 0xFF
    }

    pub(super) fn has(&self, flag: u32) -> bool {
        self.flags & flag != 0
    }
}

/// Its class is in the lowest byte.
pub(super) fn flags(cursor: &mut Cursor<'_>) -> Result<u32, IngestError> {
    let element = Element::read(cursor, "array flags")?;
    let ElementType::Number(NumberKind::U32) = element.kind else {
        return Err(element.of_wrong_type("array flags", "6 (uint32)"));
    };
    cursor
        .within(element.data, element.offset)
        .u32("array flags")
}

/// Its lengths, and how many elements they make.
pub(super) fn dimensions(cursor: &mut Cursor<'_>) -> Result<(Vec<usize>, usize), IngestError> {
    let element = Element::read(cursor, "dimensions")?;
    let (kind, rank) = element.number_kind("dimensions")?;
    // Some writers mark dimensions as unsigned, which does no harm as long as they fit the signed type.
    if !matches!(kind, NumberKind::I32 | NumberKind::U32) {
        return Err(element.of_wrong_type("dimensions", "5 (int32)"));
    }
    if rank > MOST_DIMENSIONS {
        return Err(element.of_wrong_size("dimensions", "at most 128"));
    }
    let bytes = rank * size_of::<usize>();
    cursor
        .budget
        .spend("an array", bytes as u64 + ALLOCATION_BYTES)?;
    let mut dims = Vec::with_capacity(rank);
    for bytes in element.data.as_chunks::<4>().0 {
        let number = cursor.order.u32(*bytes).cast_signed();
        dims.push(
            usize::try_from(number).map_err(|_| IngestError::NegativeDimension {
                offset: element.offset,
                number,
            })?,
        );
    }
    let count = dims
        .iter()
        .try_fold(1_usize, |product, &length| product.checked_mul(length))
        .filter(|_| !dims.is_empty())
        .ok_or(IngestError::TooManyElements {
            offset: element.offset,
        })?;
    Ok((dims, count))
}
