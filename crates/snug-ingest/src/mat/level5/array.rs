//! An array: flags, shape, name, and what its class calls for.

use super::element::{Element, ElementType};
use super::{structure, text};
use crate::IngestError;
use crate::mat::cursor::Cursor;
use crate::mat::numbers::{NumberKind, Numbers};
use crate::mat::{Content, MAXIMUM_DEPTH, Sparse, Unsupported, Value, Variable};
use crate::memory::{ALLOCATION_BYTES, Budget};

/// No program writes more dimensions; MATLAB itself has no limit.
const MOST_DIMENSIONS: usize = 128;

/// The format's class numbers (`mx` classes).
mod class {
    pub(super) const CELL: u32 = 1;
    pub(super) const STRUCT: u32 = 2;
    pub(super) const OBJECT: u32 = 3;
    pub(super) const CHAR: u32 = 4;
    pub(super) const SPARSE: u32 = 5;
    /// Of [`NumberKind::CLASSES`](super::NumberKind::CLASSES).
    pub(super) const FIRST_NUMERIC: u32 = 6;
    pub(super) const FUNCTION: u32 = 16;
    pub(super) const OPAQUE: u32 = 17;
}

/// Bits of the array flags.
mod flag {
    pub(super) const LOGICAL: u32 = 0x200;
    pub(super) const GLOBAL: u32 = 0x400;
    pub(super) const COMPLEX: u32 = 0x800;
}

/// What stands at the start of every array.
pub(super) struct Header {
    flags: u32,
    dims: Vec<usize>,
    count: usize,
    name: String,
}

impl Header {
    fn class(&self) -> u32 {
        self.flags & 0xFF
    }

    fn has(&self, flag: u32) -> bool {
        self.flags & flag != 0
    }
}

/// The name of the array whose data start with what `cursor` holds, which need not be all.
pub(super) fn name(cursor: &mut Cursor<'_>) -> Result<String, IngestError> {
    if flags(cursor)? & 0xFF != class::OPAQUE {
        Element::read(cursor, "dimensions")?;
    }
    Element::read(cursor, "array name")?.name("array name")
}

/// A top-level array, of whose data `cursor` stands at the start.
pub(super) fn variable(cursor: &mut Cursor<'_>) -> Result<Variable, IngestError> {
    let (header, value) = array(cursor, 0)?;
    Ok(Variable {
        global: header.has(flag::GLOBAL),
        name: header.name,
        value,
    })
}

/// The array whose data are what `cursor` holds.
pub(super) fn array(cursor: &mut Cursor<'_>, depth: usize) -> Result<(Header, Value), IngestError> {
    if depth > MAXIMUM_DEPTH {
        return Err(IngestError::NestedTooDeep {
            offset: cursor.offset(),
            limit: MAXIMUM_DEPTH,
        });
    }
    let flags = flags(cursor)?;
    if flags & 0xFF == class::OPAQUE {
        return opaque(cursor, flags);
    }
    let (dims, count) = dimensions(cursor)?;
    let name = Element::read(cursor, "array name")?.name("array name")?;
    let header = Header {
        flags,
        dims,
        count,
        name,
    };
    let content = content(cursor, &header, depth)?;
    let value = Value {
        dims: header.dims.clone(),
        content,
    };
    Ok((header, value))
}

fn flags(cursor: &mut Cursor<'_>) -> Result<u32, IngestError> {
    let element = Element::read(cursor, "array flags")?;
    let ElementType::Number(NumberKind::U32) = element.kind else {
        return Err(element.of_wrong_type("array flags", "6 (uint32)"));
    };
    cursor
        .within(element.data, element.offset)
        .u32("array flags")
}

