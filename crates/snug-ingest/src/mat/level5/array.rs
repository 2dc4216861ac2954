//! An array: its header, and what its class calls for; arrays of arrays are cells, structs, and instances of old-style classes.

use super::element::{Element, ElementType};
use super::field_names::field_names;
use super::header::{Header, class, dimensions, flag, flags};
use super::numeric::{number_kind, numeric, sparse};
use super::text;
use crate::error::IngestError;
use crate::mat::cursor::{Cursor, check_room};
use crate::mat::{Content, Field, MAXIMUM_DEPTH, Unsupported, Value, Variable};
use crate::memory::ALLOCATION_BYTES;

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
        class::CELL => cell(cursor, header.count, depth),
        class::STRUCT => structure(cursor, header.count, None, depth),
        class::OBJECT => {
            let class_name = Element::read(cursor, "class name")?.name("class name")?;
            structure(cursor, header.count, Some(class_name), depth)
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

/// A cell of `count` elements.
fn cell(cursor: &mut Cursor<'_>, count: usize, depth: usize) -> Result<Content, IngestError> {
    check_count(cursor, count)?;
    let mut values = cursor.budget.list("cells", count)?;
    for _ in 0..count {
        values.push(value(cursor, depth)?);
    }
    Ok(Content::Cell(values))
}

/// A struct of `count` elements.
fn structure(
    cursor: &mut Cursor<'_>,
    count: usize,
    class_name: Option<String>,
    depth: usize,
) -> Result<Content, IngestError> {
    let names = field_names(cursor)?;
    let total = count
        .checked_mul(names.len())
        .ok_or(IngestError::TooManyElements {
            offset: cursor.offset(),
        })?;
    check_count(cursor, total)?;
    let mut fields = cursor.budget.list("the fields of a struct", names.len())?;
    for name in names {
        let values = cursor.budget.list("the fields of a struct", count)?;
        fields.push(Field { name, values });
    }
    if !fields.is_empty() {
        for _ in 0..count {
            for field in &mut fields {
                field.values.push(value(cursor, depth)?);
            }
        }
    }
    Ok(Content::Struct { class_name, fields })
}

/// Each element takes at least its tag of 8 bytes, so a count that the file cannot hold is refused before memory is
/// asked for.
fn check_count(cursor: &Cursor<'_>, count: usize) -> Result<(), IngestError> {
    let needed = count.saturating_mul(8);
    let what = "elements of a cell or struct";
    check_room(what, cursor.offset(), needed, cursor.remaining())
}

fn value(cursor: &mut Cursor<'_>, depth: usize) -> Result<Value, IngestError> {
    let element = Element::read(cursor, "element of a cell or struct")?;
    if element.kind != ElementType::Array {
        return Err(element.of_wrong_type("element of a cell or struct", "14 (array)"));
    }
    if element.data.is_empty() {
        let value = Value::empty();
        let shape = size_of_val(value.dims.as_slice()) as u64;
        cursor.budget.spend("cells", shape + ALLOCATION_BYTES)?;
        return Ok(value);
    }
    let mut inside = cursor.within(element.data, element.offset);
    Ok(array(&mut inside, depth + 1)?.1)
}
