//! One Parquet file to and from bytes: always the same bytes for the same content.

use std::collections::BTreeMap;
use std::fs::File;
use std::path::Path;
use std::sync::Arc;

use arrow::array::{ArrayRef, RecordBatch};
use arrow::compute::concat_batches;
use arrow::datatypes::{DataType, Field, Schema};
use parquet::arrow::ArrowWriter;
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use parquet::basic::{Compression, Encoding, ZstdLevel};
use parquet::file::properties::WriterProperties;
use parquet::schema::types::ColumnPath;

use super::error::StoreError;

/// Keys of a column's metadata.
pub(super) const UNIT: &str = "unit";
pub(super) const ROLE: &str = "role";
pub(super) const NAME: &str = "name";

/// A column about to be written.
pub(super) struct Series {
    pub field: Field,
    pub values: ArrayRef,
}

impl Series {
    /// A column whose metadata says what it is: its role, its own name and its unit.
    pub fn new(column: &str, role: &str, name: &str, unit: Option<&str>, values: ArrayRef) -> Series {
        let mut metadata = BTreeMap::from([
            (ROLE.to_string(), role.to_string()),
            (NAME.to_string(), name.to_string()),
        ]);
        if let Some(unit) = unit {
            metadata.insert(UNIT.to_string(), unit.to_string());
        }
        let field = Field::new(column, values.data_type().clone(), true).with_metadata(metadata);
        Series { field, values }
    }
}

pub(super) fn batch(columns: Vec<Series>) -> Result<RecordBatch, StoreError> {
    let (fields, values): (Vec<Field>, Vec<ArrayRef>) = columns
        .into_iter()
        .map(|column| (column.field, column.values))
        .unzip();
    RecordBatch::try_new(Arc::new(Schema::new(fields)), values)
        .map_err(|error| StoreError::invalid(error.to_string()))
}

/// Zstd throughout; doubles split by byte, which compresses smooth series several times better.
pub(super) fn encode(batch: &RecordBatch) -> Result<Vec<u8>, StoreError> {
    let level = ZstdLevel::try_new(3).map_err(|error| StoreError::invalid(error.to_string()))?;
    let mut properties = WriterProperties::builder().set_compression(Compression::ZSTD(level));
    for field in batch.schema().fields() {
        if field.data_type() == &DataType::Float64 {
            let column = ColumnPath::new(vec![field.name().clone()]);
            properties = properties
                .set_column_dictionary_enabled(column.clone(), false)
                .set_column_encoding(column, Encoding::BYTE_STREAM_SPLIT);
        }
    }
    let write = || -> parquet::errors::Result<Vec<u8>> {
        let mut bytes = Vec::new();
        let mut writer = ArrowWriter::try_new(&mut bytes, batch.schema(), Some(properties.build()))?;
        writer.write(batch)?;
        writer.close()?;
        Ok(bytes)
    };
    write().map_err(|error| StoreError::invalid(error.to_string()))
}

/// Reads a whole file. `name` is what an error calls it.
pub(super) fn decode(path: &Path, name: &str) -> Result<RecordBatch, StoreError> {
    let file = File::open(path).map_err(|error| StoreError::io("read", path, error))?;
    let read = || -> Result<RecordBatch, Box<dyn std::error::Error>> {
        let reader = ParquetRecordBatchReaderBuilder::try_new(file)?.build()?;
        let schema = arrow::array::RecordBatchReader::schema(&reader);
        let batches = reader.collect::<Result<Vec<_>, _>>()?;
        Ok(concat_batches(&schema, &batches)?)
    };
    read().map_err(|error| StoreError::damaged(name, format!("not a readable Parquet file: {error}")))
}
