//! A suspension as it is recorded.

use super::model::Suspension;
use super::observe::{MOST_CLASSES, Measures};
use super::profile::Deposit;
use super::run::Settling;
use crate::outcome::{Column, Outcome, Scalar, Table};
use crate::scene::course::Recorded;
use crate::scene::divergence::{Signs, diverged};
use crate::scene::snapshots::Snapshots;

pub struct Watch<'a, S> {
    pub scene: &'a Suspension,
    pub settling: S,
    pub rows: Vec<Measures>,
    /// Weight less buoyancy of all grains, each counted with its sign off [N].
    load: f64,
    weight: f64,
    momentum_gap: f64,
    snapshots: Snapshots,
}

impl<S: Settling> Recorded for Watch<'_, S> {
    fn patience(&self) -> u64 {
        self.settling.patience()
    }

    fn advance(&mut self, _: u64, steps: u64) -> Result<(), String> {
        self.settling.advance(steps)
    }

    fn look(&mut self, done: u64) {
        let time = done as f64 * self.settling.time_step();
        let settling = &self.settling;
        let measures = Measures::of(self.scene, settling.bed(), time, |place| settling.slip(place));
        self.rows.push(measures);
        self.momentum_gap = self.momentum_gap.max(settling.momentum_gap());
        let contacts = settling.bed().contact_numbers();
        self.snapshots.keep(
            settling.bed(),
            &contacts,
            [time, settling.time_step()],
            |number| number,
        );
        self.settling.forget_deepest();
    }

    fn diverged(&self) -> Option<String> {
        let last = self.rows.last()?;
        // Nothing can move faster than the fall through the whole column makes it.
        let signs = Signs {
            time: last.time,
            most: self.load * self.scene.column.height,
            source: "the work of gravity",
            deepest: last.deepest,
        };
        diverged(self.settling.bed(), &signs)
    }

    fn is_over(&self) -> bool {
        false
    }

    fn split_of_time(&self) -> Vec<(&'static str, f64)> {
        self.settling.split_of_time()
    }

    fn outcome(&mut self) -> Outcome {
        let deposit = self.deposit();
        let bed = self.settling.bed();
        let mut tables = vec![self.time_series(&deposit), self.porosity_map()];
        let time = self.rows.last().map_or(0.0, |row| row.time);
        tables.extend(
            self.snapshots
                .table(bed, &bed.contact_numbers(), time, |number| number),
        );
        Outcome {
            scalars: self.scalars(&deposit),
            tables,
            counters: self.settling.counters(),
        }
    }
}

impl<'a, S: Settling> Watch<'a, S> {
    pub fn new(scene: &'a Suspension, settling: S) -> Self {
        let bed = settling.bed();
        let mass: f64 = (0..bed.grains.moving).map(|grain| bed.grains.mass(grain)).sum();
        Watch {
            load: scene.as_sedimentation().load(),
            weight: mass * scene.gravity,
            snapshots: Snapshots::new(scene.snapshots, scene.duration),
            scene,
            settling,
            rows: Vec::new(),
            momentum_gap: 0.0,
        }
    }

    /// The deposit at the last row.
    fn deposit(&self) -> Deposit {
        let area = self.scene.column.width * self.scene.column.width;
        let none = Deposit {
            height: 0.0,
            solids: f64::NAN,
            threshold: f64::NAN,
        };
        self.rows.last().map_or(none, |row| {
            Deposit::of(self.settling.bed(), &row.profile, 1.0 - self.scene.porosity, area)
        })
    }

