//! The run as it is recorded, and what the record does to it: the flux follows the cake.

use std::collections::VecDeque;

use super::cake::Cake;
use super::feeder::{Feeder, volume};
use super::model::{Deposited, Feed, Filtration};
use super::operation::Operation;
use crate::bed::Bed;
use crate::math::Vec3;
use crate::outcome::Outcome;
use crate::scene::sedimentation::album::Album;
use crate::scene::sedimentation::fate::{Signs, diverged};
use crate::scene::sedimentation::observe::{Measures, Settled};
use crate::scene::sedimentation::step::Limits;

/// Speed of a slow grain over the terminal speed [-].
const SLOW: f64 = 0.1;
/// Rows over which a settled grain has not moved.
const WINDOW: usize = 2;

/// One instant.
#[derive(Clone, Copy, Debug, Default)]
pub struct Row {
    /// [s]
    pub time: f64,
    pub measures: Measures,
    pub cake: Cake,
    /// q [m/s] and ΔP [Pa].
    pub flux: f64,
    pub pressure_drop: f64,
    /// Filtrate per area [m].
    pub filtrate: f64,
    pub fed: usize,
    pub waiting: usize,
    pub passed: usize,
    /// Greatest overlap since the last row over the smaller diameter [-].
    pub deepest: f64,
}

pub struct Watch<'a> {
    pub scene: &'a Filtration,
    pub bed: Bed,
    pub operation: Operation,
    pub limits: &'a Limits,
    pub rows: Vec<Row>,
    pub settled: Option<Settled>,
    pub album: Album,
    feeder: Feeder,
    /// A terminal speed [m/s]: what counts as slow is measured by it.
    speed: f64,
    /// Places in the feed of the moving grains by their numbers in the bed.
    names: Vec<u32>,
    /// Positions by place in the feed at the last rows.
    places: VecDeque<Vec<Vec3>>,
    /// Number and volume [m³] of the grains that have passed.
    passed: (usize, f64),
    filtrate: f64,
    flux: f64,
    /// Whether anything has moved, come or gone since the last look: places in the bed are others.
    moved: bool,
}

impl<'a> Watch<'a> {
    pub fn new(scene: &'a Filtration, bed: Bed, operation: Operation, limits: &'a Limits) -> Self {
        let speeds = scene
            .bed
            .extremes()
            .into_iter()
            .map(|(body, density)| scene.bed.greatest_speed(&body, density));
        let mut feeder = Feeder::new(scene);
        if scene.feed == Feed::AtStart {
            let radii = (0..bed.grains.moving).map(|grain| bed.grains.radius(grain));
            feeder.all_here(radii.map(volume).sum());
        }
        Watch {
            scene,
            speed: speeds.fold(0.0, f64::max),
            names: (0..bed.grains.moving as u32).collect(),
            bed,
            operation,
            limits,
            rows: Vec::new(),
            settled: None,
            album: Album::new(&scene.bed, limits.time_step),
            feeder,
            places: VecDeque::new(),
            passed: (0, 0.0),
            filtrate: 0.0,
            flux: operation.flux,
            moved: false,
        }
    }

