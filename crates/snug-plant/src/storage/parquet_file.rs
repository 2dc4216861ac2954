//! One Parquet file in memory: written whole, read back whole.

use crate::error::PlantError;
use arrow::array::RecordBatch;
use arrow::datatypes::{DataType, Schema, SchemaRef};
#[cfg(test)]
use bytes::Bytes;
use parquet::arrow::ArrowWriter;
#[cfg(test)]
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use parquet::basic::{Compression, Encoding, ZstdLevel};
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::schema::types::ColumnPath;

/// Rows of a row group that holds signals: at 3000 samples of two channels some 12 MB, what one reader holds at a time.
pub const ROWS_WITH_SIGNALS: usize = 256;

/// Rows of a row group that holds none.
const ROWS_WITHOUT_SIGNALS: usize = 65_536;

/// Of zstd, for signals and all else. Chosen: level 6 takes three times as long for 2 % less.
const LEVEL: i32 = 3;

/// A file of `batches`, which have one schema.
pub fn written(
    object: &str,
    schema: &SchemaRef,
    batches: &[RecordBatch],
) -> Result<Vec<u8>, PlantError> {
    let failed = PlantError::parquet(object);
    let mut bytes = Vec::new();
    let properties = properties(schema).map_err(&failed)?;
    let mut writer =
        ArrowWriter::try_new(&mut bytes, schema.clone(), Some(properties)).map_err(&failed)?;
    for batch in batches {
        writer.write(batch).map_err(&failed)?;
    }
    writer.close().map_err(&failed)?;
    Ok(bytes)
}

fn properties(schema: &Schema) -> Result<WriterProperties, parquet::errors::ParquetError> {
    let is_signal = |kind: &DataType| matches!(kind, DataType::List(item) if item.data_type() == &DataType::Float64);
    let has_signals = schema
        .fields()
        .iter()
        .any(|field| is_signal(field.data_type()));
    let rows = if has_signals {
        ROWS_WITH_SIGNALS
    } else {
        ROWS_WITHOUT_SIGNALS
    };
    let told = schema.metadata().iter();
    let told = told.map(|(key, value)| KeyValue::new(key.clone(), value.clone()));
    let mut builder = WriterProperties::builder()
        .set_compression(Compression::ZSTD(ZstdLevel::try_new(LEVEL)?))
        .set_max_row_group_row_count(Some(rows))
        .set_key_value_metadata(Some(told.collect()));
    for field in schema
        .fields()
        .iter()
        .filter(|field| is_signal(field.data_type()))
    {
        let parts = [field.name().as_str(), "list", "item"].map(str::to_owned);
        let column = ColumnPath::new(parts.to_vec());
        // The bytes of equal weight stand together: those below a float's precision are zeros, and go.
        builder = builder
            .set_column_dictionary_enabled(column.clone(), false)
            .set_column_statistics_enabled(column.clone(), EnabledStatistics::None)
            .set_column_encoding(column, Encoding::BYTE_STREAM_SPLIT);
    }
    Ok(builder.build())
}

/// Everything that a file holds.
#[cfg(test)]
pub fn read(object: &str, bytes: Bytes) -> Result<Vec<RecordBatch>, PlantError> {
    let failed = PlantError::parquet(object);
    let reader = ParquetRecordBatchReaderBuilder::try_new(bytes).map_err(&failed)?;
    let reader = reader.build().map_err(&failed)?;
    reader
        .collect::<Result<_, _>>()
        .map_err(PlantError::columns(object))
}
