//! Level 4: a flat row of matrices, each behind a header of five numbers and a name.
//!
//! Source: MathWorks, *MAT-File Format*, chapter "Level 4 MAT-Files".

use super::cursor::{ByteOrder, Cursor};
use super::numbers::NumberKind;
use super::{Content, Numbers, Sparse, Value, Variable};
use crate::IngestError;

/// The header's first number is below this, in the file's own byte order.
const LARGEST_TYPE_CODE: u32 = 5000;

/// What the matrix is: the ones digit of the type code.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Full,
    Text,
    Sparse,
}

struct Header {
    number_kind: NumberKind,
    kind: Kind,
    rows: usize,
    columns: usize,
    complex: bool,
    name: String,
}

/// All variables of a level 4 file.
pub(super) fn variables(bytes: &[u8]) -> Result<Vec<Variable>, IngestError> {
    let mut cursor = Cursor::new(bytes, 0, ByteOrder::Little);
    if cursor.clone().u32("level 4 header")? >= LARGEST_TYPE_CODE {
        cursor.order = ByteOrder::Big;
    }
    let mut variables = Vec::new();
    while cursor.remaining() > 0 {
        let header = header(&mut cursor)?;
        let value = value(&mut cursor, &header)?;
        variables.push(Variable {
            name: header.name,
            global: false,
            value,
        });
    }
    Ok(variables)
}

fn header(cursor: &mut Cursor<'_>) -> Result<Header, IngestError> {
    let offset = cursor.offset();
    let code = cursor.u32("level 4 type code")?;
    let rows = dimension(cursor)?;
    let columns = dimension(cursor)?;
    let complex = cursor.u32("level 4 complex flag")?;
    let name_bytes = dimension(cursor)?;
    let bad_code = || IngestError::Level4TypeCode { offset, code };
    // Thousands 0 and 1 are IEEE numbers; 2 to 4 are VAX and Cray numbers, which nobody writes any more.
    if code / 1000 > 1 || (code / 100) % 10 != 0 || complex > 1 {
        return Err(bad_code());
    }
    let number_kind = match (code / 10) % 10 {
        0 => NumberKind::F64,
        1 => NumberKind::F32,
        2 => NumberKind::I32,
        3 => NumberKind::I16,
        4 => NumberKind::U16,
        5 => NumberKind::U8,
        _ => return Err(bad_code()),
    };
    let kind = match code % 10 {
        0 => Kind::Full,
        1 => Kind::Text,
        2 => Kind::Sparse,
        _ => return Err(bad_code()),
    };
    if name_bytes == 0 {
        return Err(IngestError::ElementSize {
            what: "level 4 variable name",
            offset: cursor.offset(),
            expected: "at least one",
            found: 0,
        });
    }
    let name = cursor.take(name_bytes, "level 4 variable name")?;
    let end = name
        .iter()
        .position(|&byte| byte == 0)
        .unwrap_or(name.len());
    Ok(Header {
        number_kind,
        kind,
        rows,
        columns,
        complex: complex == 1,
        name: name[..end].iter().map(|&byte| char::from(byte)).collect(),
    })
}

fn dimension(cursor: &mut Cursor<'_>) -> Result<usize, IngestError> {
    let offset = cursor.offset();
    let number = cursor.u32("level 4 dimension")?.cast_signed();
    usize::try_from(number).map_err(|_| IngestError::NegativeDimension { offset, number })
}

fn value(cursor: &mut Cursor<'_>, header: &Header) -> Result<Value, IngestError> {
    let real = numbers(cursor, header)?;
    // A complex sparse matrix has a column more, not a second block.
    let imaginary = (header.complex && header.kind != Kind::Sparse)
        .then(|| numbers(cursor, header))
        .transpose()?;
    let dims = vec![header.rows, header.columns];
    match header.kind {
        Kind::Full => Ok(Value {
            dims,
            content: Content::Numeric { real, imaginary },
        }),
        Kind::Text => {
            let characters = real
                .to_f64()
                .iter()
                .map(|&code| char::from_u32(code as u32).unwrap_or(char::REPLACEMENT_CHARACTER))
                .collect();
            Ok(Value {
                dims,
                content: Content::Text(characters),
            })
        }
        Kind::Sparse => sparse(&real.to_f64(), header).ok_or(IngestError::SparseParts {
            offset: cursor.offset(),
        }),
    }
}

fn numbers(cursor: &mut Cursor<'_>, header: &Header) -> Result<Numbers, IngestError> {
    let bytes = header
        .rows
        .checked_mul(header.columns)
        .and_then(|count| count.checked_mul(header.number_kind.bytes()))
        .ok_or(IngestError::TooManyElements {
            offset: cursor.offset(),
        })?;
    let bytes = cursor.take(bytes, "level 4 matrix")?;
    Ok(Numbers::decode(header.number_kind, bytes, cursor.order))
}

/// A sparse matrix is stored as full triplets (row, column, value), 1-based; the last triplet is the shape.
fn sparse(table: &[f64], header: &Header) -> Option<Value> {
    let (entries, columns) = (header.rows.checked_sub(1)?, header.columns);
    if !(3..=4).contains(&columns) {
        return None;
    }
    let cell = |entry: usize, column: usize| table[column * header.rows + entry];
    let natural = |number: f64| {
        (0.0..=f64::from(u32::MAX))
            .contains(&number)
            .then_some(number as usize)
    };
    let dims = vec![natural(cell(entries, 0))?, natural(cell(entries, 1))?];
    let mut order = Vec::with_capacity(entries);
    for entry in 0..entries {
        let row = natural(cell(entry, 0) - 1.0).filter(|&row| row < dims[0])?;
        let column = natural(cell(entry, 1) - 1.0).filter(|&column| column < dims[1])?;
        order.push((column, row, entry));
    }
    order.sort_unstable();
    let part = |column: usize| {
        order
            .iter()
            .map(|&(_, _, entry)| cell(entry, column))
            .collect()
    };
    Some(Value {
        dims,
        content: Content::Sparse(Sparse {
            rows: order.iter().map(|&(_, row, _)| row).collect(),
            columns: order.iter().map(|&(column, _, _)| column).collect(),
            real: part(2),
            imaginary: (columns == 4).then(|| part(3)),
            logical: false,
        }),
    })
}
