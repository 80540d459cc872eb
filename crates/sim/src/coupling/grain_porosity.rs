//! Porosity at the grains, from the grains alone, in one pass.
//!
//! ```text
//! ε_i = 1 − Σ_j V W*(r_ij, h_p), itself included
//! ```
//!
//! In a lattice the grain's own term belongs to the sum like any other (structure factor 0).

use crate::fluid::kernel::Sharpening;
use crate::math::Vec3;
use crate::neighbours::{CellGrid, images};

/// Porosity [-] of each of equal grains of `volume` [m³], with porosity length h_p [m], in a
/// column periodic over `width` [m].
pub fn grain_porosity(
    grains: &[Vec3],
    volume: f64,
    length: f64,
    sharpening: Sharpening,
    width: f64,
) -> Vec<f64> {
    let reach = 2.0 * length;
    let mut points = grains.to_vec();
    points.extend(
        images(grains, width, reach)
            .iter()
            .map(|i| grains[i.source as usize] + i.shift),
    );
    let grid = CellGrid::new(&points, reach);
    let unit = volume / length.powi(3);
    grains
        .iter()
        .map(|grain| {
            let mut solids = 0.0;
            grid.visit_near(grain, |j| {
                let q = (points[j as usize] - grain).norm() / length;
                if q < 2.0 {
                    solids += unit * sharpening.value(q);
                }
            });
            1.0 - solids
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn a_periodic_lattice_has_its_own_porosity_inside() {
        let (diameter, side) = (1e-4, 12);
        let volume = PI / 6.0 * diameter * diameter * diameter;
        let pitch = (volume / 0.1_f64).cbrt();
        let grains: Vec<Vec3> = (0..side * side * 25)
            .map(|i| {
                let (x, y, z) = (i % side, i / side % side, i / side / side);
                Vec3::new(x as f64 + 0.5, y as f64 + 0.5, z as f64) * pitch
            })
            .collect();
        let inside = side * side * 12;
        for (sharpening, tolerance) in [(Sharpening::NONE, 3e-3), (Sharpening::EDGE_NEUTRAL, 1e-2)] {
            let porosity = grain_porosity(&grains, volume, 3.0 * diameter, sharpening, side as f64 * pitch);
            assert!(
                (porosity[inside] - 0.9).abs() < 0.1 * tolerance,
                "{}",
                porosity[inside]
            );
        }
    }
}
