//! The surface of a cake.

use crate::math::Vec3;

/// Vertical lines across the smallest diameter along which the surface is looked for.
const LINES: f64 = 5.0;

/// Vertical lines over a rectangle, or along a line where it is flat.
pub struct Surface {
    /// Side [m], number of lines and whether it repeats itself, along x and along y.
    sides: [(f64, usize, bool); 2],
}

impl Surface {
    /// Over sides [m] for grains of a diameter [m]; without a depth in two dimensions.
    pub fn new(width: f64, depth: Option<f64>, periodic: [bool; 2], diameter: f64) -> Surface {
        let count = |side: f64| ((side / diameter * LINES).ceil() as usize).max(1);
        Surface {
            sides: [
                (width, count(width), periodic[0]),
                depth.map_or((0.0, 1, false), |depth| (depth, count(depth), periodic[1])),
            ],
        }
    }

    /// Mean height over a floor [m] of the highest points of spheres by centre and radius [m].
    pub fn mean_height(&self, spheres: impl Iterator<Item = (Vec3, f64)>, floor: f64) -> f64 {
        let [(_, columns, _), (_, rows, _)] = self.sides;
        let mut heights = vec![floor; columns * rows];
        for (centre, radius) in spheres {
            let along = self.near(0, centre.x, radius);
            for (row, beside) in self.near(1, centre.y, radius) {
                for (column, across) in &along {
                    let squared = radius * radius - across * across - beside * beside;
                    if squared > 0.0 {
                        let height = &mut heights[row * columns + column];
                        *height = height.max(centre.z + squared.sqrt());
                    }
                }
            }
        }
        heights.iter().map(|height| height - floor).sum::<f64>() / heights.len() as f64
    }

    /// Lines that a sphere may reach and their distances [m] along an axis.
    fn near(&self, axis: usize, centre: f64, radius: f64) -> Vec<(usize, f64)> {
        let (side, count, periodic) = self.sides[axis];
        if side == 0.0 {
            return vec![(0, centre)];
        }
        let spacing = side / count as f64;
        let first = ((centre - radius) / spacing - 0.5).ceil() as i64;
        let last = ((centre + radius) / spacing - 0.5).floor() as i64;
        let distance = |line: i64| (line as f64 + 0.5) * spacing - centre;
        (first..=last)
            .filter(|line| periodic || (0..count as i64).contains(line))
            .map(|line| (line.rem_euclid(count as i64) as usize, distance(line)))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_sphere_raises_the_mean_by_the_volume_under_its_upper_half() {
        let surface = Surface::new(3.0, Some(4.0), [true; 2], 0.2);
        let volume = 2.0 / 3.0 * std::f64::consts::PI + std::f64::consts::PI * 1.5;
        for x in [0.1, 1.3, 2.9] {
            let sphere = (Vec3::new(x, 3.7, 1.5), 1.0);
            let height = surface.mean_height(std::iter::once(sphere), 0.0);
            assert!((height * 12.0 / volume - 1.0).abs() < 0.01, "{x}: {height}");
        }
    }

    #[test]
    fn walls_hold_what_lies_beyond_and_the_lower_of_two_is_not_seen() {
        let surface = Surface::new(3.0, None, [false; 2], 0.1);
        let low = (Vec3::new(0.0, 0.0, 1.0), 0.5);
        let high = (Vec3::new(0.0, 0.0, 2.0), 0.5);
        let both = surface.mean_height([low, high].into_iter(), 0.0);
        assert_eq!(both, surface.mean_height([high].into_iter(), 0.0));
        let inside = (Vec3::new(1.5, 0.0, 2.0), 0.5);
        let whole = surface.mean_height([inside].into_iter(), 0.0);
        assert!((both / whole - 0.5).abs() < 0.02, "{both}, {whole}");
    }

    #[test]
    fn without_grains_there_is_the_floor() {
        let surface = Surface::new(3.0, Some(4.0), [true; 2], 0.2);
        assert_eq!(surface.mean_height(std::iter::empty(), 0.7), 0.0);
    }
}
