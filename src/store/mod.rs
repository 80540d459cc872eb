//! Results on disk: Parquet files that survive a crash and tell when they are damaged.
//!
//! | path | holds |
//! |---|---|
//! | `runs.parquet` | one row per run: identity, status, parameters, results, work counters |
//! | `timings.parquet` | per run: times, memory, provenance; all that may differ between equal runs |
//! | `columns.parquet` | what every column of every table is, with its unit |
//! | `series/`, `profiles/` | one file per run and table |
//! | `pending/` | rows of runs since the last [`Store::compact`] |
//! | `manifest.blake3` | the BLAKE3 sum of each of these files |

mod canonical;
mod cells;
mod columns;
mod disk;
mod error;
mod file;
mod manifest;
pub mod model;
mod provenance;
mod recovery;
mod row;
mod series;
mod timing;
mod units;

use std::collections::{BTreeMap, HashMap};
use std::path::Path;
use std::sync::{Mutex, MutexGuard, PoisonError};

pub use canonical::canonical;
pub use error::StoreError;

use disk::Disk;
use manifest::{ABSENT, FILE, Manifest, sum};
use model::{PointId, Run, Status, Timing};
use row::Row;
use series::{TableFile, file_name, is_file_name};

const RUNS: &str = "runs.parquet";
const TIMINGS: &str = "timings.parquet";
const COLUMNS: &str = "columns.parquet";
const TABLES: [&str; 3] = [RUNS, TIMINGS, COLUMNS];

/// A folder of results. One process writes to it at a time.
#[derive(Debug)]
pub struct Store {
    disk: Disk,
    state: Mutex<State>,
}

/// One thing `verify` found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Damage {
    pub file: String,
    pub problem: String,
}

/// What the files hold, without the tables of the runs.
#[derive(Debug, Default)]
struct State {
    manifest: Manifest,
    entries: BTreeMap<PointId, Entry>,
    axis_units: BTreeMap<String, String>,
}

#[derive(Debug)]
struct Entry {
    row: Row,
    /// Its file below `pending/`, until the next compaction.
    pending: Option<String>,
}

impl State {
    /// The new row of a run in place of its old one, which is returned.
    fn insert(&mut self, row: Row, pending: Option<String>) -> Option<Entry> {
        self.entries.insert(row.run.id.clone(), Entry { row, pending })
    }

    /// Files that rows refer to, with their sums.
    fn referenced(&self) -> BTreeMap<String, String> {
        let tables = self.entries.values().flat_map(|entry| &entry.row.tables);
        tables
            .filter_map(|place| Some((place.path.clone()?, place.hash.clone())))
            .collect()
    }
}

impl Store {
    /// Opens or creates a store, for this process alone. Mends what a crash left behind: temporary
    /// files go, finished runs that the manifest does not list yet are taken in.
    ///
    /// # Errors
    /// [`StoreError::NotWritable`], [`StoreError::InUse`] while another process has it open,
    /// [`StoreError::Damaged`] when a table is missing or differs from the manifest.
    pub fn open(dir: &Path) -> Result<Store, StoreError> {
        Store::with(Disk::open(dir)?, true)
    }

    /// Opens a store without locking or changing it; an absent one is empty. Runs that a crash left
    /// out of the manifest are not seen.
    pub fn read(dir: &Path) -> Result<Store, StoreError> {
        Store::with(Disk::read(dir), false)
    }

    fn with(disk: Disk, repair: bool) -> Result<Store, StoreError> {
        let state = Mutex::new(recovery::gather(&disk, repair)?);
        Ok(Store { disk, state })
    }

    /// Everything wrong with the store in a folder, which need not be fit for opening. Changes
    /// nothing; an absent store has no fault.
    pub fn inspect(dir: &Path) -> Result<Vec<Damage>, StoreError> {
        recovery::inspect(&Disk::read(dir))
    }

    /// Points with a finished run, and how it ended.
    pub fn finished(&self) -> Result<HashMap<PointId, Status>, StoreError> {
        let state = self.state();
        Ok(state
            .entries
            .iter()
            .map(|(id, entry)| (id.clone(), entry.row.run.status))
            .collect())
    }

    /// Every run of the store, of whatever study and version, without its tables.
    pub fn summaries(&self) -> Vec<Run> {
        self.state()
            .entries
            .values()
            .map(|entry| entry.row.run.clone())
            .collect()
    }

