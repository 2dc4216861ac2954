//! Arrays of arrays: cells, structs, and instances of old-style classes.

use super::array;
use super::element::{Element, ElementType};
use crate::IngestError;
use crate::mat::cursor::{Cursor, check_room, until_zero};
use crate::mat::{Content, Field, Value};
use crate::memory::ALLOCATION_BYTES;
use std::collections::{HashMap, HashSet};

/// A cell of `count` elements.
pub(super) fn cell(
    cursor: &mut Cursor<'_>,
    count: usize,
    depth: usize,
) -> Result<Content, IngestError> {
    check_count(cursor, count)?;
    let mut values = cursor.budget.list("cells", count)?;
    for _ in 0..count {
        values.push(value(cursor, depth)?);
    }
    Ok(Content::Cell(values))
}

/// A struct of `count` elements.
pub(super) fn structure(
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
    Ok(array::array(&mut inside, depth + 1)?.1)
}

fn field_names(cursor: &mut Cursor<'_>) -> Result<Vec<String>, IngestError> {
    let element = Element::read(cursor, "field name length")?;
    let length = match element.number_kind("field name length")? {
        (_, 1) => element.doubles("field name length", cursor)?[0],
        _ => -1.0,
    };
    if length.is_nan() || length < 0.0 {
        return Err(element.of_wrong_size("field name length", "one number, not negative"));
    }
    // Zero is right where there is no field.
    let length = (length as usize).max(1);
    let stored = Element::read(cursor, "field names")?.data;
    let mut names = cursor.budget.list("field names", stored.len() / length)?;
    for name in stored.chunks_exact(length) {
        let name = until_zero(name);
        // A byte that is no text becomes a character of three.
        cursor
            .budget
            .spend("field names", 3 * name.len() as u64 + ALLOCATION_BYTES)?;
        names.push(String::from_utf8_lossy(name).into_owned());
    }
    // Renaming looks every name up among the others.
    let lookup = (names.len() * 2 * size_of::<(String, usize)>()) as u64 + 2 * stored.len() as u64;
    cursor.budget.spend("field names", lookup)?;
    cursor.budget.give_back(lookup);
    Ok(unique(names))
}

/// MATLAB writes files in which a struct has several fields of one name. As SciPy does, the second is called `_1_name`,
/// the third `_2_name`, …; where such a name is there already (which SciPy refuses), the next number is taken.
fn unique(mut names: Vec<String>) -> Vec<String> {
    let mut taken: HashSet<String> = names.iter().cloned().collect();
    if taken.len() == names.len() {
        return names;
    }
    let mut earlier: HashMap<String, usize> = HashMap::new();
    for name in &mut names {
        let Some(count) = earlier.get_mut(name.as_str()) else {
            earlier.insert(name.clone(), 0);
            continue;
        };
        let free = (*count + 1..)
            .map(|number| (number, format!("_{number}_{name}")))
            .find(|(_, new)| !taken.contains(new));
        if let Some((number, new)) = free {
            *count = number;
            taken.insert(new.clone());
            *name = new;
        }
    }
    names
}
