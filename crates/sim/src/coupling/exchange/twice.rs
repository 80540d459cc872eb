//! Double smoothing: what large grains gave the fluid over their own length is smoothed among the fluid
//! over a shorter one.
//!
//! ```text
//! φ_a = Σ_b V_b φ_b W(r_ab, h) / Σ_b V_b W(r_ab, h)
//! ```
//!
//! Source: Raso (2014), eqs. 3.9–3.10, with the volume V_b of the fluid particle where a grain's is printed.

use crate::fluid::FluidParticles;
use crate::fluid::kernel::{Kernel, WendlandC2};
use crate::math::Vec3;
use crate::neighbours::{Record, Rows};

pub(super) struct SecondSmoothing {
    /// Which grains are smoothed twice.
    pub marked: Vec<bool>,
    /// Sums of these grains, laid out as those of all.
    pub sums: Vec<Record>,
    /// h [m].
    length: f64,
    /// Of the fluid particles among the candidate points, themselves left out.
    rows: Rows,
}

impl SecondSmoothing {
    pub fn new(marked: Vec<bool>, length: f64) -> Self {
        SecondSmoothing {
            marked,
            sums: Vec::new(),
            length,
            rows: Rows::default(),
        }
    }

    /// Finds neighbours anew; they may move by `skin` [m] each.
    pub fn collect(&mut self, fluid: &FluidParticles, origins: &[(u32, Vec3)], skin: f64) {
        let points: Vec<Vec3> = (origins.iter())
            .map(|(source, shift)| fluid.position[*source as usize] + shift)
            .collect();
        let reach = 2.0 * self.length + 2.0 * skin;
        self.rows = Rows::new(&fluid.position, &points, reach, points.len() as u32);
    }

    pub fn clear(&mut self, particles: usize) {
        self.sums.clear();
        self.sums.resize(particles, Record::default());
    }

    /// Adds the sums, smoothed, to those of the grains that are smoothed once. `points` are the candidates,
    /// `source_of` the particles they are.
    pub fn add_to(&self, sums: &mut [Record], points: &[Record], source_of: &[u32]) {
        let per_length = 1.0 / self.length;
        for (a, sum) in sums.iter_mut().enumerate() {
            let own = points[a].0[6] * WendlandC2.value(0.0);
            let mut norm = own;
            let mut smoothed = self.sums[a].0.map(|value| own * value);
            for &b in self.rows.row(a) {
                let point = &points[b as usize].0;
                let r = Vec3::new(
                    point[0] - points[a].0[0],
                    point[1] - points[a].0[1],
                    point[2] - points[a].0[2],
                );
                let weight = point[6] * WendlandC2.value(r.norm() * per_length);
                norm += weight;
                let other = &self.sums[source_of[b as usize] as usize].0;
                for (smoothed, value) in smoothed.iter_mut().zip(other) {
                    *smoothed += weight * value;
                }
            }
            for (sum, smoothed) in sum.0.iter_mut().zip(smoothed) {
                *sum += smoothed / norm;
            }
        }
    }
}
