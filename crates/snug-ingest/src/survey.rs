//! What stands in a measurement file of which nobody has declared anything: columns of numbers, single numbers, words.

mod json;
mod mat;
mod table;

use crate::csv::Column;
use crate::declared::Part;
use crate::error::IngestError;
use crate::file::name::ending;
use crate::memory::Budget;
use crate::thesis_layout::ThesisLayout;
use snug_files::{Disk, Host};
use std::path::Path;

/// Samples that a column has at least.
const FEWEST_SAMPLES: usize = 16;

/// Rows or columns of a table that are looked at one by one at most.
const MOST_COLUMNS: usize = 64;

/// Elements of a list, a cell or a struct array that are looked into, where they are no samples.
const MOST_ELEMENTS: usize = 4;

/// What a file is written in, by its ending.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum SurveyedFormat {
    /// Delimited text (`.csv`, `.tsv`, `.txt`).
    Csv,
    /// MAT of any level (`.mat`).
    Mat,
    /// JSON (`.json`).
    Json,
}

/// What stands in a file.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Survey {
    /// Columns of at least 16 numbers.
    pub columns: Vec<SurveyedColumn>,
    /// Single numbers, each with its name or path.
    pub numbers: Vec<(String, f64)>,
    /// Short texts, each with its name or path.
    pub texts: Vec<(String, String)>,
    /// Whether it is a MAT file in the layout of the thesis, which needs no declaration.
    pub is_thesis: bool,
}

/// A column of numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct SurveyedColumn {
    /// Where it stands.
    pub place: SurveyedPlace,
    /// Its name without unit; empty where it has none.
    pub name: String,
    /// Its unit as the file writes it, for example `deg/s`; empty where it says none.
    pub unit: String,
    /// Its numbers, NaN where there is none.
    pub values: Vec<f64>,
}

/// Where a column stands, as a study declares it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SurveyedPlace {
    /// Of a table.
    Column(Column),
    /// At a path.
    Path(String, Part),
}

impl SurveyedFormat {
    /// By the file's ending.
    pub fn of(file: &Path) -> Option<Self> {
        match ending(file).as_str() {
            "csv" | "tsv" | "txt" => Some(Self::Csv),
            "mat" => Some(Self::Mat),
            "json" => Some(Self::Json),
            _ => None,
        }
    }
}

/// Looks at a file.
///
/// # Errors
/// [`IngestError::File`] around the reason why it cannot be read; [`IngestError::NotSurveyed`] for other formats.
pub fn survey(file: &Path) -> Result<Survey, IngestError> {
    let budget = Budget::new(None);
    let look = || {
        let mut input = Host.open(file).map_err(IngestError::Read)?;
        match SurveyedFormat::of(file) {
            Some(SurveyedFormat::Csv) => table::survey(input.as_mut(), &budget),
            Some(SurveyedFormat::Mat) => mat::survey(input.as_mut(), &budget),
            Some(SurveyedFormat::Json) => json::survey(input.as_mut(), &budget),
            None => Err(IngestError::NotSurveyed),
        }
    };
    look().map_err(|error| error.in_file(file))
}

impl Survey {
    /// Adds a column that stands at a path, named by the path's last name.
    fn add(&mut self, path: String, part: Part, values: Vec<f64>) {
        let last = path
            .rsplit(['.', '[', ']', '"'])
            .find(|name| !name.is_empty() && !name.bytes().all(|byte| byte.is_ascii_digit()));
        // A table's one name says nothing of its columns.
        let whole = if part == Part::Whole { last } else { None };
        let (name, unit) = name_and_unit(whole.unwrap_or_default());
        self.columns.push(SurveyedColumn {
            place: SurveyedPlace::Path(path, part),
            name,
            unit,
            values,
        });
    }

    /// Adds the columns, or the rows where these are longer, of a table.
    fn add_table(
        &mut self,
        path: &str,
        rows: usize,
        columns: usize,
        at: impl Fn(usize, usize) -> f64,
    ) {
        let (short, long) = (rows.min(columns), rows.max(columns));
        if long < FEWEST_SAMPLES || short > MOST_COLUMNS {
            return;
        }
        for place in 0..short {
            let (part, values) = match rows >= columns {
                true => (
                    Part::Column(place),
                    (0..rows).map(|row| at(row, place)).collect(),
                ),
                false => (
                    Part::Row(place),
                    (0..columns).map(|column| at(place, column)).collect(),
                ),
            };
            let part = if short == 1 { Part::Whole } else { part };
            self.add(path.to_owned(), part, values);
        }
    }
}

/// `Speed [rpm]`, `speed (rpm)` and `speed/rpm` in two.
fn name_and_unit(text: &str) -> (String, String) {
    for (open, close) in [('[', ']'), ('(', ')')] {
        if let Some((name, rest)) = text.split_once(open)
            && let Some((unit, _)) = rest.rsplit_once(close)
        {
            return (name.trim().to_owned(), unit.trim().to_owned());
        }
    }
    (text.trim().to_owned(), String::new())
}

/// Whether these variables make a file of the thesis.
fn is_thesis(names: &[String]) -> bool {
    let layout = ThesisLayout::default();
    let has = |accepted: &[String]| accepted.iter().any(|name| names.contains(name));
    has(&layout.acceleration) && has(&layout.torque)
}

#[cfg(test)]
mod tests;
