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

/// A column of lists of numbers.
struct Numbers<'a> {
    lists: &'a ListArray,
    values: &'a [f64],
}

impl<'a> Numbers<'a> {
    fn of(lists: &'a ListArray) -> Result<Self, ArrowError> {
        let values = lists.values().as_primitive_opt::<Float64Type>();
        let values = typed("of a list", values)?.values();
        Ok(Self { lists, values })
    }

    /// The list of a row; `None` where there is none.
    fn row(&self, row: usize) -> Option<&'a [f64]> {
        let offsets = self.lists.value_offsets();
        let range = offsets[row] as usize..offsets[row + 1] as usize;
        self.lists.is_valid(row).then(|| &self.values[range])
    }
}

/// What is found under each of some names.
fn each<T, const N: usize>(
    names: [&str; N],
    find: impl FnMut(&str) -> Result<T, ArrowError>,
) -> Result<[T; N], ArrowError> {
    let found = names.into_iter().map(find).collect::<Result<Vec<T>, _>>()?;
    let found = <[T; N]>::try_from(found);
    Ok(found.unwrap_or_else(|_| unreachable!("there are as many as names")))
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
    let targets = columns.numbers("target_torque_nm")?;
    let rig = Rig {
        lever_arm_m: 1.0,
        known_inertia_kg_m2: 0.0,
    };
    let of_row = |(row, conditions)| {
        let mut one = Tightening::from_torque(rig, 1.0, Vec::new());
        one.conditions = conditions;
        one.target_torque_nm = targets.value(row);
        one
    };
    let conditions = conditions_of(&columns, batch.num_rows())?;
    Ok(conditions.into_iter().enumerate().map(of_row).collect())
}

fn conditions_of(columns: &Columns<'_>, rows: usize) -> Result<Vec<Conditions>, ArrowError> {
    let names = ["participant", "strategy", "joint"];
    let [participants, strategies, joints] = each(names, |name| columns.texts(name))?;
    let paces = columns.numbers("pace_per_min")?;
    let of_row = |row| Conditions {
        participant: text(participants, row),
        strategy: text(strategies, row),
        joint: text(joints, row),
        pace_per_min: number(paces, row),
    };
    Ok((0..rows).map(of_row).collect())
}

/// The prepared tightenings of a batch that has the columns of the table `tightenings`, but for key, day, tool and station.
///
/// # Errors
/// A column that is missing or of another type, and signals whose checksum is not the stored one.
pub(crate) fn prepared(batch: &RecordBatch) -> Result<Vec<Prepared>, ArrowError> {
    let columns = Columns(batch);
    let signals = Signals::of(&columns)?;
    let numbers = [
        "start_s",
        "interval_s",
        "lever_arm_m",
        "known_inertia_kg_m2",
        "peak_torque_nm",
        "target_torque_nm",
    ];
    let numbers = each(numbers, |name| columns.numbers(name))?;
    let [onsets, zeros, checksums] =
        each(["onset_sample", "zero_sample", "signals_crc32"], |name| {
            columns.counts(name)
        })?;
    let [rejects, up, down] = each(["data_quality_rejects", "goes_up", "goes_down"], |name| {
        columns.flags(name)
    })?;
    let taken_out = columns.lists("corrections")?;
    let noises = noises(&columns, batch.num_rows())?;
    let conditions = conditions_of(&columns, batch.num_rows())?;
    let known = ids(batch)?.into_iter().zip(noises).zip(conditions);
    let mut all = Vec::with_capacity(batch.num_rows());
    for (row, ((id, noise), conditions)) in known.enumerate() {
        let [
            start_s,
            interval_s,
            lever_arm_m,
            known_inertia_kg_m2,
            peak,
            target,
        ] = numbers.map(|column| column.value(row));
        let tightening = Tightening {
            torque_nm: signals.torque.row(row).unwrap_or_default().to_vec(),
            motion: signals.motion(row, interval_s)?,
            grip_force_n: signals.force.row(row).map(<[f64]>::to_vec),
            rig: Rig {
                lever_arm_m,
                known_inertia_kg_m2,
            },
            time_base: TimeBase {
                start_s,
                interval_s,
            },
            peak_torque_nm: peak,
            target_torque_nm: target,
            onset: count(onsets, row),
            corrections: corrections(taken_out, row)?,
            conditions,
            noise,
            id,
        };
        check(&tightening, checksums.value(row))?;
        all.push(Prepared {
            tightening,
            thesis_checks: up.is_valid(row).then(|| ThesisChecks {
                goes_up: up.value(row),
                goes_down: down.value(row),
            }),
            zero_sample: count(zeros, row),
            data_quality_rejects: rejects.value(row),
        });
    }
    Ok(all)
}

/// The columns of signals.
struct Signals<'a> {
    torque: Numbers<'a>,
    displacement: Numbers<'a>,
    velocity: Numbers<'a>,
    acceleration: Numbers<'a>,
    force: Numbers<'a>,
    integrated_from: &'a StringArray,
}

impl<'a> Signals<'a> {
    fn of(columns: &Columns<'a>) -> Result<Self, ArrowError> {
        let names = [
            "torque_nm",
            "displacement_rad",
            "velocity_rad_per_s",
            "acceleration_rad_per_s2",
            "grip_force_n",
        ];
        let [torque, displacement, velocity, acceleration, force] =
            each(names, |name| Numbers::of(columns.lists(name)?))?;
        Ok(Self {
            torque,
            displacement,
            velocity,
            acceleration,
            force,
            integrated_from: columns.texts("integrated_from")?,
        })
    }

    fn motion(&self, row: usize, interval_s: f64) -> Result<Motion, ArrowError> {
        let own = |column: &Numbers<'_>| column.row(row).map(<[f64]>::to_vec);
        let mut motion = Motion {
            displacement_rad: own(&self.displacement),
            velocity_rad_per_s: own(&self.velocity),
            acceleration_rad_per_s2: own(&self.acceleration),
        };
        if let Some(from) = quantity(text(self.integrated_from, row))? {
            complete(&mut motion, from, interval_s);
        }
        Ok(motion)
    }
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

fn noises(columns: &Columns<'_>, rows: usize) -> Result<Vec<Option<NoiseFloor>>, ArrowError> {
    let (sources, quantities) = (
        columns.texts("noise_source")?,
        columns.texts("noise_quantity")?,
    );
    let deviations = columns.numbers("noise_standard_deviation")?;
    let autoregressions = Numbers::of(columns.lists("noise_autoregression")?)?;
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
            autoregression: autoregressions.row(row).unwrap_or_default().to_vec(),
            innovation_sd: innovations.value(row),
            samples: samples.value(row) as usize,
        }))
    };
    (0..rows).map(noise).collect()
}

fn corrections(column: &ListArray, row: usize) -> Result<Vec<Correction>, ArrowError> {
    if column.is_null(row) || column.value_length(row) == 0 {
        return Ok(Vec::new());
    }
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
