//! The columns of every table, each with its unit and what it is: one list, from which schemas and documentation follow.

use arrow::datatypes::{DataType, Field, Fields, Schema, SchemaRef};
use std::collections::HashMap;
use std::sync::Arc;

/// Of all tables together. A column that is added keeps it; one that goes or changes its meaning raises it.
pub const SCHEMA_VERSION: u32 = 1;

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Text,
    Texts,
    Day,
    Count,
    Flag,
    Number,
    Numbers,
    Corrections,
}

/// A column: name, what it holds, whether it may be null, what it is.
pub(crate) type Column = (&'static str, Kind, bool, &'static str);

/// A measurement file, in every table that names one.
const FILE: Column = (
    "file",
    Kind::Text,
    false,
    "measurement file without its folder",
);

/// A tool, in every table that names one.
const TOOL: Column = (
    "tool",
    Kind::Text,
    false,
    "name of the tool; 'unknown' where nothing says it",
);

/// Who, where, when: in front of every row of tightenings and results.
pub(crate) const IDENTITY: &[Column] = &[
    (
        "key",
        Kind::Text,
        false,
        "stable key: SHA-256 of the measurement file's bytes (first 16 bytes, hexadecimal), '-', number",
    ),
    FILE,
    (
        "number",
        Kind::Count,
        false,
        "1-based number of the tightening within the file",
    ),
    (
        "day",
        Kind::Day,
        true,
        "day of the tightening; null where nothing says it",
    ),
    TOOL,
    ("station", Kind::Text, true, "name of the station"),
    (
        "time_of_day_s",
        Kind::Number,
        true,
        "when the file's recording began, since midnight [s]",
    ),
    ("participant", Kind::Text, true, "who held the tool"),
    ("strategy", Kind::Text, true, "tightening strategy"),
    ("joint", Kind::Text, true, "joint stiffness"),
    ("pace_per_min", Kind::Number, true, "tightenings per minute"),
    (
        "peak_torque_nm",
        Kind::Number,
        false,
        "largest torque of the segment [Nm]",
    ),
    (
        "target_torque_nm",
        Kind::Number,
        false,
        "peak torque rounded to 5 Nm [Nm]",
    ),
];

/// What preparation made of it: all that a fit takes.
pub(crate) const PREPARED: &[Column] = &[
    ("lever_arm_m", Kind::Number, false, "joint axis to grip [m]"),
    (
        "known_inertia_kg_m2",
        Kind::Number,
        false,
        "known inertia about the joint [kg m²]",
    ),
    (
        "start_s",
        Kind::Number,
        false,
        "time of the first sample since the segment's start [s]",
    ),
    (
        "interval_s",
        Kind::Number,
        false,
        "time between samples [s]",
    ),
    ("samples", Kind::Count, false, "samples of the window"),
    (
        "onset_sample",
        Kind::Count,
        true,
        "0-based sample at which the torque pulse begins",
    ),
    (
        "zero_sample",
        Kind::Count,
        true,
        "0-based sample whose displacement was taken as zero (preset thesis)",
    ),
    (
        "goes_up",
        Kind::Flag,
        true,
        "the displacement does not come back (preset thesis)",
    ),
    (
        "goes_down",
        Kind::Flag,
        true,
        "the largest excursion is negative (preset thesis)",
    ),
    (
        "data_quality_rejects",
        Kind::Flag,
        false,
        "a fault of the data keeps it out of the statistics; the findings say which",
    ),
    (
        "noise_source",
        Kind::Text,
        true,
        "where the noise was measured: pre_roll, repeats, declared or residual",
    ),
    (
        "noise_quantity",
        Kind::Text,
        true,
        "of which quantity: displacement, velocity or acceleration",
    ),
    (
        "noise_standard_deviation",
        Kind::Number,
        true,
        "of the noise, in that quantity's unit",
    ),
    (
        "noise_autoregression",
        Kind::Numbers,
        true,
        "a_1 … a_p of n_t + a_1 n_(t-1) + … = e_t",
    ),
    (
        "noise_innovation_sd",
        Kind::Number,
        true,
        "standard deviation of e_t, in that quantity's unit",
    ),
    (
        "noise_samples",
        Kind::Count,
        true,
        "samples it was estimated from",
    ),
    (
        "corrections",
        Kind::Corrections,
        false,
        "sensor errors that were measured in the quiet part and taken out, in unit",
    ),
    (
        "torque_nm",
        Kind::Numbers,
        false,
        "joint torque [Nm], one value a sample",
    ),
    (
        "displacement_rad",
        Kind::Numbers,
        true,
        "angle [rad]; null where it is the trapezoid sum of the velocity",
    ),
    (
        "velocity_rad_per_s",
        Kind::Numbers,
        true,
        "angular velocity [rad/s]; null where it is the trapezoid sum of the acceleration",
    ),
    (
        "acceleration_rad_per_s2",
        Kind::Numbers,
        true,
        "angular acceleration [rad/s²]; null where it was not measured",
    ),
    (
        "grip_force_n",
        Kind::Numbers,
        true,
        "grip force [N]; null where it was not measured",
    ),
    (
        "integrated_from",
        Kind::Text,
        true,
        "acceleration or velocity: what is null of the motion below it are its trapezoid sums from 0",
    ),
    (
        "signals_crc32",
        Kind::Count,
        false,
        "CRC-32 of the signals' bytes, checked before every fit",
    ),
];

