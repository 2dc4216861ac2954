//! Tightenings as rows: every field of a prepared tightening in columns, and back with the same bits.

mod decode;
mod encode;
mod integrals;

pub(crate) use decode::{conditions, names_of, prepared};
pub use encode::batch;

use arrow::array::RecordBatch;
use arrow::compute::{SortColumn, lexsort_to_indices, take_record_batch};
#[cfg(target_endian = "little")]
use arrow::datatypes::ToByteSlice;
use arrow::error::ArrowError;
use snug_campaign::{Quantity, Tightening};
use snug_preprocess::Prepared;

/// A prepared tightening with what no measurement file says of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Digest of the measurement file's bytes.
    pub source: String,
    /// Name of the station.
    pub station: Option<String>,
    /// When the file's recording began, since midnight \[s\].
    pub time_of_day_s: Option<f64>,
    /// The tightening.
    pub prepared: Prepared,
}

impl Row {
    /// The key by which the row is known: the same tightening of the same file has the same.
    pub fn key(&self) -> String {
        format!("{}-{}", self.source, self.prepared.tightening.id.number)
    }
}

/// Rows in the order of these columns, the first counting most.
pub(crate) fn sorted(rows: &RecordBatch, by: &[&str]) -> Result<RecordBatch, ArrowError> {
    let columns = by.iter().filter_map(|name| rows.column_by_name(name));
    let columns = columns.map(|values| SortColumn {
        values: values.clone(),
        options: None,
    });
    let order = lexsort_to_indices(&columns.collect::<Vec<_>>(), None)?;
    take_record_batch(rows, &order)
}

/// CRC-32 of a tightening's signals: of each its length and its values, in the byte order of little-endian machines.
pub(crate) fn checksum(tightening: &Tightening) -> u32 {
    let motion = Quantity::ALL.map(|quantity| tightening.motion.get(quantity).unwrap_or(&[]));
    let force = tightening.grip_force_n.as_deref().unwrap_or(&[]);
    let mut hasher = crc32fast::Hasher::new();
    for signal in [&tightening.torque_nm[..]]
        .into_iter()
        .chain(motion)
        .chain([force])
    {
        hasher.update(&(signal.len() as u64).to_le_bytes());
        #[cfg(target_endian = "little")]
        hasher.update(signal.to_byte_slice());
        #[cfg(target_endian = "big")]
        for value in signal {
            hasher.update(&value.to_le_bytes());
        }
    }
    hasher.finalize()
}

#[cfg(test)]
mod tests;
