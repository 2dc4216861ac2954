//! Columns to prepared tightenings.

use super::checksum;
use super::integrals::complete;
use arrow::array::{
    Array, AsArray, BooleanArray, Float64Array, ListArray, RecordBatch, StringArray, StructArray,
    UInt32Array,
};
use arrow::datatypes::{Date32Type, Float64Type, UInt32Type};
use arrow::error::ArrowError;
use snug_campaign::{
    Conditions, Correction, Motion, NoiseFloor, NoiseSource, Quantity, Rig, Tightening,
    TighteningId, TimeBase,
};
use snug_preprocess::{Prepared, ThesisChecks};

/// What a source of noise is called in a column.
pub(super) const SOURCES: [(NoiseSource, &str); 4] = [
    (NoiseSource::PreRoll, "pre_roll"),
    (NoiseSource::Repeats, "repeats"),
    (NoiseSource::Declared, "declared"),
    (NoiseSource::Residual, "residual"),
];

/// A batch whose columns are found by their names.
struct Columns<'a>(&'a RecordBatch);

impl<'a> Columns<'a> {
    fn column(&self, name: &str) -> Result<&'a dyn Array, ArrowError> {
        let found = self.0.column_by_name(name);
        let missing = || ArrowError::SchemaError(format!("there is no column {name}"));
        found.map(AsRef::as_ref).ok_or_else(missing)
    }

    fn texts(&self, name: &str) -> Result<&'a StringArray, ArrowError> {
        typed(name, self.column(name)?.as_string_opt())
    }

    fn numbers(&self, name: &str) -> Result<&'a Float64Array, ArrowError> {
        typed(name, self.column(name)?.as_primitive_opt::<Float64Type>())
    }

    fn counts(&self, name: &str) -> Result<&'a UInt32Array, ArrowError> {
        typed(name, self.column(name)?.as_primitive_opt::<UInt32Type>())
    }

    fn flags(&self, name: &str) -> Result<&'a BooleanArray, ArrowError> {
        typed(name, self.column(name)?.as_boolean_opt())
    }

    fn lists(&self, name: &str) -> Result<&'a ListArray, ArrowError> {
        typed(name, self.column(name)?.as_list_opt())
    }
}

fn typed<'a, T>(name: &str, column: Option<&'a T>) -> Result<&'a T, ArrowError> {
    column.ok_or_else(|| ArrowError::SchemaError(format!("column {name} is of another type")))
}

fn text(column: &StringArray, row: usize) -> Option<String> {
    column.is_valid(row).then(|| column.value(row).to_owned())
}

fn number(column: &Float64Array, row: usize) -> Option<f64> {
    column.is_valid(row).then(|| column.value(row))
}

fn count(column: &UInt32Array, row: usize) -> Option<usize> {
    column.is_valid(row).then(|| column.value(row) as usize)
}

fn list(column: &ListArray, row: usize) -> Result<Option<Vec<f64>>, ArrowError> {
    if column.is_null(row) {
        return Ok(None);
    }
    let values = column.value(row);
    let values = typed("of a list", values.as_primitive_opt::<Float64Type>())?;
    Ok(Some(values.values().to_vec()))
}

fn quantity(name: Option<String>) -> Result<Option<Quantity>, ArrowError> {
    let Some(name) = name else {
        return Ok(None);
    };
    let known = Quantity::ALL
        .into_iter()
        .find(|quantity| quantity.name() == name);
    let unknown = || ArrowError::SchemaError(format!("{name:?} is no measured quantity"));
    known.map(Some).ok_or_else(unknown)
}

/// Identities of a batch's rows.
fn ids(batch: &RecordBatch) -> Result<Vec<TighteningId>, ArrowError> {
    let columns = Columns(batch);
    let (files, numbers) = (columns.texts("file")?, columns.counts("number")?);
    let id = |row| TighteningId {
        file: files.value(row).to_owned(),
        number: numbers.value(row),
    };
    Ok((0..batch.num_rows()).map(id).collect())
}

