//! Snapshots: every grain at equally spaced times.

use super::model::Sedimentation;
use crate::bed::Bed;
use crate::outcome::{Column, Table};

/// One kept instant [s]: a row per grain.
type Snapshot = (f64, Vec<[f64; FIELDS.len()]>);

const FIELDS: [(&str, &str); 10] = [
    ("grain", "1"),
    ("class", "1"),
    ("x", "m"),
    ("y", "m"),
    ("z", "m"),
    ("radius", "m"),
    ("speed_x", "m/s"),
    ("speed_y", "m/s"),
    ("speed_z", "m/s"),
    ("coordination", "1"),
];

/// The snapshots of a run.
pub struct Album {
    wanted: u32,
    duration: f64,
    time_step: f64,
    kept: Vec<Snapshot>,
}

impl Album {
    /// For a run with a time step [s].
    pub fn new(scene: &Sedimentation, time_step: f64) -> Self {
        Album {
            wanted: scene.snapshots,
            duration: scene.duration,
            time_step,
            kept: Vec::new(),
        }
    }

    /// Keeps a snapshot where one is due at a time [s]. `contacts` counts those of each place; `name`
    /// tells the number that a grain is known by from that in the bed.
    pub fn keep(&mut self, bed: &Bed, time: f64, contacts: &[u16], name: impl Fn(u32) -> u32) {
        if self.wanted < 2 {
            return;
        }
        let due = self.kept.len() as f64 * self.duration / f64::from(self.wanted - 1);
        if time + 0.5 * self.time_step >= due {
            self.kept.push((time, rows(bed, contacts, name)));
        }
    }

    /// All that is kept, and the end at a time [s] where the run has ended early.
    pub fn table(&self, bed: &Bed, time: f64, contacts: &[u16], name: impl Fn(u32) -> u32) -> Table {
        let missing = self.kept.last().is_none_or(|(kept, _)| *kept < time);
        let last = missing.then(|| (time, rows(bed, contacts, name)));
        let all = || self.kept.iter().chain(&last);
        let times = all().flat_map(|(time, rows)| rows.iter().map(|_| *time));
        let mut columns = vec![Column {
            name: "time",
            unit: "s",
            values: times.collect(),
        }];
        columns.extend(FIELDS.iter().enumerate().map(|(field, (name, unit))| Column {
            name,
            unit,
            values: all().flat_map(|(_, rows)| rows).map(|row| row[field]).collect(),
        }));
        Table {
            name: "snapshots",
            columns,
        }
    }
}

fn rows(bed: &Bed, contacts: &[u16], name: impl Fn(u32) -> u32) -> Vec<[f64; FIELDS.len()]> {
    let grains = &bed.grains;
    let row = |place: u32| {
        let grain = place as usize;
        let (x, v) = (bed.inside(grains.position(grain)), grains.velocity(grain));
        let class = match grains.class[grain] {
            u16::MAX => -1.0,
            class => f64::from(class),
        };
        [
            f64::from(name(grains.number[grain])),
            class,
            x.x,
            x.y,
            x.z,
            grains.radius(grain),
            v.x,
            v.y,
            v.z,
            f64::from(contacts[grain]),
        ]
    };
    grains.places().into_iter().map(row).collect()
}
