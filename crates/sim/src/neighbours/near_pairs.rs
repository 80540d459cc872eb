//! All pairs of spheres whose surfaces are near each other.
//!
//! Spheres of similar size share a grid, each grid with cells as wide as its largest sphere: a sphere
//! looks for partners in its own grid and in those of larger spheres, so that a few large ones do not
//! make everybody search far. Cost grows with the number of spheres, not of pairs.

use super::Record;

/// Sizes apart by more than this factor live in different grids.
const SIZE_STEP: f64 = 2.0;
const MOST_LEVELS: usize = 8;

/// Side [m] of each periodic direction, zero where the domain is open.
pub type Period = [f64; 3];

/// How pairs are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Search {
    Grid,
    /// Every pair is looked at: the measure for the grid, in tests and in studies of cost.
    BruteForce,
}

/// Calls `visit` once for each pair i < j whose surfaces are closer than `reach` [m], in an order that
/// follows from the order of the spheres alone.
///
/// A record holds x, y, z, R [m] first; periodic positions lie within [0, side). Pairs of two fixed
/// spheres, those from index `moving` on, are left out. Returns the number of pairs looked at.
pub fn visit_near_pairs(
    search: Search,
    spheres: &[Record],
    moving: usize,
    period: Period,
    reach: f64,
    mut visit: impl FnMut(u32, u32),
) -> u64 {
    let near = Near {
        spheres,
        period,
        reach,
    };
    let mut looked_at = 0;
    let mut look = |i: usize, j: usize| {
        looked_at += 1;
        if near.holds(i, j) {
            visit(i.min(j) as u32, i.max(j) as u32);
        }
    };
    if search == Search::BruteForce {
        (0..moving).for_each(|i| (i + 1..spheres.len()).for_each(|j| look(i, j)));
        return looked_at;
    }
    let levels = Levels::new(spheres);
    for (level, &largest) in levels.largest.iter().enumerate() {
        let grid = Grid::new(&near, levels.members(level), 2.0 * largest + reach);
        for (i, sphere) in spheres.iter().enumerate() {
            let own = levels.of[i] as usize;
            if own < level {
                continue;
            }
            grid.visit_around(&sphere.0, |j| {
                let j = j as usize;
                let once = own > level || j > i;
                if once && (i < moving || j < moving) {
                    look(i, j);
                }
            });
        }
    }
    looked_at
}

struct Near<'a> {
    spheres: &'a [Record],
    period: Period,
    reach: f64,
}

impl Near<'_> {
    #[inline(always)]
    fn holds(&self, i: usize, j: usize) -> bool {
        let (a, b) = (&self.spheres[i].0, &self.spheres[j].0);
        let squared = squared_distance(a, b, self.period);
        let far = a[3] + b[3] + self.reach;
        squared < far * far
    }
}

/// Squared distance [m²] of two positions that lie within the periodic sides, x, y, z first, by the
/// shortest way.
#[inline(always)]
pub fn squared_distance(a: &[f64; 8], b: &[f64; 8], period: Period) -> f64 {
    let mut squared = 0.0;
    for axis in 0..3 {
        let mut apart = (a[axis] - b[axis]).abs();
        let side = period[axis];
        if side > 0.0 && apart > 0.5 * side {
            apart = side - apart;
        }
        squared += apart * apart;
    }
    squared
}

/// Spheres sorted into classes of size, the largest first.
struct Levels {
    /// Level of each sphere.
    of: Vec<u8>,
    /// Largest radius of each level [m].
    largest: Vec<f64>,
}

impl Levels {
    fn new(spheres: &[Record]) -> Self {
        let top = spheres.iter().map(|sphere| sphere.0[3]).fold(0.0, f64::max);
        let level = |radius: f64| {
            let mut floor = top / SIZE_STEP;
            let mut level = 0;
            while radius <= floor && level + 1 < MOST_LEVELS {
                floor /= SIZE_STEP;
                level += 1;
            }
            level
        };
        let mut largest = Vec::new();
        let of = spheres
            .iter()
            .map(|sphere| {
                let radius = sphere.0[3];
                let level = level(radius);
                if largest.len() <= level {
                    largest.resize(level + 1, 0.0);
                }
                largest[level] = f64::max(largest[level], radius);
                level as u8
            })
            .collect();
        Levels { of, largest }
    }

    fn members(&self, level: usize) -> impl Iterator<Item = u32> + Clone + '_ {
        let of = self.of.iter().enumerate();
        of.filter(move |(_, own)| **own as usize == level)
            .map(|(i, _)| i as u32)
    }
}

