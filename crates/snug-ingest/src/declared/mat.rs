//! MAT files of any level whose variables the study declares.

use super::path::joined;
use super::{Block, DataPath, DeclaredLayout, Found, Order, Places, Segment, Wanted};
use crate::error::IngestError;
use crate::file::finding_log::{About, FindingLog};
use crate::mat;
use crate::mat::{Content, MatSelection, Sparse, Value};
use crate::memory::Budget;
use serde::{Deserialize, Serialize};
use snug_files::Input;

/// Which variables of a MAT file, fields of structs, rows and columns are which signals.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct MatLayout(
    /// The places.
    pub DeclaredLayout,
);

impl Places for MatLayout {
    const ENDINGS: &[&str] = &["mat"];

    fn places(&self) -> &DeclaredLayout {
        &self.0
    }

    fn check_path(path: &DataPath) -> Result<(), IngestError> {
        let matlabs =
            |segment: &Segment| matches!(segment, Segment::Key(key) if key.contains(['(', '{']));
        if path.segments.iter().any(matlabs) {
            let allowed = "places in square brackets, counted from 0: MATLAB's run(2).torque is run[1].torque";
            return Err(IngestError::setting("path", path, allowed));
        }
        Ok(())
    }

    fn find(
        wanted: &[Wanted],
        input: &mut dyn Input,
        budget: &Budget,
        log: &mut FindingLog,
    ) -> Result<Found, IngestError> {
        let is_wanted = |name: &str| wanted.iter().any(|one| variable(one) == Some(name));
        let file = mat::select(input, &is_wanted, budget)?;
        note_copies(&file, wanted, log);
        let numbers = wanted.iter().map(|one| samples(&file, one, budget));
        Ok(numbers.collect())
    }
}

/// The variable in which something stands.
fn variable(wanted: &Wanted) -> Option<&str> {
    match wanted.path.segments.first() {
        Some(Segment::Key(name)) => Some(name),
        _ => None,
    }
}

/// A file may hold several variables of one name.
fn note_copies(file: &MatSelection, wanted: &[Wanted], log: &mut FindingLog) {
    for one in wanted {
        let is_it = |name: &&String| Some(name.as_str()) == variable(one);
        let copies = file.present.iter().filter(is_it).count();
        if copies > 1 {
            let name = variable(one).unwrap_or_default();
            let message = format!("the file holds {name} {copies} times; the first is used");
            log.note("channel_twice", About::Channel(name), message);
        }
    }
}

/// The numbers of one wanted place.
fn samples(file: &MatSelection, wanted: &Wanted, budget: &Budget) -> Result<Vec<f64>, IngestError> {
    let missing = |present: Vec<String>| IngestError::MissingChannel {
        channel: wanted.what.clone(),
        accepted: vec![wanted.path.to_string()],
        present,
    };
    let name = variable(wanted).unwrap_or_default();
    if let Some(damaged) = file.unreadable.iter().find(|one| one.name == name) {
        return Err(IngestError::UnusableChannel {
            channel: wanted.what.clone(),
            variable: name.to_owned(),
            found: format!("damaged ({})", damaged.reason),
        });
    }
    let Some(found) = file.variables.iter().find(|one| one.name == name) else {
        return Err(missing(file.present.clone()));
    };
    let values = resolve(&found.value, wanted).map_err(missing)?;
    block(&values, wanted, budget)?.part(wanted, budget)
}

/// A value, or one element of a struct array.
#[derive(Clone, Copy)]
struct Cursor<'a> {
    value: &'a Value,
    element: Option<usize>,
}

/// What the steps behind the variable's name lead to; else what stands where they end.
fn resolve<'a>(value: &'a Value, wanted: &Wanted) -> Result<Vec<&'a Value>, Vec<String>> {
    let mut cursors = vec![Cursor {
        value,
        element: None,
    }];
    for (depth, segment) in wanted.path.segments.iter().enumerate().skip(1) {
        let before = wanted.path.start(depth);
        let mut next = Vec::new();
        for cursor in &cursors {
            next.extend(step(*cursor, segment).ok_or_else(|| cursor.inside(&before))?);
        }
        cursors = next;
    }
    match cursors.iter().all(|cursor| cursor.element.is_none()) {
        true => Ok(cursors.iter().map(|cursor| cursor.value).collect()),
        false => Err(cursors[0].inside(&wanted.path.to_string())),
    }
}

