//! Cell grids for grains of very different sizes: one grid for each doubling of the radius.
//!
//! Ogarko and Luding (2012), A fast multilevel algorithm for contact detection of arbitrarily
//! polydisperse objects, doi:10.1016/j.cpc.2011.12.019. A small grain is sought in small cells, and the
//! few large ones in large cells, so that the largest grain does not set the cost for all.

use super::Region;
use crate::math::Vec3;

/// End of the chain of grains in a cell.
const NOBODY: u32 = u32::MAX;

/// Grains in cells that they can enter, leave and change.
pub(super) struct Levels {
    region: Region,
    levels: Vec<Level>,
    /// Level of every grain, the largest grains at 0.
    level_of: Vec<u8>,
    /// The next grain in the same cell.
    next: Vec<u32>,
}

/// The grains whose radius lies within a factor of two.
struct Level {
    /// Largest radius of the level [m].
    largest: f64,
    counts: [usize; 3],
    /// Cells per length along each axis [1/m].
    per_length: [f64; 3],
    first: Vec<u32>,
}

/// The cells of a level along one axis that a query covers.
#[derive(Clone, Copy)]
struct Span {
    start: usize,
    cells: usize,
    count: usize,
}

impl Levels {
    /// Empty cells for grains of these radii [m], wide enough to find what is `slack` [m] apart.
    pub(super) fn new(region: &Region, radii: &[f64], slack: f64) -> Self {
        let largest = radii.iter().copied().fold(0.0, f64::max);
        let smallest = radii.iter().copied().fold(f64::INFINITY, f64::min);
        let mut levels = Vec::new();
        let mut level_of = vec![0; radii.len()];
        let mut top = largest;
        while top >= smallest && levels.len() < usize::from(u8::MAX) {
            let members = || {
                radii
                    .iter()
                    .enumerate()
                    .filter(|(_, r)| **r <= top && **r > 0.5 * top)
            };
            if let Some(widest) = members().map(|(_, r)| *r).max_by(f64::total_cmp) {
                members().for_each(|(grain, _)| level_of[grain] = levels.len() as u8);
                levels.push(Level::new(region, widest, members().count(), slack));
            }
            top *= 0.5;
        }
        Levels {
            region: *region,
            levels,
            level_of,
            next: vec![NOBODY; radii.len()],
        }
    }

    pub(super) fn insert(&mut self, grain: usize, position: &Vec3) {
        let level = &mut self.levels[usize::from(self.level_of[grain])];
        let cell = level.cell(position);
        self.next[grain] = level.first[cell];
        level.first[cell] = grain as u32;
    }

    /// Takes a grain from one place to another, both inside the region.
    pub(super) fn displace(&mut self, grain: usize, from: &Vec3, to: &Vec3) {
        let level = &mut self.levels[usize::from(self.level_of[grain])];
        let (old, new) = (level.cell(from), level.cell(to));
        if old == new {
            return;
        }
        let following = self.next[grain];
        if level.first[old] == grain as u32 {
            level.first[old] = following;
        } else {
            let mut before = level.first[old] as usize;
            while self.next[before] != grain as u32 {
                before = self.next[before] as usize;
            }
            self.next[before] = following;
        }
        self.next[grain] = level.first[new];
        level.first[new] = grain as u32;
    }

    /// Whether `holds` is true of any grain that may lie within its own radius plus `reach` [m].
    #[inline]
    pub(super) fn any_near(&self, position: &Vec3, reach: f64, holds: impl FnMut(usize) -> bool) -> bool {
        self.any_near_in(self.levels.len(), position, reach, holds)
    }

    /// The same among grains of the level of `grain` and of those above it, none of which is visited twice.
    #[inline]
    pub(super) fn any_as_large_near(
        &self,
        grain: usize,
        position: &Vec3,
        reach: f64,
        holds: impl FnMut(usize) -> bool,
    ) -> bool {
        self.any_near_in(usize::from(self.level_of[grain]) + 1, position, reach, holds)
    }

    /// Level of a grain, the largest grains at 0.
    pub(super) fn level(&self, grain: usize) -> u8 {
        self.level_of[grain]
    }

    #[inline]
    fn any_near_in(
        &self,
        levels: usize,
        position: &Vec3,
        reach: f64,
        mut holds: impl FnMut(usize) -> bool,
    ) -> bool {
        for level in &self.levels[..levels] {
            let spans = [0, 1, 2].map(|axis| level.span(&self.region, axis, position[axis], reach));
            for z in spans[2].indices() {
                for y in spans[1].indices() {
                    let row = (z * level.counts[1] + y) * level.counts[0];
                    for x in spans[0].indices() {
                        let mut grain = level.first[row + x];
                        while grain != NOBODY {
                            if holds(grain as usize) {
                                return true;
                            }
                            grain = self.next[grain as usize];
                        }
                    }
                }
            }
        }
        false
    }
}

