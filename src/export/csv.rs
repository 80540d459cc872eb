//! A table as comma-separated values: units in the head, every digit.

use crate::store::model::Table;

pub fn write(table: &Table) -> String {
    let head = table
        .columns
        .iter()
        .map(|column| format!("{} [{}]", column.name, column.unit));
    let mut text = head.collect::<Vec<_>>().join(",") + "\n";
    let rows = table
        .columns
        .iter()
        .map(|column| column.values.len())
        .max()
        .unwrap_or(0);
    for row in 0..rows {
        let cells = table.columns.iter().map(|column| {
            let value = column.values.get(row);
            value.map_or(String::new(), |value| number(*value))
        });
        text += &cells.collect::<Vec<_>>().join(",");
        text.push('\n');
    }
    text
}

/// The shortest text that reads back as the same number.
pub fn number(value: f64) -> String {
    let size = value.abs();
    match value {
        value if value.is_nan() => "nan".to_owned(),
        value if size != 0.0 && !(1e-4..1e15).contains(&size) && value.is_finite() => format!("{value:e}"),
        value => value.to_string(),
    }
}
