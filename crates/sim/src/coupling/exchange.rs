//! One list of weights between grains and fluid serves every sum of the coupling.
//!
//! A grain samples a field with weights w_ai = V_a W*(r_ai) / Σ_b V_b W*(r_bi), which sum to one
//! (Shepard 1968), and hands its impulse back with the same weights, so that action equals reaction
//! to rounding. The porosity of the fluid comes from the plain kernel:
//!
//! ```text
//! ε_a = 1 − Σ_i V_i W(r_ai, h_x)
//! ```

use crate::fluid::FluidParticles;
use crate::fluid::kernel::{Kernel, Sharpening, WendlandC2};
use crate::math::Vec3;
use crate::neighbours::{Rows, images};

/// What a grain may sample from a fluid particle: a velocity [m/s], a force density [N/m³] and the
/// porosity [-]. One cache line.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C, align(64))]
pub struct Field(pub [f64; 8]);

impl Field {
    pub fn new(velocity: Vec3, stress: Vec3, porosity: f64) -> Self {
        Field([
            velocity.x, velocity.y, velocity.z, stress.x, stress.y, stress.z, porosity, 0.0,
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
}

/// Share of the support added to the candidate rows.
const SKIN: f64 = 0.08;

pub struct Exchange {
    /// Exchange length h_x [m]; the support is twice as wide.
    pub length: f64,
    pub sharpening: Sharpening,
    /// Solids fraction 1 − ε of each fluid particle at the last refresh [-].
    pub solids: Vec<f64>,
    /// Its rate of change along the particle [1/s].
    pub solids_rate: Vec<f64>,
    starts: Vec<u32>,
    sources: Vec<u32>,
    weights: Vec<f64>,
    candidates: Rows,
    /// Source and offset of every candidate point.
    origins: Vec<(u32, Vec3)>,
    /// Relative displacement since the candidates were collected is bounded by these anchors.
    fluid_anchor: Vec<Vec3>,
    grain_anchor: Vec<Vec3>,
    pub pairs: u64,
}

impl Exchange {
    pub fn new(length: f64, sharpening: Sharpening, fluid: &FluidParticles, grains: &[Vec3]) -> Self {
        let mut exchange = Exchange {
            length,
            sharpening,
            solids: vec![0.0; fluid.len()],
            solids_rate: vec![0.0; fluid.len()],
            starts: Vec::new(),
            sources: Vec::new(),
            weights: Vec::new(),
            candidates: Rows::default(),
            origins: Vec::new(),
            fluid_anchor: Vec::new(),
            grain_anchor: Vec::new(),
            pairs: 0,
        };
        exchange.collect(fluid, grains);
        exchange
    }

    /// Recomputes weights and porosities for grains of `volume` [m³] that move with `velocity` [m/s].
    pub fn refresh(&mut self, fluid: &FluidParticles, grains: &[Vec3], volume: f64, velocity: Vec3) {
        if self.outgrown(fluid, grains) {
            self.collect(fluid, grains);
        }
        self.solids.fill(0.0);
        self.solids_rate.fill(0.0);
        self.starts.clear();
        self.starts.push(0);
        self.sources.clear();
        self.weights.clear();
        let per_length = 1.0 / self.length;
        let (unit, slope_unit) = (volume * per_length.powi(3), volume * per_length.powi(5));
        for (i, grain) in grains.iter().enumerate() {
            let first = self.weights.len();
            let mut norm = 0.0;
            for &member in self.candidates.row(i) {
                let Some(&(source, shift)) = self.origins.get(member as usize) else {
                    break;
                };
                let a = source as usize;
                let r = fluid.position[a] + shift - grain;
                let q = r.norm() * per_length;
                if q >= 2.0 {
                    continue;
                }
                self.solids[a] += unit * WendlandC2.value(q);
                self.solids_rate[a] +=
                    slope_unit * WendlandC2.slope(q) * r.dot(&(fluid.velocity[a] - velocity));
                let weight = fluid.volume(a) * self.sharpening.value(q);
                norm += weight;
                self.sources.push(source);
                self.weights.push(weight);
            }
            self.weights[first..]
                .iter_mut()
                .for_each(|weight| *weight /= norm);
            self.starts.push(self.weights.len() as u32);
        }
        self.pairs += self.weights.len() as u64;
    }

    fn outgrown(&self, fluid: &FluidParticles, grains: &[Vec3]) -> bool {
        let allowed = SKIN * 2.0 * self.length;
        let furthest = |now: &[Vec3], anchor: &[Vec3], wrapped: f64| {
            now.iter()
                .zip(anchor)
                .map(|(x, x0)| {
                    let mut r = x - x0;
                    // A particle that crossed a periodic side has moved by a whole width.
                    r.x -= wrapped * (r.x / wrapped).round();
                    r.y -= wrapped * (r.y / wrapped).round();
                    r.norm_squared()
                })
                .fold(0.0, f64::max)
                .sqrt()
        };
        let crossed = |now: &[Vec3], anchor: &[Vec3]| {
            now.iter()
                .zip(anchor)
                .any(|(x, x0)| (x.x - x0.x).abs().max((x.y - x0.y).abs()) > 0.5 * fluid.width)
        };
        crossed(&fluid.position, &self.fluid_anchor)
            || furthest(&fluid.position, &self.fluid_anchor, fluid.width)
                + furthest(grains, &self.grain_anchor, fluid.width)
                >= allowed
    }

    fn collect(&mut self, fluid: &FluidParticles, grains: &[Vec3]) {
        let reach = 2.0 * self.length * (1.0 + SKIN);
        let images = images(&fluid.position, fluid.width, reach);
        self.origins = (0..fluid.len() as u32).map(|a| (a, Vec3::zeros())).collect();
        self.origins
            .extend(images.iter().map(|image| (image.source, image.shift)));
        let points: Vec<Vec3> = self
            .origins
            .iter()
            .map(|(source, shift)| fluid.position[*source as usize] + shift)
            .collect();
        self.candidates = Rows::new(grains, &points, reach, u32::MAX);
        self.fluid_anchor = fluid.position.clone();
        self.grain_anchor = grains.to_vec();
    }

    fn row(&self, grain: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let range = self.starts[grain] as usize..self.starts[grain + 1] as usize;
        self.sources[range.clone()]
            .iter()
            .zip(&self.weights[range])
            .map(|(source, weight)| (*source as usize, *weight))
    }

    /// Weighted mean of a field around a grain.
    pub fn sample(&self, grain: usize, fields: &[Field]) -> Field {
        let mut mean = Field::default();
        for (a, weight) in self.row(grain) {
            for (sum, value) in mean.0.iter_mut().zip(&fields[a].0) {
                *sum += weight * value;
            }
        }
        mean
    }

    /// Adds an impulse [N s] around a grain to the impulses of the fluid particles.
    pub fn spread(&self, grain: usize, impulse: Vec3, impulses: &mut [[f64; 4]]) {
        let impulse = [impulse.x, impulse.y, impulse.z, 0.0];
        for (a, weight) in self.row(grain) {
            for (sum, value) in impulses[a].iter_mut().zip(&impulse) {
                *sum += weight * value;
            }
        }
    }

    /// Σ_a w_a²/V_a [1/m³]: how much of a force density it hands out a grain samples back.
    pub fn echo(&self, grain: usize, fluid: &FluidParticles) -> f64 {
        self.row(grain)
            .map(|(a, weight)| weight * weight / fluid.volume(a))
            .sum()
    }
}
