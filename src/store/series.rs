//! Time series and profiles: one file per table of a run.
//!
//! The name of a file ends in the start of its own BLAKE3 sum. A run that is done again never
//! overwrites a file that a row in the store refers to; and a file says by itself if it is whole.

use std::collections::BTreeSet;
use std::path::Path;

use arrow::array::RecordBatch;
use serde::{Deserialize, Serialize};

use super::cells::{Reader, numbers, texts};
use super::error::StoreError;
use super::file::{self, Series};
use super::manifest::sum;
use super::model::{Column, PointId, Table};

const ROLE: &str = "series";

/// Where a table of a run is kept, and what it holds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct TableFile {
    pub name: String,
    /// Inside the store; `None` for a table without columns, which has no file.
    pub path: Option<String>,
    /// BLAKE3 of the file.
    pub hash: String,
    /// Names and units.
    pub columns: Vec<(String, String)>,
}

/// `NAME-SUM.parquet`, with enough of the sum to tell contents apart.
pub(super) fn file_name(folder: &str, name: &str, hash: &str) -> String {
    format!("{folder}/{name}-{}.parquet", &hash[..16])
}

/// Whether the name of a file carries the start of this sum.
pub(super) fn name_fits(path: &str, hash: &str) -> bool {
    path.ends_with(&format!("-{}.parquet", &hash[..16]))
}

/// The bytes of a table and the file it belongs in.
pub(super) fn encode(id: &PointId, table: &Table) -> Result<(TableFile, Vec<u8>), StoreError> {
    check(table)?;
    let columns = table
        .columns
        .iter()
        .map(|column| (column.name.clone(), column.unit.clone()));
    let mut place = TableFile {
        name: table.name.clone(),
        path: None,
        hash: String::new(),
        columns: columns.collect(),
    };
    if table.columns.is_empty() {
        return Ok((place, Vec::new()));
    }
    let length = table.columns[0].values.len();
    let ids = texts(std::iter::repeat_n(Some(&id.0), length));
    let mut all = vec![Series::new("id", "identity", "id", None, ids)];
    all.extend(table.columns.iter().map(|column| {
        let values = numbers(column.values.iter().copied().map(Some));
        Series::new(&column.name, ROLE, &column.name, Some(&column.unit), values)
    }));
    let bytes = file::encode(&file::batch(all)?)?;
    place.hash = sum(&bytes);
    place.path = Some(match table.name.as_str() {
        "time_series" => file_name("series", &id.0, &place.hash),
        profile => file_name("profiles", &format!("{}-{profile}", id.0), &place.hash),
    });
    Ok((place, bytes))
}

fn check(table: &Table) -> Result<(), StoreError> {
    if !is_file_name(&table.name) {
        return Err(StoreError::invalid(format!(
            "`{}` cannot name a table",
            table.name
        )));
    }
    let mut names = BTreeSet::from(["id"]);
    let length = table.columns.first().map_or(0, |column| column.values.len());
    for column in &table.columns {
        let place = format!("column `{}` of table `{}`", column.name, table.name);
        if !names.insert(&column.name) {
            return Err(StoreError::invalid(format!("{place} has a name that is taken")));
        }
        if column.values.len() != length {
            let found = column.values.len();
            return Err(StoreError::invalid(format!(
                "{place} has {found} values, the first has {length}"
            )));
        }
    }
    Ok(())
}

/// Letters, digits, `_`, `-` and `.`, not starting with a dot.
pub(super) fn is_file_name(text: &str) -> bool {
    let plain = |byte: u8| byte.is_ascii_alphanumeric() || b"_-.".contains(&byte);
    !text.is_empty() && !text.starts_with('.') && text.bytes().all(plain)
}

/// Reads a table back. The caller has compared the sum of the file.
pub(super) fn decode(
    place: &TableFile,
    root: impl Fn(&str) -> std::path::PathBuf,
) -> Result<Table, StoreError> {
    let mut table = Table {
        name: place.name.clone(),
        columns: Vec::new(),
    };
    if let Some(name) = &place.path {
        let path = root(name);
        let batch = file::decode(Path::new(&path), name)?;
        for (column, unit) in &place.columns {
            table.columns.push(read_column(&batch, name, column, unit)?);
        }
    }
    Ok(table)
}

fn read_column(batch: &RecordBatch, file: &str, name: &str, unit: &str) -> Result<Column, StoreError> {
    let reader = Reader { batch, file };
    let found = reader.find(ROLE, name, Some(unit))?;
    let values = (0..batch.num_rows()).map(|row| reader.number_of(found, name, row));
    Ok(Column {
        name: name.to_string(),
        unit: unit.to_string(),
        values: values.collect::<Result<_, _>>()?,
    })
}
