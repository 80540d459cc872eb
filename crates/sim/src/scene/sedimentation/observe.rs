//! What is seen of a bed at one instant.

use std::f64::consts::PI;

use super::interior::Lines;
use super::model::{Dimensions, Sedimentation};
use crate::bed::Bed;
use crate::coupling::permeability;
use crate::coupling::slices::{solid_volume_between, sphere_volume_between};
use crate::math::Vec3;
use crate::scene::divergence::kinetic_energy;

/// Speed of a settled grain, over the terminal speed [-].
const SETTLED_SPEED: f64 = 0.01;
/// Way of a settled grain in a window, over its diameter [-].
const SETTLED_WAY: f64 = 0.01;

/// Who has settled: slow, hardly moved since the last window, and carried by a chain of contacts that
/// reaches the floor.
pub struct Settled {
    /// By place in the bed.
    pub grains: Vec<bool>,
    /// Contacts of each grain, with grains and walls.
    pub contacts: Vec<u16>,
}

impl Settled {
    /// `before` holds the positions of all numbers one window ago [m], `speed` a terminal speed [m/s].
    pub fn of(bed: &Bed, before: Option<&[Vec3]>, speed: f64) -> Settled {
        let grains = &bed.grains;
        let touching = bed.contacts();
        let contacts = touching.numbers(grains.len());
        let quiet = |grain: usize| {
            let still = grains.velocity(grain).norm() < SETTLED_SPEED * speed;
            let number = grains.number[grain] as usize;
            let moved = before.map_or(f64::INFINITY, |before| {
                bed.nearest(grains.position(grain) - before[number]).norm()
            });
            still && moved < SETTLED_WAY * 2.0 * grains.radius(grain)
        };
        let mut settled = vec![false; grains.len()];
        let mut neighbours = vec![Vec::new(); grains.len()];
        for &[i, j] in &touching.pairs {
            neighbours[i as usize].push(j);
            neighbours[j as usize].push(i);
        }
        // Wall 0 is the floor; fixed grains carry as well.
        let floor = touching
            .walls
            .iter()
            .filter(|(_, wall)| *wall == 0)
            .map(|&(grain, _)| grain);
        let mut carried: Vec<u32> = floor.chain(grains.moving as u32..grains.len() as u32).collect();
        let mut seen = vec![false; grains.len()];
        while let Some(grain) = carried.pop() {
            let place = grain as usize;
            if std::mem::replace(&mut seen[place], true) {
                continue;
            }
            let fixed = place >= grains.moving;
            if fixed || quiet(place) {
                settled[place] = !fixed;
                carried.extend(&neighbours[place]);
            }
        }
        Settled {
            grains: settled,
            contacts,
        }
    }

    pub fn count(&self) -> usize {
        self.grains.iter().filter(|settled| **settled).count()
    }
}

/// A bed in numbers.
#[derive(Clone, Copy, Debug, Default)]
pub struct Measures {
    /// From the lowest to the highest point of settled grains [m].
    pub thickness: f64,
    /// Porosity of the central slice, of the central half, and by centres [-].
    pub porosity: f64,
    pub porosity_half: f64,
    pub porosity_centre: f64,
    /// Ends of the central slice [m].
    pub slice: [f64; 2],
    /// By areas of discs [-]; two dimensions.
    pub area_porosity: f64,
    pub permeability: f64,
    pub settled_share: f64,
    pub coordination: f64,
    pub centre_of_mass: f64,
    pub top_height: f64,
    pub mean_speed: f64,
    pub kinetic_energy: f64,
}

impl Measures {
    pub fn of(scene: &Sedimentation, bed: &Bed, settled: &Settled) -> Measures {
        let grains = &bed.grains;
        let moving = 0..grains.moving;
        let count = grains.moving as f64;
        if grains.moving == 0 {
            return Measures {
                porosity: 1.0,
                porosity_half: 1.0,
                porosity_centre: 1.0,
                area_porosity: 1.0,
                ..Measures::default()
            };
        }
        let (mut low, mut high, mut coordination) = (f64::INFINITY, f64::NEG_INFINITY, 0.0);
        for grain in moving.clone().filter(|grain| settled.grains[*grain]) {
            let (z, radius) = (grains.position(grain).z, grains.radius(grain));
            low = low.min(z - radius);
            high = high.max(z + radius);
            coordination += f64::from(settled.contacts[grain]);
        }
        let number = settled.count();
        let mut measures = Measures {
            settled_share: number as f64 / count,
            porosity: f64::NAN,
            porosity_half: f64::NAN,
            porosity_centre: f64::NAN,
            area_porosity: f64::NAN,
            permeability: f64::NAN,
            ..Measures::default()
        };
        if number > 0 && high > low {
            measures.thickness = high - low;
            measures.coordination = coordination / number as f64;
            measures.of_bed(scene, bed, [low, high]);
        }
        let mut mass = 0.0;
        for grain in moving {
            let (own, z) = (grains.mass(grain), grains.position(grain).z);
            mass += own;
            measures.centre_of_mass += own * z;
            measures.mean_speed += grains.velocity(grain).norm() / count;
            measures.top_height = measures.top_height.max(z + grains.radius(grain));
        }
        measures.centre_of_mass /= mass;
        measures.kinetic_energy = kinetic_energy(bed);
        measures
    }