fn dimensions(cursor: &mut Cursor<'_>) -> Result<(Vec<usize>, usize), IngestError> {
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

/// Opaque objects have names in the place of dimensions: the variable's, the type system's, the class's.
fn opaque(cursor: &mut Cursor<'_>, flags: u32) -> Result<(Header, Value), IngestError> {
    let name = Element::read(cursor, "array name")?.name("array name")?;
    Element::read(cursor, "type system")?.name("type system")?;
    let class_name = Element::read(cursor, "class name")?.name("class name")?;
    let value = Value {
        dims: Vec::new(),
        content: Content::Unsupported(Unsupported::Opaque { class_name }),
    };
    let header = Header {
        flags,
        dims: Vec::new(),
        count: 0,
        name,
    };
    Ok((header, value))
}

fn content(cursor: &mut Cursor<'_>, header: &Header, depth: usize) -> Result<Content, IngestError> {
    match header.class() {
        class::CELL => structure::cell(cursor, header.count, depth),
        class::STRUCT => structure::structure(cursor, header.count, None, depth),
        class::OBJECT => {
            let class_name = Element::read(cursor, "class name")?.name("class name")?;
            structure::structure(cursor, header.count, Some(class_name), depth)
        }
        class::CHAR => {
            let element = Element::read(cursor, "characters")?;
            text::characters(&element, header.count, cursor).map(Content::Text)
        }
        class::SPARSE => sparse(cursor, header),
        class::FUNCTION => Ok(Content::Unsupported(Unsupported::FunctionHandle)),
        number => match number_kind(number) {
            Some(kind) => numeric(cursor, header, kind),
            None => Ok(Content::Unsupported(Unsupported::UnknownClass { number })),
        },
    }
}

fn number_kind(class: u32) -> Option<NumberKind> {
    let place = class.checked_sub(class::FIRST_NUMERIC)?;
    let (kind, _) = NumberKind::CLASSES.get(place as usize)?;
    Some(*kind)
}

fn numeric(
    cursor: &mut Cursor<'_>,
    header: &Header,
    kind: NumberKind,
) -> Result<Content, IngestError> {
    let mut part = |what| -> Result<Numbers, IngestError> {
        let element = Element::read(cursor, what)?;
        let (_, found) = element.number_kind(what)?;
        if found != header.count {
            return Err(IngestError::ValueCount {
                what,
                offset: element.offset,
                expected: header.count,
                found,
            });
        }
        element.numbers(what, cursor)
    };
    let real = part("real part")?;
    let imaginary = (header.has(flag::COMPLEX) && !header.has(flag::LOGICAL))
        .then(|| part("imaginary part"))
        .transpose()?;
    let budget = cursor.budget;
    if header.has(flag::LOGICAL) {
        budget.spend_on::<bool>("truth values", real.len())?;
        budget.give_back(real.bytes());
        return Ok(Content::Logical(real.to_logical()));
    }
    Ok(Content::Numeric {
        real: as_class(real, kind, budget)?,
        imaginary: imaginary
            .map(|imaginary| as_class(imaginary, kind, budget))
            .transpose()?,
    })
}

/// Numbers are stored in the narrowest kind that holds them, whatever their class.
fn as_class(stored: Numbers, kind: NumberKind, budget: &Budget) -> Result<Numbers, IngestError> {
    if stored.kind() == kind {
        return Ok(stored);
    }
    let (bytes, count) = (stored.bytes(), stored.len());
    budget.spend(
        "numbers",
        (count as u64).saturating_mul(kind.bytes() as u64),
    )?;
    budget.give_back(bytes);
    Ok(stored.into_kind(kind))
}

fn sparse(cursor: &mut Cursor<'_>, header: &Header) -> Result<Content, IngestError> {
    let offset = cursor.offset();
    let mut part = |what| Element::read(cursor, what)?.doubles(what, cursor);
    let rows = part("row indices")?;
    let starts = part("column starts")?;
    let logical = header.has(flag::LOGICAL);
    let count = starts.last().map_or(0, |&count| count as usize);
    let mut part = |what| -> Result<Vec<f64>, IngestError> {
        let element = Element::read(cursor, what)?;
        // MATLAB marks truth values as doubles and stores one byte of each.
        if logical && element.data.len() == count {
            cursor.budget.spend_on::<f64>(what, count)?;
            return Ok(element.data.iter().map(|&byte| f64::from(byte)).collect());
        }
        element.doubles(what, cursor)
    };
    let real = part("real part")?;
    let imaginary = header
        .has(flag::COMPLEX)
        .then(|| part("imaginary part"))
        .transpose()?;
    // Places take a row and a column each; their stored form goes.
    cursor.budget.spend_on::<[usize; 2]>("places", rows.len())?;
    let stored = rows.len() + starts.len();
    let sparse = Sparse::from_columns(&header.dims, &rows, &starts, real, imaginary, logical);
    cursor.budget.give_back(8 * stored as u64);
    sparse
        .map(Content::Sparse)
        .ok_or(IngestError::SparseParts { offset })
}