impl Level {
    fn new(region: &Region, largest: f64, grains: usize, slack: f64) -> Self {
        let lengths = region.lengths();
        let mut width = 2.0 * largest + slack;
        let at = |width: f64| lengths.map(|length| ((length / width) as usize).max(1));
        // No more cells than a few per grain, however large the box.
        while at(width).iter().map(|&n| n as f64).product::<f64>() > (4 * grains + 64) as f64 {
            width *= 1.25;
        }
        let counts = at(width);
        let per_length = [0, 1, 2].map(|axis| match lengths[axis] {
            0.0 => 0.0,
            length => counts[axis] as f64 / length,
        });
        Level {
            largest,
            counts,
            per_length,
            first: vec![NOBODY; counts.iter().product()],
        }
    }

    fn cell(&self, position: &Vec3) -> usize {
        let [x, y, z] = [0, 1, 2]
            .map(|axis| ((position[axis] * self.per_length[axis]) as usize).min(self.counts[axis] - 1));
        (z * self.counts[1] + y) * self.counts[0] + x
    }

    fn span(&self, region: &Region, axis: usize, coordinate: f64, reach: f64) -> Span {
        let count = self.counts[axis];
        // A little further than needed, so that rounding cannot hide a grain on a border.
        let reach = (reach + self.largest) * (1.0 + 1e-6);
        let (low, high) = (coordinate - reach, coordinate + reach);
        // Casts cut off towards zero and stop at zero: below, all numbers that matter are positive.
        if !region.wraps(axis) {
            let start = ((low * self.per_length[axis]) as usize).min(count - 1);
            let end = ((high * self.per_length[axis]) as usize).min(count - 1);
            return Span {
                start,
                cells: end - start + 1,
                count,
            };
        }
        // All around, at most once.
        if 2.0 * reach >= region.lengths()[axis] {
            return Span {
                start: 0,
                cells: count,
                count,
            };
        }
        let start = (low * self.per_length[axis] + count as f64) as usize;
        let end = (high * self.per_length[axis] + count as f64) as usize;
        Span {
            start: if start >= count { start - count } else { start },
            cells: (end - start + 1).min(count),
            count,
        }
    }
}

impl Span {
    #[inline]
    fn indices(self) -> impl Iterator<Item = usize> {
        (0..self.cells).map(move |step| {
            let index = self.start + step;
            if index >= self.count {
                index - self.count
            } else {
                index
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::Dimensions;
    use super::*;
    use crate::math::Random;
    use proptest::prelude::*;

    fn scattered(region: &Region, number: usize, seed: u64) -> Vec<Vec3> {
        let mut random = Random::new(seed);
        let lengths = region.lengths();
        (0..number)
            .map(|_| Vec3::from(lengths.map(|length| random.between(0.0, length))))
            .collect()
    }

    fn filled(region: &Region, radii: &[f64], positions: &[Vec3]) -> Levels {
        let mut levels = Levels::new(region, radii, 0.0);
        positions
            .iter()
            .enumerate()
            .for_each(|(grain, position)| levels.insert(grain, position));
        levels
    }

    proptest! {
        #[test]
        fn finds_all_that_brute_force_finds_and_none_twice(
            (width, depth, height) in (0.3..3.0, 0.3..3.0, 0.3..3.0),
            (periodic, flat) in (any::<bool>(), any::<bool>()),
            radii in prop::collection::vec(0.005..0.15, 1..60),
            (reach, seed) in (0.0..0.4, any::<u64>()),
        ) {
            let dimensions = if flat { Dimensions::Two } else { Dimensions::Three };
            let region = Region { width, depth, height, periodic: [periodic; 2], dimensions };
            // Some are put elsewhere first.
            let before = scattered(&region, radii.len(), !seed);
            let positions = scattered(&region, radii.len(), seed);
            let mut levels = filled(&region, &radii, &before);
            for grain in (0..radii.len()).rev() {
                levels.displace(grain, &before[grain], &positions[grain]);
            }
            for position in &positions {
                let mut visited = Vec::new();
                levels.any_near(position, reach, |grain| {
                    visited.push(grain);
                    false
                });
                visited.sort();
                prop_assert!(visited.windows(2).all(|pair| pair[0] < pair[1]));
                for (grain, other) in positions.iter().enumerate() {
                    let near = region.nearest(position - other).norm() < reach + radii[grain];
                    prop_assert!(!near || visited.binary_search(&grain).is_ok());
                }
            }
        }
    }

    #[test]
    fn a_large_grain_does_not_make_small_ones_visit_more() {
        let region = Region {
            width: 1.0,
            depth: 1.0,
            height: 1.0,
            periodic: [true; 2],
            dimensions: Dimensions::Three,
        };
        let visits = |radii: &[f64]| {
            let positions = scattered(&region, radii.len(), 5);
            let levels = filled(&region, radii, &positions);
            let mut visits = 0;
            for (position, radius) in positions.iter().zip(radii).skip(1) {
                levels.any_near(position, *radius, |_| {
                    visits += 1;
                    false
                });
            }
            visits as f64 / (radii.len() - 1) as f64
        };
        let mut radii = vec![0.01; 20_000];
        let equal = visits(&radii);
        radii[0] = 0.1;
        // One more level, with one grain in it.
        assert!(visits(&radii) <= equal + 1.0);
    }
}