/// Names of the files that rows are known by where many days of many tools are asked together, one for every row: those that `name`
/// gives to its tool and its day (days since 1970-01-01, `None` for an unknown day).
///
/// # Errors
/// A column that is missing or of another type.
pub(crate) fn names_of(
    batch: &RecordBatch,
    name: &dyn Fn(&str, Option<i32>) -> String,
) -> Result<Vec<String>, ArrowError> {
    let columns = Columns(batch);
    let days = typed(
        "day",
        columns.column("day")?.as_primitive_opt::<Date32Type>(),
    )?;
    let tools = columns.texts("tool")?;
    let day = |row: usize| days.is_valid(row).then(|| days.value(row));
    Ok((0..batch.num_rows())
        .map(|row| name(tools.value(row), day(row)))
        .collect())
}

/// Tightenings of which only conditions and target torque are known, of a batch that has these columns.
///
/// # Errors
/// A column that is missing or of another type.
pub(crate) fn conditions(batch: &RecordBatch) -> Result<Vec<Tightening>, ArrowError> {
    let columns = Columns(batch);
    let [participants, strategies, joints] =
        ["participant", "strategy", "joint"].map(|name| columns.texts(name));
    let (participants, strategies, joints) = (participants?, strategies?, joints?);
    let paces = columns.numbers("pace_per_min")?;
    let targets = columns.numbers("target_torque_nm")?;
    let rig = Rig {
        lever_arm_m: 1.0,
        known_inertia_kg_m2: 0.0,
    };
    let of_row = |row: usize| {
        let mut one = Tightening::from_torque(rig, 1.0, Vec::new());
        one.conditions = Conditions {
            participant: text(participants, row),
            strategy: text(strategies, row),
            joint: text(joints, row),
            pace_per_min: number(paces, row),
        };
        one.target_torque_nm = targets.value(row);
        one
    };
    Ok((0..batch.num_rows()).map(of_row).collect())
}

/// The prepared tightenings of a batch that has the columns of the table `tightenings`, but for key, day, tool and station.
///
/// # Errors
/// A column that is missing or of another type, and signals whose checksum is not the stored one.
pub(crate) fn prepared(batch: &RecordBatch) -> Result<Vec<Prepared>, ArrowError> {
    let columns = Columns(batch);
    let ids = ids(batch)?;
    let noises = noises(&columns, batch.num_rows())?;
    let [participants, strategies, joints] =
        ["participant", "strategy", "joint"].map(|name| columns.texts(name));
    let (participants, strategies, joints) = (participants?, strategies?, joints?);
    let number_of =
        |name: &'static str, row: usize| Ok::<_, ArrowError>(columns.numbers(name)?.value(row));
    let count_of = |name: &'static str, row| Ok::<_, ArrowError>(count(columns.counts(name)?, row));
    let rejects = columns.flags("data_quality_rejects")?;
    let paces = columns.numbers("pace_per_min")?;
    let mut all = Vec::with_capacity(batch.num_rows());
    for ((row, id), noise) in ids.into_iter().enumerate().zip(noises) {
        let time_base = TimeBase {
            start_s: number_of("start_s", row)?,
            interval_s: number_of("interval_s", row)?,
        };
        let tightening = Tightening {
            conditions: Conditions {
                participant: text(participants, row),
                strategy: text(strategies, row),
                joint: text(joints, row),
                pace_per_min: number(paces, row),
            },
            rig: Rig {
                lever_arm_m: number_of("lever_arm_m", row)?,
                known_inertia_kg_m2: number_of("known_inertia_kg_m2", row)?,
            },
            torque_nm: list(columns.lists("torque_nm")?, row)?.unwrap_or_default(),
            motion: motion(&columns, row, time_base.interval_s)?,
            grip_force_n: list(columns.lists("grip_force_n")?, row)?,
            peak_torque_nm: number_of("peak_torque_nm", row)?,
            target_torque_nm: number_of("target_torque_nm", row)?,
            onset: count_of("onset_sample", row)?,
            corrections: corrections(columns.lists("corrections")?, row)?,
            time_base,
            noise,
            id,
        };
        check(&tightening, columns.counts("signals_crc32")?.value(row))?;
        all.push(Prepared {
            tightening,
            thesis_checks: thesis_checks(&columns, row)?,
            zero_sample: count_of("zero_sample", row)?,
            data_quality_rejects: rejects.value(row),
        });
    }
    Ok(all)
}

