//! Porosity at the grains, from the grains alone, in one pass.
//!
//! ```text
//! ε_i = 1 − Σ_j V_j W(r_ij, h_j) + S_0 V_i W(0, h_i),     j = i included in the sum
//! ```
//!
//! The sum at a grain's own centre holds the grain itself, which a sum at any place does so only as often
//! as grains are found there. Which share of the own term is one too many depends on how the others are
//! arranged: all of it for a grain alone, none in a lattice, S_0 = (1 − φ)⁴/(1 + 2φ)² in a random
//! suspension of hard spheres (structure factor at long waves; Percus and Yevick 1958, Phys. Rev. 110, 1).

mod strips;

use strips::{StripSum, Strips};

use super::{GrainSize, exchange::unwrapped};
use crate::fluid::kernel::Sharpening;
use crate::math::Vec3;
use crate::neighbours::in_widest;

/// How the neighbours of a grain are arranged: it decides the share S_0 of the own term.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arrangement {
    Lattice,
    Random,
}

impl Arrangement {
    /// S_0 [-] where the solids fraction with the own term is φ [-].
    fn own_share(self, solids: f64) -> f64 {
        match self {
            Arrangement::Lattice => 0.0,
            Arrangement::Random => {
                let clear = (1.0 - solids).clamp(0.0, 1.0);
                let crowded = 1.0 + 2.0 * solids.max(0.0);
                clear * clear * clear * clear / (crowded * crowded)
            }
        }
    }
}

/// How the porosity at grains is summed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PorosityRules {
    pub sharpening: Sharpening,
    pub arrangement: Arrangement,
    /// Whether grains are mirrored at the floor z = 0.
    pub floor_images: bool,
}

impl PorosityRules {
    /// Of grains that move freely: plain kernels, a random arrangement, images at the floor.
    pub const FREE: PorosityRules = PorosityRules {
        sharpening: Sharpening::NONE,
        arrangement: Arrangement::Random,
        floor_images: true,
    };
    /// Of a lattice with sharp edges away from the floor.
    pub const SHARP_LATTICE: PorosityRules = PorosityRules {
        sharpening: Sharpening::EDGE_NEUTRAL,
        arrangement: Arrangement::Lattice,
        floor_images: false,
    };
}

/// Way over the smallest porosity length that grains may go before their sums are taken anew [-]. The porosity
/// changes over a length: at the edge of a suspension by a hundredth of its solids fraction at the most.
const SLACK: f64 = 0.01;

/// The porosity at grains of given sizes, again and again.
#[derive(Clone, Debug)]
pub struct PorositySums {
    rules: PorosityRules,
    /// `length` of a size is the porosity length h_p here.
    sizes: Vec<GrainSize>,
    /// Side of the periodic cross-section [m].
    width: f64,
    strips: Box<Strips>,
    solids: Vec<f64>,
    /// Where the grains were when the sums were taken [m], and how far they may go [m].
    anchor: Vec<Vec3>,
    slack: f64,
    /// Porosity [-] of every grain at the last [`refresh`](Self::refresh).
    pub porosity: Vec<f64>,
}

impl PorositySums {
    /// For grains in a column periodic over `width` [m]; `length` of a size is its porosity length.
    pub fn new(rules: PorosityRules, sizes: Vec<GrainSize>, width: f64) -> Self {
        PorositySums {
            rules,
            porosity: vec![1.0; sizes.len()],
            solids: Vec::new(),
            anchor: Vec::new(),
            slack: SLACK * sizes.iter().map(|size| size.length).fold(f64::INFINITY, f64::min),
            sizes,
            width,
            strips: Box::default(),
        }
    }

    /// Sums anew for grains at these places [m], if one has gone far enough to tell: a settled bed costs
    /// nothing.
    pub fn refresh(&mut self, position: &[Vec3]) {
        if !self.outgrown(position) {
            return;
        }
        self.anchor.clear();
        self.anchor.extend(position);
        self.strips
            .fill(position, &self.sizes, self.width, self.rules.floor_images);
        self.solids.clear();
        self.solids.resize(position.len(), 0.0);
        in_widest(StripSum {
            strips: &self.strips,
            sharpening: self.rules.sharpening,
            solids: &mut self.solids,
        });
        for (i, porosity) in self.porosity.iter_mut().enumerate() {
            let (solids, size) = (self.solids[i], &self.sizes[i]);
            let own =
                size.volume() / (size.length * size.length * size.length) * self.rules.sharpening.value(0.0);
            *porosity = 1.0 - solids + self.rules.arrangement.own_share(solids) * own;
        }
    }
}

impl PorositySums {
    fn outgrown(&self, position: &[Vec3]) -> bool {
        let limit = self.slack * self.slack;
        let gone =
            |(x, anchor): (&Vec3, &Vec3)| (unwrapped(x, anchor, self.width) - anchor).norm_squared() > limit;
        self.anchor.len() != position.len() || position.iter().zip(&self.anchor).any(gone)
    }
}

/// Porosity [-] once of each of the grains at `position` [m].
pub fn grain_porosity(
    position: &[Vec3],
    sizes: Vec<GrainSize>,
    rules: PorosityRules,
    width: f64,
) -> Vec<f64> {
    let mut sums = PorositySums::new(rules, sizes, width);
    sums.refresh(position);
    sums.porosity
}

#[cfg(test)]
mod tests;
