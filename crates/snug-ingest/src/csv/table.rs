use super::{Column, CsvLayout, report_gaps};
use crate::IngestError;
use crate::finding_log::FindingLog;
use csv::{ReaderBuilder, StringRecord, Trim};
use serde::{Deserialize, Serialize};

/// Lines of text below the header (units, remarks) that are passed over.
const MOST_TEXT_LINES: usize = 10;

/// What separates the columns.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Delimiter {
    /// Semicolon, tab or comma: the first of them that the first line holds.
    #[default]
    Auto,
    /// `,`
    Comma,
    /// `;`
    Semicolon,
    /// Tabulator
    Tab,
}

/// Whether the first line names the columns.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Header {
    /// It does where a column is declared by name, or where a declared column's first cell is no number.
    #[default]
    Auto,
    /// It does.
    Present,
    /// It does not.
    Absent,
}

/// The wanted columns of a file.
pub(super) struct Table {
    /// One per wanted column, NaN where a cell holds no number.
    pub(super) columns: Vec<Vec<f64>>,
    /// 1-based line of every row.
    pub(super) lines: Vec<u64>,
}

/// A column while it is read.
struct Reading {
    name: String,
    index: usize,
    values: Vec<f64>,
    gaps: usize,
    first_gap: Option<(u64, String)>,
}

/// Reads the wanted columns, each with the name of what it measures.
pub(super) fn read(
    content: &[u8],
    layout: &CsvLayout,
    wanted: &[(String, &Column)],
    log: &mut FindingLog,
) -> Result<Table, IngestError> {
    let content = content.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(content);
    let (content, skipped) = skip_lines(content, layout.skip_lines);
    let mut rows = Rows::new(content, layout, skipped);
    let mut row = rows.next()?;
    let header = has_header(layout.header, wanted, row.as_ref(), layout);
    let names: Vec<String> = match &row {
        Some((_, record)) if header => record.iter().map(unquoted).collect(),
        _ => Vec::new(),
    };
    let width = row.as_ref().map_or(0, |(_, record)| record.len());
    let mut columns = wanted
        .iter()
        .map(|(channel, column)| reading(channel, column, &names, width))
        .collect::<Result<Vec<Reading>, IngestError>>()?;
    if header {
        row = rows.next()?;
        row = rows.skip_text_lines(row, &columns)?;
    }
    let mut lines = Vec::new();
    while let Some((line, record)) = row {
        for column in &mut columns {
            column.push(record.get(column.index).unwrap_or_default(), line, layout);
        }
        lines.push(line);
        row = rows.next()?;
    }
    if lines.is_empty() {
        return Err(IngestError::NoRows {
            lines: rows.reader.position().line() - 1 + rows.skipped,
        });
    }
    for (column, (channel, _)) in columns.iter().zip(wanted) {
        if column.gaps == lines.len() {
            return Err(IngestError::UnusableChannel {
                channel: channel.clone(),
                variable: column.name.clone(),
                found: format!("without any number in {} rows", lines.len()),
            });
        }
        if let Some((line, text)) = &column.first_gap {
            report_gaps(&column.name, column.gaps, lines.len(), *line, text, log);
        }
    }
    Ok(Table {
        columns: columns.into_iter().map(|column| column.values).collect(),
        lines,
    })
}

impl Reading {
    fn push(&mut self, cell: &str, line: u64, layout: &CsvLayout) {
        self.values
            .push(layout.decimal.parse(cell).unwrap_or_else(|| {
                self.gaps += 1;
                self.first_gap.get_or_insert((line, cell.to_owned()));
                f64::NAN
            }));
    }
}

/// The records of a file, blank and comment lines passed over.
struct Rows<'a> {
    reader: csv::Reader<&'a [u8]>,
    skipped: u64,
    layout: &'a CsvLayout,
}

type Row = Option<(u64, StringRecord)>;

impl<'a> Rows<'a> {
    fn new(content: &'a [u8], layout: &'a CsvLayout, skipped: u64) -> Self {
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
            .from_reader(content);
        Self {
            reader,
            skipped,
            layout,
        }
    }

    /// The next record with its line; text that is not UTF-8 (a header's `°` in an old encoding) is read as far as it is.
    fn next(&mut self) -> Result<Row, IngestError> {
        let mut record = csv::ByteRecord::new();
        let more = self
            .reader
            .read_byte_record(&mut record)
            .map_err(|source| IngestError::CsvSyntax {
                line: source
                    .position()
                    .map_or(0, |place| place.line() + self.skipped),
                source,
            })?;
        let line = record.position().map_or(0, csv::Position::line) + self.skipped;
        Ok(more.then(|| (line, StringRecord::from_byte_record_lossy(record))))
    }

    /// Passes over lines in which every declared column holds text.
    fn skip_text_lines(&mut self, mut row: Row, columns: &[Reading]) -> Result<Row, IngestError> {
        for _ in 0..MOST_TEXT_LINES {
            let Some((_, record)) = &row else {
                return Ok(row);
            };
            let text = |column: &Reading| {
                record.get(column.index).is_some_and(|cell| {
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

/// A blank before a quote makes the quote part of the text.
fn unquoted(name: &str) -> String {
    name.trim_matches([' ', '"']).to_owned()
}

fn skip_lines(content: &[u8], count: usize) -> (&[u8], u64) {
    let mut rest = content;
    let mut skipped = 0;
    for _ in 0..count {
        match rest.iter().position(|&byte| byte == b'\n') {
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

fn has_header(
    header: Header,
    wanted: &[(String, &Column)],
    first: Option<&(u64, StringRecord)>,
    layout: &CsvLayout,
) -> bool {
    match header {
        Header::Present => true,
        Header::Absent => false,
        Header::Auto => wanted.iter().any(|(_, column)| match column {
            Column::Name(_) => true,
            Column::Index(index) => first
                .and_then(|(_, record)| record.get(*index))
                .is_some_and(|cell| !cell.is_empty() && layout.decimal.parse(cell).is_none()),
        }),
    }
}

fn reading(
    channel: &str,
    column: &Column,
    names: &[String],
    width: usize,
) -> Result<Reading, IngestError> {
    let index = match column {
        Column::Index(index) => (*index < width).then_some(*index),
        Column::Name(name) => names.iter().position(|found| found == name).or_else(|| {
            let same = |found: &String| found.to_lowercase() == name.to_lowercase();
            names.iter().position(same)
        }),
    };
    let index = index.ok_or_else(|| IngestError::MissingChannel {
        channel: channel.to_owned(),
        accepted: vec![column.to_string()],
        present: if names.is_empty() {
            (0..width)
                .map(|index| Column::Index(index).to_string())
                .collect()
        } else {
            names
                .iter()
                .filter(|name| !name.is_empty())
                .cloned()
                .collect()
        },
    })?;
    Ok(Reading {
        name: column.to_string(),
        index,
        values: Vec::new(),
        gaps: 0,
        first_gap: None,
    })
}