    /// The number of a grain in the feed from that in the bed; grains of the medium follow.
    fn name(names: &[u32], total: usize) -> impl Fn(u32) -> u32 + '_ {
        move |number| {
            let fixed = || total as u32 + number - names.len() as u32;
            names.get(number as usize).copied().unwrap_or_else(fixed)
        }
    }

    /// Lets the filtrate of the last steps go, takes in who comes with it and lets go who has passed;
    /// says whether anybody came or went.
    pub fn exchange(&mut self, done: u64, steps: u64) -> bool {
        let elapsed = steps as f64 * self.limits.time_step;
        self.filtrate += self.flux * elapsed;
        self.feeder.draw(self.flux, elapsed);
        let time = done as f64 * self.limits.time_step;
        let leaving = self.through();
        let arriving = self.feeder.feed(&self.bed, time, self.flux);
        if leaving.is_empty() && arriving.is_empty() {
            return false;
        }
        let first = (self.feeder.fed - arriving.len()) as u32;
        self.bed.exchange(&leaving, &arriving);
        let mut number = 0;
        self.names.retain(|_| {
            number += 1;
            !leaving.contains(&(number - 1))
        });
        self.names.extend(first..first + arriving.len() as u32);
        true
    }

    /// Numbers of the grains that are out of the medium's reach below it.
    fn through(&mut self) -> Vec<u32> {
        let grains = &self.bed.grains;
        let bottom = self.scene.bed.floor_bottom();
        // A flat medium gives way a little and lets nobody through.
        let below = |grain: &usize| grains.position(*grain).z < bottom - grains.radius(*grain);
        let leaving: Vec<usize> = (0..grains.moving).filter(below).collect();
        for grain in &leaving {
            self.passed.0 += 1;
            self.passed.1 += volume(grains.radius(*grain));
        }
        leaving.into_iter().map(|grain| grains.number[grain]).collect()
    }

    /// Sees how things stand and lets the flux follow.
    pub fn look(&mut self, done: u64) {
        let time = done as f64 * self.limits.time_step;
        let settled = self.deposit();
        self.keep_places();
        self.moved = false;
        let mut measures = Measures::of(&self.scene.bed, &self.bed, &settled);
        let cake = Cake::of(
            self.scene,
            &self.bed,
            &settled,
            &measures,
            &self.feeder,
            self.passed.1,
        );
        if cake.deposited == 0 {
            // No cake has no porosity, not even in an empty cell.
            let nothing = f64::NAN;
            (measures.porosity, measures.porosity_half) = (nothing, nothing);
            (measures.porosity_centre, measures.area_porosity) = (nothing, nothing);
        }
        measures.settled_share = cake.deposited as f64 / self.feeder.fed.max(1) as f64;
        let viscosity = self.scene.viscosity();
        let (flux, pressure_drop) =
            self.scene
                .filtrate
                .with_cake(&self.operation, viscosity, cake.resistance);
        if flux != self.flux {
            self.flux = flux;
            self.bed.draw(flux);
        }
        self.rows.push(Row {
            time,
            measures,
            cake,
            flux,
            pressure_drop,
            filtrate: self.filtrate,
            fed: self.feeder.fed,
            waiting: self.feeder.due(time) - self.feeder.fed,
            passed: self.passed.0,
            deepest: std::mem::take(&mut self.bed.deepest),
        });
        let name = Self::name(&self.names, self.feeder.total());
        self.album.keep(&self.bed, time, &settled.contacts, name);
        self.settled = Some(settled);
    }

    /// Tells that the bed is about to move.
    pub fn part(&mut self) {
        self.moved = true;
    }

    /// Keeps where everybody is.
    fn keep_places(&mut self) {
        let grains = &self.bed.grains;
        // Who came later has been nowhere.
        let nowhere = Vec3::repeat(f64::NAN);
        let mut positions = vec![nowhere; self.feeder.total()];
        for place in 0..grains.moving {
            let name = self.names[grains.number[place] as usize];
            positions[name as usize] = grains.position(place);
        }
        self.places.push_back(positions);
        if self.places.len() > WINDOW {
            self.places.pop_front();
        }
    }

    /// Who belongs to the cake.
    fn deposit(&self) -> Settled {
        let grains = &self.bed.grains;
        match self.scene.deposited {
            Deposited::Carried => Settled::carried(&self.bed, |_| true),
            Deposited::Slow => {
                let limit = SLOW * self.speed;
                Settled::carried(&self.bed, |grain| grains.velocity(grain).norm() < limit)
            }
            Deposited::Settled => {
                let before = (self.places.len() == WINDOW).then(|| {
                    let own = self.names.iter().map(|name| self.places[0][*name as usize]);
                    own.collect::<Vec<Vec3>>()
                });
                Settled::of(&self.bed, before.as_deref(), self.speed)
            }
        }
    }

    /// Depth under the top of the cell at which the lowest grain was fed, in largest diameters [-].
    pub fn feed_depth(&self) -> f64 {
        (self.scene.top() - self.feeder.lowest) / self.scene.bed.largest_diameter()
    }

    /// Whether all grains have come and none is under way.
    pub fn all_settled(&self) -> bool {
        let under_way = |row: &Row| row.cake.in_flight + self.feeder.total() - row.fed;
        self.rows.last().is_some_and(|row| under_way(row) == 0)
    }

    /// Why the run makes no sense any more.
    pub fn diverged(&self) -> Option<String> {
        let row = self.rows.last()?;
        let bed = &self.scene.bed;
        let mass: f64 = bed
            .classes
            .iter()
            .map(|class| class.density * f64::from(class.number) * class.mean_cube())
            .sum();
        let carried = mass * self.scene.drive().speed.powi(2);
        let signs = Signs {
            time: row.time,
            energy: row.measures.kinetic_energy,
            // Nothing can move faster than the fall through the cell and the flow make it.
            most: bed.load() * bed.container.height + carried,
            source: "what gravity and the flow can give",
            deepest: row.deepest,
        };
        diverged(&self.bed, &signs)
    }

    /// What is known, at any time: a run may end between two looks.
    pub fn outcome(&mut self) -> Outcome {
        if self.moved {
            self.settled = Some(self.deposit());
        }
        let time = self.rows.last().map_or(0.0, |row| row.time);
        let name = Self::name(&self.names, self.feeder.total());
        super::outcome::outcome(self, |contacts| {
            self.album.table(&self.bed, time, contacts, &name)
        })
    }
}
