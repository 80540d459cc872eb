//! The run of a sedimentation scene.

use std::f64::consts::PI;

use super::growth::Growth;
use super::model::{Dimensions, Floor, Sedimentation, Sides, Until};
use super::mover::Mover;
use super::observe::{Measures, Settled, porosity_interior, profile, whole_area_porosity};
use super::start::start;
use super::step::limits;
use crate::bed::Bed;
use crate::math::Vec3;
use crate::outcome::{Column, Control, Failure, Outcome, Scalar, Table};
use crate::scene::course::{Recorded, follow, without_room, work_of};
use crate::scene::divergence::{Signs, diverged, leapt};
use crate::scene::snapshots::Snapshots;

/// Rows of the time series at most.
const MOST_ROWS: f64 = 1000.0;
/// Rows over which a settled grain has not moved.
const WINDOW: usize = 2;
/// Drag relaxation times after which grains fall at their first speed.
const START_UP: f64 = 6.0;

/// Runs the scene to its end.
///
/// # Errors
/// Grains without room, overlaps beyond 5 % of a diameter, a grain that leaps, or a stop from outside.
pub fn run(scene: &Sedimentation, control: &Control) -> Result<Outcome, Box<Failure>> {
    let bed = start(scene).map_err(|fault| without_room(&fault))?;
    let limits = limits(scene);
    let dt = limits.time_step;
    let steps = (scene.duration / dt).ceil().max(1.0) as u64;
    let mut watch = Watch::new(scene, bed, limits.contact_time, dt);
    let motion = Mover::start(scene.integrator, &mut watch.bed);
    follow(
        Running { watch, motion },
        scene.duration,
        steps,
        MOST_ROWS,
        control,
    )
}

/// A bed in motion.
struct Running<'a> {
    watch: Watch<'a>,
    motion: Mover,
}

impl Recorded for Running<'_> {
    // Often enough to be stopped within a moment, in any bed.
    fn patience(&self) -> u64 {
        (2_000_000 / (self.watch.bed.grains.len() as u64 + 1)).clamp(1, 1000)
    }

    fn advance(&mut self, done: u64, steps: u64) -> Result<(), String> {
        let time = (done + steps) as f64 * self.watch.dt;
        let moved = self.motion.advance(&mut self.watch.bed, steps);
        moved.map_err(|astray| leapt(&astray, time))
    }

    fn look(&mut self, done: u64) {
        self.watch.look(done);
    }

    fn diverged(&self) -> Option<String> {
        self.watch.diverged()
    }

    fn is_over(&self) -> bool {
        self.watch.scene.until == Until::Settled && self.watch.all_settled()
    }

    fn outcome(&mut self) -> Outcome {
        self.watch.outcome()
    }
}

/// The run as it is recorded.
struct Watch<'a> {
    scene: &'a Sedimentation,
    bed: Bed,
    contact_time: f64,
    dt: f64,
    /// A terminal speed [m/s]: what counts as slow is measured by it.
    speed: f64,
    rows: Vec<(f64, Measures, f64)>,
    /// Positions by number at the last rows.
    places: std::collections::VecDeque<Vec<Vec3>>,
    settled: Option<Settled>,
    settling_time: f64,
    first_speed: f64,
    deepest: f64,
    snapshots: Snapshots,
}

impl<'a> Watch<'a> {
    fn new(scene: &'a Sedimentation, bed: Bed, contact_time: f64, dt: f64) -> Self {
        let speeds = scene
            .extremes()
            .into_iter()
            .map(|(body, density)| scene.greatest_speed(&body, density));
        Watch {
            scene,
            bed,
            contact_time,
            dt,
            speed: speeds.fold(0.0, f64::max),
            rows: Vec::new(),
            places: std::collections::VecDeque::new(),
            settled: None,
            settling_time: f64::NAN,
            first_speed: f64::NAN,
            deepest: 0.0,
            snapshots: Snapshots::new(scene.snapshots, scene.duration),
        }
    }

