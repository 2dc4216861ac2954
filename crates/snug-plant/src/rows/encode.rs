//! Rows to columns.

use super::integrals::{follows, integrated_from};
use super::{Row, checksum};
use crate::error::PlantError;
use crate::storage::partition::Partition;
use crate::storage::schema::{self, CORRECTION};
use arrow::array::{
    Array, ArrayRef, BooleanArray, Date32Array, Float64Array, Float64Builder, ListArray,
    ListBuilder, RecordBatch, StringArray, StructArray, UInt32Array,
};
use arrow::buffer::OffsetBuffer;
use arrow::datatypes::Field;
use snug_campaign::{Correction, NoiseFloor, Quantity, Tightening};
use std::sync::Arc;

/// The rows of one partition as a batch of the table `tightenings`.
///
/// # Errors
/// [`PlantError::Columns`] where rows have no such form.
pub fn batch(partition: &Partition, rows: &[Row]) -> Result<RecordBatch, PlantError> {
    let mut columns = identity(partition, rows);
    columns.extend(prepared(rows));
    RecordBatch::try_new(schema::tightenings(), columns)
        .map_err(PlantError::columns(&partition.to_string()))
}

fn texts<'a>(values: impl Iterator<Item = Option<&'a str>>) -> ArrayRef {
    Arc::new(values.collect::<StringArray>())
}

fn numbers(values: impl Iterator<Item = Option<f64>>) -> ArrayRef {
    Arc::new(values.collect::<Float64Array>())
}

fn counts(values: impl Iterator<Item = Option<u32>>) -> ArrayRef {
    Arc::new(values.collect::<UInt32Array>())
}

fn flags(values: impl Iterator<Item = Option<bool>>) -> ArrayRef {
    Arc::new(values.collect::<BooleanArray>())
}

fn lists<'a>(values: impl Iterator<Item = Option<&'a [f64]>>) -> ArrayRef {
    let mut lists = ListBuilder::new(Float64Builder::new());
    for value in values {
        match value {
            Some(value) => {
                lists.values().append_slice(value);
                lists.append(true);
            }
            None => lists.append(false),
        }
    }
    Arc::new(lists.finish())
}

/// Samples and counts: none of a window comes near the end of what fits.
fn count(value: usize) -> u32 {
    u32::try_from(value).unwrap_or(u32::MAX)
}

fn identity(partition: &Partition, rows: &[Row]) -> Vec<ArrayRef> {
    let all = || rows.iter().map(|row| &row.prepared.tightening);
    let keys: Vec<String> = rows.iter().map(Row::key).collect();
    let days: Date32Array = rows.iter().map(|_| partition.days()).collect();
    vec![
        texts(keys.iter().map(|key| Some(key.as_str()))),
        texts(all().map(|one| Some(one.id.file.as_str()))),
        counts(all().map(|one| Some(one.id.number))),
        Arc::new(days),
        texts(rows.iter().map(|_| Some(partition.tool.as_str()))),
        texts(rows.iter().map(|row| row.station.as_deref())),
        numbers(rows.iter().map(|row| row.time_of_day_s)),
        texts(all().map(|one| one.conditions.participant.as_deref())),
        texts(all().map(|one| one.conditions.strategy.as_deref())),
        texts(all().map(|one| one.conditions.joint.as_deref())),
        numbers(all().map(|one| one.conditions.pace_per_min)),
        numbers(all().map(|one| Some(one.peak_torque_nm))),
        numbers(all().map(|one| Some(one.target_torque_nm))),
    ]
}

fn prepared(rows: &[Row]) -> Vec<ArrayRef> {
    let all = || rows.iter().map(|row| &row.prepared.tightening);
    let from: Vec<Option<Quantity>> = all()
        .map(|one| integrated_from(&one.motion, one.time_base.interval_s))
        .collect();
    let motion = |quantity: Quantity| {
        lists(
            all()
                .zip(&from)
                .map(|(one, from)| match follows(*from, quantity) {
                    true => None,
                    false => one.motion.get(quantity),
                }),
        )
    };
    let checks = |read: fn(&snug_preprocess::ThesisChecks) -> bool| {
        flags(
            rows.iter()
                .map(|row| row.prepared.thesis_checks.as_ref().map(read)),
        )
    };
    let mut columns = vec![
        numbers(all().map(|one| Some(one.rig.lever_arm_m))),
        numbers(all().map(|one| Some(one.rig.known_inertia_kg_m2))),
        numbers(all().map(|one| Some(one.time_base.start_s))),
        numbers(all().map(|one| Some(one.time_base.interval_s))),
        counts(all().map(|one| Some(count(one.torque_nm.len())))),
        counts(all().map(|one| one.onset.map(count))),
        counts(rows.iter().map(|row| row.prepared.zero_sample.map(count))),
        checks(|checks| checks.goes_up),
        checks(|checks| checks.goes_down),
        flags(
            rows.iter()
                .map(|row| Some(row.prepared.data_quality_rejects)),
        ),
    ];
    columns.extend(noise(
        &all().map(|one| one.noise.as_ref()).collect::<Vec<_>>(),
    ));
    columns.push(corrections(&all().collect::<Vec<_>>()));
    columns.extend([
        lists(all().map(|one| Some(one.torque_nm.as_slice()))),
        motion(Quantity::Displacement),
        motion(Quantity::Velocity),
        motion(Quantity::Acceleration),
        lists(all().map(|one| one.grip_force_n.as_deref())),
        texts(from.iter().map(|from| from.map(Quantity::name))),
        counts(all().map(|one| Some(checksum(one)))),
    ]);
    columns
}

fn noise(all: &[Option<&NoiseFloor>]) -> [ArrayRef; 6] {
    let each = || all.iter().copied();
    [
        texts(each().map(|one| one.map(|noise| super::decode::SOURCES[noise.source as usize].1))),
        texts(each().map(|one| one.map(|noise| noise.quantity.name()))),
        numbers(each().map(|one| one.map(|noise| noise.standard_deviation))),
        lists(each().map(|one| one.map(|noise| noise.autoregression.as_slice()))),
        numbers(each().map(|one| one.map(|noise| noise.innovation_sd))),
        counts(each().map(|one| one.map(|noise| count(noise.samples)))),
    ]
}

fn corrections(all: &[&Tightening]) -> ArrayRef {
    let each = || all.iter().flat_map(|one| &one.corrections);
    let text = |read: fn(&Correction) -> Option<&str>| texts(each().map(read));
    let number = |read: fn(&Correction) -> f64| numbers(each().map(|one| Some(read(one))));
    let fields = schema::fields(CORRECTION);
    let columns = vec![
        text(|one| Some(&one.effect)),
        text(|one| one.constant_of.map(Quantity::name)),
        number(|one| one.value),
        number(|one| one.standard_error),
        text(|one| Some(&one.unit)),
        flags(each().map(|one| Some(one.significant))),
    ];
    let items = StructArray::new(fields, columns, None);
    let lengths = all.iter().map(|one| one.corrections.len());
    let item = Arc::new(Field::new_list_field(items.data_type().clone(), true));
    let offsets = OffsetBuffer::from_lengths(lengths);
    Arc::new(ListArray::new(item, offsets, Arc::new(items), None))
}
