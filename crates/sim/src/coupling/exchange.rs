//! One list of weights between grains and fluid serves every sum of the coupling.
//!
//! A grain samples a field with weights w_ai = V_a W*(r_ai, h_i) / Σ_b V_b W*(r_bi, h_i), which sum to
//! one (Shepard 1968), and hands its impulse back with the same weights, so that action equals reaction
//! to rounding. What the fluid learns of the grains comes from the plain kernel, each grain with its own
//! exchange length h_i:
//!
//! ```text
//! φ_a = Σ_i V_i W(r_ai, h_i),   its flux Σ_i V_i v_i W,   its surface Σ_i (V_i/d_i) W
//! ```

mod sums;
mod twice;

use std::f64::consts::PI;

use super::weights::{Sample, Spread, Weights};
use crate::fluid::FluidParticles;
use crate::fluid::kernel::Sharpening;
use crate::math::{Number, Vec3, along_curve};
use crate::neighbours::{Record, Rows, images, in_widest};

/// What a grain may sample from a fluid particle: a velocity [m/s], a force density [N/m³], the porosity
/// [-] and Σ φ_k/d_k over the grains' sizes [1/m]. One cache line.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C, align(64))]
pub struct Field(pub [f64; 8]);

impl Field {
    pub fn new(velocity: Vec3, stress: Vec3, porosity: f64, surface: f64) -> Self {
        Field([
            velocity.x, velocity.y, velocity.z, stress.x, stress.y, stress.z, porosity, surface,
        ])
    }

    pub fn velocity(&self) -> Vec3 {
        Vec3::new(self.0[0], self.0[1], self.0[2])
    }

    pub fn stress(&self) -> Vec3 {
        Vec3::new(self.0[3], self.0[4], self.0[5])
    }

    pub fn porosity(&self) -> f64 {
        self.0[6]
    }

    pub fn surface(&self) -> f64 {
        self.0[7]
    }
}

/// What the exchange must know of a grain besides where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GrainSize {
    /// d [m].
    pub diameter: f64,
    /// Exchange length h_x [m]; the support is twice as wide.
    pub length: f64,
}

impl GrainSize {
    /// V [m³].
    pub fn volume(&self) -> f64 {
        PI / 6.0 * self.diameter * self.diameter * self.diameter
    }
}

/// How the sums are taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExchangeRules {
    /// Of the weights.
    pub sharpening: Sharpening,
    /// Whether grains are mirrored at the floor z = 0 in what the fluid learns of them: a grain next to it
    /// then gives all its volume to the fluid side, and solids have no flux through it.
    pub floor_images: bool,
    /// r/h from which on fluid particles get no weight, 2 for the whole kernel [-].
    pub cut: f64,
}

/// What the fluid knows of the grains, by fluid particle.
#[derive(Clone, Debug, Default)]
pub struct Solids {
    /// φ = 1 − ε [-].
    pub fraction: Vec<f64>,
    /// Its rate of change along the particle [1/s].
    pub rate: Vec<f64>,
    /// Σ V_i v_i W [m/s].
    pub flux: Vec<Vec3>,
    /// Σ (V_i/d_i) W [1/m].
    pub surface: Vec<f64>,
}

impl Solids {
    fn read(&mut self, sums: &[Record]) {
        self.fraction.clear();
        self.rate.clear();
        self.flux.clear();
        self.surface.clear();
        for Record([fraction, rate, x, y, z, surface, ..]) in sums {
            self.fraction.push(*fraction);
            self.rate.push(*rate);
            self.flux.push(Vec3::new(*x, *y, *z));
            self.surface.push(*surface);
        }
    }
}

/// Share of the widest support added to the candidate rows.
const SKIN: f64 = 0.12;

