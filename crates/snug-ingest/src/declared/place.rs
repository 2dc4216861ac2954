//! Numbers that stand at one place of a file, and the part of them that is one signal.

use crate::error::IngestError;
use crate::memory::Budget;
use serde::{Deserialize, Serialize};

use super::Wanted;

/// Which part of an array is the signal.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Part {
    /// All of it: a row, a column or a list.
    #[default]
    Whole,
    /// One row, counted from 0.
    Row(usize),
    /// One column, counted from 0.
    Column(usize),
}

/// How a table's numbers follow each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Order {
    /// Row after row.
    Rows,
    /// Column after column.
    Columns,
}

/// The numbers at one place, as a table.
#[derive(Debug)]
pub(crate) struct Block {
    pub(crate) values: Vec<f64>,
    pub(crate) rows: usize,
    pub(crate) columns: usize,
    pub(crate) order: Order,
    /// Shape and class, for messages.
    pub(crate) described: String,
}

impl Block {
    /// The samples of the part that is wanted; the block's own numbers are given back to the budget where they are not
    /// those.
    pub(crate) fn part(self, wanted: &Wanted, budget: &Budget) -> Result<Vec<f64>, IngestError> {
        let (rows, columns) = (self.rows, self.columns);
        let unusable = |why: &str| IngestError::UnusableChannel {
            channel: wanted.what.clone(),
            variable: wanted.path.to_string(),
            found: format!("{}{why}", self.described),
        };
        if self.values.is_empty() {
            return Err(unusable(""));
        }
        let (start, step, count) = match (wanted.part, self.order) {
            (Part::Whole, _) if rows == 1 || columns == 1 => return Ok(self.values),
            (Part::Whole, _) => {
                return Err(unusable(
                    ", of which no row or column is declared (as part: Column(0))",
                ));
            }
            (Part::Row(row), _) if row >= rows => {
                return Err(unusable(&format!(
                    ", which has no row {row} counted from 0"
                )));
            }
            (Part::Column(column), _) if column >= columns => {
                return Err(unusable(&format!(
                    ", which has no column {column} counted from 0"
                )));
            }
            (Part::Row(row), Order::Rows) => (row * columns, 1, columns),
            (Part::Row(row), Order::Columns) => (row, rows, columns),
            (Part::Column(column), Order::Columns) => (column * rows, 1, rows),
            (Part::Column(column), Order::Rows) => (column, columns, rows),
        };
        let mut samples = budget.list("a channel", count)?;
        samples.extend(self.values.iter().skip(start).step_by(step).take(count));
        budget.give_back(size_of_val(self.values.as_slice()) as u64);
        Ok(samples)
    }
}
