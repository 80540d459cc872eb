//! Points sorted into a uniform grid of cells, whose rows along x lie one behind the other in memory.

use super::{LANES, Wide};
use crate::math::Vec3;

/// Cells per widest reach: small ones follow the sphere of reach more closely, but their runs are short.
const PER_REACH: f64 = 2.0;
/// Cells along each direction at most, however far a stray point lies.
const MOST: f64 = 400.0;

/// Points [m] in the order of their cells.
pub struct CellGrid {
    origin: Vec3,
    width: f64,
    counts: [usize; 3],
    /// Start of each cell, one past the end last.
    starts: Vec<u32>,
    /// Which point stands where.
    members: Vec<u32>,
    /// Their coordinates [m], with eight more at the end that are nobody's.
    places: [Vec<f64>; 3],
}

impl CellGrid {
    /// Sorts `points` [m] into cells for searches within `reach` [m].
    pub fn new(points: &[Vec3], reach: f64) -> Self {
        let mut low = Vec3::repeat(f64::INFINITY);
        let mut high = Vec3::repeat(f64::NEG_INFINITY);
        for point in points {
            low = low.inf(point);
            high = high.sup(point);
        }
        let extent = if points.is_empty() {
            Vec3::zeros()
        } else {
            high - low
        };
        let width = (reach / PER_REACH)
            .max(extent.max() / MOST)
            .max(f64::MIN_POSITIVE);
        let counts = [0, 1, 2].map(|axis| (extent[axis] / width) as usize + 1);
        let mut grid = CellGrid {
            origin: low,
            width,
            counts,
            starts: Vec::new(),
            members: Vec::new(),
            places: Default::default(),
        };
        grid.fill(points);
        grid
    }

    fn fill(&mut self, points: &[Vec3]) {
        let cells: usize = self.counts.iter().product();
        let homes: Vec<usize> = points.iter().map(|point| self.home(point)).collect();
        self.starts = vec![0; cells + 1];
        for &home in &homes {
            self.starts[home + 1] += 1;
        }
        for cell in 0..cells {
            self.starts[cell + 1] += self.starts[cell];
        }
        let mut next = self.starts.clone();
        self.members = vec![0; points.len()];
        self.places = [0; 3].map(|_| vec![0.0; points.len() + LANES]);
        for (index, (point, &home)) in points.iter().zip(&homes).enumerate() {
            let at = next[home] as usize;
            next[home] += 1;
            self.members[at] = index as u32;
            (0..3).for_each(|axis| self.places[axis][at] = point[axis]);
        }
    }

    fn home(&self, point: &Vec3) -> usize {
        let [x, y, z] = [0, 1, 2].map(|axis| self.cell(point[axis], axis));
        self.flat([x, y, z])
    }

    /// The cell along one axis that holds a value, or the nearest one.
    #[inline(always)]
    fn cell(&self, value: f64, axis: usize) -> usize {
        let position = (value - self.origin[axis]) / self.width;
        (position.max(0.0) as usize).min(self.counts[axis] - 1)
    }

    /// The first and the last cell along one axis within a radius of a value [m].
    #[inline(always)]
    fn span(&self, value: f64, radius: f64, axis: usize) -> (usize, usize) {
        (self.cell(value - radius, axis), self.cell(value + radius, axis))
    }

    #[inline(always)]
    fn flat(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.counts[1] + y) * self.counts[0] + x
    }

    /// Writes into `found` the points closer than `radius` [m] to a place, the place itself left out, in
    /// the order of the cells; returns how many they are.
    #[inline(always)]
    pub fn find_near<W: Wide>(&self, place: &Vec3, radius: f64, found: &mut Vec<u32>) -> usize {
        let mut count = 0;
        if self.members.is_empty() {
            return count;
        }
        let squared = radius * radius;
        let [along, across, up] = [
            self.span(place.x, radius, 0),
            self.span(place.y, radius, 1),
            self.span(place.z, radius, 2),
        ];
        let own = [W::splat(place.x), W::splat(place.y), W::splat(place.z)];
        for z in up.0..=up.1 {
            for y in across.0..=across.1 {
                let first = self.starts[self.flat([along.0, y, z])] as usize;
                let last = self.starts[self.flat([along.1, y, z]) + 1] as usize;
                found.resize(found.len().max(count + (last - first)), 0);
                for at in (first..last).step_by(LANES) {
                    let x = load::<W>(&self.places[0], at) - own[0];
                    let y = load::<W>(&self.places[1], at) - own[1];
                    let z = load::<W>(&self.places[2], at) - own[2];
                    let distances = (x * x + y * y + z * z).lanes();
                    for (member, distance) in self.members[at..last].iter().zip(distances) {
                        found[count] = *member;
                        count += usize::from(distance < squared && distance > 0.0);
                    }
                }
            }
        }
        count
    }
}

#[inline(always)]
fn load<W: Wide>(values: &[f64], at: usize) -> W {
    let mut lanes = [0.0; LANES];
    lanes.copy_from_slice(&values[at..at + LANES]);
    W::from_lanes(lanes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::neighbours::Plain;
    use proptest::prelude::*;

    fn near(grid: &CellGrid, place: &Vec3, radius: f64) -> Vec<usize> {
        let mut found = Vec::new();
        let count = grid.find_near::<Plain>(place, radius, &mut found);
        let mut found: Vec<usize> = found[..count].iter().map(|index| *index as usize).collect();
        found.sort();
        found
    }

    proptest! {
        #[test]
        fn finds_every_neighbour_that_brute_force_finds(
            raw in prop::collection::vec((0.0..1.0, 0.0..1.0, 0.0..1.0), 1..80),
            targets in prop::collection::vec((-0.5..1.5, -0.5..1.5, -0.5..1.5), 1..20),
            reach in 0.05..0.6,
            share in 0.2..1.0,
        ) {
            let vectors = |raw: &[(f64, f64, f64)]| -> Vec<Vec3> {
                raw.iter().map(|&(x, y, z)| Vec3::new(x, y, z)).collect()
            };
            let points = vectors(&raw);
            let grid = CellGrid::new(&points, reach);
            let radius = share * reach;
            for target in points.iter().chain(&vectors(&targets)) {
                let expected: Vec<usize> = (0..points.len())
                    .filter(|&j| points[j] != *target && (points[j] - target).norm() < radius)
                    .collect();
                prop_assert_eq!(near(&grid, target, radius), expected);
            }
        }
    }

    #[test]
    fn an_empty_grid_finds_nobody() {
        assert!(near(&CellGrid::new(&[], 1.0), &Vec3::zeros(), 1.0).is_empty());
    }
}
