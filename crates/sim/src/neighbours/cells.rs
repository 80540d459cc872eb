//! A uniform grid of cells holding point indices in ascending order.

use crate::math::Vec3;

/// Points sorted into cubic cells at least as wide as the search radius.
pub struct CellGrid {
    origin: Vec3,
    width: f64,
    counts: [usize; 3],
    /// Start of each cell in `members`, one past the end last.
    starts: Vec<u32>,
    members: Vec<u32>,
}

impl CellGrid {
    /// Sorts `points` [m] into cells of side `radius` [m] (wider where the domain is huge).
    pub fn new(points: &[Vec3], radius: f64) -> Self {
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
        // At most a few million cells, however far a stray point lies.
        let width = radius.max(extent.max() / 200.0).max(f64::MIN_POSITIVE);
        let counts = [0, 1, 2].map(|axis| (extent[axis] / width) as usize + 1);
        let mut grid = CellGrid {
            origin: low,
            width,
            counts,
            starts: Vec::new(),
            members: Vec::new(),
        };
        grid.fill(points);
        grid
    }

    fn fill(&mut self, points: &[Vec3]) {
        let cells: usize = self.counts.iter().product();
        let homes: Vec<usize> = points.iter().map(|point| self.flat(self.cell(point))).collect();
        self.starts = vec![0; cells + 1];
        for &home in &homes {
            self.starts[home + 1] += 1;
        }
        for cell in 0..cells {
            self.starts[cell + 1] += self.starts[cell];
        }
        let mut next = self.starts.clone();
        self.members = vec![0; points.len()];
        for (index, &home) in homes.iter().enumerate() {
            self.members[next[home] as usize] = index as u32;
            next[home] += 1;
        }
    }

    fn cell(&self, point: &Vec3) -> [usize; 3] {
        [0, 1, 2].map(|axis| {
            let position = (point[axis] - self.origin[axis]) / self.width;
            (position.max(0.0) as usize).min(self.counts[axis] - 1)
        })
    }

    fn flat(&self, cell: [usize; 3]) -> usize {
        (cell[2] * self.counts[1] + cell[1]) * self.counts[0] + cell[0]
    }

    /// Calls `visit` with every point that may lie within the search radius of `point`.
    #[inline]
    pub fn visit_near(&self, point: &Vec3, mut visit: impl FnMut(u32)) {
        // A query outside the grid must not be clamped into it twice.
        let reach = [0, 1, 2].map(|axis| {
            let position = (point[axis] - self.origin[axis]) / self.width;
            let low = (position - 1.0).floor().max(0.0) as usize;
            let high = (position + 1.0).floor();
            if high < 0.0 {
                (1, 0)
            } else {
                (low, (high as usize).min(self.counts[axis] - 1))
            }
        });
        for z in reach[2].0..=reach[2].1 {
            for y in reach[1].0..=reach[1].1 {
                // Cells along x are adjacent in memory: one run of members per row of cells.
                if reach[0].0 > reach[0].1 {
                    return;
                }
                let first = self.starts[self.flat([reach[0].0, y, z])] as usize;
                let last = self.starts[self.flat([reach[0].1, y, z]) + 1] as usize;
                self.members[first..last].iter().for_each(|&member| visit(member));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn finds_every_neighbour_that_brute_force_finds(
            raw in prop::collection::vec((0.0..1.0, 0.0..1.0, 0.0..1.0), 1..80),
            radius in 0.05..0.6,
        ) {
            let points: Vec<Vec3> = raw.iter().map(|&(x, y, z)| Vec3::new(x, y, z)).collect();
            let grid = CellGrid::new(&points, radius);
            for target in &points {
                let mut found = Vec::new();
                grid.visit_near(target, |j| {
                    if (points[j as usize] - target).norm() < radius {
                        found.push(j as usize);
                    }
                });
                found.sort();
                let expected: Vec<usize> =
                    (0..points.len()).filter(|&j| (points[j] - target).norm() < radius).collect();
                prop_assert_eq!(found, expected);
            }
        }
    }

    #[test]
    fn an_empty_grid_finds_nobody() {
        CellGrid::new(&[], 1.0).visit_near(&Vec3::zeros(), |_| panic!("nobody is there"));
    }
}
