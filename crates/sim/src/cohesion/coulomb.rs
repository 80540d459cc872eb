//! Coulomb's force between charges in the centres of spheres.
//!
//! ```text
//! F = −q_i q_j / (4π ε_0 ε_r r²)
//! ```
//!
//! Attraction is positive, so equal charges give a negative force. No screening by ions: in an
//! electrolyte it holds for distances far under the Debye length only. Polarisation of the grains and
//! images in the walls are left out.

use std::f64::consts::PI;

use crate::math::Number;

/// ε_0 [F/m], CODATA 2018.
const VACUUM_PERMITTIVITY: f64 = 8.854_187_812_8e-12;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coulomb {
    /// Permittivity ε_r of the fluid over that of the vacuum [-]; 78.4 for water at 25 °C.
    pub relative_permittivity: f64,
}

impl Coulomb {
    /// Attraction [N] of two charges [C] at a distance [m] of the centres.
    #[inline(always)]
    pub fn force<N: Number>(&self, distance: N, charge_i: N, charge_j: N) -> N {
        let strength = -1.0 / (4.0 * PI * VACUUM_PERMITTIVITY * self.relative_permittivity);
        N::splat(strength) * (charge_i / distance) * (charge_j / distance)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_coulomb_repels_another_by_8_988_giganewtons_at_a_metre() {
        let force = Coulomb {
            relative_permittivity: 1.0,
        }
        .force(1.0, 1.0, 1.0);
        assert!((force + 8.987_551_79e9).abs() < 10.0, "{force}");
    }

    #[test]
    fn opposite_charges_attract_by_a_quarter_at_twice_the_distance() {
        let water = Coulomb {
            relative_permittivity: 80.0,
        };
        let near = water.force(1e-4, 1e-15, -2e-15);
        let far = water.force(2e-4, -2e-15, 1e-15);
        assert!(near > 0.0);
        assert!((near / far - 4.0).abs() < 1e-14);
    }
}
