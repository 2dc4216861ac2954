//! Series and what was found of them as Parquet.

use super::daily::Series;
use super::summary::{Judged, JudgedSeries};
use crate::error::PlantError;
use crate::storage::parquet_file;
use crate::storage::schema::{Kind, field, schema};
use arrow::array::{
    ArrayRef, BooleanArray, Date32Array, Float64Array, RecordBatch, StringArray, UInt32Array,
};
use arrow::datatypes::Field;
use std::sync::Arc;

/// What both tables begin with: which series a row is of.
fn series_columns() -> [Field; 3] {
    [
        field(
            "by",
            Kind::Text,
            false,
            "what groups tightenings: tool, joint or station",
        ),
        field("group", Kind::Text, false, "name of the group"),
        field("quantity", Kind::Text, false, "column of the results"),
    ]
}

/// The table `daily`: one row a group, quantity and day.
pub fn daily(series: &[Series]) -> Result<Vec<u8>, PlantError> {
    let mut columns = Vec::from(series_columns());
    columns.extend([
        field("day", Kind::Day, false, "day"),
        field(
            "tightenings",
            Kind::Count,
            false,
            "tightenings that have the quantity",
        ),
        field(
            "median",
            Kind::Number,
            false,
            "their median, in the quantity's unit",
        ),
    ]);
    let each = || {
        series
            .iter()
            .flat_map(|one| one.days.iter().map(move |day| (one, day)))
    };
    let text = |read: fn(&Series) -> &str| -> ArrayRef {
        Arc::new(
            each()
                .map(|(one, _)| Some(read(one)))
                .collect::<StringArray>(),
        )
    };
    let counts = each().map(|(_, day)| u32::try_from(day.tightenings).ok());
    let arrays: Vec<ArrayRef> = vec![
        text(|one| one.by.column()),
        text(|one| &one.group),
        text(|one| &one.column),
        Arc::new(
            each()
                .map(|(_, day)| Some(day.day))
                .collect::<Date32Array>(),
        ),
        Arc::new(counts.collect::<UInt32Array>()),
        Arc::new(
            each()
                .map(|(_, day)| Some(day.value))
                .collect::<Float64Array>(),
        ),
    ];
    table("daily", columns, arrays)
}

/// How a number is read from a judged series.
type Read = fn(&JudgedSeries) -> Option<f64>;

/// The table's numbers: name, what it is, how it is read.
const NUMBERS: [(&str, &str, Read); 11] = [
    (
        "now",
        "mean of the days since the change, or of all, in the quantity's unit",
        |one| Some(one.level.mean),
    ),
    (
        "now_low",
        "lower end of its 95 % interval over days",
        |one| Some(one.level.interval?.0),
    ),
    (
        "now_high",
        "upper end of its 95 % interval over days",
        |one| Some(one.level.interval?.1),
    ),
    (
        "before",
        "mean of the days before the likeliest change",
        |one| Some(one.change?.before),
    ),
    ("after", "mean of the days from it on", |one| {
        Some(one.change?.after)
    }),
    (
        "difference_low",
        "lower end of the 95 % interval of after - before",
        |one| Some(one.change?.difference.0),
    ),
    (
        "difference_high",
        "upper end of the 95 % interval of after - before",
        |one| Some(one.change?.difference.1),
    ),
    (
        "change_p_adjusted",
        "p of the change (Worsley 1979), adjusted (Benjamini-Hochberg)",
        |one| one.change_p,
    ),
    (
        "sisters_mean",
        "mean of its sisters (random effects)",
        |one| Some(one.beside?.mean),
    ),
    ("sisters_spread", "standard deviation between them", |one| {
        Some(one.beside?.spread)
    }),
    (
        "sisters_p_adjusted",
        "p of the difference from them, adjusted (Benjamini-Hochberg)",
        |one| one.beside_p,
    ),
];

/// The table `watch`: one row a group and quantity.
pub fn judged(judged: &Judged) -> Result<Vec<u8>, PlantError> {
    let all = &judged.all;
    let mut columns = Vec::from(series_columns());
    columns.extend([
        field("days", Kind::Count, false, "days that have a value"),
        field(
            "changed",
            Kind::Flag,
            false,
            "whether the level changed, under false-discovery control",
        ),
        field(
            "since",
            Kind::Day,
            true,
            "first day of the change; null where none is told",
        ),
        field(
            "differs",
            Kind::Flag,
            false,
            "whether it differs from its sisters, under false-discovery control",
        ),
    ]);
    columns.extend(
        NUMBERS
            .iter()
            .map(|(name, told, _)| field(name, Kind::Number, true, told)),
    );
    let text = |read: fn(&JudgedSeries) -> &str| -> ArrayRef {
        Arc::new(
            all.iter()
                .map(|one| Some(read(one)))
                .collect::<StringArray>(),
        )
    };
    let flags = |read: fn(&JudgedSeries) -> bool| -> ArrayRef {
        Arc::new(
            all.iter()
                .map(|one| Some(read(one)))
                .collect::<BooleanArray>(),
        )
    };
    let since = all.iter().map(day_of_change);
    let days = all
        .iter()
        .map(|one| u32::try_from(one.series.days.len()).ok());
    let mut arrays: Vec<ArrayRef> = vec![
        text(|one| one.series.by.column()),
        text(|one| &one.series.group),
        text(|one| &one.series.column),
        Arc::new(days.collect::<UInt32Array>()),
        flags(|one| one.is_changed),
        Arc::new(since.collect::<Date32Array>()),
        flags(|one| one.differs),
    ];
    for (_, _, read) in NUMBERS {
        arrays.push(Arc::new(all.iter().map(read).collect::<Float64Array>()));
    }
    table("watch", columns, arrays)
}

/// First day of a change that counts, in days since 1970-01-01.
fn day_of_change(one: &JudgedSeries) -> Option<i32> {
    let change = one.change.filter(|_| one.is_changed)?;
    Some(one.series.days[change.first].day)
}

fn table(name: &str, columns: Vec<Field>, arrays: Vec<ArrayRef>) -> Result<Vec<u8>, PlantError> {
    let schema = schema(name, columns);
    let batch = RecordBatch::try_new(schema.clone(), arrays).map_err(PlantError::columns(name))?;
    parquet_file::written(name, &schema, &[batch])
}
