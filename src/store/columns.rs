//! The table `columns`: what every column of every table is, for readers that do not see metadata.

use std::collections::BTreeSet;

use arrow::array::RecordBatch;
use arrow::datatypes::DataType;

use super::cells::texts;
use super::error::StoreError;
use super::file::{self, NAME, ROLE, Series, UNIT};
use super::row::Row;

/// A line of the table.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct Line {
    table: String,
    column: String,
    unit: Option<String>,
    kind: &'static str,
    description: String,
}

pub(super) fn table(
    runs: &RecordBatch,
    timings: &RecordBatch,
    rows: &[&Row],
) -> Result<RecordBatch, StoreError> {
    let mut lines: BTreeSet<Line> = BTreeSet::new();
    for (table, batch) in [("runs", runs), ("timings", timings)] {
        lines.extend(batch.schema_ref().fields().iter().map(|field| {
            let says = |key| field.metadata().get(key).map_or("", String::as_str);
            Line {
                table: table.to_string(),
                column: field.name().clone(),
                unit: field.metadata().get(UNIT).cloned(),
                kind: kind(field.data_type()),
                description: describe(says(ROLE), says(NAME)),
            }
        }));
    }
    for place in rows.iter().flat_map(|row| &row.tables) {
        let line = |column: &str, unit: Option<&str>, kind, description: &str| Line {
            table: place.name.clone(),
            column: column.to_string(),
            unit: unit.map(str::to_string),
            kind,
            description: description.to_string(),
        };
        lines.insert(line("id", None, "text", &describe("identity", "id")));
        for (position, (column, unit)) in place.columns.iter().enumerate() {
            let description = if position == 0 {
                "independent variable"
            } else {
                "computed by the run"
            };
            lines.insert(line(column, Some(unit), "double", description));
        }
    }
    let text = |name, read: fn(&Line) -> Option<&str>| {
        Series::new(name, "identity", name, None, texts(lines.iter().map(read)))
    };
    file::batch(vec![
        text("table", |line| Some(&line.table)),
        text("column", |line| Some(&line.column)),
        text("unit", |line| line.unit.as_deref()),
        text("type", |line| Some(line.kind)),
        text("description", |line| Some(&line.description)),
    ])
}

fn kind(of: &DataType) -> &'static str {
    match of {
        DataType::Float64 => "double",
        DataType::UInt64 => "unsigned integer",
        DataType::Int64 => "integer",
        DataType::Boolean => "boolean",
        _ => "text",
    }
}

fn describe(role: &str, name: &str) -> String {
    match (role, name) {
        (_, "id") => "identity of the run: hash of settings, seed, simulator and schema".into(),
        (_, "study") => "study that computed the run first".into(),
        (_, "scene") => "name of the scene inside the study".into(),
        (_, "kind") => "kind of the scene".into(),
        (_, "seed") => "seed of the random numbers".into(),
        (_, "status") => "completed, diverged, panicked, timed_out or out_of_memory".into(),
        (_, "reason") => "why the run did not complete".into(),
        (_, "settings_json") => "all settings of the scene, JSON".into(),
        (_, "contents_json") => "order and units of results, and the files of the run's tables, JSON".into(),
        ("axis", name) => format!("varied parameter {name}"),
        ("setting", name) => format!("setting {name} of the scene"),
        ("result", name) => format!("result {name}"),
        ("counter", name) => format!("work counter {name}"),
        ("timing", "wall") => "wall time".into(),
        ("timing", "cpu") => "processor time of the threads that worked on the run".into(),
        ("timing", "split_json") => "what the run spent its time on [s], JSON".into(),
        ("timing", "peak_memory") => "largest memory of the run".into(),
        ("provenance", "dirty") => "whether the sources differed from the commit".into(),
        ("provenance", "lock_hash") => "BLAKE3 of Cargo.lock".into(),
        ("provenance", "simulator_hash") => "BLAKE3 of the simulator's sources".into(),
        ("provenance", "processor") => "model of the processor".into(),
        ("provenance", "finished") => "end of the run, UTC".into(),
        (_, name) => format!("{} of the program that ran", name.replace('_', " ")),
    }
}
