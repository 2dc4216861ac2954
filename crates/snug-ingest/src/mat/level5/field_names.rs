//! The names of a struct's fields.

use super::element::Element;
use crate::error::IngestError;
use crate::mat::cursor::{Cursor, until_zero};
use crate::memory::ALLOCATION_BYTES;
use std::collections::{HashMap, HashSet};

/// Each name once.
pub(super) fn field_names(cursor: &mut Cursor<'_>) -> Result<Vec<String>, IngestError> {
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