    /// Units of varied parameters, `1` when dimensionless: kept with their columns from the next
    /// compaction on.
    pub fn set_axis_units<'a>(&self, units: impl IntoIterator<Item = (&'a str, &'a str)>) {
        let units = units
            .into_iter()
            .map(|(name, unit)| (name.to_string(), unit.to_string()));
        self.state().axis_units.extend(units);
    }

    /// Keeps a run: durable when this returns. Safe to call from several threads. A run that the
    /// store has already is replaced.
    pub fn append(&self, run: &Run) -> Result<(), StoreError> {
        if !is_file_name(&run.id.0) {
            return Err(StoreError::invalid(format!(
                "`{}` is no identity of a point",
                run.id.0
            )));
        }
        row::check(run)?;
        let mut tables = Vec::new();
        let kept = self.write_tables(run, &mut tables).and_then(|()| {
            let mut run = run.clone();
            run.tables.clear();
            let tables = tables.clone();
            self.commit(Row { run, tables })
        });
        if kept.is_err() {
            self.discard(&tables);
        }
        kept
    }

    fn write_tables(&self, run: &Run, places: &mut Vec<TableFile>) -> Result<(), StoreError> {
        for table in &run.tables {
            let (place, bytes) = series::encode(&run.id, table)?;
            if let Some(path) = &place.path {
                self.disk.write(path, &bytes)?;
            }
            places.push(place);
        }
        Ok(())
    }

    /// Clears away the tables of a run that could not be kept, as far as nothing refers to them.
    fn discard(&self, places: &[TableFile]) {
        let wanted = self.state().referenced();
        for path in places.iter().filter_map(|place| place.path.as_ref()) {
            if !wanted.contains_key(path) {
                // Should this fail as well, the next opening does it.
                let _ = self.disk.remove(path);
            }
        }
    }

    /// The rename of the row's file is the instant at which the run exists.
    fn commit(&self, row: Row) -> Result<(), StoreError> {
        let mut columns = row::columns(&[&row], &BTreeMap::new())?;
        columns.extend(timing::columns(&[&row.run.timing]));
        let bytes = file::encode(&file::batch(columns)?)?;
        let hash = sum(&bytes);
        let path = file_name("pending", &row.run.id.0, &hash);
        let mut state = self.state();
        self.disk.write(&path, &bytes)?;
        let places = row.tables.clone();
        for place in &places {
            if let Some(table) = &place.path {
                state.manifest.set(table, &place.hash);
            }
        }
        state.manifest.set(&path, &hash);
        let old = state.insert(row, Some(path.clone()));
        for stale in old.into_iter().flat_map(Entry::files) {
            if stale != path && !places.iter().any(|place| place.path.as_ref() == Some(&stale)) {
                self.disk.remove(&stale)?;
                state.manifest.remove(&stale);
            }
        }
        self.disk.write(FILE, state.manifest.render().as_bytes())
    }

    /// The runs of these points that exist, in the order asked for.
    ///
    /// # Errors
    /// [`StoreError::Damaged`] when a table is missing or altered.
    pub fn load(&self, ids: &[PointId]) -> Result<Vec<Run>, StoreError> {
        let state = self.state();
        let found = ids.iter().filter_map(|id| state.entries.get(id));
        found.map(|entry| self.with_tables(&entry.row)).collect()
    }

    fn with_tables(&self, row: &Row) -> Result<Run, StoreError> {
        let mut run = row.run.clone();
        for place in &row.tables {
            if let Some(path) = &place.path {
                match self.disk.sum(path)? {
                    None => return Err(StoreError::damaged(path, "the file is missing")),
                    Some(sum) if sum != place.hash => {
                        return Err(StoreError::damaged(path, "its contents differ from the manifest"));
                    }
                    Some(_) => {}
                }
            }
            run.tables
                .push(series::decode(place, |path| self.disk.path(path))?);
        }
        Ok(run)
    }

    /// Merges small files into tables, sorted by study and identity. The tables of results depend
    /// on the results alone: neither on the order in which they came nor on when.
    pub fn compact(&self) -> Result<(), StoreError> {
        let mut state = self.state();
        let new = tables(&state)?;
        let listed = |table: &Merged| state.manifest.sums(table.name) == [table.hash.clone()];
        let pending: Vec<String> = state
            .entries
            .values()
            .filter_map(|entry| entry.pending.clone())
            .collect();
        if pending.is_empty() && new.iter().all(listed) {
            return Ok(());
        }
        // Either version of a table is right from here on, until all are replaced.
        for Merged { name, hash, .. } in &new {
            if !state.manifest.lists(name) {
                state.manifest.admit(name, ABSENT);
            }
            state.manifest.admit(name, hash);
        }
        self.disk.write(FILE, state.manifest.render().as_bytes())?;
        for Merged { name, bytes, .. } in &new {
            self.disk.write(name, bytes)?;
        }
        for Merged { name, hash, .. } in &new {
            state.manifest.set(name, hash);
        }
        for path in &pending {
            state.manifest.remove(path);
        }
        self.disk.write(FILE, state.manifest.render().as_bytes())?;
        for path in &pending {
            self.disk.remove(path)?;
        }
        for entry in state.entries.values_mut() {
            entry.pending = None;
        }
        Ok(())
    }

    /// Checks every file against the manifest; finds orphans and torn files.
    pub fn verify(&self) -> Result<Vec<Damage>, StoreError> {
        let _nobody_writes = self.state();
        recovery::inspect(&self.disk)
    }

    fn state(&self) -> MutexGuard<'_, State> {
        // The state is changed in steps that each leave it whole.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Entry {
    /// Files that belong to this row alone.
    fn files(self) -> Vec<String> {
        let tables = self.row.tables.into_iter().filter_map(|place| place.path);
        self.pending.into_iter().chain(tables).collect()
    }
}

/// A table about to be written.
struct Merged {
    name: &'static str,
    bytes: Vec<u8>,
    hash: String,
}

/// The tables of all runs.
fn tables(state: &State) -> Result<Vec<Merged>, StoreError> {
    let mut rows: Vec<&Row> = state.entries.values().map(|entry| &entry.row).collect();
    rows.sort_by_key(|row| (&row.run.study, &row.run.id));
    let runs = file::batch(row::columns(&rows, &state.axis_units)?)?;
    let ids = cells::texts(rows.iter().map(|row| Some(&row.run.id.0)));
    let mut timing_columns = vec![file::Series::new("id", row::IDENTITY, "id", None, ids)];
    let timings: Vec<&Timing> = rows.iter().map(|row| &row.run.timing).collect();
    timing_columns.extend(timing::columns(&timings));
    let timings = file::batch(timing_columns)?;
    let columns = columns::table(&runs, &timings, &rows)?;
    let mut all = Vec::new();
    for (name, batch) in [(RUNS, runs), (TIMINGS, timings), (COLUMNS, columns)] {
        let bytes = file::encode(&batch)?;
        let hash = sum(&bytes);
        all.push(Merged { name, bytes, hash });
    }
    Ok(all)
}

#[cfg(test)]
mod tests;