pub struct Exchange {
    pub rules: ExchangeRules,
    /// Of the last refresh.
    pub solids: Solids,
    sizes: Vec<GrainSize>,
    /// Share of its volume that each grain gives to the fluid [-].
    given: Vec<f64>,
    /// What is smoothed among the fluid once more.
    twice: Option<twice::SecondSmoothing>,
    /// The smallest and the largest [m].
    diameters: (f64, f64),
    /// Rows of weights and candidates follow this order of the grains, cell by cell, so that
    /// consecutive rows share their fluid particles.
    order: Vec<u32>,
    /// Row of each grain.
    row_of: Vec<u32>,
    weights: Weights,
    candidates: Rows,
    /// Source and offset of every candidate point.
    origins: Vec<(u32, Vec3)>,
    /// The sources alone, and one for the padding.
    source_of: Vec<u32>,
    /// The candidate points as the refresh reads them: x, y, z, u_x, u_y, u_z, V. One more without
    /// volume and far away stands behind them for the padding.
    points: Vec<Record>,
    /// Solids under way: φ, its rate, flux in x, y and z, surface.
    sums: Vec<Record>,
    /// Relative displacement since the candidates were collected is bounded by these anchors.
    fluid_anchor: Vec<Vec3>,
    grain_anchor: Vec<Vec3>,
    /// Pairs of all refreshes, and how often candidates were collected.
    pub pairs: u64,
    pub collections: u64,
}

impl Exchange {
    /// Grains of these sizes at these places [m].
    pub fn new(
        sizes: Vec<GrainSize>,
        rules: ExchangeRules,
        fluid: &FluidParticles,
        position: &[Vec3],
    ) -> Self {
        let mut exchange = Exchange {
            rules,
            solids: Solids::default(),
            diameters: sizes.iter().fold((f64::INFINITY, 0.0), |(low, high), size| {
                (size.diameter.min(low), size.diameter.max(high))
            }),
            given: vec![1.0; sizes.len()],
            twice: None,
            sizes,
            order: Vec::new(),
            row_of: Vec::new(),
            weights: Weights::default(),
            candidates: Rows::default(),
            origins: Vec::new(),
            source_of: Vec::new(),
            points: Vec::new(),
            sums: Vec::new(),
            fluid_anchor: Vec::new(),
            grain_anchor: Vec::new(),
            pairs: 0,
            collections: 0,
        };
        exchange.collect(fluid, position);
        exchange
    }

    /// Lets each grain give only a share [-] of its volume to the fluid.
    pub fn giving(mut self, shares: Vec<f64>) -> Self {
        self.given = shares;
        self
    }

    /// Smooths what marked grains give once more among the fluid, over `length` [m].
    pub fn smoothing_twice(mut self, marked: Vec<bool>, length: f64, fluid: &FluidParticles) -> Self {
        self.twice = Some(twice::SecondSmoothing::new(marked, length));
        self.collect_second(fluid);
        self
    }

    fn collect_second(&mut self, fluid: &FluidParticles) {
        let skin = self.skin();
        if let Some(twice) = &mut self.twice {
            twice.collect(fluid, &self.origins, skin);
        }
    }

    /// Diameter and exchange length of a grain.
    pub fn size(&self, grain: usize) -> &GrainSize {
        &self.sizes[grain]
    }

    /// The smallest and the largest diameter [m].
    pub fn diameters(&self) -> (f64, f64) {
        self.diameters
    }

    /// Recomputes weights and solids for grains at these places [m] with these velocities [m/s], and for the
    /// fluid where it will be `ahead` [s] from now.
    pub fn refresh(&mut self, fluid: &FluidParticles, ahead: f64, position: &[Vec3], velocity: &[Vec3]) {
        if self.outgrown(fluid, ahead, position) {
            self.collect(fluid, position);
        }
        self.write_points(fluid, ahead);
        self.weights.clear(self.candidates.len_padded());
        self.sums.clear();
        self.sums.resize(fluid.len(), Record::default());
        if let Some(twice) = &mut self.twice {
            twice.clear(fluid.len());
        }
        let width = fluid.width;
        in_widest(sums::Weigh {
            exchange: self,
            position,
            velocity,
            width,
        });
        if let Some(twice) = &self.twice {
            twice.add_to(&mut self.sums, &self.points, &self.source_of);
        }
        self.solids.read(&self.sums);
        self.pairs += self.weights.members() as u64;
    }

    fn write_points(&mut self, fluid: &FluidParticles, ahead: f64) {
        self.points.clear();
        for &(source, shift) in &self.origins {
            let a = source as usize;
            let u = &fluid.velocity[a];
            let x = unwrapped(&fluid.position[a], &self.fluid_anchor[a], fluid.width) + shift + u * ahead;
            self.points
                .push(Record([x.x, x.y, x.z, u.x, u.y, u.z, fluid.volume(a), 0.0]));
        }
        let far = -1e3 * (1.0 + fluid.width);
        self.points.push(Record([far, far, far, 0.0, 0.0, 0.0, 0.0, 0.0]));
    }

