//! Level 4: a flat row of matrices, each behind a header of five numbers and a name.
//!
//! Source: MathWorks, *MAT-File Format*, chapter "Level 4 MAT-Files".

use super::cursor::{ByteOrder, Cursor, until_zero};
use super::numbers::NumberKind;
use super::selection::{MatSelection, Wanted};
use super::stream::Stream;
use super::{Content, MatFormat, Numbers, Sparse, Value, Variable};
use crate::error::IngestError;
use crate::memory::Budget;

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

/// Bytes of a matrix's header before its name.
const HEADER_BYTES: usize = 20;

/// MATLAB's names end after 63 letters \[bytes\].
const LONGEST_NAME_BYTES: usize = 4096;

/// The wanted variables of a level 4 file.
pub(super) fn select(
    stream: &mut Stream<'_>,
    wanted: Wanted<'_>,
    budget: &Budget,
) -> Result<MatSelection, IngestError> {
    let mut selection = MatSelection::new(MatFormat::Level4);
    let mut order = None;
    while stream.remaining() > 0 {
        let offset = stream.offset();
        let mut start = [0; HEADER_BYTES];
        stream.fill(&mut start, "level 4 header")?;
        let order = *order.get_or_insert_with(|| byte_order(start));
        let mut cursor = Cursor::new(&start, offset, order, budget);
        let header = header(&mut cursor, stream)?;
        let bytes = header.bytes(stream.offset())?;
        if !selection.note(&header.name, wanted, budget)? {
            stream.skip(bytes, "level 4 matrix")?;
            continue;
        }
        let before = budget.mark();
        let base = stream.offset();
        let data = stream.take(bytes, "level 4 matrix", budget)?;
        let read = value(&mut Cursor::new(&data, base, order, budget), &header);
        let Header { name, .. } = header;
        let read = read.map(|value| Variable {
            name: name.clone(),
            global: false,
            value,
        });
        selection.keep_stored(name, read, budget, before, bytes as u64)?;
    }
    Ok(selection)
}

fn byte_order(start: [u8; HEADER_BYTES]) -> ByteOrder {
    match ByteOrder::Little.u32([start[0], start[1], start[2], start[3]]) {
        0..LARGEST_TYPE_CODE => ByteOrder::Little,
        _ => ByteOrder::Big,
    }
}

fn header(cursor: &mut Cursor<'_>, stream: &mut Stream<'_>) -> Result<Header, IngestError> {
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
    if !(1..=LONGEST_NAME_BYTES).contains(&name_bytes) {
        return Err(IngestError::ElementSize {
            what: "level 4 variable name",
            offset: cursor.offset(),
            expected: "1 to 4096",
            found: name_bytes,
        });
    }
    let name = stream.take(name_bytes, "level 4 variable name", cursor.budget)?;
    cursor.budget.give_back(name_bytes as u64);
    Ok(Header {
        number_kind,
        kind,
        rows,
        columns,
        complex: complex == 1,
        name: until_zero(&name)
            .iter()
            .map(|&byte| char::from(byte))
            .collect(),
    })
}

fn dimension(cursor: &mut Cursor<'_>) -> Result<usize, IngestError> {
    let offset = cursor.offset();
    let number = cursor.u32("level 4 dimension")?.cast_signed();
    usize::try_from(number).map_err(|_| IngestError::NegativeDimension { offset, number })
}

impl Header {
    /// A complex sparse matrix has a column more, not a second block.
    fn has_imaginary_block(&self) -> bool {
        self.complex && self.kind != Kind::Sparse
    }

    /// Length of one block of numbers.
    fn block_bytes(&self, offset: usize) -> Result<usize, IngestError> {
        self.rows
            .checked_mul(self.columns)
            .and_then(|count| count.checked_mul(self.number_kind.bytes()))
            .ok_or(IngestError::TooManyElements { offset })
    }

    /// Length of the data that follow the name.
    fn bytes(&self, offset: usize) -> Result<usize, IngestError> {
        let blocks = if self.has_imaginary_block() { 2 } else { 1 };
        self.block_bytes(offset)?
            .checked_mul(blocks)
            .ok_or(IngestError::TooManyElements { offset })
    }
}

fn value(cursor: &mut Cursor<'_>, header: &Header) -> Result<Value, IngestError> {
    let budget = cursor.budget;
    budget.spend_on::<[usize; 2]>("an array", 1)?;
    let real = numbers(cursor, header)?;
    let imaginary = header
        .has_imaginary_block()
        .then(|| numbers(cursor, header))
        .transpose()?;
    let dims = vec![header.rows, header.columns];
    match header.kind {
        Kind::Full => Ok(Value {
            dims,
            content: Content::Numeric { real, imaginary },
        }),
        Kind::Text => {
            budget.spend_on::<(char, f64)>("characters", real.len())?;
            let characters = real
                .into_f64()
                .into_iter()
                .map(|code| char::from_u32(code as u32).unwrap_or(char::REPLACEMENT_CHARACTER))
                .collect();
            Ok(Value {
                dims,
                content: Content::Text(characters),
            })
        }
        Kind::Sparse => {
            // The whole table as doubles, then the places, their order and the values.
            budget.spend_on::<f64>("a sparse matrix", real.len())?;
            budget.spend_on::<[usize; 8]>("a sparse matrix", header.rows)?;
            sparse(&real.into_f64(), header).ok_or(IngestError::SparseParts {
                offset: cursor.offset(),
            })
        }
    }
}

fn numbers(cursor: &mut Cursor<'_>, header: &Header) -> Result<Numbers, IngestError> {
    let bytes = header.block_bytes(cursor.offset())?;
    let bytes = cursor.take(bytes, "level 4 matrix")?;
    cursor.budget.spend("numbers", bytes.len() as u64)?;
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
