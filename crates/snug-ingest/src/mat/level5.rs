//! Level 5: a header of 128 bytes, then tagged elements, compressed or not, that nest.
//!
//! Source: MathWorks, *MAT-File Format*, chapter "Level 5 MAT-Files"; opaque objects and function handles are not
//! described there and are recognised only.

mod array;
mod element;
mod text;

use super::Variable;
use super::cursor::{ByteOrder, Cursor};
use crate::IngestError;
use element::{Element, ElementType};

/// Length of the header.
pub(super) const HEADER_BYTES: usize = 128;

/// All variables of a level 5 file.
pub(super) fn variables(bytes: &[u8]) -> Result<Vec<Variable>, IngestError> {
    let order = byte_order(bytes)?;
    let mut cursor = Cursor::new(&bytes[HEADER_BYTES..], HEADER_BYTES, order);
    let mut variables = Vec::new();
    while cursor.remaining() > 0 {
        let offset = cursor.offset();
        let element = Element::read_top_level(&mut cursor)?;
        let variable = match element.kind {
            ElementType::Compressed => {
                compressed(&element, order).map_err(|error| IngestError::InCompressed {
                    offset,
                    source: Box::new(error),
                })?
            }
            _ => array::variable(&element, order)?,
        };
        variables.extend(variable);
    }
    Ok(variables)
}

fn byte_order(bytes: &[u8]) -> Result<ByteOrder, IngestError> {
    let tail: [u8; 4] = bytes
        .get(124..HEADER_BYTES)
        .and_then(|tail| tail.try_into().ok())
        .ok_or(IngestError::Truncated {
            what: "level 5 header",
            offset: 0,
            needed: HEADER_BYTES,
            available: bytes.len(),
        })?;
    let (order, version) = match &tail[2..] {
        b"IM" => (ByteOrder::Little, u16::from_le_bytes([tail[0], tail[1]])),
        b"MI" => (ByteOrder::Big, u16::from_be_bytes([tail[0], tail[1]])),
        _ => {
            return Err(IngestError::NotMat {
                bytes: bytes.len(),
                first_bytes: bytes[..4].to_vec(),
            });
        }
    };
    if version >> 8 != 1 {
        return Err(IngestError::MatVersion { version });
    }
    Ok(order)
}

/// A compressed element holds exactly one array.
fn compressed(element: &Element<'_>, order: ByteOrder) -> Result<Option<Variable>, IngestError> {
    let inflated = element::inflate(element.data, order)?;
    let mut cursor = Cursor::new(&inflated, 0, order);
    let inner = Element::read_top_level(&mut cursor)?;
    if inner.kind == ElementType::Compressed {
        return Err(IngestError::ElementType {
            what: "array in a compressed element",
            offset: 0,
            expected: "14 (array)",
            found: ElementType::Compressed.number(),
        });
    }
    array::variable(&inner, order)
}

#[cfg(test)]
mod tests;