    fn look(&mut self, done: u64) {
        let time = done as f64 * self.dt;
        let before = (self.places.len() == WINDOW).then(|| self.places[0].as_slice());
        let settled = Settled::of(&self.bed, before, self.speed);
        let measures = Measures::of(self.scene, &self.bed, &settled);
        let grains = &self.bed.grains;
        let mut positions = vec![Vec3::zeros(); grains.len()];
        for (place, &number) in grains.number.iter().enumerate() {
            positions[number as usize] = grains.position(place);
        }
        self.places.push_back(positions);
        if self.places.len() > WINDOW {
            self.places.pop_front();
        }
        if measures.settled_share < 1.0 {
            self.settling_time = f64::NAN;
        } else if self.settling_time.is_nan() {
            self.settling_time = time;
        }
        if self.first_speed.is_nan() && time >= START_UP * self.relaxation() {
            self.first_speed = self.falling_speed(&settled);
        }
        let deepest = std::mem::take(&mut self.bed.deepest);
        self.deepest = self.deepest.max(deepest);
        self.rows.push((time, measures, deepest));
        self.snapshots
            .keep(&self.bed, &settled.contacts, [time, self.dt], |number| number);
        self.settled = Some(settled);
    }

    /// Time in which drag stops the slowest grain [s].
    fn relaxation(&self) -> f64 {
        let viscosity = self.scene.fluid.medium().viscosity;
        let time = |radius: f64, mass: f64| mass / (6.0 * PI * viscosity * radius);
        self.scene
            .extremes()
            .iter()
            .map(|(body, _)| time(body.radius, body.mass))
            .fold(0.0, f64::max)
    }

    /// Mean downward speed [m/s] of the grains in the middle of those that have not settled.
    fn falling_speed(&self, settled: &Settled) -> f64 {
        let grains = &self.bed.grains;
        let mut falling: Vec<(f64, f64)> = (0..grains.moving)
            .filter(|grain| !settled.grains[*grain] && settled.contacts[*grain] == 0)
            .map(|grain| (grains.position(grain).z, -grains.velocity(grain).z))
            .collect();
        falling.sort_by(|a, b| a.0.total_cmp(&b.0));
        let middle = &falling[falling.len() / 4..falling.len() - falling.len() / 4];
        middle.iter().map(|(_, speed)| speed).sum::<f64>() / middle.len() as f64
    }

    fn all_settled(&self) -> bool {
        self.rows
            .last()
            .is_some_and(|(_, measures, _)| measures.settled_share >= 1.0)
    }

    /// Why the run makes no sense any more.
    fn diverged(&self) -> Option<String> {
        let (time, _, deepest) = self.rows.last()?;
        let signs = Signs {
            time: *time,
            // Nothing can move faster than the fall through the whole box makes it.
            most: self.scene.load() * self.scene.container.height,
            source: "the work of gravity",
            deepest: *deepest,
        };
        diverged(&self.bed, &signs)
    }

    /// Grains beyond the walls.
    fn fallen_out(&self) -> usize {
        let grains = &self.bed.grains;
        let container = &self.scene.container;
        let floor = match container.floor {
            Floor::Flat => 0.0,
            Floor::Grains(floor) => -0.5 * floor.diameter,
        };
        let [along, across] = self.scene.periodic();
        let out = |grain: &usize| {
            let x = grains.position(*grain);
            let beside = !along && (x.x < 0.0 || x.x > container.width)
                || !across
                    && self.scene.dimensions == Dimensions::Three
                    && (x.y < 0.0 || x.y > container.depth);
            x.z < floor || beside
        };
        (0..grains.moving).filter(out).count()
    }

    fn outcome(&self) -> Outcome {
        let mut tables = vec![self.time_series()];
        let [heights, porosities] = profile(self.scene, &self.bed);
        tables.push(Table {
            name: "porosity_profile",
            columns: vec![
                column("height", "m", heights),
                column("porosity", "1", porosities),
            ],
        });
        let time = self.rows.last().map_or(0.0, |row| row.0);
        let contacts = self
            .settled
            .as_ref()
            .map_or(&[][..], |settled| settled.contacts.as_slice());
        tables.extend(self.snapshots.table(&self.bed, contacts, time, |number| number));
        Outcome {
            scalars: self.scalars(),
            tables,
            counters: work_of(&self.bed),
        }
    }