    fn of_bed(&mut self, scene: &Sedimentation, bed: &Bed, [low, high]: [f64; 2]) {
        let grains = &bed.grains;
        let area = scene.container.width * scene.depth();
        let central = |share: f64| {
            let margin = 0.5 * (1.0 - share) * (high - low);
            [low + margin, high - margin]
        };
        let spheres = || (0..grains.moving).map(|grain| (grains.position(grain).z, grains.radius(grain)));
        let porosity =
            |[from, to]: [f64; 2]| 1.0 - solid_volume_between(spheres(), from, to) / (area * (to - from));
        let slice = central(scene.central_slice);
        self.slice = slice;
        self.porosity = porosity(slice);
        self.porosity_half = porosity(central(0.5));
        let inside = || spheres().filter(|(z, _)| *z >= slice[0] && *z < slice[1]);
        let span = slice[1] - slice[0];
        let volume: f64 = inside().map(|(_, radius)| 4.0 / 3.0 * PI * radius.powi(3)).sum();
        let discs: f64 = inside().map(|(_, radius)| PI * radius * radius).sum();
        self.porosity_centre = 1.0 - volume / (area * span);
        self.area_porosity = 1.0 - discs / (scene.container.width * span);
        let (cubes, squares) = spheres().fold((0.0, 0.0), |(cubes, squares), (_, radius)| {
            (cubes + radius.powi(3), squares + radius * radius)
        });
        let seen = match scene.dimensions {
            Dimensions::Two => self.area_porosity,
            Dimensions::Three => self.porosity,
        };
        self.permeability = permeability::kozeny_carman(seen, 2.0 * cubes / squares);
    }
}

/// Porosity [-] between two heights [m], one largest diameter away from flat side walls.
pub fn porosity_interior(scene: &Sedimentation, bed: &Bed, heights: [f64; 2]) -> f64 {
    let grains = &bed.grains;
    let lines = Lines::away_from_walls(scene.container.width, scene.depth(), scene.largest_diameter());
    let spheres = (0..grains.moving).map(|grain| (grains.position(grain), grains.radius(grain)));
    lines.porosity(spheres, heights)
}

/// Porosity [-] by areas of all settled discs in a bed of this thickness [m], from its lowest to its
/// highest point. Grains that still fall are not part of it.
pub fn whole_area_porosity(scene: &Sedimentation, bed: &Bed, settled: &Settled, thickness: f64) -> f64 {
    if thickness <= 0.0 {
        return f64::NAN;
    }
    let discs: f64 = (0..bed.grains.moving)
        .filter(|grain| settled.grains[*grain])
        .map(|grain| PI * bed.grains.radius(grain).powi(2))
        .sum();
    1.0 - discs / (scene.container.width * thickness)
}

/// Heights [m] and porosities [-] of thin slices from the floor to the top of the highest grain.
pub fn profile(scene: &Sedimentation, bed: &Bed) -> [Vec<f64>; 2] {
    let grains = &bed.grains;
    let spacing = 0.5 * scene.largest_diameter();
    let top = (0..grains.moving)
        .map(|grain| grains.position(grain).z + grains.radius(grain))
        .fold(0.0, f64::max);
    let count = (top / spacing).ceil() as usize;
    let area = scene.container.width * scene.depth();
    let mut solids = vec![0.0; count];
    for grain in 0..grains.moving {
        let (z, radius) = (grains.position(grain).z, grains.radius(grain));
        let first = ((z - radius) / spacing).floor().max(0.0) as usize;
        let last = (((z + radius) / spacing).ceil().max(0.0) as usize).min(count);
        for (slice, solids) in solids.iter_mut().enumerate().take(last).skip(first) {
            let low = slice as f64 * spacing;
            *solids += sphere_volume_between(z, radius, low, low + spacing);
        }
    }
    [
        (0..count).map(|slice| (slice as f64 + 0.5) * spacing).collect(),
        solids
            .iter()
            .map(|solids| 1.0 - solids / (area * spacing))
            .collect(),
    ]
}
