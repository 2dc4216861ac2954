//! Lists of numbers in a JSON file.

use super::{FEWEST_SAMPLES, MOST_ELEMENTS, Survey};
use crate::declared::json::syntax;
use crate::declared::{Part, Segment, joined};
use crate::error::IngestError;
use crate::layout;
use crate::memory::Budget;
use serde_json::Value;
use snug_files::Input;

/// Memory that a tree takes per byte of text: an object of one number, `{"":1},`, takes 670 for its 8.
const BYTES_PER_BYTE: usize = 100;

pub(super) fn survey(input: &mut dyn Input, budget: &Budget) -> Result<Survey, IngestError> {
    let content = layout::text(input, budget)?;
    budget.spend_on::<[u8; BYTES_PER_BYTE]>("the file as a tree", content.len())?;
    let tree: Value = serde_json::from_slice(&content).map_err(|error| syntax(&content, &error))?;
    let mut survey = Survey::default();
    look(&mut survey, "", &tree);
    Ok(survey)
}

fn look(survey: &mut Survey, path: &str, value: &Value) {
    match value {
        Value::Number(_) => survey.numbers.push((path.to_owned(), number(value))),
        Value::String(text) if text.len() < 100 => {
            survey.texts.push((path.to_owned(), text.clone()))
        }
        Value::Object(fields) => {
            for (key, value) in fields {
                look(survey, &joined(path, &Segment::Key(key.clone())), value);
            }
        }
        Value::Array(values) => list(survey, path, values),
        _ => {}
    }
}

fn list(survey: &mut Survey, path: &str, values: &[Value]) {
    let is_long = values.len() >= FEWEST_SAMPLES;
    let rows: Vec<&Vec<Value>> = values.iter().filter_map(Value::as_array).collect();
    let columns = rows.first().map_or(0, |row| row.len());
    let is_number = |value: &Value| value.is_number() || value.is_null();
    if is_long && values.iter().all(is_number) {
        survey.add(
            path.to_owned(),
            Part::Whole,
            values.iter().map(number).collect(),
        );
    } else if !rows.is_empty()
        && rows.len() == values.len()
        && rows
            .iter()
            .all(|row| row.len() == columns && row.iter().all(is_number))
    {
        survey.add_table(path, rows.len(), columns, |row, column| {
            number(&rows[row][column])
        });
    } else if let (true, Some(Value::Object(first))) = (is_long, values.first()) {
        for key in first.keys() {
            let samples: Vec<f64> = values.iter().map(|one| number(&one[key])).collect();
            if samples.iter().filter(|sample| !sample.is_nan()).count() * 2 > samples.len() {
                let path = joined(&joined(path, &Segment::Each), &Segment::Key(key.clone()));
                survey.add(path, Part::Whole, samples);
            }
        }
    } else {
        for (place, value) in values.iter().enumerate().take(MOST_ELEMENTS) {
            look(survey, &joined(path, &Segment::Index(place)), value);
        }
    }
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}
