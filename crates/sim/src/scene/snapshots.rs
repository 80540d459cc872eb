//! Every grain of a bed at some instants of a run.

use crate::bed::Bed;
use crate::outcome::{Column, Table};

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

/// Snapshots equally spaced in time, the first and the last included.
#[derive(Clone, Debug)]
pub struct Snapshots {
    wanted: u32,
    duration: f64,
    kept: Vec<Snapshot>,
}

/// A time [s] and a row per grain, by number.
type Snapshot = (f64, Vec<[f64; FIELDS.len()]>);

impl Snapshots {
    /// None below two.
    pub fn new(wanted: u32, duration: f64) -> Self {
        Snapshots {
            wanted,
            duration,
            kept: Vec::new(),
        }
    }

    /// Keeps the bed at `time` [s] where a snapshot is due within half a step of `dt` [s]. `contacts`
    /// counts those of each place, none where it is empty; `name` tells the number that a grain is known
    /// by from that in the bed.
    pub fn keep(&mut self, bed: &Bed, contacts: &[u16], [time, dt]: [f64; 2], name: impl Fn(u32) -> u32) {
        if self.wanted < 2 {
            return;
        }
        let due = self.kept.len() as f64 * self.duration / f64::from(self.wanted - 1);
        if time + 0.5 * dt >= due {
            self.kept.push(snapshot(bed, contacts, time, name));
        }
    }

    /// All that are kept; the bed at `time` [s] as well where the run has ended early.
    pub fn table(&self, bed: &Bed, contacts: &[u16], time: f64, name: impl Fn(u32) -> u32) -> Option<Table> {
        if self.wanted < 2 {
            return None;
        }
        let missing = self.kept.last().is_none_or(|(kept, _)| *kept < time);
        let last = missing.then(|| snapshot(bed, contacts, time, name));
        let all = || self.kept.iter().chain(&last);
        let rows = || all().flat_map(|(_, rows)| rows);
        let times = all().flat_map(|(time, rows)| rows.iter().map(|_| *time));
        let mut columns = vec![column("time", "s", times.collect())];
        columns.extend(
            FIELDS
                .iter()
                .enumerate()
                .map(|(field, (name, unit))| column(name, unit, rows().map(|row| row[field]).collect())),
        );
        Some(Table {
            name: "snapshots",
            columns,
        })
    }
}

fn snapshot(bed: &Bed, contacts: &[u16], time: f64, name: impl Fn(u32) -> u32) -> Snapshot {
    let grains = &bed.grains;
    let row = |place: u32| {
        let grain = place as usize;
        let (x, v) = (bed.inside(grains.position(grain)), grains.velocity(grain));
        let class = match grains.class[grain] {
            u16::MAX => -1.0,
            class => f64::from(class),
        };
        let contacts = contacts.get(grain).map_or(0.0, |contacts| f64::from(*contacts));
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
            contacts,
        ]
    };
    (time, grains.places().into_iter().map(row).collect())
}

fn column(name: &'static str, unit: &'static str, values: Vec<f64>) -> Column {
    Column { name, unit, values }
}
