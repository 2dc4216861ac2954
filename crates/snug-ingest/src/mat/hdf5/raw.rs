//! The elements of an HDF5 dataset by their HDF5 type, before MATLAB's class says what they mean.

use super::{Numbers, failed};
use crate::error::IngestError;
use crate::mat::cursor::ByteOrder;
use crate::mat::numbers::NumberKind;
use hdf5_pure::{AttrValue, Dataset, Datatype, DatatypeByteOrder, FixedPointLayout, ReferenceType};

/// The elements of a dataset by kind, in the order of the file, which is MATLAB's column-major order.
pub(super) enum Elements {
    Numbers(Numbers),
    Complex(Numbers, Numbers),
    /// Truth values of other programs: an enumeration of FALSE and TRUE.
    Logical(Vec<bool>),
    /// One string of another program.
    Text(String),
    /// References to cells' elements, to be followed.
    References,
    /// Anything else, with its type's name.
    Foreign(String),
}

pub(super) fn elements(path: &str, dataset: &Dataset) -> Result<Elements, IngestError> {
    let failed = |error| failed(path, error);
    let datatype = dataset.datatype().map_err(failed)?;
    if let Some((kind, order)) = number(&datatype) {
        let raw = dataset.read_raw().map_err(failed)?;
        return Ok(Elements::Numbers(Numbers::decode(kind, &raw, order)));
    }
    match &datatype {
        Datatype::Reference {
            ref_type: ReferenceType::Object,
            ..
        } => Ok(Elements::References),
        Datatype::Compound { size, members } => {
            let [first, second] = members.as_slice() else {
                return Ok(foreign(&datatype));
            };
            let parts = (number(&first.datatype), number(&second.datatype));
            let (Some(real), Some(imaginary)) = parts else {
                return Ok(foreign(&datatype));
            };
            let raw = dataset.read_raw().map_err(failed)?;
            let part = |(kind, order), offset: u64| {
                member(&raw, *size as usize, offset as usize, kind, order)
            };
            Ok(Elements::Complex(
                part(real, first.byte_offset),
                part(imaginary, second.byte_offset),
            ))
        }
        Datatype::Enumeration {
            base_type, members, ..
        } if members.len() == 2 => {
            let Some((kind, order)) = number(base_type) else {
                return Ok(foreign(&datatype));
            };
            let raw = dataset.read_raw().map_err(failed)?;
            Ok(Elements::Logical(
                Numbers::decode(kind, &raw, order).to_logical(),
            ))
        }
        Datatype::String { .. }
        | Datatype::VariableLength {
            is_string: true, ..
        } => {
            // Many strings may be one and the same long one, so that they cannot be had within any budget.
            let count: u64 = dataset.shape().map_err(failed)?.iter().product();
            if count != 1 {
                return Ok(Elements::Foreign("array of strings".to_owned()));
            }
            let strings = dataset.read_string().map_err(failed)?;
            match <[String; 1]>::try_from(strings) {
                Ok([text]) => Ok(Elements::Text(text)),
                Err(_) => Ok(Elements::Foreign("array of strings".to_owned())),
            }
        }
        _ => Ok(foreign(&datatype)),
    }
}

fn foreign(datatype: &Datatype) -> Elements {
    let name = match datatype {
        Datatype::Compound { .. } => "compound",
        Datatype::Opaque { .. } => "opaque",
        Datatype::VariableLength { .. } => "variable length",
        Datatype::Array { .. } => "array",
        Datatype::Enumeration { .. } => "enumeration",
        Datatype::Time { .. } => "time",
        Datatype::BitField { .. } => "bit field",
        Datatype::Reference { .. } => "region reference",
        _ => "number of an unusual layout",
    };
    Elements::Foreign(name.to_owned())
}

/// The primitive type, for plain IEEE and integer types.
fn number(datatype: &Datatype) -> Option<(NumberKind, ByteOrder)> {
    let (kind, order) = match datatype {
        Datatype::FloatingPoint {
            size, byte_order, ..
        } => match size {
            8 => (NumberKind::F64, byte_order),
            4 => (NumberKind::F32, byte_order),
            _ => return None,
        },
        Datatype::FixedPoint {
            size,
            byte_order,
            layout,
        } => (integer(*size, layout)?, byte_order),
        _ => return None,
    };
    let order = match order {
        DatatypeByteOrder::LittleEndian => ByteOrder::Little,
        DatatypeByteOrder::BigEndian => ByteOrder::Big,
        _ => return None,
    };
    Some((kind, order))
}

fn integer(size: u32, layout: &FixedPointLayout) -> Option<NumberKind> {
    Some(match (size, layout.signed) {
        (1, true) => NumberKind::I8,
        (1, false) => NumberKind::U8,
        (2, true) => NumberKind::I16,
        (2, false) => NumberKind::U16,
        (4, true) => NumberKind::I32,
        (4, false) => NumberKind::U32,
        (8, true) => NumberKind::I64,
        (8, false) => NumberKind::U64,
        _ => return None,
    })
}

fn member(raw: &[u8], size: usize, offset: usize, kind: NumberKind, order: ByteOrder) -> Numbers {
    let bytes: Vec<u8> = raw
        .chunks_exact(size.max(1))
        .filter_map(|element| element.get(offset..offset + kind.bytes()))
        .flatten()
        .copied()
        .collect();
    Numbers::decode(kind, &bytes, order)
}

/// An empty vector of a numeric class.
pub(super) fn no_numbers(class: Option<&str>) -> Numbers {
    let known = NumberKind::CLASSES
        .iter()
        .find(|(_, name)| class == Some(name));
    let kind = known.map_or(NumberKind::F64, |&(kind, _)| kind);
    Numbers::decode(kind, &[], ByteOrder::Little)
}

/// A natural number in an attribute.
pub(super) fn attribute_number(value: &AttrValue) -> Option<usize> {
    match value {
        AttrValue::U64(number) => usize::try_from(*number).ok(),
        AttrValue::I64(number) => usize::try_from(*number).ok(),
        AttrValue::U32(number) => usize::try_from(*number).ok(),
        AttrValue::I32(number) => usize::try_from(*number).ok(),
        AttrValue::U8(number) => Some(usize::from(*number)),
        AttrValue::F64(number) if *number >= 0.0 => Some(*number as usize),
        _ => None,
    }
}
