//! What is kept of a run.

use serde::{Deserialize, Serialize};

use crate::study::model::{AxisValue, Point};

/// Identity of a point: BLAKE3 of canonical settings, seed, simulator sources and schema, in hex.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct PointId(pub String);

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    Completed,
    Diverged,
    Panicked,
    TimedOut,
    OutOfMemory,
}

impl Status {
    /// As it is written in the store.
    pub fn name(self) -> &'static str {
        match self {
            Status::Completed => "completed",
            Status::Diverged => "diverged",
            Status::Panicked => "panicked",
            Status::TimedOut => "timed_out",
            Status::OutOfMemory => "out_of_memory",
        }
    }

    pub fn from_name(name: &str) -> Option<Status> {
        use Status::{Completed, Diverged, OutOfMemory, Panicked, TimedOut};
        [Completed, Diverged, Panicked, TimedOut, OutOfMemory]
            .into_iter()
            .find(|status| status.name() == name)
    }
}

/// One finished run, whatever its end.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    pub id: PointId,
    pub study: String,
    pub scene: String,
    pub axes: Vec<(String, AxisValue)>,
    pub seed: u64,
    /// Canonical settings, JSON.
    pub settings: serde_json::Value,
    pub status: Status,
    /// In words, when the run did not complete.
    pub reason: Option<String>,
    pub scalars: Vec<Scalar>,
    /// Work counters by name: machine-independent.
    pub counters: Vec<(String, u64)>,
    /// Time series and profiles.
    pub tables: Vec<Table>,
    /// What a study makes of the tables; never stored.
    pub derived: Vec<Derived>,
    pub timing: Timing,
}

/// A number that a study makes of the series of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Derived {
    /// NaN where there is none.
    pub scalar: Scalar,
    /// Half width of its 95 % confidence interval; zero where there is none.
    pub half_width: f64,
    /// Why there is no number.
    pub fault: Option<String>,
}

/// A named number with its unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Scalar {
    pub name: String,
    pub unit: String,
    pub value: f64,
}

/// Columns of equal length; the first is the independent variable.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// `time_series`, or the name of a profile.
    pub name: String,
    pub columns: Vec<Column>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    pub name: String,
    pub unit: String,
    pub values: Vec<f64>,
}

impl Run {
    pub fn scalar(&self, name: &str) -> Option<&Scalar> {
        let made = self.derived.iter().filter(|derived| derived.fault.is_none());
        let all = self.scalars.iter().chain(made.map(|derived| &derived.scalar));
        all.into_iter().find(|scalar| scalar.name == name)
    }

    /// What the study made under a name, found or not.
    pub fn derived(&self, name: &str) -> Option<&Derived> {
        self.derived.iter().find(|derived| derived.scalar.name == name)
    }

    /// A number of the run with its unit: a scalar, `counters.NAME`, `timings.wall` or `timings.cpu`.
    pub fn measure(&self, name: &str) -> Option<(f64, &str)> {
        if let Some(scalar) = self.scalar(name) {
            return Some((scalar.value, &scalar.unit));
        }
        match name {
            "timings.wall" => return Some((self.timing.wall, "s")),
            "timings.cpu" => return Some((self.timing.cpu, "s")),
            _ => {}
        }
        let counter = name.strip_prefix("counters.").unwrap_or(name);
        let mut counters = self.counters.iter();
        let found = counters.find(|(known, _)| known == counter);
        found.map(|(_, count)| (*count as f64, "1"))
    }

    pub fn table(&self, name: &str) -> Option<&Table> {
        self.tables.iter().find(|table| table.name == name)
    }

    /// Value of a parameter: an axis, `scene`, or the one settings field of that name.
    pub fn parameter(&self, name: &str) -> Option<AxisValue> {
        if name == "scene" {
            return Some(AxisValue::Word(self.scene.clone()));
        }
        self.axis(name).cloned().or_else(|| leaf(&self.settings, name))
    }

    /// Gives the run the names that `study` has for it. Two studies may share a point and call its
    /// scene and axes differently; the store keeps the names of whoever computed it first.
    pub fn relabel(&mut self, study: &str, point: &Point) {
        self.study = study.to_string();
        self.scene.clone_from(&point.scene);
        self.axes.clone_from(&point.axes);
    }

    pub fn axis(&self, name: &str) -> Option<&AxisValue> {
        self.axes
            .iter()
            .find(|(axis, _)| axis == name)
            .map(|(_, value)| value)
    }
}

/// The first leaf called `name` in a tree of settings, depth first.
pub(crate) fn leaf(tree: &serde_json::Value, name: &str) -> Option<AxisValue> {
    let fields = tree.as_object()?;
    let here = fields
        .get(name)
        .and_then(|value| serde_json::from_value(value.clone()).ok());
    here.or_else(|| fields.values().find_map(|branch| leaf(branch, name)))
}

impl Table {
    pub fn column(&self, name: &str) -> Option<&Column> {
        self.columns.iter().find(|column| column.name == name)
    }
}

/// What differs from machine to machine and run to run; kept apart from the results.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Timing {
    /// [s]
    pub wall: f64,
    /// CPU time of the threads that worked on the point [s].
    pub cpu: f64,
    /// Peak memory of the point [bytes].
    pub peak_memory: u64,
    /// What the point spent its time on [s], by name; empty where nobody keeps count.
    pub split: Vec<(String, f64)>,
    pub provenance: Provenance,
}

impl Timing {
    /// The split of time in words: `fluid 31 %, exchange 40 %`; empty where nobody keeps count.
    pub fn split_in_words(&self) -> String {
        let all: f64 = self.split.iter().map(|(_, time)| time).sum();
        let part = |(name, time): &(String, f64)| format!("{name} {:.0} %", 100.0 * time / all);
        self.split.iter().map(part).collect::<Vec<_>>().join(", ")
    }
}

/// Where a result comes from.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Provenance {
    pub version: String,
    pub commit: String,
    pub dirty: bool,
    /// BLAKE3 of Cargo.lock.
    pub lock_hash: String,
    /// BLAKE3 of the simulator's sources.
    pub simulator_hash: String,
    pub compiler: String,
    pub cpu: String,
    /// RFC 3339, UTC.
    pub finished: String,
}
