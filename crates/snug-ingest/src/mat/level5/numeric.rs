//! Arrays of numbers, dense and sparse.

use super::element::Element;
use super::header::{Header, class, flag};
use crate::error::IngestError;
use crate::mat::cursor::Cursor;
use crate::mat::numbers::{NumberKind, Numbers};
use crate::mat::{Content, Sparse};
use crate::memory::Budget;

/// The kind of a numeric class.
pub(super) fn number_kind(class: u32) -> Option<NumberKind> {
    let place = class.checked_sub(class::FIRST_NUMERIC)?;
    let (kind, _) = NumberKind::CLASSES.get(place as usize)?;
    Some(*kind)
}

/// A dense array of one kind.
pub(super) fn numeric(
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

/// A sparse array.
pub(super) fn sparse(cursor: &mut Cursor<'_>, header: &Header) -> Result<Content, IngestError> {
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
