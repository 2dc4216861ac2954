//! Columns of a MAT file's variables.

use super::{FEWEST_SAMPLES, MOST_ELEMENTS, Survey, is_thesis};
use crate::declared::{Part, Segment, joined};
use crate::error::IngestError;
use crate::mat;
use crate::mat::{Content, Value};
use crate::memory::Budget;
use snug_files::Input;

pub(super) fn survey(input: &mut dyn Input, budget: &Budget) -> Result<Survey, IngestError> {
    let file = mat::select(input, &|_| true, budget)?;
    let mut survey = Survey {
        is_thesis: is_thesis(&file.present),
        ..Survey::default()
    };
    for variable in &file.variables {
        look(&mut survey, &variable.name, &variable.value, budget)?;
    }
    Ok(survey)
}

fn look(
    survey: &mut Survey,
    path: &str,
    value: &Value,
    budget: &Budget,
) -> Result<(), IngestError> {
    let below = |segment| joined(path, &segment);
    match &value.content {
        Content::Struct { fields, .. } => {
            for field in fields {
                let many = field.values.len() > 1;
                for (place, value) in field.values.iter().enumerate().take(MOST_ELEMENTS) {
                    let element = if many {
                        below(Segment::Index(place))
                    } else {
                        path.to_owned()
                    };
                    let path = joined(&element, &Segment::Key(field.name.clone()));
                    look(survey, &path, value, budget)?;
                }
            }
        }
        Content::Cell(values) => {
            for (place, value) in values.iter().enumerate().take(MOST_ELEMENTS) {
                look(survey, &below(Segment::Index(place)), value, budget)?;
            }
        }
        Content::Text(_) => {
            if let Some(text) = value.text().filter(|text| text.len() < 100) {
                survey.texts.push((path.to_owned(), text));
            }
        }
        Content::Numeric { .. } | Content::Logical(_) if value.dims.len() == 2 => {
            budget.spend_on::<[f64; 2]>("columns", value.numbers_held().0)?;
            let numbers = value.to_f64().unwrap_or_default();
            let (rows, columns) = (value.dims[0], value.dims[1]);
            match numbers.as_slice() {
                [] => {}
                &[number] => survey.numbers.push((path.to_owned(), number)),
                _ if rows.min(columns) == 1 && numbers.len() >= FEWEST_SAMPLES => {
                    survey.add(path.to_owned(), Part::Whole, numbers);
                }
                _ => survey.add_table(path, rows, columns, |row, column| {
                    numbers[column * rows + row]
                }),
            }
        }
        _ => {}
    }
    Ok(())
}
