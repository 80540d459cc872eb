//! Grains that wait to come into the cell, and how they do.

use super::model::{Feed, Filtration};
use crate::bed::{Bed, Grain};
use crate::contact::Body;
use crate::math::{Random, Vec3};
use crate::scene::sedimentation::start::bodies;

/// Places tried for a grain before it waits for the next round.
const TRIES: u32 = 200;
/// Gap kept between grains, and between grains and walls, over the sum of radii [-].
const CLEARANCE: f64 = 1e-9;
/// A grain is due as soon as its time has come up to rounding [-].
const ROUNDING: f64 = 1e-9;

/// The grains that have not come yet.
pub struct Feeder {
    feed: Feed,
    /// Bodies and classes in the order in which they come.
    order: Vec<(Body, u16)>,
    /// Number of those that have come, and their volume [m³].
    pub fed: usize,
    pub fed_volume: f64,
    /// Volume of solids that has come with the suspension [m³].
    drawn: f64,
    /// Settling speed of a grain among others in the suspension [m/s].
    settling: f64,
    area: f64,
    width: [f64; 2],
    periodic: [bool; 2],
    /// Ends of the zone that grains are fed into [m].
    zone: [f64; 2],
    flat: bool,
    /// Lowest height at which a grain has come [m].
    pub lowest: f64,
    random: Random,
}

impl Feeder {
    pub fn new(scene: &Filtration) -> Self {
        let bed = &scene.bed;
        let mut random = Random::new(bed.seed);
        let mut order = bodies(bed, &mut random);
        if bed.classes.len() > 1 {
            random.shuffle(&mut order);
        }
        let layers = match scene.feed {
            Feed::AtStart => 0.0,
            Feed::Rate { layers, .. } | Feed::Suspension { layers, .. } => layers,
        };
        let top = scene.top();
        let flat = bed.dimensions == crate::scene::Dimensions::Two;
        Feeder {
            feed: scene.feed,
            order,
            fed: 0,
            fed_volume: 0.0,
            drawn: 0.0,
            settling: settling_speed(scene),
            area: scene.area(),
            width: [bed.container.width, bed.depth()],
            periodic: bed.periodic(),
            zone: [(top - layers * bed.largest_diameter()).max(bed.floor_top()), top],
            flat,
            lowest: f64::NAN,
            random,
        }
    }

    /// All grains are in the cell, with a volume [m³].
    pub fn all_here(&mut self, volume: f64) {
        (self.fed, self.fed_volume) = (self.order.len(), volume);
    }

    pub fn total(&self) -> usize {
        self.order.len()
    }

    /// Lets the filtrate flow with a flux [m/s] over a time [s].
    pub fn draw(&mut self, flux: f64, time: f64) {
        if let Feed::Suspension { solids_fraction, .. } = self.feed {
            self.drawn += solids_fraction * (flux + self.settling) * self.area * time;
        }
    }

    /// Number of grains that should have come by a time [s].
    pub fn due(&self, time: f64) -> usize {
        let due = match self.feed {
            Feed::AtStart => self.total(),
            Feed::Rate { rate, .. } => (rate * time * (1.0 + ROUNDING)) as usize,
            Feed::Suspension { .. } => {
                let mut volumes = self.fed_volume;
                let comes = |(body, _): &&(Body, u16)| {
                    volumes += volume(body.radius);
                    volumes <= self.drawn * (1.0 + ROUNDING)
                };
                self.fed + self.order[self.fed..].iter().take_while(comes).count()
            }
        };
        due.min(self.total())
    }

    /// Puts those that are due by a time [s] where there is room, in turn, until one finds none.
    /// They come with the velocity of a fluid that flows down with `flux` [m/s].
    pub fn feed(&mut self, bed: &Bed, time: f64, flux: f64) -> Vec<Grain> {
        let due = self.due(time);
        if due == self.fed {
            return Vec::new();
        }
        let grains = &bed.grains;
        let mut near: Vec<(Vec3, f64)> = (0..grains.len())
            .map(|grain| (grains.position(grain), grains.radius(grain)))
            .filter(|(position, radius)| position.z + radius > self.zone[0])
            .collect();
        let mut arriving = Vec::new();
        while self.fed < due {
            let (body, class) = self.order[self.fed];
            let Some(position) = self.room(bed, &near, body.radius) else {
                break;
            };
            near.push((position, body.radius));
            self.lowest = self.lowest.min(position.z);
            arriving.push(Grain {
                body,
                class,
                position,
                velocity: bed.surroundings.flow(position.z, -flux).into(),
                angular_velocity: Vec3::zeros(),
            });
            self.fed += 1;
            self.fed_volume += volume(body.radius);
        }
        arriving
    }

    /// A place without neighbours for a grain of this radius [m].
    fn room(&mut self, bed: &Bed, near: &[(Vec3, f64)], radius: f64) -> Option<Vec3> {
        let margin = radius * (1.0 + CLEARANCE);
        let sideways = |axis: usize| {
            if self.periodic[axis] {
                [0.0, self.width[axis]]
            } else {
                [margin, self.width[axis] - margin]
            }
        };
        let along = sideways(0);
        let across = if self.flat { [0.0; 2] } else { sideways(1) };
        let up = [self.zone[0] + margin, self.zone[1] - margin];
        (0..TRIES).find_map(|_| {
            let mut between = |[low, high]: [f64; 2]| self.random.between(low, high.max(low));
            let position = Vec3::new(between(along), between(across), between(up));
            let free = |(other, size): &(Vec3, f64)| {
                let contact = (radius + size) * (1.0 + CLEARANCE);
                bed.nearest(position - other).norm_squared() > contact * contact
            };
            near.iter().all(free).then_some(position)
        })
    }
}

/// Settling speed in the suspension where grains settle into the cell, else zero [m/s].
fn settling_speed(scene: &Filtration) -> f64 {
    let Feed::Suspension {
        solids_fraction,
        settling: true,
        ..
    } = scene.feed
    else {
        return 0.0;
    };
    scene.settling_speed(1.0 - solids_fraction).unwrap_or(0.0)
}

/// Volume of a sphere [m³].
pub fn volume(radius: f64) -> f64 {
    Body::sphere(2.0 * radius, 1.0).mass
}

impl Filtration {
    /// Speed [m/s] at which the grain of the mean size settles among others at a porosity, beside the
    /// flow of the filtrate; `None` without drag.
    pub fn settling_speed(&self, porosity: f64) -> Option<f64> {
        let bed = &self.bed;
        let (_, density) = bed.extremes().into_iter().next()?;
        let mean = Body::sphere(bed.sauter_diameter(), density);
        bed.settling_speed(&mean, density, porosity)
    }
}
