//! Porosity away from side walls.

use crate::math::Vec3;

/// Vertical lines across a diameter along which solids are measured.
const LINES: f64 = 32.0;

/// Vertical lines on a square grid over a rectangle, one for each cell of the grid.
pub struct Lines {
    /// Edge of the first cell, spacing [m] and number, along x and along y.
    grid: [(f64, f64, i64); 2],
}

impl Lines {
    /// Over all that lies one diameter [m] away from the sides of a box [m].
    pub fn away_from_walls(width: f64, depth: f64, diameter: f64) -> Lines {
        let along = |width: f64| {
            let inner = (width - 2.0 * diameter).max(0.0);
            let count = (inner / diameter * LINES).ceil();
            (diameter, inner / count.max(1.0), count as i64)
        };
        Lines {
            grid: [along(width), along(depth)],
        }
    }

    /// Porosity [-] between two heights [m] among spheres by centre and radius [m]; NaN where there is no room.
    ///
    /// The volume of a single sphere is measured within 0.3 %.
    pub fn porosity(&self, spheres: impl Iterator<Item = (Vec3, f64)>, heights: [f64; 2]) -> f64 {
        let [(_, _, along_x), (_, _, along_y)] = self.grid;
        let whole = (along_x * along_y) as f64 * (heights[1] - heights[0]);
        let solids: f64 = spheres
            .map(|(centre, radius)| self.inside(centre, radius, heights))
            .sum();
        if whole > 0.0 {
            1.0 - solids / whole
        } else {
            f64::NAN
        }
    }

    /// Length of all lines [m] inside of a sphere and between two heights [m].
    fn inside(&self, centre: Vec3, radius: f64, [low, high]: [f64; 2]) -> f64 {
        if centre.z + radius <= low || centre.z - radius >= high {
            return 0.0;
        }
        let [x, y] = [0, 1].map(|axis| self.near(axis, centre[axis], radius));
        let mut length = 0.0;
        for across in x {
            for beside in &y {
                let squared = radius * radius - across * across - beside * beside;
                if squared > 0.0 {
                    let half = squared.sqrt();
                    length += ((centre.z + half).min(high) - (centre.z - half).max(low)).max(0.0);
                }
            }
        }
        length
    }

    /// Distances [m] along an axis to the lines that a sphere may reach.
    fn near(&self, axis: usize, centre: f64, radius: f64) -> Vec<f64> {
        let (edge, spacing, count) = self.grid[axis];
        let line = |place: i64| edge + (place as f64 + 0.5) * spacing - centre;
        let place = |position: f64| ((position - edge) / spacing - 0.5).clamp(-1.0, count as f64);
        let first = (place(centre - radius).ceil() as i64).max(0);
        let last = (place(centre + radius).floor() as i64).min(count - 1);
        (first..=last).map(line).collect()
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    const HEIGHTS: [f64; 2] = [0.0, 4.0];

    fn solids(centre: Vec3, radius: f64, heights: [f64; 2]) -> f64 {
        let lines = Lines::away_from_walls(6.0, 7.0, 1.0);
        let porosity = lines.porosity(std::iter::once((centre, radius)), heights);
        (1.0 - porosity) * 4.0 * 5.0 * (heights[1] - heights[0])
    }

    #[test]
    fn a_sphere_inside_counts_with_its_volume_wherever_it_lies() {
        for step in 0..20 {
            let shift = 0.037 * f64::from(step);
            let found = solids(Vec3::new(2.5 + shift, 3.0 + 0.7 * shift, 2.0), 0.5, HEIGHTS);
            let volume = PI / 6.0;
            assert!((found / volume - 1.0).abs() < 3e-3, "{shift}: {found}");
        }
    }

    #[test]
    fn a_sphere_astride_a_face_counts_with_the_part_inside() {
        let (volume, radius) = (PI / 6.0, 0.5);
        let halves = [
            (Vec3::new(1.0, 3.0, 2.0), HEIGHTS),
            (Vec3::new(3.0, 6.0, 2.0), HEIGHTS),
            (Vec3::new(3.0, 3.0, 4.0), HEIGHTS),
            (Vec3::new(3.0, 3.0, 0.0), HEIGHTS),
        ];
        for (centre, heights) in halves {
            let share = solids(centre, radius, heights) / volume;
            assert!((share - 0.5).abs() < 0.02, "{centre:?}: {share}");
        }
        let corner = solids(Vec3::new(1.0, 1.0, 0.0), radius, HEIGHTS) / volume;
        assert!((corner - 0.125).abs() < 0.01, "{corner}");
        for outside in [Vec3::new(0.5, 3.0, 2.0), Vec3::new(3.0, 3.0, 4.5)] {
            assert_eq!(solids(outside, radius, HEIGHTS), 0.0);
        }
    }

    #[test]
    fn nothing_is_said_of_a_box_that_is_all_wall() {
        let lines = Lines::away_from_walls(2.0, 7.0, 1.0);
        assert!(lines.porosity(std::iter::empty(), HEIGHTS).is_nan());
    }
}
