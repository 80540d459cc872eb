//! Timings and provenance: what may differ between two runs with the same results.

use super::cells::{Reader, counts, flags, numbers, texts};
use super::error::StoreError;
use super::file::Series;
use super::model::{Provenance, Timing};

/// Column names, so that no result takes one of them.
pub(super) const NAMES: [&str; 12] = [
    "wall",
    "cpu",
    "peak_memory",
    SPLIT,
    "version",
    "commit",
    "dirty",
    "lock_hash",
    "simulator_hash",
    "compiler",
    "processor",
    "finished",
];

/// Stores written before there was one are read all the same.
const SPLIT: &str = "split_json";

pub(super) fn columns(timings: &[&Timing]) -> Vec<Series> {
    let number = |name, read: fn(&Timing) -> f64| {
        let values = numbers(timings.iter().map(|timing| Some(read(timing))));
        Series::new(name, "timing", name, Some("s"), values)
    };
    let text = |name, read: fn(&Provenance) -> &String| {
        let values = texts(timings.iter().map(|timing| Some(read(&timing.provenance))));
        Series::new(name, "provenance", name, None, values)
    };
    let memory = counts(timings.iter().map(|timing| Some(timing.peak_memory)));
    let split = timings
        .iter()
        .map(|timing| (!timing.split.is_empty()).then(|| serde_json::json!(timing.split).to_string()));
    let dirty = flags(timings.iter().map(|timing| timing.provenance.dirty));
    vec![
        number("wall", |timing| timing.wall),
        number("cpu", |timing| timing.cpu),
        Series::new("peak_memory", "timing", "peak_memory", Some("B"), memory),
        Series::new(SPLIT, "timing", SPLIT, None, texts(split)),
        text("version", |from| &from.version),
        text("commit", |from| &from.commit),
        Series::new("dirty", "provenance", "dirty", None, dirty),
        text("lock_hash", |from| &from.lock_hash),
        text("simulator_hash", |from| &from.simulator_hash),
        text("compiler", |from| &from.compiler),
        text("processor", |from| &from.cpu),
        text("finished", |from| &from.finished),
    ]
}

pub(super) fn decode(reader: &Reader, row: usize) -> Result<Timing, StoreError> {
    Ok(Timing {
        wall: reader.number("wall", row)?,
        cpu: reader.number("cpu", row)?,
        peak_memory: reader.count("peak_memory", row)?,
        split: split(reader, row)?,
        provenance: Provenance {
            version: reader.word("version", row)?,
            commit: reader.word("commit", row)?,
            dirty: reader.flag("dirty", row)?,
            lock_hash: reader.word("lock_hash", row)?,
            simulator_hash: reader.word("simulator_hash", row)?,
            compiler: reader.word("compiler", row)?,
            cpu: reader.word("processor", row)?,
            finished: reader.word("finished", row)?,
        },
    })
}

fn split(reader: &Reader, row: usize) -> Result<Vec<(String, f64)>, StoreError> {
    if reader.batch.column_by_name(SPLIT).is_none() {
        return Ok(Vec::new());
    }
    let Some(json) = reader.text(SPLIT, row)? else {
        return Ok(Vec::new());
    };
    serde_json::from_str(&json)
        .map_err(|error| StoreError::damaged(reader.file, format!("row {row}, `{SPLIT}`: {error}")))
}
