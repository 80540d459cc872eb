//! What is seen of a cake at one instant, and how it resists the filtrate.

use super::feeder::{Feeder, volume};
use super::model::{CakeLength, CakePermeability, Filtration};
use super::surface::Surface;
use crate::bed::Bed;
use crate::coupling::permeability::kozeny_carman;
use crate::coupling::slices::{solid_volume_between, sphere_volume_between};
use crate::scene::Dimensions;
use crate::scene::sedimentation::observe::{Measures, Settled};

/// A cake in numbers.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cake {
    pub deposited: usize,
    /// Volume and mass of its grains [m³], [kg].
    pub volume: f64,
    pub mass: f64,
    /// Mean height of its surface over the medium [m].
    pub thickness_mean: f64,
    /// Of its grains from its lowest to its highest point [-].
    pub porosity_whole: f64,
    /// k [m²], infinite where there is none.
    pub permeability: f64,
    /// L/k [1/m]
    pub resistance: f64,
    /// Grains in the cell that are not part of it.
    pub in_flight: usize,
    /// Gap between the volume fed and all that is accounted for, over the volume fed [-].
    pub volume_error: f64,
    /// Gap between its volume and (1 − ε) A L, over its volume [-].
    pub solids_error: f64,
    /// Volume of grains carried along x per area and time [m/s].
    pub grain_flux: f64,
}

impl Cake {
    /// `passed` is the volume of the grains that have passed [m³].
    pub fn of(
        scene: &Filtration,
        bed: &Bed,
        settled: &Settled,
        measures: &Measures,
        feeder: &Feeder,
        passed: f64,
    ) -> Cake {
        let grains = &bed.grains;
        let mut cake = Cake {
            porosity_whole: f64::NAN,
            permeability: f64::NAN,
            ..Cake::default()
        };
        let (mut flying, mut flux) = (0.0, 0.0);
        for grain in 0..grains.moving {
            let own = volume(grains.radius(grain));
            flux += own * grains.velocity(grain).x;
            if settled.grains[grain] {
                cake.deposited += 1;
                cake.volume += own;
                cake.mass += grains.mass(grain);
            } else {
                cake.in_flight += 1;
                flying += own;
            }
        }
        cake.grain_flux = flux / (scene.area() * scene.bed.container.height);
        if feeder.fed_volume > 0.0 {
            let found = flying + cake.volume + passed;
            cake.volume_error = (feeder.fed_volume - found).abs() / feeder.fed_volume;
        }
        if cake.deposited > 0 {
            cake.resist(scene, bed, settled, measures);
        }
        cake
    }

    fn resist(&mut self, scene: &Filtration, bed: &Bed, settled: &Settled, measures: &Measures) {
        let grains = &bed.grains;
        let lying = || (0..grains.moving).filter(|grain| settled.grains[*grain]);
        let container = &scene.bed.container;
        let depth = (scene.bed.dimensions == Dimensions::Three).then_some(container.depth);
        let surface = Surface::new(
            container.width,
            depth,
            scene.bed.periodic(),
            scene.bed.smallest_diameter(),
        );
        let spheres = lying().map(|grain| (grains.position(grain), grains.radius(grain)));
        self.thickness_mean = surface.mean_height(spheres, scene.bed.floor_top());
        let [low, high] = measures.ends;
        let own = lying().map(|grain| (grains.position(grain).z, grains.radius(grain)));
        let solids = solid_volume_between(own, low, high);
        self.porosity_whole = 1.0 - solids / (scene.area() * (high - low));
        self.solids_error = (solids / self.volume - 1.0).abs();
        let (permeability, resistance) = match scene.filtrate.permeability {
            CakePermeability::Mean => (measures.permeability, (high - low) / measures.permeability),
            CakePermeability::Layered => {
                let layers = layers(scene, bed, [low, high]);
                let sum: f64 = layers.iter().map(Layer::resistance).sum();
                ((high - low) / sum, sum)
            }
        };
        self.permeability = permeability;
        self.resistance = match scene.filtrate.length {
            CakeLength::Thickness => resistance,
            CakeLength::CellHeight => resistance * container.height / (high - low),
        };
    }

    /// ⟨α⟩ [m/kg]: the resistance over the mass per area [m²].
    pub fn specific_resistance(&self, area: f64) -> f64 {
        self.resistance / (self.mass / area)
    }
}

/// A layer of a cake.
#[derive(Clone, Copy, Debug)]
pub struct Layer {
    /// Its ends [m].
    pub ends: [f64; 2],
    pub porosity: f64,
    pub permeability: f64,
}

impl Layer {
    pub fn resistance(&self) -> f64 {
        (self.ends[1] - self.ends[0]) / self.permeability
    }
}

/// Layers one largest diameter thick between two heights [m], the last one thinner; permeabilities by
/// Kozeny and Carman with the local porosity and the local Sauter diameter.
pub fn layers(scene: &Filtration, bed: &Bed, [low, high]: [f64; 2]) -> Vec<Layer> {
    let grains = &bed.grains;
    let thickness = scene.bed.largest_diameter();
    // What is left over by rounding is no layer.
    let count = ((high - low) / thickness - 1e-9).ceil().max(0.0) as usize;
    let ends = |layer: usize| [layer, layer + 1].map(|end| (low + end as f64 * thickness).min(high));
    let mut sums = vec![(0.0, 0.0); count];
    for grain in 0..grains.moving {
        let (z, radius) = (grains.position(grain).z, grains.radius(grain));
        let first = (((z - radius - low) / thickness).floor().max(0.0) as usize).min(count);
        let last = (((z + radius - low) / thickness).ceil().max(0.0) as usize).min(count);
        for (layer, sum) in sums.iter_mut().enumerate().take(last).skip(first) {
            let [from, to] = ends(layer);
            let part = sphere_volume_between(z, radius, from, to);
            sum.0 += part;
            sum.1 += part / (2.0 * radius);
        }
    }
    let layer = |(layer, (solids, per_diameter)): (usize, &(f64, f64))| {
        let ends = ends(layer);
        let porosity = 1.0 - solids / (scene.area() * (ends[1] - ends[0]));
        Layer {
            ends,
            porosity,
            permeability: kozeny_carman(porosity, solids / per_diameter),
        }
    };
    sums.iter().enumerate().map(layer).collect()
}