    /// Way [m] beyond the supports that grains and fluid together may go on one collection.
    fn skin(&self) -> f64 {
        let widest = self.sizes.iter().map(|size| size.length).fold(0.0, f64::max);
        SKIN * 2.0 * widest
    }

    fn outgrown(&self, fluid: &FluidParticles, ahead: f64, position: &[Vec3]) -> bool {
        let furthest = |ways: &mut dyn Iterator<Item = Vec3>| {
            ways.map(|way| way.norm_squared()).fold(0.0, f64::max).sqrt()
        };
        let way = |x: &Vec3, anchor: &Vec3| unwrapped(x, anchor, fluid.width) - anchor;
        let places = fluid.position.iter().zip(&fluid.velocity);
        let mut flown = (places.zip(&self.fluid_anchor)).map(|((x, u), anchor)| way(x, anchor) + u * ahead);
        let mut fallen = (position.iter().zip(&self.grain_anchor)).map(|(x, anchor)| way(x, anchor));
        furthest(&mut flown) + furthest(&mut fallen) >= self.skin()
    }

    fn collect(&mut self, fluid: &FluidParticles, position: &[Vec3]) {
        let skin = self.skin();
        let widest = self.sizes.iter().map(|size| size.length).fold(0.0, f64::max);
        let images = images(&fluid.position, fluid.width, 2.0 * widest + skin);
        self.origins = (0..fluid.len() as u32).map(|a| (a, Vec3::zeros())).collect();
        self.origins
            .extend(images.iter().map(|image| (image.source, image.shift)));
        let points: Vec<Vec3> = self
            .origins
            .iter()
            .map(|(source, shift)| fluid.position[*source as usize] + shift)
            .collect();
        self.source_of = self
            .origins
            .iter()
            .map(|(source, _)| *source)
            .chain([0])
            .collect();
        let places: Vec<[f64; 3]> = position.iter().map(|place| (*place).into()).collect();
        self.order = along_curve(&places, widest);
        self.row_of = vec![0; position.len()];
        for (row, &i) in self.order.iter().enumerate() {
            self.row_of[i as usize] = row as u32;
        }
        let targets: Vec<Vec3> = self.order.iter().map(|&i| position[i as usize]).collect();
        let radii: Vec<f64> = (self.order.iter())
            .map(|&i| 2.0 * self.sizes[i as usize].length + skin)
            .collect();
        self.candidates = Rows::within(&targets, &radii, &points, points.len() as u32);
        self.fluid_anchor = fluid.position.clone();
        self.grain_anchor = position.to_vec();
        self.collections += 1;
        self.collect_second(fluid);
    }

    /// Weighted means of a field around every grain. Rows that follow each other share their fluid
    /// particles, so that these are found in the nearest cache.
    pub fn sample_all(&self, fields: &[Field], means: &mut Vec<Field>) {
        means.resize(self.order.len(), Field::default());
        in_widest(Sample {
            weights: &self.weights,
            fields,
            order: &self.order,
            means,
        });
    }

    /// Adds four numbers of every grain, such as an impulse [N s], to the sums of the fluid particles
    /// around it, each with its share.
    pub fn spread(&self, given: &[[f64; 4]], sums: &mut [[f64; 4]]) {
        in_widest(Spread {
            weights: &self.weights,
            order: &self.order,
            given,
            sums,
        });
    }

    /// Σ_a w_a²/V_a [1/m³]: how much of a force density it hands out a grain samples back.
    pub fn echo(&self, grain: usize, fluid: &FluidParticles) -> f64 {
        let row = self.weights.row(self.row_of[grain] as usize);
        row.map(|(source, share)| share * share / fluid.volume(source as usize))
            .sum()
    }
}

/// The copy of a place that has not left its anchor through a periodic side.
#[inline(always)]
pub(super) fn unwrapped(place: &Vec3, anchor: &Vec3, width: f64) -> Vec3 {
    let whole = |way: f64| width * Number::round(way / width);
    Vec3::new(
        place.x - whole(place.x - anchor.x),
        place.y - whole(place.y - anchor.y),
        place.z,
    )
}

#[cfg(test)]
mod tests;