fn check(tightening: &Tightening, stored: u32) -> Result<(), ArrowError> {
    let found = checksum(tightening);
    if found == stored {
        return Ok(());
    }
    Err(ArrowError::ComputeError(format!(
        "{}: its signals have the checksum {found:08x}, stored is {stored:08x}; the file is damaged",
        tightening.id
    )))
}

fn motion(columns: &Columns<'_>, row: usize, interval_s: f64) -> Result<Motion, ArrowError> {
    let mut motion = Motion {
        displacement_rad: list(columns.lists("displacement_rad")?, row)?,
        velocity_rad_per_s: list(columns.lists("velocity_rad_per_s")?, row)?,
        acceleration_rad_per_s2: list(columns.lists("acceleration_rad_per_s2")?, row)?,
    };
    if let Some(from) = quantity(text(columns.texts("integrated_from")?, row))? {
        complete(&mut motion, from, interval_s);
    }
    Ok(motion)
}

fn thesis_checks(columns: &Columns<'_>, row: usize) -> Result<Option<ThesisChecks>, ArrowError> {
    let (up, down) = (columns.flags("goes_up")?, columns.flags("goes_down")?);
    Ok(up.is_valid(row).then(|| ThesisChecks {
        goes_up: up.value(row),
        goes_down: down.value(row),
    }))
}

fn noises(columns: &Columns<'_>, rows: usize) -> Result<Vec<Option<NoiseFloor>>, ArrowError> {
    let (sources, quantities) = (
        columns.texts("noise_source")?,
        columns.texts("noise_quantity")?,
    );
    let deviations = columns.numbers("noise_standard_deviation")?;
    let autoregressions = columns.lists("noise_autoregression")?;
    let innovations = columns.numbers("noise_innovation_sd")?;
    let samples = columns.counts("noise_samples")?;
    let noise = |row| {
        let (Some(name), Some(quantity)) = (text(sources, row), quantity(text(quantities, row))?)
        else {
            return Ok(None);
        };
        let known = SOURCES.iter().find(|(_, known)| *known == name);
        let unknown = || ArrowError::SchemaError(format!("{name:?} is no source of noise"));
        Ok(Some(NoiseFloor {
            source: known.ok_or_else(unknown)?.0,
            quantity,
            standard_deviation: deviations.value(row),
            autoregression: list(autoregressions, row)?.unwrap_or_default(),
            innovation_sd: innovations.value(row),
            samples: samples.value(row) as usize,
        }))
    };
    (0..rows).map(noise).collect()
}

fn corrections(column: &ListArray, row: usize) -> Result<Vec<Correction>, ArrowError> {
    let items = column.value(row);
    let items: &StructArray = typed("corrections", items.as_struct_opt())?;
    let column = |name: &str| {
        let missing = || ArrowError::SchemaError(format!("corrections have no field {name}"));
        items.column_by_name(name).ok_or_else(missing)
    };
    let texts = |name: &str| typed(name, column(name)?.as_string_opt::<i32>());
    let numbers = |name: &str| typed(name, column(name)?.as_primitive_opt::<Float64Type>());
    let (effects, units) = (texts("effect")?, texts("unit")?);
    let (constants, significant) = (
        texts("constant_of")?,
        typed("significant", column("significant")?.as_boolean_opt())?,
    );
    let (values, errors) = (numbers("value")?, numbers("standard_error")?);
    let correction = |item| {
        Ok(Correction {
            effect: effects.value(item).to_owned(),
            constant_of: quantity(text(constants, item))?,
            value: values.value(item),
            standard_error: errors.value(item),
            unit: units.value(item).to_owned(),
            significant: significant.value(item),
        })
    };
    (0..items.len()).map(correction).collect()
}
