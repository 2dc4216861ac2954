//! Columns of delimited text.

use super::{FEWEST_SAMPLES, MOST_COLUMNS, Survey, SurveyedColumn, SurveyedPlace, name_and_unit};
use crate::csv::{Column, CsvLayout, Rows};
use crate::error::IngestError;
use crate::layout;
use crate::memory::Budget;
use snug_files::Input;

/// Share of the rows in which a column has a number, at least.
const FULL: f64 = 0.5;

pub(super) fn survey(input: &mut dyn Input, budget: &Budget) -> Result<Survey, IngestError> {
    let content = layout::text(input, budget)?;
    let csv = CsvLayout::default();
    let mut rows = Rows::new(&content, &csv);
    let Some((_, first)) = rows.next()? else {
        return Err(IngestError::EmptyFile);
    };
    let cells: Vec<String> = first.iter().take(MOST_COLUMNS).map(unquoted).collect();
    let number = |cell: &str| csv.decimal.parse(cell);
    let has_header = cells
        .iter()
        .any(|cell| !cell.is_empty() && number(cell).is_none());
    let mut units = vec![String::new(); cells.len()];
    let mut values: Vec<Vec<f64>> = vec![Vec::new(); cells.len()];
    let mut row = match has_header {
        true => rows.next()?,
        false => Some((1, first)),
    };
    let mut above = has_header;
    while let Some((_, record)) = row {
        // Units and remarks stand between names and numbers.
        if above && record.iter().all(|cell| number(cell).is_none()) {
            for (unit, cell) in units.iter_mut().zip(&record) {
                *unit = unquoted(cell).trim_matches(['[', ']', '(', ')']).to_owned();
            }
        } else {
            above = false;
            for (place, column) in values.iter_mut().enumerate() {
                let cell = record.get(place).unwrap_or_default();
                budget.push("a column", column, number(cell).unwrap_or(f64::NAN))?;
            }
        }
        row = rows.next()?;
    }
    let names = if has_header {
        cells
    } else {
        vec![String::new(); cells.len()]
    };
    Ok(columns(&names, units, values))
}

/// Columns that are full, and the one number of those that hold no more.
fn columns(names: &[String], mut units: Vec<String>, values: Vec<Vec<f64>>) -> Survey {
    let mut survey = Survey::default();
    for (place, values) in values.into_iter().enumerate() {
        let header = names[place].as_str();
        let numbers = values.iter().filter(|value| !value.is_nan()).count();
        let (name, unit) = name_and_unit(header);
        let unit = if unit.is_empty() {
            std::mem::take(&mut units[place])
        } else {
            unit
        };
        if values.len() >= FEWEST_SAMPLES && numbers as f64 >= FULL * values.len() as f64 {
            // Of two columns of one name only the first can be declared by it.
            let is_named = !header.is_empty() && !names[..place].contains(&names[place]);
            let column = match is_named {
                true => Column::Name(header.to_owned()),
                false => Column::Index(place),
            };
            let place = SurveyedPlace::Column(column);
            survey.columns.push(SurveyedColumn {
                place,
                name,
                unit,
                values,
            });
        } else if let (true, Some(value)) =
            (numbers == 1, values.iter().find(|value| !value.is_nan()))
        {
            survey.numbers.push((header.to_owned(), *value));
        }
    }
    survey
}

fn unquoted(cell: &str) -> String {
    cell.trim_matches([' ', '"']).to_owned()
}
