//! Text to columns of numbers.

use super::rows::Rows;
use super::{Column, CsvLayout};
use crate::error::IngestError;
use crate::file::finding_log::{About, FindingLog};
use crate::memory::Budget;
use csv::StringRecord;
use serde::{Deserialize, Serialize};
use snug_campaign::excerpt;

/// What separates the columns.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
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
#[non_exhaustive]
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
    budget: &Budget,
    log: &mut FindingLog,
) -> Result<Table, IngestError> {
    let mut rows = Rows::new(content, layout);
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
        let places: Vec<usize> = columns.iter().map(|column| column.index).collect();
        row = rows.next()?;
        row = rows.skip_text_lines(row, &places)?;
    }
    let mut lines = Vec::new();
    let (mut swallowed, mut first_swallowed) = (0, None);
    while let Some((line, record)) = row {
        for column in &mut columns {
            let cell = record.get(column.index).unwrap_or_default();
            column.push(cell, line, layout, budget)?;
        }
        let inside = rows.rows_in_quotes(&record);
        if inside > 0 {
            swallowed += inside;
            first_swallowed.get_or_insert(line);
        }
        budget.push("the lines' numbers", &mut lines, line)?;
        row = rows.next()?;
    }
    if lines.is_empty() {
        return Err(IngestError::NoRows {
            lines: rows.lines(),
        });
    }
    if let Some(line) = first_swallowed {
        log.left_out(
            "quoted_lines",
            About::File,
            format!(
                "{swallowed} lines stand within quotes, as parts of the cell before them, and are no rows (first: the row \
                 at line {line}); is a quote open?"
            ),
        );
    }
    judge_gaps(&columns, wanted, lines.len(), log)?;
    Ok(Table {
        columns: columns.into_iter().map(|column| column.values).collect(),
        lines,
    })
}

/// Says how many cells of a column are no numbers, and refuses a column of nothing else.
fn judge_gaps(
    columns: &[Reading],
    wanted: &[(String, &Column)],
    rows: usize,
    log: &mut FindingLog,
) -> Result<(), IngestError> {
    for (column, (channel, _)) in columns.iter().zip(wanted) {
        if column.gaps == rows {
            return Err(IngestError::UnusableChannel {
                channel: channel.clone(),
                variable: column.name.clone(),
                found: format!("without any number in {rows} rows"),
            });
        }
        if let Some((line, text)) = &column.first_gap {
            log.note(
                "not_a_number",
                About::Channel(&column.name),
                format!(
                    "{} of {rows} cells are no numbers and are read as NaN (first: {text:?} in line {line})",
                    column.gaps
                ),
            );
        }
    }
    Ok(())
}

impl Reading {
    fn push(
        &mut self,
        cell: &str,
        line: u64,
        layout: &CsvLayout,
        budget: &Budget,
    ) -> Result<(), IngestError> {
        let number = layout.decimal.parse(cell).unwrap_or_else(|| {
            self.gaps += 1;
            self.first_gap.get_or_insert_with(|| (line, excerpt(cell)));
            f64::NAN
        });
        budget.push("a column", &mut self.values, number)
    }
}

/// A blank before a quote makes the quote part of the text.
fn unquoted(name: &str) -> String {
    name.trim_matches([' ', '"']).to_owned()
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
