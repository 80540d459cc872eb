//! Who may meet whom within a span.
//!
//! A velocity that starts at v₀ and never changes by more than m stays in a ball; so the gap of two
//! grains shrinks by no more than `T (|v₀ᵢ − v₀ⱼ| + mᵢ + mⱼ)`, and of those whose gap is wider neither
//! can be touched by the other.

use crate::bed::contacts::Interaction;
use crate::bed::pairs::{Block, Standing};
use crate::bed::walls::Walls;
use crate::math::{Number, Vec3, Vector};
use crate::neighbours::{LANES, Record, Wide, WideWork};

/// For the rounding of all that follows [-].
const ROUNDING: f64 = 1e-9;

/// Where all grains start from and how their velocities change.
#[derive(Clone, Copy)]
pub struct Encounters<'a> {
    pub interaction: &'a Interaction,
    pub motion: &'a [Record],
    /// Holds the greatest change of velocity in its fourth number.
    pub flights: &'a [Record],
    /// T [s].
    pub span: f64,
    /// Gap up to which pairs are taken for such that may meet anyway [m].
    pub floor: f64,
}

impl Encounters<'_> {
    /// How two grains stand at the start: dormant where they cannot meet.
    pub fn standing(&self, [i, j]: [u32; 2]) -> Standing {
        let (i, j) = (i as usize, j as usize);
        let (a, b) = (&self.motion[i].0, &self.motion[j].0);
        let period = self.interaction.period;
        let mut apart = [0.0; 3];
        for axis in 0..3 {
            apart[axis] = a[axis] - b[axis];
            if period[axis] > 0.0 {
                apart[axis] = apart[axis] - period[axis] * Number::round(apart[axis] / period[axis]);
            }
        }
        let gap = Vec3::from(apart).norm() - (a[3] + b[3]);
        let slip = Vec3::new(a[4] - b[4], a[5] - b[5], a[6] - b[6]).norm();
        self.stand(gap, slip + self.flights[i].0[3] + self.flights[j].0[3])
    }

    /// How a grain and a wall stand at the start.
    pub fn standing_at_wall(&self, walls: &Walls, [grain, wall]: [u32; 2]) -> Standing {
        let grain = grain as usize;
        let [x, y, z, level, ..] = walls.record(wall as usize).0;
        let [px, py, pz, radius, vx, vy, vz, _] = self.motion[grain].0;
        let gap = x * px + y * py + z * pz - level - radius;
        let approach = -(x * vx + y * vy + z * vz);
        self.stand(gap, approach + self.flights[grain].0[3])
    }

    fn stand(&self, gap: f64, closing: f64) -> Standing {
        let reach = self
            .interaction
            .attraction
            .map_or(0.0, |attraction| attraction.reach());
        let way = (self.span * closing * (1.0 + ROUNDING)).max(self.floor);
        if gap < 0.0 {
            Standing::Touching
        } else if gap * (1.0 - ROUNDING) < reach + way {
            Standing::Apart
        } else {
            // What is no number is found by those who move.
            Standing::Dormant
        }
    }
}

/// Collects the blocks in which somebody may meet, by one bound on all changes of velocity.
pub struct Suspects<'a> {
    pub encounters: Encounters<'a>,
    /// Greatest change of velocity of all grains [m/s].
    pub change: f64,
    pub blocks: &'a [Block],
    /// The first block to look at.
    pub first: usize,
    pub found: &'a mut Vec<u32>,
}

impl WideWork for Suspects<'_> {
    type Output = ();

    #[inline(always)]
    fn run<W: Wide>(self) {
        let Encounters {
            interaction,
            motion,
            span,
            floor,
            ..
        } = self.encounters;
        let reach = match &interaction.attraction {
            Some(attraction) => attraction.reach(),
            None => 0.0,
        };
        let time = W::splat(span);
        let changes = W::splat((2.0 * self.change * span).max(floor) + reach);
        for (place, block) in self.blocks.iter().enumerate().skip(self.first) {
            let [first, second] = &block.members;
            let a = W::gather(motion, first);
            let b = W::gather(motion, second);
            let slip = Vector::new(a[4] - b[4], a[5] - b[5], a[6] - b[6]).norm();
            let near = (a[3] + b[3] + slip * time + changes) * W::splat(1.0 + ROUNDING);
            let squared = interaction.between(&a, &b).norm_squared();
            if W::any(squared.below(near * near)) {
                self.found.push(place as u32);
            }
        }
    }
}

/// Lanes of a block that hold a pair.
pub fn pairs_in(block: &Block, nobody: u32) -> impl Iterator<Item = [u32; 2]> + '_ {
    (0..LANES)
        .map(|lane| block.members.map(|end| end[lane]))
        .filter(move |pair| pair[0] != nobody)
}
