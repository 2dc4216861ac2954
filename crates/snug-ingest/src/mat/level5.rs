//! Level 5: a header of 128 bytes, then tagged elements, compressed or not, that nest.
//!
//! Of every element just so much is read, and inflated, as tells the variable's name; what is not asked for is passed
//! over.
//!
//! Source: MathWorks, *MAT-File Format*, chapter "Level 5 MAT-Files"; opaque objects and function handles are not
//! described there and are recognised only.

mod array;
mod element;
mod field_names;
mod header;
mod inflater;
mod numeric;
mod text;

use super::MatFormat;
use super::cursor::{ByteOrder, Cursor};
use super::selection::{MatSelection, Wanted};
use super::stream::Stream;
use crate::error::IngestError;
use crate::memory::Budget;
use element::ElementType;
use inflater::Inflater;

/// Length of the header.
pub(super) const HEADER_BYTES: usize = 128;

/// The start of an array that is looked at for its name \[bytes\]; a shape of 32 dimensions and a name of 63 letters take
/// 250.
const NAME_WITHIN_BYTES: usize = 4096;

/// The wanted variables of a level 5 file.
pub(super) fn select(
    stream: &mut Stream<'_>,
    wanted: Wanted<'_>,
    budget: &Budget,
) -> Result<MatSelection, IngestError> {
    let mut selection = MatSelection::new(MatFormat::Level5);
    let order = byte_order(stream)?;
    let mut inflater = Inflater::new();
    while stream.remaining() > 0 {
        let offset = stream.offset();
        let (kind, size) = element::top_level(stream, order)?;
        let element = Framed {
            offset,
            size,
            order,
            budget,
        };
        if kind == ElementType::Compressed {
            element
                .compressed(stream, &mut inflater, wanted, &mut selection)
                .map_err(|error| in_compressed(offset, error))?;
        } else {
            element.plain(stream, wanted, &mut selection)?;
        }
    }
    Ok(selection)
}

fn in_compressed(offset: usize, error: IngestError) -> IngestError {
    if error.is_of_the_file() {
        return error;
    }
    IngestError::InCompressed {
        offset,
        source: Box::new(error),
    }
}

fn byte_order(stream: &mut Stream<'_>) -> Result<ByteOrder, IngestError> {
    let mut header = [0; HEADER_BYTES];
    stream.fill(&mut header, "level 5 header")?;
    let tail = &header[124..];
    let (order, version) = match &tail[2..] {
        b"IM" => (ByteOrder::Little, u16::from_le_bytes([tail[0], tail[1]])),
        b"MI" => (ByteOrder::Big, u16::from_be_bytes([tail[0], tail[1]])),
        _ => {
            return Err(IngestError::NotMat {
                bytes: stream.length(),
                first_bytes: header[..4].to_vec(),
            });
        }
    };
    if version >> 8 != 1 {
        return Err(IngestError::MatVersion { version });
    }
    Ok(order)
}

/// A top-level element behind its tag.
struct Framed<'a> {
    /// Where its tag starts.
    offset: usize,
    /// Length of its data.
    size: usize,
    order: ByteOrder,
    budget: &'a Budget,
}

impl Framed<'_> {
    fn plain(
        &self,
        stream: &mut Stream<'_>,
        wanted: Wanted<'_>,
        selection: &mut MatSelection,
    ) -> Result<(), IngestError> {
        let before = self.budget.mark();
        let base = stream.offset();
        let mut data = stream.take(self.size.min(NAME_WITHIN_BYTES), "variable", self.budget)?;
        let rest = self.size - data.len();
        let name = array::name(&mut self.cursor(&data, base))?;
        if name.is_empty() {
            // The nameless workspace that MATLAB adds behind function handles and objects.
            return stream.skip(rest, "variable");
        }
        if !selection.note(&name, wanted, self.budget)? {
            self.budget.give_back(data.len() as u64);
            return stream.skip(rest, "variable");
        }
        if rest > 0 {
            stream.extend(&mut data, rest, "variable", self.budget)?;
        }
        let read = array::variable(&mut self.cursor(&data, base));
        selection.keep_stored(name, read, self.budget, before, data.len() as u64)
    }

    /// A compressed element holds exactly one array.
    fn compressed(
        &self,
        stream: &mut Stream<'_>,
        inflater: &mut Inflater,
        wanted: Wanted<'_>,
        selection: &mut MatSelection,
    ) -> Result<(), IngestError> {
        let before = self.budget.mark();
        let mut inflating = inflater.start(stream, self.size);
        let size = inflating.array_size(self.order)?;
        inflating.at_least(size.min(NAME_WITHIN_BYTES), self.budget)?;
        let name = array::name(&mut self.cursor(inflating.data(), element::TAG_BYTES))?;
        if name.is_empty() || !selection.note(&name, wanted, self.budget)? {
            self.budget.give_back(inflating.room());
            return inflating.skip_rest();
        }
        let whole = inflating.finish(size, self.budget);
        inflating.skip_rest()?;
        let (data, room) = (inflater.data(), inflater.room());
        let read = whole.and_then(|()| array::variable(&mut self.cursor(data, element::TAG_BYTES)));
        let read = read.map_err(|error| in_compressed(self.offset, error));
        selection.keep_stored(name, read, self.budget, before, room)
    }

    fn cursor<'a>(&'a self, data: &'a [u8], base: usize) -> Cursor<'a> {
        Cursor::new(data, base, self.order, self.budget)
    }
}

#[cfg(test)]
mod tests;
