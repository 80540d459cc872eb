//! Stored tables of one point for other programs: CSV for tables, VTK for ParaView.

mod csv;
mod vtk;

use std::path::{Path, PathBuf};

use crate::store::model::{Run, Table};

/// The table in which scenes keep their grains.
const SNAPSHOTS: &str = "snapshots";

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// One `.vtp` file of grains per kept time and a `.pvd` file that lists them.
    Vtk,
    /// One file per table.
    Csv,
}

/// What is wanted of a point.
#[derive(Clone, Debug)]
pub struct Wanted {
    pub format: Format,
    /// Only the kept time nearest to this one [s].
    pub time: Option<f64>,
    /// Only this table; VTK knows grains alone.
    pub table: Option<String>,
}

#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// The point has nothing of the kind, with what to do.
    #[error("{0}")]
    Nothing(String),
    #[error("cannot write {path}: {error}; choose another folder with --out")]
    NotWritable { path: String, error: std::io::Error },
}

/// Writes a run into a folder, which is made where there is none; gives back the files written.
///
/// # Errors
/// [`ExportError::Nothing`] for a table that the run does not have, [`ExportError::NotWritable`].
pub fn export(run: &Run, wanted: &Wanted, out: &Path) -> Result<Vec<PathBuf>, ExportError> {
    let files = match wanted.format {
        Format::Vtk => vtk::files(&grains(run, wanted)?)?,
        Format::Csv => tables(run, wanted)?,
    };
    let failed = |path: &Path, error| ExportError::NotWritable {
        path: path.display().to_string(),
        error,
    };
    std::fs::create_dir_all(out).map_err(|error| failed(out, error))?;
    let mut written = Vec::new();
    for (name, text) in files {
        let path = out.join(name);
        std::fs::write(&path, text).map_err(|error| failed(&path, error))?;
        written.push(path);
    }
    Ok(written)
}

/// The snapshots of a run.
fn grains(run: &Run, wanted: &Wanted) -> Result<Table, ExportError> {
    if let Some(table) = wanted.table.as_deref().filter(|table| *table != SNAPSHOTS) {
        return Err(ExportError::Nothing(format!(
            "VTK holds grains, not `{table}`; write `{table}` with --format csv"
        )));
    }
    match run.table(SNAPSHOTS) {
        Some(table) => nearest(table, wanted.time),
        None => Err(ExportError::Nothing(format!(
            "the point keeps no snapshots of its grains ({}); let its scene keep some, or take --format csv",
            kept(run)
        ))),
    }
}

/// File names with their contents.
type Files = Vec<(String, String)>;

fn tables(run: &Run, wanted: &Wanted) -> Result<Files, ExportError> {
    let chosen: Vec<&Table> = match &wanted.table {
        Some(name) => run.table(name).into_iter().collect(),
        None => run.tables.iter().collect(),
    };
    if chosen.is_empty() {
        let asked = wanted.table.as_deref().unwrap_or("any table");
        return Err(ExportError::Nothing(format!(
            "the point does not keep {asked} ({})",
            kept(run)
        )));
    }
    chosen
        .into_iter()
        .map(|table| {
            let table = nearest(table, wanted.time)?;
            Ok((format!("{}.csv", table.name), csv::write(&table)))
        })
        .collect()
}

/// The tables of a run in words.
fn kept(run: &Run) -> String {
    let names: Vec<&str> = run.tables.iter().map(|table| table.name.as_str()).collect();
    match names.is_empty() {
        true => "it keeps no table".to_owned(),
        false => format!("it keeps {}", names.join(", ")),
    }
}

/// The rows of the kept time nearest to a wanted one; all of them where none is wanted or the table has no
/// times.
fn nearest(table: &Table, time: Option<f64>) -> Result<Table, ExportError> {
    let (Some(time), Some(times)) = (time, table.column("time")) else {
        return Ok(table.clone());
    };
    let off = |at: &&f64| (**at - time).abs();
    let best = times
        .values
        .iter()
        .min_by(|one, other| off(one).total_cmp(&off(other)));
    let best = best.ok_or_else(|| ExportError::Nothing(format!("the table `{}` is empty", table.name)))?;
    let rows: Vec<bool> = times.values.iter().map(|at| at == best).collect();
    let mut table = table.clone();
    for column in &mut table.columns {
        let mut rows = rows.iter();
        column.values.retain(|_| rows.next().is_some_and(|kept| *kept));
    }
    Ok(table)
}

#[cfg(test)]
mod tests;