    fn scalars(&self, deposit: &Deposit) -> Vec<Scalar> {
        let bed = self.settling.bed();
        let heights = (0..bed.grains.moving).map(|grain| bed.grains.position(grain).z);
        let settled = heights.filter(|z| *z < deposit.height).count();
        let counters = self.settling.counters();
        let deepest = self.rows.iter().map(|row| row.deepest).fold(0.0, f64::max);
        let scalar = |name, unit, value| Scalar { name, unit, value };
        let mut scalars = vec![
            scalar("bed_porosity", "1", 1.0 - deposit.solids),
            scalar("bed_thickness", "m", deposit.height),
            scalar("deposit_fraction", "1", deposit.solids),
            scalar("solids_fraction", "1", self.solids_fraction()),
            scalar("momentum_error", "1", self.momentum_gap / self.weight),
            scalar("largest_overlap", "1", deepest),
            scalar("porosity_clips", "1", counters.porosity_clips as f64),
            scalar("settled_share", "1", settled as f64 / bed.grains.moving as f64),
            scalar("grain_number", "1", bed.grains.moving as f64),
            scalar("time_step", "s", self.settling.time_step()),
        ];
        scalars.extend(self.settling.scalars());
        scalars
    }

    /// Share of the column that the grains fill [-].
    fn solids_fraction(&self) -> f64 {
        let bed = self.settling.bed();
        let volume = |grain: usize| 4.0 / 3.0 * std::f64::consts::PI * bed.grains.radius(grain).powi(3);
        let column = &self.scene.column;
        (0..bed.grains.moving).map(volume).sum::<f64>() / (column.width * column.width * column.height)
    }

    fn time_series(&self, deposit: &Deposit) -> Table {
        const INTERFACE: [&str; MOST_CLASSES] = [
            "interface_height_1",
            "interface_height_2",
            "interface_height_3",
            "interface_height_4",
        ];
        const CENTRE: [&str; MOST_CLASSES] = [
            "centre_of_mass_1",
            "centre_of_mass_2",
            "centre_of_mass_3",
            "centre_of_mass_4",
        ];
        const SLIP: [&str; MOST_CLASSES] = ["slip_1", "slip_2", "slip_3", "slip_4"];
        const SPEED: [&str; MOST_CLASSES] = [
            "settling_speed_1",
            "settling_speed_2",
            "settling_speed_3",
            "settling_speed_4",
        ];
        let front = |row: &Measures| row.profile.front_from_below(deposit.threshold);
        let mut columns = vec![
            self.column("time", "s", |row| row.time),
            self.column("interface_height", "m", |row| row.interface_height[0]),
            self.column("interface_front", "m", |row| row.interface_front),
            self.column("bed_front", "m", front),
            self.column("centre_of_mass", "m", |row| row.centre_of_mass[0]),
            self.column("velocity_fluctuation", "m/s", |row| row.fluctuation[0]),
            self.column("velocity_fluctuation_horizontal", "m/s", |row| row.fluctuation[1]),
        ];
        for class in 0..self.scene.classes.len().min(MOST_CLASSES) {
            columns.extend([
                self.column(INTERFACE[class], "m", |row| row.interface_height[1 + class]),
                self.column(CENTRE[class], "m", |row| row.centre_of_mass[1 + class]),
                self.column(SLIP[class], "m/s", |row| row.slip[class]),
                self.column(SPEED[class], "m/s", |row| row.settling_speed[class]),
            ]);
        }
        Table {
            name: "time_series",
            columns,
        }
    }

    fn porosity_map(&self) -> Table {
        let levels = || {
            self.rows
                .iter()
                .flat_map(|row| (0..row.profile.solids.len()).map(move |level| (row, level)))
        };
        let column = |name, unit, values| Column { name, unit, values };
        Table {
            name: "porosity_map",
            columns: vec![
                column("time", "s", levels().map(|(row, _)| row.time).collect()),
                column(
                    "height",
                    "m",
                    levels().map(|(row, level)| row.profile.middle(level)).collect(),
                ),
                column(
                    "porosity",
                    "1",
                    levels()
                        .map(|(row, level)| 1.0 - row.profile.solids[level])
                        .collect(),
                ),
            ],
        }
    }

    fn column(&self, name: &'static str, unit: &'static str, value: impl Fn(&Measures) -> f64) -> Column {
        Column {
            name,
            unit,
            values: self.rows.iter().map(value).collect(),
        }
    }
}
