//! Character arrays: which of the format's number types hold text, and in which encoding.

use super::element::{Element, ElementType};
use crate::error::IngestError;
use crate::mat::cursor::Cursor;
use crate::mat::numbers::{NumberKind, Numbers};

/// The characters of a text element of an array with `count` elements.
///
/// 8-bit numbers are Latin-1, 16-bit numbers UTF-16 units, wider ones code points; what is no character becomes U+FFFD.
///
/// # Errors
/// When the element is no text, or gives another number of characters than `count` (fewer are right where two UTF-16
/// units made one character; none are right where a writer left the data out).
pub(super) fn characters(
    element: &Element<'_>,
    count: usize,
    within: &Cursor<'_>,
) -> Result<Vec<char>, IngestError> {
    let order = within.order;
    // A damaged byte becomes a character of three bytes on the way, and lists grow by doubling.
    let room = (element.data.len() as u64).saturating_mul(12);
    within.budget.spend("characters", room)?;
    let mut characters: Vec<char> = match element.kind {
        ElementType::Utf8 => String::from_utf8_lossy(element.data).chars().collect(),
        ElementType::Number(NumberKind::I8 | NumberKind::U8) => {
            element.data.iter().map(|&byte| char::from(byte)).collect()
        }
        ElementType::Utf16 | ElementType::Number(NumberKind::U16 | NumberKind::I16) => {
            match Numbers::decode(NumberKind::U16, element.data, order) {
                Numbers::U16(units) => char::decode_utf16(units)
                    .map(|unit| unit.unwrap_or(char::REPLACEMENT_CHARACTER))
                    .collect(),
                _ => Vec::new(),
            }
        }
        ElementType::Utf32 | ElementType::Number(NumberKind::U32 | NumberKind::I32) => {
            match Numbers::decode(NumberKind::U32, element.data, order) {
                Numbers::U32(codes) => codes
                    .into_iter()
                    .map(|code| char::from_u32(code).unwrap_or(char::REPLACEMENT_CHARACTER))
                    .collect(),
                _ => Vec::new(),
            }
        }
        _ => return Err(element.of_wrong_type("characters", "a text type")),
    };
    characters.shrink_to_fit();
    within.budget.give_back(room);
    within
        .budget
        .spend_on::<char>("characters", characters.len())?;
    let units: usize = characters
        .iter()
        .map(|character| character.len_utf16())
        .sum();
    if characters.len() == count || units == count || characters.is_empty() {
        return Ok(characters);
    }
    Err(IngestError::ValueCount {
        what: "characters",
        offset: element.offset,
        expected: count,
        found: characters.len(),
    })
}