/// What was found of the data beside the rows.
pub(crate) const FINDINGS: &[Column] = &[
    (
        "source",
        Kind::Text,
        false,
        "SHA-256 of the measurement file's bytes (first 16 bytes, hexadecimal)",
    ),
    FILE,
    (
        "number",
        Kind::Count,
        true,
        "1-based number of the tightening; null where the whole file is meant",
    ),
    ("day", Kind::Day, true, "day; null where nothing says it"),
    TOOL,
    ("severity", Kind::Text, false, "note, repaired or left_out"),
    ("code", Kind::Text, false, "stable name of the kind"),
    ("channel", Kind::Text, true, "channel concerned"),
    (
        "message",
        Kind::Text,
        false,
        "what was found, what is allowed, what was done",
    ),
];

/// What a correction says.
pub(crate) const CORRECTION: &[Column] = &[
    (
        "effect",
        Kind::Text,
        false,
        "effect of the catalogue it corresponds to",
    ),
    (
        "constant_of",
        Kind::Text,
        true,
        "measured quantity whose constant error it is",
    ),
    ("value", Kind::Number, false, "what was subtracted, in unit"),
    ("standard_error", Kind::Number, false, "in unit"),
    ("unit", Kind::Text, false, "of value and standard error"),
    (
        "significant",
        Kind::Flag,
        false,
        "whether it differs from zero beyond chance",
    ),
];

impl Kind {
    pub(crate) fn data_type(self) -> DataType {
        let list = |kind| DataType::List(Arc::new(Field::new_list_field(kind, true)));
        match self {
            Self::Text => DataType::Utf8,
            Self::Texts => list(DataType::Utf8),
            Self::Day => DataType::Date32,
            Self::Count => DataType::UInt32,
            Self::Flag => DataType::Boolean,
            Self::Number => DataType::Float64,
            Self::Numbers => list(DataType::Float64),
            Self::Corrections => list(DataType::Struct(fields(CORRECTION))),
        }
    }
}

/// A column as a field that says what it is.
pub(crate) fn field(name: &str, kind: Kind, nullable: bool, told: &str) -> Field {
    let metadata = HashMap::from([("description".to_owned(), told.to_owned())]);
    Field::new(name, kind.data_type(), nullable).with_metadata(metadata)
}

/// Fields without anything said of them, as within a list.
pub(crate) fn fields(columns: &[Column]) -> Fields {
    let plain = |(name, kind, nullable, _): &Column| Field::new(*name, kind.data_type(), *nullable);
    columns.iter().map(plain).collect()
}

/// The schema of a table of these columns.
pub(crate) fn schema(table: &str, columns: impl IntoIterator<Item = Field>) -> SchemaRef {
    // One entry: several would stand in another order in every file, and the same rows would not have the same bytes.
    let told = format!("{SCHEMA_VERSION} {table}");
    let metadata = HashMap::from([("snug.schema_version".to_owned(), told)]);
    let fields: Fields = columns.into_iter().collect();
    Arc::new(Schema::new_with_metadata(fields, metadata))
}

fn described(columns: &[Column]) -> impl Iterator<Item = Field> + '_ {
    columns
        .iter()
        .map(|(name, kind, nullable, told)| field(name, *kind, *nullable, told))
}

/// The table `tightenings`.
pub fn tightenings() -> SchemaRef {
    schema(
        "tightenings",
        described(IDENTITY).chain(described(PREPARED)),
    )
}

/// The table `findings`.
pub fn findings() -> SchemaRef {
    schema("findings", described(FINDINGS))
}

/// The columns that a fit puts behind those of [`IDENTITY`].
pub(crate) fn identity() -> impl Iterator<Item = Field> {
    described(IDENTITY)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_column_stands_in_the_documentation() {
        let readme = include_str!("../../README.md");
        for (name, ..) in IDENTITY
            .iter()
            .chain(PREPARED)
            .chain(FINDINGS)
            .chain(CORRECTION)
        {
            assert!(readme.contains(&format!("`{name}`")), "{name}");
        }
    }
}
