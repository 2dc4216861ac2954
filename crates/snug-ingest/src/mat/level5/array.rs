use super::element::{Element, ElementType};
use super::text;
use crate::IngestError;
use crate::mat::cursor::{ByteOrder, Cursor};
use crate::mat::numbers::{NumberKind, Numbers};
use crate::mat::{Content, Field, MAXIMUM_DEPTH, Sparse, Unsupported, Value, Variable};

/// The format's class numbers (`mx` classes).
mod class {
    pub(super) const CELL: u32 = 1;
    pub(super) const STRUCT: u32 = 2;
    pub(super) const OBJECT: u32 = 3;
    pub(super) const CHAR: u32 = 4;
    pub(super) const SPARSE: u32 = 5;
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
struct Header {
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

/// A top-level array; `None` for the nameless workspace that MATLAB adds behind function handles and objects.
pub(super) fn variable(
    element: &Element<'_>,
    order: ByteOrder,
) -> Result<Option<Variable>, IngestError> {
    let (header, value) = array(element, order, 0)?;
    let workspace = header.name.is_empty() && value.class_name() == "uint8";
    Ok((!workspace).then(|| Variable {
        global: header.has(flag::GLOBAL),
        name: header.name,
        value,
    }))
}

fn array(
    element: &Element<'_>,
    order: ByteOrder,
    depth: usize,
) -> Result<(Header, Value), IngestError> {
    if depth > MAXIMUM_DEPTH {
        return Err(IngestError::NestedTooDeep {
            offset: element.offset,
            limit: MAXIMUM_DEPTH,
        });
    }
    let mut cursor = Cursor::new(element.data, element.offset, order);
    let flags = flags(&mut cursor)?;
    if flags & 0xFF == class::OPAQUE {
        return opaque(&mut cursor, flags);
    }
    let (dims, count) = dimensions(&mut cursor)?;
    let name = Element::read(&mut cursor, "array name")?.name("array name")?;
    let header = Header {
        flags,
        dims,
        count,
        name,
    };
    let content = content(&mut cursor, &header, depth)?;
    let value = Value {
        dims: header.dims.clone(),
        content,
    };
    Ok((header, value))
}

fn flags(cursor: &mut Cursor<'_>) -> Result<u32, IngestError> {
    let element = Element::read(cursor, "array flags")?;
    let ElementType::Number(NumberKind::U32) = element.kind else {
        return Err(IngestError::ElementType {
            what: "array flags",
            offset: element.offset,
            expected: "6 (uint32)",
            found: element.kind.number(),
        });
    };
    Cursor::new(element.data, element.offset, cursor.order).u32("array flags")
}

fn dimensions(cursor: &mut Cursor<'_>) -> Result<(Vec<usize>, usize), IngestError> {
    let element = Element::read(cursor, "dimensions")?;
    let numbers = element.numbers("dimensions", cursor.order)?;
    // Some writers mark dimensions as unsigned, which does no harm as long as they fit the signed type.
    if !matches!(numbers, Numbers::I32(_) | Numbers::U32(_)) {
        return Err(IngestError::ElementType {
            what: "dimensions",
            offset: element.offset,
            expected: "5 (int32)",
            found: element.kind.number(),
        });
    }
    let mut dims = Vec::with_capacity(numbers.len());
    if let Numbers::I32(numbers) = numbers.into_kind(NumberKind::I32) {
        for number in numbers {
            dims.push(
                usize::try_from(number).map_err(|_| IngestError::NegativeDimension {
                    offset: element.offset,
                    number,
                })?,
            );
        }
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
        class::CELL => Ok(Content::Cell(arrays(cursor, header.count, depth)?)),
        class::STRUCT => structure(cursor, header, None, depth),
        class::OBJECT => {
            let class_name = Element::read(cursor, "class name")?.name("class name")?;
            structure(cursor, header, Some(class_name), depth)
        }
        class::CHAR => {
            let element = Element::read(cursor, "characters")?;
            text::characters(&element, header.count, cursor.order).map(Content::Text)
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
    Some(match class {
        6 => NumberKind::F64,
        7 => NumberKind::F32,
        8 => NumberKind::I8,
        9 => NumberKind::U8,
        10 => NumberKind::I16,
        11 => NumberKind::U16,
        12 => NumberKind::I32,
        13 => NumberKind::U32,
        14 => NumberKind::I64,
        15 => NumberKind::U64,
        _ => return None,
    })
}

fn numeric(
    cursor: &mut Cursor<'_>,
    header: &Header,
    kind: NumberKind,
) -> Result<Content, IngestError> {
    let mut part = |what| -> Result<Numbers, IngestError> {
        let element = Element::read(cursor, what)?;
        let numbers = element.numbers(what, cursor.order)?;
        if numbers.len() != header.count {
            return Err(IngestError::ValueCount {
                what,
                offset: element.offset,
                expected: header.count,
                found: numbers.len(),
            });
        }
        Ok(numbers.into_kind(kind))
    };
    let real = part("real part")?;
    if header.has(flag::LOGICAL) {
        return Ok(Content::Logical(real.to_logical()));
    }
    let imaginary = header
        .has(flag::COMPLEX)
        .then(|| part("imaginary part"))
        .transpose()?;
    Ok(Content::Numeric { real, imaginary })
}

fn sparse(cursor: &mut Cursor<'_>, header: &Header) -> Result<Content, IngestError> {
    let offset = cursor.offset();
    let mut part = |what| -> Result<Vec<f64>, IngestError> {
        let element = Element::read(cursor, what)?;
        Ok(element.numbers(what, cursor.order)?.to_f64())
    };
    let rows = part("row indices")?;
    let starts = part("column starts")?;
    let real = part("real part")?;
    let imaginary = header
        .has(flag::COMPLEX)
        .then(|| part("imaginary part"))
        .transpose()?;
    let logical = header.has(flag::LOGICAL);
    Sparse::from_columns(&header.dims, &rows, &starts, real, imaginary, logical)
        .map(Content::Sparse)
        .ok_or(IngestError::SparseParts { offset })
}

fn structure(
    cursor: &mut Cursor<'_>,
    header: &Header,
    class_name: Option<String>,
    depth: usize,
) -> Result<Content, IngestError> {
    let element = Element::read(cursor, "field name length")?;
    let lengths = element.numbers("field name length", cursor.order)?.to_f64();
    let length = match lengths.as_slice() {
        // Zero is right where there is no field.
        &[length] if length >= 0.0 => (length as usize).max(1),
        _ => {
            return Err(IngestError::ElementSize {
                what: "field name length",
                offset: element.offset,
                expected: "one number, not negative",
                found: element.data.len(),
            });
        }
    };
    let names = Element::read(cursor, "field names")?;
    let mut fields: Vec<Field> = names
        .data
        .chunks_exact(length)
        .map(|name| {
            let end = name.iter().position(|&byte| byte == 0).unwrap_or(length);
            Field {
                name: String::from_utf8_lossy(&name[..end]).into_owned(),
                values: Vec::new(),
            }
        })
        .collect();
    let total = header
        .count
        .checked_mul(fields.len())
        .ok_or(IngestError::TooManyElements {
            offset: cursor.offset(),
        })?;
    let field_count = fields.len();
    for (index, value) in arrays(cursor, total, depth)?.into_iter().enumerate() {
        fields[index % field_count].values.push(value);
    }
    Ok(Content::Struct { class_name, fields })
}

/// The next `count` arrays of a cell or struct.
fn arrays(cursor: &mut Cursor<'_>, count: usize, depth: usize) -> Result<Vec<Value>, IngestError> {
    // Each takes at least its tag of 8 bytes, so a count that the file cannot hold is refused before memory is asked for.
    if count > cursor.remaining() / 8 {
        return Err(IngestError::Truncated {
            what: "elements of a cell or struct",
            offset: cursor.offset(),
            needed: count.saturating_mul(8),
            available: cursor.remaining(),
        });
    }
    let mut values = Vec::with_capacity(count);
    for _ in 0..count {
        let element = Element::read(cursor, "element of a cell or struct")?;
        if element.kind != ElementType::Array {
            return Err(IngestError::ElementType {
                what: "element of a cell or struct",
                offset: element.offset,
                expected: "14 (array)",
                found: element.kind.number(),
            });
        }
        values.push(if element.data.is_empty() {
            Value::empty()
        } else {
            array(&element, cursor.order, depth + 1)?.1
        });
    }
    Ok(values)
}
