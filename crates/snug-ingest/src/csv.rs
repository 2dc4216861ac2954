//! CSV files with declared columns.

mod number;
mod rows;
mod table;

pub use number::Decimal;
pub use table::{Delimiter, Header};

use crate::error::IngestError;
use crate::file::finding_log::FindingLog;
use crate::file::ingested::Ingested;
use crate::layout;
use crate::layout::Layout;
use crate::memory::Budget;
use crate::recording::channels;
use crate::recording::condition_pattern::ConditionPattern;
use crate::recording::range;
use crate::recording::range::Range;
use crate::recording::sampling;
use crate::recording::sampling::Timed;
use crate::signal;
use crate::signal::Signal;
use crate::unit::Unit;
pub(crate) use rows::Rows;
use serde::{Deserialize, Serialize};
use snug_campaign::TimeBase;
use snug_files::Input;
use std::fmt;
use std::path::Path;
use table::Table;

/// What a CSV file's columns are. One file is one recording.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct CsvLayout {
    /// The columns that are read: one input (torque or force) and at least one motion. Default none (must be declared).
    pub channels: Vec<CsvChannel>,
    /// Where the samples' times come from. Default a column `time` in s.
    pub sampling: Sampling,
    /// What separates the columns. Default `Auto`.
    pub delimiter: Delimiter,
    /// How decimals are written. Default `Auto`.
    pub decimal: Decimal,
    /// Whether the first line names the columns. Default `Auto`.
    pub header: Header,
    /// Lines that start with this are passed over. Default `#`.
    pub comment: Option<char>,
    /// Lines before the header that are passed over. Default 0.
    pub skip_lines: usize,
    /// Stretches that become segments; without any the whole file is one. Default none.
    pub ranges: Vec<Range>,
    /// How the file's name tells the conditions; `None` (default): it does not.
    pub conditions: Option<ConditionPattern>,
}

impl Default for CsvLayout {
    fn default() -> Self {
        Self {
            channels: Vec::new(),
            sampling: Sampling::default(),
            delimiter: Delimiter::default(),
            decimal: Decimal::default(),
            header: Header::default(),
            comment: Some('#'),
            skip_lines: 0,
            ranges: Vec::new(),
            conditions: None,
        }
    }
}

/// One column.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CsvChannel {
    /// Which column.
    pub column: Column,
    /// What it measures.
    pub signal: Signal,
    /// In which unit.
    pub unit: Unit,
    /// Factor before the unit, for gain or sign (−1: the sensor counts the other way). Default 1.
    #[serde(default = "signal::as_it_is")]
    pub scale: f64,
}

/// A column by the header's name or by place.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Column {
    /// The header's text; letter case counts only where two columns differ by it alone.
    Name(String),
    /// Place, counted from 0.
    Index(usize),
}

impl fmt::Display for Column {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Name(name) => formatter.write_str(name),
            Self::Index(index) => write!(formatter, "column {index}"),
        }
    }
}

/// Where the samples' times come from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub enum Sampling {
    /// The samples are equally spaced, the first at 0 s.
    Rate {
        /// Samples per second \[Hz\].
        hz: f64,
    },
    /// A column holds the times.
    TimeColumn {
        /// Which column.
        column: Column,
        /// Its unit. Default s.
        #[serde(default)]
        unit: TimeUnit,
        /// How far a sample may lie from the uniform grid, in intervals, before all are interpolated. Default 0.1.
        #[serde(default = "sampling::default_tolerance_ratio")]
        tolerance_ratio: f64,
    },
}

impl Default for Sampling {
    fn default() -> Self {
        Self::TimeColumn {
            column: Column::Name("time".to_owned()),
            unit: TimeUnit::default(),
            tolerance_ratio: sampling::default_tolerance_ratio(),
        }
    }
}

/// Unit of a time column.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum TimeUnit {
    /// s
    #[default]
    Second,
    /// ms
    Millisecond,
    /// µs
    Microsecond,
    /// ns
    Nanosecond,
}

impl TimeUnit {
    /// How long it is \[s\].
    pub fn seconds(self) -> f64 {
        match self {
            Self::Second => 1.0,
            Self::Millisecond => 1e-3,
            Self::Microsecond => 1e-6,
            Self::Nanosecond => 1e-9,
        }
    }
}

impl Layout for CsvLayout {
    fn endings(&self) -> &'static [&'static str] {
        &["csv", "tsv", "txt"]
    }

    fn check(&self) -> Result<(), IngestError> {
        channels::check(&self.declared())?;
        range::check(&self.ranges)?;
        let (field, value) = match &self.sampling {
            Sampling::Rate { hz } => ("sampling.hz", *hz),
            Sampling::TimeColumn {
                tolerance_ratio, ..
            } => ("sampling.tolerance_ratio", *tolerance_ratio),
        };
        layout::check_positive(field, value)?;
        if let Some(comment) = self.comment.filter(|comment| !comment.is_ascii()) {
            return Err(IngestError::setting(
                "comment",
                comment,
                "an ASCII character",
            ));
        }
        Ok(())
    }

    fn ranges(&self) -> &[Range] {
        &self.ranges
    }

    fn declared(&self) -> Vec<(Signal, Unit, f64)> {
        let channels = self.channels.iter();
        channels.map(|c| (c.signal, c.unit, c.scale)).collect()
    }

    fn read(
        &self,
        input: &mut dyn Input,
        path: &Path,
        lever_arm_m: f64,
        budget: &Budget,
    ) -> Result<Ingested, IngestError> {
        let content = layout::text(input, budget)?;
        if content.trim_ascii().is_empty() {
            return Err(IngestError::EmptyFile);
        }
        let mut log = FindingLog::new(path);
        let table = table::read(&content, self, &self.wanted(), budget, &mut log)?;
        let (grid, columns) = self.on_a_grid(table, budget, &mut log)?;
        let channels = self.declared().into_iter().zip(columns).collect();
        let about = (&self.ranges[..], self.conditions.as_ref());
        let recording = layout::recording(about, path, grid, channels, lever_arm_m, &mut log);
        Ok(Ingested {
            recordings: vec![recording],
            findings: log.finish(),
        })
    }
}

impl CsvLayout {
    /// The columns to read, each with what it holds: the channels, then the times where a column has them.
    fn wanted(&self) -> Vec<(String, &Column)> {
        let channels = (self.channels.iter()).map(|one| (one.signal.in_words(), &one.column));
        let times = match &self.sampling {
            Sampling::TimeColumn { column, .. } => Some(("time".to_owned(), column)),
            Sampling::Rate { .. } => None,
        };
        channels.chain(times).collect()
    }

    /// The channels' samples on a uniform grid.
    fn on_a_grid(
        &self,
        table: Table,
        budget: &Budget,
        log: &mut FindingLog,
    ) -> Result<(TimeBase, Vec<Vec<f64>>), IngestError> {
        let Table { mut columns, lines } = table;
        let time_base = match &self.sampling {
            Sampling::Rate { hz } => TimeBase {
                start_s: 0.0,
                interval_s: 1.0 / hz,
            },
            Sampling::TimeColumn {
                unit,
                tolerance_ratio,
                ..
            } => {
                let mut times_s = columns.pop().unwrap_or_default();
                times_s.iter_mut().for_each(|time| *time *= unit.seconds());
                let timed = Timed {
                    times_s,
                    channels: &mut columns,
                    place: &|index| format!("line {}", lines[index]),
                    budget,
                };
                sampling::uniform(timed, *tolerance_ratio, log)?
            }
        };
        Ok((time_base, columns))
    }
}

#[cfg(test)]
mod tests;