fn step<'a>(cursor: Cursor<'a>, segment: &Segment) -> Option<Vec<Cursor<'a>>> {
    let whole = |value: &'a Value| Cursor {
        value,
        element: None,
    };
    match (segment, &cursor.value.content) {
        (Segment::Key(key), Content::Struct { .. }) => {
            let values = cursor.value.field(key)?;
            let place = match cursor.element {
                Some(place) => place,
                None if values.len() == 1 => 0,
                None => return None,
            };
            Some(vec![whole(values.get(place)?)])
        }
        (_, Content::Struct { fields, .. }) if cursor.element.is_none() => {
            let count = fields.first().map_or(0, |field| field.values.len());
            let element = |place| Cursor {
                value: cursor.value,
                element: Some(place),
            };
            match segment {
                Segment::Index(place) => (*place < count).then(|| vec![element(*place)]),
                _ => Some((0..count).map(element).collect()),
            }
        }
        (Segment::Index(place), Content::Cell(values)) => Some(vec![whole(values.get(*place)?)]),
        (Segment::Each, Content::Cell(values)) => Some(values.iter().map(whole).collect()),
        _ => None,
    }
}

impl Cursor<'_> {
    /// What stands inside, as paths behind `path`.
    fn inside(self, path: &str) -> Vec<String> {
        let behind = |segment| joined(path, &segment);
        match &self.value.content {
            Content::Struct { fields, .. } => {
                let count = fields.first().map_or(0, |field| field.values.len());
                let names = fields.iter().map(|field| Segment::Key(field.name.clone()));
                match self.element.is_some() || count == 1 {
                    true => names.map(behind).collect(),
                    false => (0..count.min(100))
                        .map(|place| behind(Segment::Index(place)))
                        .collect(),
                }
            }
            Content::Cell(values) => (0..values.len().min(100))
                .map(|place| behind(Segment::Index(place)))
                .collect(),
            _ => vec![format!("{path} ({})", self.value.describe())],
        }
    }
}

/// The numbers of one array, or of many single ones.
fn block(values: &[&Value], wanted: &Wanted, budget: &Budget) -> Result<Block, IngestError> {
    if let &[value] = values {
        return numbers(value, wanted, budget);
    }
    let mut all = budget.list("a channel", values.len())?;
    for &value in values {
        match value.to_f64().as_deref() {
            Some(&[number]) => all.push(number),
            _ => return Err(unusable(value, wanted)),
        }
    }
    Ok(Block {
        rows: all.len(),
        columns: 1,
        order: Order::Columns,
        described: format!("{} numbers", all.len()),
        values: all,
    })
}

fn unusable(value: &Value, wanted: &Wanted) -> IngestError {
    IngestError::UnusableChannel {
        channel: wanted.what.clone(),
        variable: wanted.path.to_string(),
        found: value.describe(),
    }
}

/// An array of at most two dimensions longer than 1, as doubles.
pub(crate) fn numbers(
    value: &Value,
    wanted: &Wanted,
    budget: &Budget,
) -> Result<Block, IngestError> {
    let lengths: Vec<usize> = match value.dims.iter().filter(|&&length| length != 1).count() {
        0..=2 if value.dims.len() <= 2 => value.dims.clone(),
        // 1×N×M: the dimensions of length 1 say nothing.
        0..=2 => value
            .dims
            .iter()
            .copied()
            .filter(|&length| length != 1)
            .collect(),
        _ => return Err(unusable(value, wanted)),
    };
    let rows = lengths.first().copied().unwrap_or(1);
    let columns = lengths.get(1).copied().unwrap_or(1);
    if value.dims.is_empty() {
        return Err(unusable(value, wanted));
    }
    let values = match &value.content {
        Content::Sparse(sparse) if sparse.imaginary.is_none() => {
            dense(sparse, rows, columns, budget)?
        }
        _ => {
            budget.spend_on::<f64>("a channel", value.numbers_held().0)?;
            value.to_f64().ok_or_else(|| unusable(value, wanted))?
        }
    };
    Ok(Block {
        values,
        rows,
        columns,
        order: Order::Columns,
        described: value.describe(),
    })
}

/// Every element of a sparse matrix, of truth values, too.
fn dense(
    sparse: &Sparse,
    rows: usize,
    columns: usize,
    budget: &Budget,
) -> Result<Vec<f64>, IngestError> {
    let count = rows.saturating_mul(columns);
    let mut values = budget.list("a sparse matrix with its zeros", count)?;
    values.resize(count, 0.0);
    let places = sparse.rows.iter().zip(&sparse.columns);
    for ((row, column), value) in places.zip(&sparse.real) {
        if let Some(place) = values.get_mut(column * rows + row) {
            *place = *value;
        }
    }
    Ok(values)
}

#[cfg(test)]
mod tests;