    fn scalars(&self) -> Vec<Scalar> {
        let last = self.rows.last().map_or(Measures::default(), |row| row.1);
        let mut scalars = Vec::new();
        let mut add = |name, unit, value| scalars.push(Scalar { name, unit, value });
        if self.scene.dimensions == Dimensions::Two {
            add("area_porosity", "1", last.area_porosity);
            let whole = self.settled.as_ref().map_or(f64::NAN, |settled| {
                whole_area_porosity(self.scene, &self.bed, settled, last.thickness)
            });
            add("area_porosity_whole", "1", whole);
            add("porosity_drop", "1", self.porosity_drop());
        } else if self.scene.container.sides == Sides::Walls {
            let interior = porosity_interior(self.scene, &self.bed, last.slice);
            add("porosity_interior", "1", interior);
        }
        if let Floor::Grains(_) = self.scene.container.floor {
            add("floor_grain_diameter", "m", self.floor_grain_diameter());
        }
        add("porosity", "1", last.porosity);
        add("porosity_half", "1", last.porosity_half);
        add("porosity_centre", "1", last.porosity_centre);
        add("solids_fraction", "1", 1.0 - last.porosity);
        add("thickness", "m", last.thickness);
        add("permeability", "m²", last.permeability);
        add("settling_time", "s", self.settling_time);
        let growth = self.growth();
        add("plateau_time", "s", growth.plateau_time);
        add("growth_linearity", "1", growth.linearity);
        add("final_growth_rate", "m/s", growth.final_rate);
        add("settled_share", "1", last.settled_share);
        add("coordination", "1", last.coordination);
        add("largest_overlap", "1", self.deepest);
        add("momentum_error", "1", self.bed.momentum_error());
        add("first_speed", "m/s", self.first_speed);
        add("centre_of_mass", "m", last.centre_of_mass);
        add("time_step", "s", self.dt);
        add("contact_time", "s", self.contact_time);
        add("grains_fallen_out", "1", self.fallen_out() as f64);
        let work = &self.bed.work;
        add("pairs_per_search", "1", work.looked_at as f64 / work.lists as f64);
        scalars
    }

    fn growth(&self) -> Growth {
        let times: Vec<f64> = self.rows.iter().map(|row| row.0).collect();
        let thicknesses: Vec<f64> = self.rows.iter().map(|row| row.1.thickness).collect();
        Growth::of(&times, &thicknesses)
    }

    /// From the first settled grains to the end [-].
    fn porosity_drop(&self) -> f64 {
        let known = |row: &&(f64, Measures, f64)| !row.1.porosity.is_nan();
        let [first, last] = [self.rows.iter().find(known), self.rows.iter().rfind(known)];
        match (first, last) {
            (Some(first), Some(last)) => first.1.porosity - last.1.porosity,
            _ => f64::NAN,
        }
    }

    /// Of the fixed grains that make the floor [m].
    fn floor_grain_diameter(&self) -> f64 {
        2.0 * self.bed.grains.radius(self.bed.grains.moving)
    }

    fn time_series(&self) -> Table {
        let of =
            |value: fn(&Measures) -> f64| self.rows.iter().map(|(_, measures, _)| value(measures)).collect();
        let mut table = Table {
            name: "time_series",
            columns: vec![
                column("time", "s", self.rows.iter().map(|row| row.0).collect()),
                column("thickness", "m", of(|measures| measures.thickness)),
                column("porosity", "1", of(|measures| measures.porosity)),
                column("settled_share", "1", of(|measures| measures.settled_share)),
                column("centre_of_mass", "m", of(|measures| measures.centre_of_mass)),
                column("top_height", "m", of(|measures| measures.top_height)),
                column("mean_speed", "m/s", of(|measures| measures.mean_speed)),
                column("kinetic_energy", "J", of(|measures| measures.kinetic_energy)),
                column("coordination", "1", of(|measures| measures.coordination)),
                column(
                    "largest_overlap",
                    "1",
                    self.rows.iter().map(|row| row.2).collect(),
                ),
            ],
        };
        if self.scene.dimensions == Dimensions::Two {
            table.columns.push(column(
                "area_porosity",
                "1",
                of(|measures| measures.area_porosity),
            ));
        }
        table
    }
}

fn column(name: &'static str, unit: &'static str, values: Vec<f64>) -> Column {
    Column { name, unit, values }
}
