//! Values of mixed kinds to typed columns, and columns back to values.

use std::sync::Arc;

use arrow::array::{
    Array, ArrayRef, AsArray, BooleanArray, Float64Array, Int64Array, RecordBatch, StringArray, UInt64Array,
};
use arrow::datatypes::{Float64Type, UInt64Type};

use super::error::StoreError;
use super::file::{NAME, ROLE, UNIT};

/// A value of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Cell {
    Number(f64),
    Integer(i64),
    Flag(bool),
    Text(String),
}

/// The narrowest column that holds every cell: whole numbers, numbers, flags, else text.
pub(super) fn typed(cells: &[Option<Cell>]) -> ArrayRef {
    let all = |fits: fn(&Cell) -> bool| cells.iter().flatten().all(fits);
    if all(|cell| matches!(cell, Cell::Integer(_))) {
        return Arc::new(Int64Array::from_iter(cells.iter().map(|cell| match cell {
            Some(Cell::Integer(value)) => Some(*value),
            _ => None,
        })));
    }
    if all(|cell| matches!(cell, Cell::Integer(_) | Cell::Number(_))) {
        return Arc::new(Float64Array::from_iter(cells.iter().map(|cell| match cell {
            Some(Cell::Integer(value)) => Some(*value as f64),
            Some(Cell::Number(value)) => Some(*value),
            _ => None,
        })));
    }
    if all(|cell| matches!(cell, Cell::Flag(_))) {
        return Arc::new(BooleanArray::from_iter(cells.iter().map(|cell| match cell {
            Some(Cell::Flag(value)) => Some(*value),
            _ => None,
        })));
    }
    Arc::new(StringArray::from_iter(cells.iter().map(|cell| {
        cell.as_ref().map(|cell| match cell {
            Cell::Number(value) => value.to_string(),
            Cell::Integer(value) => value.to_string(),
            Cell::Flag(value) => value.to_string(),
            Cell::Text(value) => value.clone(),
        })
    })))
}

pub(super) fn numbers(values: impl IntoIterator<Item = Option<f64>>) -> ArrayRef {
    Arc::new(Float64Array::from_iter(values))
}

pub(super) fn counts(values: impl IntoIterator<Item = Option<u64>>) -> ArrayRef {
    Arc::new(UInt64Array::from_iter(values))
}

pub(super) fn flags(values: impl IntoIterator<Item = bool>) -> ArrayRef {
    Arc::new(BooleanArray::from_iter(values.into_iter().map(Some)))
}

pub(super) fn texts<Text: AsRef<str>>(values: impl IntoIterator<Item = Option<Text>>) -> ArrayRef {
    Arc::new(StringArray::from_iter(values))
}

/// A table read back, with the name it has in error messages.
pub(super) struct Reader<'a> {
    pub batch: &'a RecordBatch,
    pub file: &'a str,
}

impl Reader<'_> {
    fn column(&self, name: &str) -> Result<&ArrayRef, StoreError> {
        self.batch
            .column_by_name(name)
            .ok_or_else(|| StoreError::damaged(self.file, format!("no column `{name}`")))
    }

    /// The column of this role, name and unit, whatever it is called in the file.
    pub fn find(&self, role: &str, name: &str, unit: Option<&str>) -> Result<&ArrayRef, StoreError> {
        let schema = self.batch.schema_ref();
        let position = schema.fields().iter().position(|field| {
            let says = |key: &str, value: &str| field.metadata().get(key).is_some_and(|found| found == value);
            says(ROLE, role) && says(NAME, name) && unit.is_none_or(|unit| says(UNIT, unit))
        });
        position
            .map(|position| self.batch.column(position))
            .ok_or_else(|| StoreError::damaged(self.file, format!("no column for the {role} `{name}`")))
    }

    pub fn text(&self, name: &str, row: usize) -> Result<Option<String>, StoreError> {
        let column = self.column(name)?;
        let column = column.as_string_opt::<i32>().ok_or_else(|| self.mistyped(name))?;
        Ok(column.is_valid(row).then(|| column.value(row).to_string()))
    }

    /// A text that must be there.
    pub fn word(&self, name: &str, row: usize) -> Result<String, StoreError> {
        self.text(name, row)?
            .ok_or_else(|| StoreError::damaged(self.file, format!("row {row} has no `{name}`")))
    }

    pub fn count(&self, name: &str, row: usize) -> Result<u64, StoreError> {
        self.count_of(self.column(name)?, name, row)
    }

    pub fn number(&self, name: &str, row: usize) -> Result<f64, StoreError> {
        self.number_of(self.column(name)?, name, row)
    }

    pub fn flag(&self, name: &str, row: usize) -> Result<bool, StoreError> {
        let column = self.column(name)?;
        let column = column.as_boolean_opt().ok_or_else(|| self.mistyped(name))?;
        Ok(column.value(row))
    }

    pub fn number_of(&self, column: &ArrayRef, name: &str, row: usize) -> Result<f64, StoreError> {
        let column = column
            .as_primitive_opt::<Float64Type>()
            .ok_or_else(|| self.mistyped(name))?;
        Ok(column.value(row))
    }

    pub fn count_of(&self, column: &ArrayRef, name: &str, row: usize) -> Result<u64, StoreError> {
        let column = column
            .as_primitive_opt::<UInt64Type>()
            .ok_or_else(|| self.mistyped(name))?;
        Ok(column.value(row))
    }

    fn mistyped(&self, name: &str) -> StoreError {
        StoreError::damaged(self.file, format!("column `{name}` has an unexpected type"))
    }
}

#[cfg(test)]
mod tests {
    use arrow::datatypes::DataType;

    use super::*;

    fn kind(cells: &[Option<Cell>]) -> DataType {
        typed(cells).data_type().clone()
    }

    #[test]
    fn columns_are_as_narrow_as_their_cells_allow() {
        let (number, integer) = (Some(Cell::Number(0.5)), Some(Cell::Integer(3)));
        let (flag, text) = (Some(Cell::Flag(true)), Some(Cell::Text("stokes".into())));
        assert_eq!(kind(&[integer.clone(), None]), DataType::Int64);
        assert_eq!(kind(&[integer.clone(), number.clone(), None]), DataType::Float64);
        assert_eq!(kind(&[None, flag.clone()]), DataType::Boolean);
        assert_eq!(kind(&[flag, number]), DataType::Utf8);
        assert_eq!(kind(&[text, integer]), DataType::Utf8);
    }
}
