//! One list of weights between grains and fluid serves every sum of the coupling.
//!
//! A grain samples a field with weights w_ai = V_a W*(r_ai) / Σ_b V_b W*(r_bi), which sum to one
//! (Shepard 1968), and hands its impulse back with the same weights, so that action equals reaction
//! to rounding. The porosity of the fluid comes from the plain kernel:
//!
//! ```text
//! ε_a = 1 − Σ_i V_i W(r_ai, h_x)
//! ```

use super::Weights;
use crate::fluid::FluidParticles;
use crate::fluid::kernel::{Kernel, Sharpening, WendlandC2};
use crate::math::Vec3;
#[cfg(target_arch = "x86_64")]
use crate::neighbours::{Avx2, Avx512};
use crate::neighbours::{LANES, Plain, Record, Rows, Wide, images};

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
    /// Solids fraction and its rate under way, side by side.
    sums: Vec<[f64; 2]>,
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
        };
        exchange.collect(fluid, grains);
        exchange
    }

    /// Recomputes weights and porosities for grains of `volume` [m³] that move with `velocity` [m/s].
    pub fn refresh(&mut self, fluid: &FluidParticles, grains: &[Vec3], volume: f64, velocity: Vec3) {
        if self.outgrown(fluid, grains) {
            self.collect(fluid, grains);
        }
        self.write_points(fluid, velocity);
        self.weights.clear(self.candidates.len_padded());
        self.sums.clear();
        self.sums.resize(fluid.len(), [0.0; 2]);
        self.weigh(grains, volume);
        for (a, [solids, rate]) in self.sums.iter().enumerate() {
            self.solids[a] = *solids;
            self.solids_rate[a] = *rate;
        }
        self.pairs += self.weights.members() as u64;
    }

    /// Velocities are written relative to the grains.
    fn write_points(&mut self, fluid: &FluidParticles, velocity: Vec3) {
        self.points.clear();
        self.points.extend(self.origins.iter().map(|&(source, shift)| {
            let a = source as usize;
            let (x, u) = (fluid.position[a] + shift, fluid.velocity[a] - velocity);
            Record([x.x, x.y, x.z, u.x, u.y, u.z, fluid.volume(a), 0.0])
        }));
        let far = -1e3 * (1.0 + fluid.width);
        self.points.push(Record([far, far, far, 0.0, 0.0, 0.0, 0.0, 0.0]));
    }

    fn weigh(&mut self, grains: &[Vec3], volume: f64) {
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq") {
                // SAFETY: the features were just detected.
                return unsafe { self.weigh_avx512(grains, volume) };
            }
            if is_x86_feature_detected!("avx2") {
                // SAFETY: the feature was just detected.
                return unsafe { self.weigh_avx2(grains, volume) };
            }
        }
        self.weigh_wide::<Plain>(grains, volume);
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx512f,avx512dq,avx512vl")]
    fn weigh_avx512(&mut self, grains: &[Vec3], volume: f64) {
        self.weigh_wide::<Avx512>(grains, volume);
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    fn weigh_avx2(&mut self, grains: &[Vec3], volume: f64) {
        self.weigh_wide::<Avx2>(grains, volume);
    }

    /// Weights and solids of eight candidates at a time. Lanes never mix before the end of a row.
    #[inline(always)]
    fn weigh_wide<W: Wide>(&mut self, grains: &[Vec3], volume: f64) {
        let per_length = 1.0 / self.length;
        let unit = W::splat(volume * per_length.powi(3));
        let slope_unit = W::splat(volume * per_length.powi(5));
        let per_length = W::splat(per_length);
        for (row, &i) in self.order.iter().enumerate() {
            let grain = &grains[i as usize];
            let grain = [W::splat(grain.x), W::splat(grain.y), W::splat(grain.z)];
            let mut norm = W::splat(0.0);
            for members in self.candidates.row(row).as_chunks::<LANES>().0 {
                let fields = W::gather(&self.points, members);
                let r = [fields[0] - grain[0], fields[1] - grain[1], fields[2] - grain[2]];
                let approach = r[0] * fields[3] + r[1] * fields[4] + r[2] * fields[5];
                let q = (r[0] * r[0] + r[1] * r[1] + r[2] * r[2]).sqrt() * per_length;
                let weight = fields[6] * self.sharpening.value(q);
                norm = norm + weight;
                let solids = (unit * WendlandC2.value(q)).lanes();
                let rate = (slope_unit * WendlandC2.slope(q) * approach).lanes();
                let (q, weight) = (q.lanes(), weight.lanes());
                for lane in 0..LANES {
                    let source = self.source_of[members[lane] as usize];
                    let sum = &mut self.sums[source as usize];
                    *sum = [sum[0] + solids[lane], sum[1] + rate[lane]];
                    self.weights.offer(source, weight[lane], q[lane] < 2.0);
                }
            }
            self.weights.close(norm.total());
        }
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
        self.source_of = self
            .origins
            .iter()
            .map(|(source, _)| *source)
            .chain([0])
            .collect();
        self.order = cell_order(grains, self.length);
        self.row_of = vec![0; grains.len()];
        for (row, &i) in self.order.iter().enumerate() {
            self.row_of[i as usize] = row as u32;
        }
        let targets: Vec<Vec3> = self.order.iter().map(|&i| grains[i as usize]).collect();
        self.candidates = Rows::new(&targets, &points, reach, points.len() as u32);
        self.fluid_anchor = fluid.position.clone();
        self.grain_anchor = grains.to_vec();
    }

    /// All grains, cell by cell: visited in this order, neighbouring rows find their fluid particles in
    /// the nearest cache.
    pub fn order(&self) -> &[u32] {
        &self.order
    }

    /// Weighted mean of a field around a grain.
    pub fn sample(&self, grain: usize, fields: &[Field]) -> Field {
        self.weights.sample(self.row_of[grain] as usize, fields)
    }

    /// Adds four sums of a grain, such as an impulse [N s], to those of the fluid particles around it.
    pub fn spread(&self, grain: usize, impulse: [f64; 4], impulses: &mut [[f64; 4]]) {
        self.weights
            .spread(self.row_of[grain] as usize, impulse, impulses);
    }

    /// Σ_a w_a²/V_a [1/m³]: how much of a force density it hands out a grain samples back.
    pub fn echo(&self, grain: usize, fluid: &FluidParticles) -> f64 {
        let (sources, shares) = self.weights.row(self.row_of[grain] as usize);
        (sources.iter().zip(shares))
            .map(|(source, share)| share * share / fluid.volume(*source as usize))
            .sum()
    }
}

/// Indices of the grains in strips along x of the given width [m], each from end to end.
fn cell_order(grains: &[Vec3], width: f64) -> Vec<u32> {
    let mut order: Vec<u32> = (0..grains.len() as u32).collect();
    let strip = |x: &Vec3| [(x.z / width).floor(), (x.y / width).floor(), x.x];
    order.sort_by(|&i, &j| {
        let (a, b) = (strip(&grains[i as usize]), strip(&grains[j as usize]));
        (a.iter().zip(&b))
            .map(|(a, b)| a.total_cmp(b))
            .fold(std::cmp::Ordering::Equal, |order, next| order.then(next))
    });
    order
}

#[cfg(test)]
mod tests;
