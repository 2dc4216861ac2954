//! Text to records.

use super::{CsvLayout, Delimiter};
use crate::error::IngestError;
use csv::{ReaderBuilder, StringRecord, Trim};
use memchr::memchr;
use std::io::{self, Read};

/// Lines of text below the header (units, remarks) that are passed over.
const MOST_TEXT_LINES: usize = 10;

/// No logger writes a row of a hundred thousand cells \[bytes\].
const LONGEST_ROW_BYTES: usize = 1 << 20;

/// Content that fails where one row takes more than it may: an open quote makes one cell of all that follows, and a
/// line of commas takes eight times its length.
struct Metered<'a> {
    rest: &'a [u8],
    since_row: usize,
}

impl Read for Metered<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.since_row > LONGEST_ROW_BYTES {
            return Err(io::Error::other("the row is too long"));
        }
        let count = self.rest.read(buffer)?;
        self.since_row += count;
        Ok(count)
    }
}

/// The records of a file, blank and comment lines passed over.
pub(crate) struct Rows<'a> {
    reader: csv::Reader<Metered<'a>>,
    skipped: u64,
    delimiter: char,
    layout: &'a CsvLayout,
}

/// A record with its 1-based line.
pub(crate) type Row = Option<(u64, StringRecord)>;

impl<'a> Rows<'a> {
    pub(crate) fn new(content: &'a [u8], layout: &'a CsvLayout) -> Self {
        let (content, skipped) = skip_lines(content, layout.skip_lines);
        let comment = layout
            .comment
            .and_then(|comment| u8::try_from(comment).ok());
        let delimiter = match layout.delimiter {
            Delimiter::Comma => b',',
            Delimiter::Semicolon => b';',
            Delimiter::Tab => b'\t',
            Delimiter::Auto => delimiter_of(content, comment),
        };
        let reader = ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .trim(Trim::All)
            .delimiter(delimiter)
            .comment(comment)
            .from_reader(Metered {
                rest: content,
                since_row: 0,
            });
        Self {
            reader,
            skipped,
            delimiter: char::from(delimiter),
            layout,
        }
    }

    /// The next record with its line; text that is not UTF-8 (a header's `°` in an old encoding) is read as far as it is.
    pub(crate) fn next(&mut self) -> Result<Row, IngestError> {
        let mut record = csv::ByteRecord::new();
        self.reader.get_mut().since_row = 0;
        let start = self.reader.position().line();
        let more = self
            .reader
            .read_byte_record(&mut record)
            .map_err(|source| match source.kind() {
                csv::ErrorKind::Io(_) => IngestError::RowTooLong {
                    line: start + self.skipped,
                    limit: LONGEST_ROW_BYTES,
                },
                _ => IngestError::CsvSyntax {
                    line: source
                        .position()
                        .map_or(0, |place| place.line() + self.skipped),
                    source,
                },
            })?;
        let line = record.position().map_or(0, csv::Position::line) + self.skipped;
        Ok(more.then(|| (line, StringRecord::from_byte_record_lossy(record))))
    }

    /// Lines within a row's quotes that would be rows themselves.
    pub(super) fn rows_in_quotes(&self, record: &StringRecord) -> usize {
        if !record.as_slice().contains('\n') {
            return 0;
        }
        record
            .iter()
            .flat_map(|cell| cell.split('\n').skip(1))
            .filter(|line| line.contains(self.delimiter))
            .count()
    }

    /// Lines until now.
    pub(super) fn lines(&self) -> u64 {
        self.reader.position().line() - 1 + self.skipped
    }

    /// Passes over lines in which every declared column holds text.
    pub(super) fn skip_text_lines(
        &mut self,
        mut row: Row,
        columns: &[usize],
    ) -> Result<Row, IngestError> {
        for _ in 0..MOST_TEXT_LINES {
            let Some((_, record)) = &row else {
                return Ok(row);
            };
            let text = |&column: &usize| {
                record.get(column).is_some_and(|cell| {
                    !cell.is_empty() && self.layout.decimal.parse(cell).is_none()
                })
            };
            if !columns.iter().all(text) {
                return Ok(row);
            }
            row = self.next()?;
        }
        Ok(row)
    }
}

fn skip_lines(content: &[u8], count: usize) -> (&[u8], u64) {
    let mut rest = content;
    let mut skipped = 0;
    for _ in 0..count {
        match memchr(b'\n', rest) {
            Some(end) => rest = &rest[end + 1..],
            None => rest = &[],
        }
        skipped += 1;
    }
    (rest, skipped)
}

fn delimiter_of(content: &[u8], comment: Option<u8>) -> u8 {
    let line = content
        .split(|&byte| byte == b'\n')
        .find(|line| !line.trim_ascii().is_empty() && line.first().copied() != comment)
        .unwrap_or_default();
    [b';', b'\t']
        .into_iter()
        .find(|delimiter| line.contains(delimiter))
        .unwrap_or(b',')
}
