//! One value a day of every group and quantity: the median of its tightenings, so that one bad fit moves nothing.

use super::quantities::Quantities;
use crate::engine::{reading_session, rows_of};
use crate::error::PlantError;
use crate::functions::results;
use crate::storage::dataset::Dataset;
use arrow::array::{Array, AsArray, RecordBatch};
use arrow::datatypes::{Date32Type, Float64Type, Int64Type};
use std::collections::BTreeMap;

/// What groups tightenings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum By {
    Tool,
    Joint,
    Station,
}

impl By {
    pub const ALL: [Self; 3] = [Self::Tool, Self::Joint, Self::Station];

    /// Its column.
    pub fn column(self) -> &'static str {
        match self {
            Self::Tool => "tool",
            Self::Joint => "joint",
            Self::Station => "station",
        }
    }
}

/// A day of a series.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Day {
    /// Days since 1970-01-01.
    pub day: i32,
    /// Tightenings that have the quantity.
    pub tightenings: usize,
    /// Their median, in the quantity's unit.
    pub value: f64,
}

/// One quantity of one group over days, in their order.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    pub by: By,
    pub group: String,
    pub column: String,
    pub days: Vec<Day>,
}

/// Every series of the groups that `by` forms; fits that ended without an optimum take no part.
pub async fn daily(
    results: &Dataset,
    quantities: &Quantities,
    by: By,
) -> Result<Vec<Series>, PlantError> {
    let commits = results.partitions().await?;
    let urls = results.urls(commits.iter().map(|(_, commit)| commit));
    if urls.is_empty() {
        return Ok(Vec::new());
    }
    let session = reading_session(&[&results.store]);
    let schema = results::results(&results.study()?)?;
    let rows = rows_of(&session, urls, &schema).await?;
    session.register_table("results", rows.into_view())?;
    let each = quantities.0.iter().map(|quantity| {
        let column = &quantity.column;
        format!("count(\"{column}\"), median(\"{column}\")")
    });
    let group = by.column();
    let text = format!(
        "SELECT \"{group}\", day, {} FROM results WHERE status IN ('converged', 'converged_at_constraint') \
         AND \"{group}\" IS NOT NULL AND day IS NOT NULL GROUP BY \"{group}\", day",
        each.collect::<Vec<_>>().join(", ")
    );
    let mut found: BTreeMap<(String, usize), Vec<Day>> = BTreeMap::new();
    for batch in session.sql(&text).await?.collect().await? {
        take(&batch, quantities, &mut found);
    }
    let series = found.into_iter().map(|((group, index), mut days)| {
        days.sort_by_key(|day| day.day);
        Series {
            by,
            group,
            column: quantities.0[index].column.clone(),
            days,
        }
    });
    Ok(series.collect())
}

fn take(
    batch: &RecordBatch,
    quantities: &Quantities,
    found: &mut BTreeMap<(String, usize), Vec<Day>>,
) {
    let groups = batch.column(0).as_string::<i32>();
    let days = batch.column(1).as_primitive::<Date32Type>();
    for index in 0..quantities.0.len() {
        let counts = batch.column(2 + 2 * index).as_primitive::<Int64Type>();
        let values = batch.column(3 + 2 * index).as_primitive::<Float64Type>();
        for row in (0..batch.num_rows()).filter(|&row| values.is_valid(row)) {
            let series = found
                .entry((groups.value(row).to_owned(), index))
                .or_default();
            series.push(Day {
                day: days.value(row),
                tightenings: usize::try_from(counts.value(row)).unwrap_or(0),
                value: values.value(row),
            });
        }
    }
}
