//! Full neighbour rows, padded so that every row is a whole number of lanes.

use super::{CellGrid, Wide, WideWork, in_widest};
use crate::math::Vec3;

/// Pairs evaluated at once. Eight doubles fill the widest registers; the sums are kept per lane,
/// so the result is the same on every instruction set.
pub const LANES: usize = 8;

/// A copy of a particle beyond a periodic side.
#[derive(Clone, Copy, Debug)]
pub struct Image {
    /// Index of the particle it copies.
    pub source: u32,
    /// Offset from it [m].
    pub shift: Vec3,
}

/// Copies of all points within `reach` [m] of a side of the square [0, width)² in x and y.
pub fn images(points: &[Vec3], width: f64, reach: f64) -> Vec<Image> {
    let mut images = Vec::new();
    for (source, point) in points.iter().enumerate() {
        for ix in -1..=1 {
            for iy in -1..=1 {
                let shift = Vec3::new(ix as f64 * width, iy as f64 * width, 0.0);
                let moved = point + shift;
                let inside = |x: f64| x > -reach && x < width + reach;
                if (ix, iy) != (0, 0) && inside(moved.x) && inside(moved.y) {
                    images.push(Image {
                        source: source as u32,
                        shift,
                    });
                }
            }
        }
    }
    images
}

/// For each target, the indices of the points within a radius of it.
#[derive(Clone, Debug, Default)]
pub struct Rows {
    starts: Vec<u32>,
    members: Vec<u32>,
    /// Pairs without padding.
    pub pairs: u64,
}

impl Rows {
    /// Rows of `targets` among `points` closer than `radius` [m]; the target itself is left out when
    /// it is one of the points (distance zero). Rows are padded with the index `nobody`.
    pub fn new(targets: &[Vec3], points: &[Vec3], radius: f64, nobody: u32) -> Self {
        Rows::within(targets, &vec![radius; targets.len()], points, nobody)
    }

    /// The same with a radius [m] for each target.
    pub fn within(targets: &[Vec3], radii: &[f64], points: &[Vec3], nobody: u32) -> Self {
        let grid = CellGrid::new(points, radii.iter().copied().fold(0.0, f64::max));
        let mut rows = Rows {
            starts: Vec::with_capacity(targets.len() + 1),
            members: Vec::new(),
            pairs: 0,
        };
        rows.starts.push(0);
        in_widest(Collection {
            grid: &grid,
            targets,
            radii,
            nobody,
            rows: &mut rows,
        });
        rows
    }

    fn close(&mut self, members: &[u32], nobody: u32) {
        self.pairs += members.len() as u64;
        self.members.extend_from_slice(members);
        self.members
            .resize(self.members.len().next_multiple_of(LANES), nobody);
        self.starts.push(self.members.len() as u32);
    }

    /// Neighbours of a target: a whole number of lanes.
    #[inline(always)]
    pub fn row(&self, target: usize) -> &[u32] {
        &self.members[self.starts[target] as usize..self.starts[target + 1] as usize]
    }

    /// Members of all rows, padding included.
    pub fn len_padded(&self) -> usize {
        self.members.len()
    }

    /// Number of targets.
    pub fn len(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// Fills rows that are still empty.
struct Collection<'a> {
    grid: &'a CellGrid,
    targets: &'a [Vec3],
    radii: &'a [f64],
    nobody: u32,
    rows: &'a mut Rows,
}

impl WideWork for Collection<'_> {
    type Output = ();

    #[inline(always)]
    fn run<W: Wide>(self) {
        let mut found = Vec::new();
        for (target, radius) in self.targets.iter().zip(self.radii) {
            let count = self.grid.find_near::<W>(target, *radius, &mut found);
            self.rows.close(&found[..count], self.nobody);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn images_make_a_periodic_lattice_homogeneous() {
        let n = 6;
        let points: Vec<Vec3> = (0..n * n)
            .map(|i| Vec3::new((i % n) as f64 + 0.5, (i / n) as f64 + 0.5, 0.0))
            .collect();
        let mut all = points.clone();
        all.extend(
            images(&points, n as f64, 2.1)
                .iter()
                .map(|i| points[i.source as usize] + i.shift),
        );
        let rows = Rows::new(&points, &all, 2.1, u32::MAX);
        // Twelve lattice neighbours lie within 2.1 spacings in a plane, rows are padded to sixteen.
        assert_eq!(rows.pairs, 12 * (n * n) as u64);
        assert!((0..rows.len()).all(|i| rows.row(i).len() == 16));
    }
}
