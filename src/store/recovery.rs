//! What a store holds when it is opened, whatever happened to the process that wrote it last.
//!
//! Files appear by rename, so each is whole; what a crash can leave behind is a temporary file, a
//! file that the manifest does not list yet, or one that nothing refers to any more. Files of runs
//! carry the start of their own sum in their name: that tells whether they are whole.

use std::collections::{BTreeMap, BTreeSet};

use arrow::array::RecordBatch;

use super::cells::Reader;
use super::disk::{Disk, FOLDERS, TEMPORARY};
use super::error::StoreError;
use super::file::{self, NAME, ROLE, UNIT};
use super::manifest::{ABSENT, FILE, Manifest};
use super::model::PointId;
use super::row::{self, Row};
use super::series::name_fits;
use super::{Damage, RUNS, State, TABLES, TIMINGS, timing};

/// Reads the whole state; with `repair`, also removes what a crash left and lists what it did not.
pub(super) fn gather(disk: &Disk, repair: bool) -> Result<State, StoreError> {
    let (mut manifest, before) = read_manifest(disk)?;
    if repair {
        for name in disk.files("")?.iter().filter(|name| name.starts_with(TEMPORARY)) {
            disk.remove(name)?;
        }
    }
    settle(disk, &mut manifest)?;
    let mut state = State {
        manifest,
        ..State::default()
    };
    read_tables(disk, &mut state)?;
    read_pending(disk, &mut state, repair)?;
    if repair {
        sweep(disk, &mut state)?;
        if state.manifest != before {
            disk.write(FILE, state.manifest.render().as_bytes())?;
        }
    }
    Ok(state)
}

fn read_manifest(disk: &Disk) -> Result<(Manifest, Manifest), StoreError> {
    let text = if disk.path(FILE).exists() {
        String::from_utf8_lossy(&disk.bytes(FILE)?).into_owned()
    } else if TABLES.iter().any(|table| disk.path(table).exists()) {
        return Err(StoreError::damaged(FILE, "the file is missing"));
    } else {
        String::new()
    };
    let manifest = Manifest::parse(&text).map_err(|problem| StoreError::damaged(FILE, problem))?;
    Ok((manifest.clone(), manifest))
}

/// Ends a replacement of tables that a crash cut short: keeps the sum that the file has.
fn settle(disk: &Disk, manifest: &mut Manifest) -> Result<(), StoreError> {
    for path in manifest.paths() {
        if manifest.sums(&path).len() < 2 {
            continue;
        }
        let found = disk.sum(&path)?.unwrap_or_else(|| ABSENT.to_string());
        if !manifest.sums(&path).contains(&found) {
            return Err(altered(&path));
        }
        if found == ABSENT {
            manifest.remove(&path);
        } else {
            manifest.set(&path, &found);
        }
    }
    Ok(())
}

fn altered(path: &str) -> StoreError {
    StoreError::damaged(path, "its contents differ from the manifest")
}

/// A listed file, compared with its sum and read.
fn read_listed(disk: &Disk, manifest: &Manifest, path: &str) -> Result<RecordBatch, StoreError> {
    match disk.sum(path)? {
        None => Err(StoreError::damaged(path, "the file is missing")),
        Some(sum) if !manifest.sums(path).contains(&sum) => Err(altered(path)),
        Some(_) => file::decode(&disk.path(path), path),
    }
}

fn read_tables(disk: &Disk, state: &mut State) -> Result<(), StoreError> {
    if !state.manifest.lists(RUNS) {
        return match disk.path(RUNS).exists() {
            true => Err(StoreError::damaged(RUNS, "the manifest does not list it")),
            false => Ok(()),
        };
    }
    let runs = read_listed(disk, &state.manifest, RUNS)?;
    let reader = Reader {
        batch: &runs,
        file: RUNS,
    };
    for index in 0..runs.num_rows() {
        state.insert(row::decode(&reader, index)?, None);
    }
    for field in runs.schema_ref().fields() {
        let metadata = field.metadata();
        let axis = metadata.get(ROLE).is_some_and(|role| role == row::AXIS);
        if let (true, Some(name), Some(unit)) = (axis, metadata.get(NAME), metadata.get(UNIT)) {
            state.axis_units.insert(name.clone(), unit.clone());
        }
    }
    if !state.manifest.lists(TIMINGS) {
        // The first compaction was cut short: the rows below `pending/` have the timings.
        return Ok(());
    }
    let timings = read_listed(disk, &state.manifest, TIMINGS)?;
    let reader = Reader {
        batch: &timings,
        file: TIMINGS,
    };
    for index in 0..timings.num_rows() {
        let id = PointId(reader.word("id", index)?);
        if let Some(entry) = state.entries.get_mut(&id) {
            entry.row.run.timing = timing::decode(&reader, index)?;
        }
    }
    Ok(())
}

