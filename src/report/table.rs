//! All runs of a study as one polars frame, and the tables made from it.

use polars::prelude::*;
use polars_io::prelude::{CsvWriter, SerWriter};

use super::{ReportError, selection};
use crate::store::model::{Run, Status};
use crate::study::model::{AxisValue, Study};

impl From<PolarsError> for ReportError {
    fn from(error: PolarsError) -> ReportError {
        ReportError(format!("the table of runs cannot be made: {error}"))
    }
}

/// What the runs of one scene took.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Effort {
    pub scene: String,
    pub points: u64,
    /// [s]
    pub wall: f64,
    /// [s]
    pub longest: f64,
    /// [s]
    pub cpu: f64,
    /// [bytes]
    pub memory: u64,
    /// Work counters in the order of [`counters`].
    pub work: Vec<u64>,
}

/// Names of the work counters of all runs, in order of appearance.
pub fn counters(runs: &[Run]) -> Vec<String> {
    names(
        runs.iter()
            .flat_map(|run| run.counters.iter().map(|(name, _)| name)),
    )
}

/// One row per run: identity, axes, scalars with their units, counters and timing.
pub fn frame(study: &Study, runs: &[Run]) -> Result<DataFrame, ReportError> {
    let words = |name: &str, value: &dyn Fn(&Run) -> String| {
        Column::new(name.into(), runs.iter().map(value).collect::<Vec<_>>())
    };
    let mut columns = vec![
        words("point", &|run| run.id.0.clone()),
        words("label", &|run| selection::label(study, run)),
        words("scene", &|run| run.scene.clone()),
        words("status", &|run| status_word(run.status).to_owned()),
        Column::new("seed".into(), runs.iter().map(|run| run.seed).collect::<Vec<_>>()),
    ];
    for axis in names(runs.iter().flat_map(|run| run.axes.iter().map(|(name, _)| name))) {
        columns.push(axis_column(runs, &axis));
    }
    for (name, unit) in scalars(runs) {
        let values: Vec<Option<f64>> = runs
            .iter()
            .map(|run| run.scalar(&name).map(|scalar| scalar.value))
            .collect();
        columns.push(Column::new(format!("{name} [{unit}]").into(), values));
    }
    for name in counters(runs) {
        let count = |run: &Run| {
            run.counters
                .iter()
                .find(|(other, _)| *other == name)
                .map(|(_, count)| *count)
        };
        columns.push(Column::new(
            work_column(&name).into(),
            runs.iter().map(count).collect::<Vec<_>>(),
        ));
    }
    let timing = |name: &str, value: fn(&Run) -> f64| {
        Column::new(name.into(), runs.iter().map(value).collect::<Vec<_>>())
    };
    columns.push(timing("wall time [s]", |run| run.timing.wall));
    columns.push(timing("CPU time [s]", |run| run.timing.cpu));
    let memory: Vec<u64> = runs.iter().map(|run| run.timing.peak_memory).collect();
    columns.push(Column::new("peak memory [bytes]".into(), memory));
    Ok(DataFrame::new(runs.len(), with_distinct_names(columns))?)
}

/// Run time and work by scene; completed runs only.
pub fn effort(frame: &DataFrame, counters: &[String]) -> Result<Vec<Effort>, ReportError> {
    let mut sums = vec![
        len().cast(DataType::UInt64).alias("points"),
        col("wall time [s]").sum().alias("wall"),
        col("wall time [s]").max().alias("longest"),
        col("CPU time [s]").sum().alias("cpu"),
        col("peak memory [bytes]").max().alias("memory"),
    ];
    sums.extend(counters.iter().map(|name| col(work_column(name)).sum()));
    let table = frame
        .clone()
        .lazy()
        .filter(col("status").eq(lit(status_word(Status::Completed))))
        .group_by_stable([col("scene")])
        .agg(sums)
        .collect()?;
    let whole = |name: &str, row: usize| -> Result<u64, ReportError> {
        Ok(table.column(name)?.u64()?.get(row).unwrap_or(0))
    };
    let seconds = |name: &str, row: usize| -> Result<f64, ReportError> {
        Ok(table.column(name)?.f64()?.get(row).unwrap_or(0.0))
    };
    let row = |row: usize| {
        Ok(Effort {
            scene: table
                .column("scene")?
                .str()?
                .get(row)
                .unwrap_or_default()
                .to_owned(),
            points: whole("points", row)?,
            wall: seconds("wall", row)?,
            longest: seconds("longest", row)?,
            cpu: seconds("cpu", row)?,
            memory: whole("memory", row)?,
            work: counters
                .iter()
                .map(|name| whole(&work_column(name), row))
                .collect::<Result<_, _>>()?,
        })
    };
    (0..table.height()).map(row).collect()
}

/// Comma-separated values with all digits.
pub fn csv(frame: &mut DataFrame) -> Result<Vec<u8>, ReportError> {
    let mut bytes = Vec::new();
    CsvWriter::new(&mut bytes).finish(frame)?;
    Ok(bytes)
}

/// A status as people read it.
pub fn status_word(status: Status) -> &'static str {
    match status {
        Status::Completed => "completed",
        Status::Diverged => "diverged",
        Status::Panicked => "panicked",
        Status::TimedOut => "timed out",
        Status::OutOfMemory => "out of memory",
    }
}

fn work_column(counter: &str) -> String {
    format!("{counter} (work)")
}

/// Doubles where every value is a number, words otherwise.
fn axis_column(runs: &[Run], axis: &str) -> Column {
    let values = || runs.iter().map(|run| run.axis(axis));
    if values()
        .flatten()
        .all(|value| matches!(value, AxisValue::Number(_)))
    {
        let numbers = values().map(|value| match value {
            Some(AxisValue::Number(number)) => Some(*number),
            _ => None,
        });
        return Column::new(axis.into(), numbers.collect::<Vec<_>>());
    }
    let words = values().map(|value| {
        value.map(|value| match value {
            AxisValue::Number(number) => super::format::exact(*number),
            AxisValue::Flag(flag) => flag.to_string(),
            AxisValue::Word(word) => word.clone(),
        })
    });
    Column::new(axis.into(), words.collect::<Vec<_>>())
}

/// An axis may be called like a column of every table; the later one steps aside.
fn with_distinct_names(columns: Vec<Column>) -> Vec<Column> {
    let mut kept: Vec<Column> = Vec::new();
    for mut column in columns {
        while kept.iter().any(|other| other.name() == column.name()) {
            let aside = format!("{} (value)", column.name());
            column.rename(aside.into());
        }
        kept.push(column);
    }
    kept
}

fn scalars(runs: &[Run]) -> Vec<(String, String)> {
    let mut found: Vec<(String, String)> = Vec::new();
    let all = runs.iter().flat_map(|run| {
        let made = run.derived.iter().map(|derived| &derived.scalar);
        run.scalars.iter().chain(made)
    });
    for scalar in all {
        if !found
            .iter()
            .any(|(name, unit)| *name == scalar.name && *unit == scalar.unit)
        {
            found.push((scalar.name.clone(), scalar.unit.clone()));
        }
    }
    found
}

fn names<'a>(all: impl Iterator<Item = &'a String>) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    for name in all {
        if !found.contains(name) {
            found.push(name.clone());
        }
    }
    found
}