/// Cells over the bounding box of their members, over the whole side where it is periodic.
struct Grid {
    origin: [f64; 3],
    per_width: [f64; 3],
    counts: [usize; 3],
    periodic: [bool; 3],
    starts: Vec<u32>,
    members: Vec<u32>,
}

impl Grid {
    fn new(near: &Near, members: impl Iterator<Item = u32> + Clone, width: f64) -> Self {
        let mut low = [f64::INFINITY; 3];
        let mut high = [f64::NEG_INFINITY; 3];
        let mut count = 0;
        for member in members.clone() {
            let position = &near.spheres[member as usize].0;
            count += 1;
            for axis in 0..3 {
                low[axis] = low[axis].min(position[axis]);
                high[axis] = high[axis].max(position[axis]);
            }
        }
        let periodic = near.period.map(|side| side > 0.0);
        let extent: [f64; 3] = std::array::from_fn(|axis| match near.period[axis] {
            side if side > 0.0 => side,
            _ if count == 0 => 0.0,
            _ => high[axis] - low[axis],
        });
        // Not more cells than a few per member, however far a stray sphere lies.
        let mut width = width;
        let cells = |width: f64| {
            extent
                .map(|side| (side / width).floor().max(1.0))
                .iter()
                .product::<f64>()
        };
        while cells(width) > 8.0 * f64::from(count) + 64.0 {
            width *= 1.26;
        }
        let counts = extent.map(|side| (side / width).floor().max(1.0) as usize);
        let mut grid = Grid {
            origin: std::array::from_fn(|axis| {
                if periodic[axis] || count == 0 {
                    0.0
                } else {
                    low[axis]
                }
            }),
            per_width: std::array::from_fn(|axis| {
                match extent[axis] {
                    // Never narrower than the search is wide, not even around members in one plane:
                    // smaller spheres look in from outside.
                    extent if extent > 0.0 => {
                        let fitting = counts[axis] as f64 / extent;
                        if periodic[axis] {
                            fitting
                        } else {
                            fitting.min(1.0 / width)
                        }
                    }
                    _ => 0.0,
                }
            }),
            counts,
            periodic,
            starts: Vec::new(),
            members: Vec::new(),
        };
        grid.fill(near, members, count as usize);
        grid
    }

    fn fill(&mut self, near: &Near, members: impl Iterator<Item = u32> + Clone, count: usize) {
        let home = |grid: &Grid, member: u32| {
            let cell: [usize; 3] =
                std::array::from_fn(|axis| grid.cell(axis, near.spheres[member as usize].0[axis]) as usize);
            (cell[2] * grid.counts[1] + cell[1]) * grid.counts[0] + cell[0]
        };
        let cells: usize = self.counts.iter().product();
        let mut starts = vec![0u32; cells + 1];
        for member in members.clone() {
            starts[home(self, member) + 1] += 1;
        }
        for cell in 0..cells {
            starts[cell + 1] += starts[cell];
        }
        let mut next = starts.clone();
        self.members = vec![0; count];
        for member in members {
            let slot = &mut next[home(self, member)];
            self.members[*slot as usize] = member;
            *slot += 1;
        }
        self.starts = starts;
    }

    /// Cell along one axis, kept inside the grid.
    #[inline(always)]
    fn cell(&self, axis: usize, position: f64) -> isize {
        let cell = ((position - self.origin[axis]) * self.per_width[axis]).floor();
        (cell as isize).clamp(0, self.counts[axis] as isize - 1)
    }

    /// Cells along one axis in which partners of a sphere may lie, in at most two runs.
    #[inline(always)]
    fn runs(&self, axis: usize, position: f64) -> [(usize, usize); 2] {
        const NONE: (usize, usize) = (1, 0);
        let count = self.counts[axis] as isize;
        if self.periodic[axis] {
            if count <= 3 {
                return [(0, count as usize - 1), NONE];
            }
            let cell = self.cell(axis, position);
            let (low, high) = (cell - 1, cell + 1);
            return if low < 0 {
                [(0, high as usize), ((count - 1) as usize, (count - 1) as usize)]
            } else if high >= count {
                [(low as usize, (count - 1) as usize), (0, 0)]
            } else {
                [(low as usize, high as usize), NONE]
            };
        }
        // The sphere itself may lie outside the grid of the larger ones.
        let cell = ((position - self.origin[axis]) * self.per_width[axis]).floor() as isize;
        let (low, high) = (
            cell.saturating_sub(1).max(0),
            cell.saturating_add(1).min(count - 1),
        );
        if low > high {
            return [NONE, NONE];
        }
        [(low as usize, high as usize), NONE]
    }