/// Rows of runs since the last compaction. Where a run has two, the one that the manifest does not
/// list yet is the newer.
fn read_pending(disk: &Disk, state: &mut State, repair: bool) -> Result<(), StoreError> {
    let present = disk.files("pending")?;
    let (listed, unlisted): (Vec<_>, Vec<_>) = present.iter().partition(|path| state.manifest.lists(path));
    let mut lost: Vec<String> = state.manifest.paths();
    lost.retain(|path| path.starts_with("pending/") && !present.contains(path));
    for path in listed {
        let batch = read_listed(disk, &state.manifest, path)?;
        let row = read_row(&batch, path)?;
        state.insert(row, Some(path.clone()));
    }
    if !repair {
        return Ok(());
    }
    let mut replaced = Vec::new();
    for path in unlisted {
        let sum = disk.sum(path)?.unwrap_or_default();
        if !name_fits(path, &sum) {
            disk.remove(path)?;
            continue;
        }
        let row = read_row(&file::decode(&disk.path(path), path)?, path)?;
        replaced.push(row.run.id.0.clone());
        if let Some(old) = state.insert(row, Some(path.clone())).and_then(|old| old.pending)
            && old != *path
        {
            disk.remove(&old)?;
            state.manifest.remove(&old);
        }
        state.manifest.set(path, &sum);
    }
    for path in lost {
        if !replaced
            .iter()
            .any(|id| path.starts_with(&format!("pending/{id}-")))
        {
            return Err(StoreError::damaged(&path, "the file is missing"));
        }
        state.manifest.remove(&path);
    }
    Ok(())
}

fn read_row(batch: &RecordBatch, path: &str) -> Result<Row, StoreError> {
    if batch.num_rows() != 1 {
        return Err(StoreError::damaged(path, "it does not hold exactly one run"));
    }
    let reader = Reader { batch, file: path };
    let mut row = row::decode(&reader, 0)?;
    row.run.timing = timing::decode(&reader, 0)?;
    Ok(row)
}

/// Removes tables of runs that never finished or were done again, and lists those that a row refers
/// to.
fn sweep(disk: &Disk, state: &mut State) -> Result<(), StoreError> {
    let wanted: BTreeMap<String, String> = state.referenced();
    let mut known: BTreeSet<String> = state.manifest.paths().into_iter().collect();
    for folder in ["series", "profiles"] {
        known.extend(disk.files(folder)?);
    }
    for path in known {
        if !(path.starts_with("series/") || path.starts_with("profiles/")) {
            continue;
        }
        match wanted.get(&path) {
            Some(hash) if !state.manifest.lists(&path) => {
                if disk.sum(&path)?.as_ref() != Some(hash) {
                    return Err(altered(&path));
                }
                state.manifest.set(&path, hash);
            }
            Some(_) => {}
            None if path.ends_with(".parquet") => {
                disk.remove(&path)?;
                state.manifest.remove(&path);
            }
            // Not one of ours.
            None => {}
        }
    }
    Ok(())
}

fn report(found: &mut Vec<Damage>, file: &str, problem: &str) {
    found.push(Damage {
        file: file.to_string(),
        problem: problem.to_string(),
    });
}

/// Everything that differs from the manifest. Changes nothing.
pub(super) fn inspect(disk: &Disk) -> Result<Vec<Damage>, StoreError> {
    let manifest = match read_manifest(disk) {
        Ok((manifest, _)) => manifest,
        Err(StoreError::Damaged { file, problem, .. }) => return Ok(vec![Damage { file, problem }]),
        Err(other) => return Err(other),
    };
    let mut found = Vec::new();
    for path in manifest.paths() {
        let sum = disk.sum(&path)?;
        match &sum {
            None if manifest.sums(&path).iter().any(|admitted| admitted == ABSENT) => {}
            None => report(&mut found, &path, "missing: the manifest lists it"),
            Some(sum) if manifest.sums(&path).contains(sum) => {}
            Some(_) => report(
                &mut found,
                &path,
                "altered: its contents differ from the manifest",
            ),
        }
    }
    for folder in std::iter::once("").chain(FOLDERS) {
        for path in disk.files(folder)? {
            if path.starts_with(TEMPORARY) {
                report(&mut found, &path, "torn: a file that was never finished");
            } else if path != FILE && !manifest.lists(&path) {
                report(&mut found, &path, "orphan: the manifest does not list it");
            }
        }
    }
    if found.is_empty() {
        let state = gather(disk, false)?;
        for path in state.referenced().keys().filter(|path| !manifest.lists(path)) {
            report(&mut found, path, "missing: a run refers to it");
        }
    }
    found.sort_by(|one, other| one.file.cmp(&other.file));
    Ok(found)
}
