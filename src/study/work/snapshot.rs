//! Stored tables of grains that a sedimentation starts from.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fs::File;
use std::path::{Path, PathBuf};

use arrow::array::{Array, AsArray, RecordBatch};
use arrow::compute::cast;
use arrow::datatypes::{DataType, Float64Type};
use kynch_sim::math::Vec3;
use kynch_sim::scene::{Placed, Snapshot};
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;

use crate::study::spec::sedimentation::SnapshotSpec;

/// What is read of a stored table `snapshots`.
const COLUMNS: [&str; 9] = [
    "time", "class", "x", "y", "z", "radius", "speed_x", "speed_y", "speed_z",
];

/// A line of the table, in the order of [`COLUMNS`].
type Line = [f64; COLUMNS.len()];

/// The BLAKE3 of a file and what it holds.
type Stored = (Option<String>, Snapshot);

/// The files that the scenes of a study name; each is read once.
pub struct Snapshots {
    folder: PathBuf,
    read: RefCell<BTreeMap<String, Stored>>,
}

impl Snapshots {
    /// Files named relative to the folder of a study.
    pub fn beside(study: &Path) -> Snapshots {
        Snapshots {
            folder: study.parent().unwrap_or(Path::new("")).to_owned(),
            read: RefCell::default(),
        }
    }

    /// Puts what the file holds into the settings.
    pub fn fill(&self, spec: &mut SnapshotSpec) {
        let mut read = self.read.borrow_mut();
        let stored = read
            .entry(spec.file.clone())
            .or_insert_with(|| self.stored(&spec.file));
        spec.blake3.clone_from(&stored.0);
        spec.contents = Some(stored.1.clone());
    }

    fn stored(&self, name: &str) -> Stored {
        let beside = self.folder.join(name);
        let path = if beside.exists() { beside } else { name.into() };
        let (sum, grains) = match contents(&path, name) {
            Ok((sum, grains)) => (Some(sum), Ok(grains.into())),
            Err(reason) => (None, Err(reason)),
        };
        let file = name.to_owned();
        (sum, Snapshot { file, grains })
    }
}

fn contents(path: &Path, name: &str) -> Result<(String, Vec<Placed>), String> {
    if !path.exists() {
        return Err(format!("there is no file `{name}`"));
    }
    if !path.is_file() {
        return Err(format!("`{name}` is not a plain file"));
    }
    let unreadable = |error: std::io::Error| format!("`{name}` cannot be read: {error}");
    let file = File::open(path).map_err(unreadable)?;
    let mut hasher = blake3::Hasher::new();
    hasher.update_reader(&file).map_err(unreadable)?;
    let lines = lines(file, name)?;
    let grains = last(&lines, name)?;
    Ok((hasher.finalize().to_hex().to_string(), grains))
}

fn lines(file: File, name: &str) -> Result<Vec<Line>, String> {
    let no_table = |error: &dyn std::fmt::Display| format!("`{name}` is no Parquet table: {error}");
    let builder = ParquetRecordBatchReaderBuilder::try_new(file).map_err(|error| no_table(&error))?;
    for column in COLUMNS {
        if builder.schema().column_with_name(column).is_none() {
            return Err(format!("`{name}` has no column `{column}`"));
        }
    }
    let mut lines = Vec::new();
    for batch in builder.build().map_err(|error| no_table(&error))? {
        append(&batch.map_err(|error| no_table(&error))?, name, &mut lines)?;
    }
    Ok(lines)
}

fn append(batch: &RecordBatch, name: &str, lines: &mut Vec<Line>) -> Result<(), String> {
    let first = lines.len();
    lines.resize(first + batch.num_rows(), [0.0; COLUMNS.len()]);
    for (place, column) in COLUMNS.iter().enumerate() {
        let wrong = || format!("the column `{column}` of `{name}` holds something else than numbers");
        let values = batch.column_by_name(column).ok_or_else(wrong)?;
        let values = cast(values, &DataType::Float64).map_err(|_| wrong())?;
        let values = values.as_primitive::<Float64Type>();
        let finite = values.values().iter().all(|value| value.is_finite());
        if values.null_count() > 0 || !finite {
            return Err(wrong());
        }
        for (line, value) in lines[first..].iter_mut().zip(values.values()) {
            line[place] = *value;
        }
    }
    Ok(())
}

/// The moving grains at the last time.
fn last(lines: &[Line], name: &str) -> Result<Vec<Placed>, String> {
    let time = lines.iter().map(|line| line[0]).fold(f64::NEG_INFINITY, f64::max);
    let mut grains = Vec::new();
    for [at, class, x, y, z, radius, speed_x, speed_y, speed_z] in lines {
        if *at < time || *class == -1.0 {
            continue;
        }
        if *class < 0.0 || class.fract() != 0.0 {
            return Err(format!("`{name}` has a grain of class {class}"));
        }
        grains.push(Placed {
            class: *class as usize,
            position: Vec3::new(*x, *y, *z),
            velocity: Vec3::new(*speed_x, *speed_y, *speed_z),
            radius: *radius,
        });
    }
    Ok(grains)
}