    #[inline(always)]
    fn visit_around(&self, position: &[f64; 8], mut visit: impl FnMut(u32)) {
        let [x, y, z] = std::array::from_fn(|axis| self.runs(axis, position[axis]));
        for (z_low, z_high) in z {
            for iz in z_low..=z_high {
                for (y_low, y_high) in y {
                    for iy in y_low..=y_high {
                        let row = (iz * self.counts[1] + iy) * self.counts[0];
                        for (x_low, x_high) in x {
                            if x_low > x_high {
                                continue;
                            }
                            let first = self.starts[row + x_low] as usize;
                            let last = self.starts[row + x_high + 1] as usize;
                            self.members[first..last].iter().for_each(|&member| visit(member));
                        }
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn pairs(
        search: Search,
        spheres: &[Record],
        moving: usize,
        period: Period,
        reach: f64,
    ) -> Vec<(u32, u32)> {
        let mut found = Vec::new();
        visit_near_pairs(search, spheres, moving, period, reach, |i, j| found.push((i, j)));
        found.sort_unstable();
        found
    }

    proptest! {
        #[test]
        fn the_grid_finds_what_brute_force_finds_and_each_pair_once(
            raw in prop::collection::vec((0.0..1.0, 0.0..1.0, 0.0..3.0, 0.01..0.15), 0..120),
            reach in 0.0..0.1,
            periodic in prop::collection::vec(any::<bool>(), 3),
            fixed in 0usize..10,
        ) {
            let spheres: Vec<Record> =
                raw.iter().map(|&(x, y, z, r)| Record([x, y, z, r, 0.0, 0.0, 0.0, 0.0])).collect();
            let moving = spheres.len().saturating_sub(fixed);
            let sides = [1.0, 1.0, 3.0];
            let period = [0, 1, 2].map(|axis| if periodic[axis] { sides[axis] } else { 0.0 });
            let expected = pairs(Search::BruteForce, &spheres, moving, period, reach);
            prop_assert_eq!(pairs(Search::Grid, &spheres, moving, period, reach), expected);
        }
    }

    #[test]
    fn a_few_large_spheres_do_not_make_the_small_ones_search_far() {
        let small = |i: usize| {
            Record([
                (i % 30) as f64,
                (i / 30 % 30) as f64,
                (i / 900) as f64,
                0.5,
                0.0,
                0.0,
                0.0,
                0.0,
            ])
        };
        let mut spheres: Vec<Record> = (0..9000).map(small).collect();
        let looked_at = |spheres: &[Record]| {
            visit_near_pairs(Search::Grid, spheres, spheres.len(), [0.0; 3], 0.05, |_, _| {})
        };
        let alone = looked_at(&spheres);
        spheres.push(Record([15.0, 15.0, 20.0, 5.0, 0.0, 0.0, 0.0, 0.0]));
        assert!(
            looked_at(&spheres) < alone + 40_000,
            "{} for {alone}",
            looked_at(&spheres)
        );
    }

    #[test]
    fn large_spheres_nearly_in_one_plane_are_found_from_above_and_below() {
        let sphere = |x: f64, y: f64, z: f64, radius: f64| Record([x, y, z, radius, 0.0, 0.0, 0.0, 0.0]);
        let spheres = [
            sphere(0.0, 0.0, 0.0, 1.0),
            sphere(2.5, 1e-6, 1e-4, 1.0),
            sphere(0.0, 0.3, 1.0, 0.1),
            sphere(2.5, -1.05, 0.0, 0.1),
            sphere(0.0, 0.0, -1.08, 0.1),
        ];
        for search in [Search::Grid, Search::BruteForce] {
            assert_eq!(
                pairs(search, &spheres, 5, [0.0; 3], 0.01),
                [(0, 2), (0, 4), (1, 3)]
            );
        }
    }

    #[test]
    fn a_stray_sphere_does_not_ask_for_a_universe_of_cells() {
        let spheres = [[0.0; 3], [1e9, 0.0, -1e12], [0.5, 0.0, 0.0]]
            .map(|[x, y, z]| Record([x, y, z, 0.5, 0.0, 0.0, 0.0, 0.0]));
        assert_eq!(pairs(Search::Grid, &spheres, 3, [0.0; 3], 0.01), [(0, 2)]);
    }
}
