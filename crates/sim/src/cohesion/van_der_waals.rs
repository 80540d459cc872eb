//! Van der Waals attraction of spheres and flat walls.
//!
//! ```text
//! pair  F = (H_a/6) 64 R_i³R_j³ (h + R_i + R_j) / [a² (a + 4 R_i R_j)²],   a = h² + 2 R_i h + 2 R_j h
//! wall  F = 2 H_a R³ / [3 h² (h + 2R)²]
//! ```
//!
//! Both follow from Hamaker's (1937) potential, Physica 4, 1058–1072. Alvim (2016), eq. 49, prints the
//! pair with the second bracket to the first power, which is no force. The gap h is held at its
//! smallest value h_min below it and in contact: F diverges at h = 0, and h_min stands for the
//! roughness of the surfaces. Retardation, which weakens F above some 10 nm, is left out.

use super::Attraction;
use crate::math::{Number, bisect};

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VanDerWaals {
    /// H_a [J].
    pub hamaker: f64,
    /// h_min [m].
    pub smallest_gap: f64,
    /// Gap beyond which there is no attraction [m].
    pub cut_off_gap: f64,
}

impl VanDerWaals {
    /// Cut off at the gap beyond which no attraction between grains of up to `largest_radius` [m], or
    /// of one to a wall, exceeds `least_force` [N]. The wall sets it, at twice the force of a pair.
    pub fn weaker_than(
        least_force: f64,
        hamaker: f64,
        smallest_gap: f64,
        largest_radius: f64,
    ) -> VanDerWaals {
        let mut law = VanDerWaals {
            hamaker,
            smallest_gap,
            cut_off_gap: f64::INFINITY,
        };
        let missing = |gap: f64| least_force - law.wall_force(gap, largest_radius);
        let mut far = 2.0 * smallest_gap;
        while missing(far) < 0.0 && far < largest_radius * 1e6 {
            far *= 2.0;
        }
        law.cut_off_gap = bisect(smallest_gap, far, missing);
        law
    }

    /// The gap held at the smallest one.
    #[inline(always)]
    fn held<N: Number>(&self, gap: N) -> N {
        N::splat(self.smallest_gap).max(gap)
    }

    /// A force where the gap is not beyond the cut-off.
    #[inline(always)]
    fn within<N: Number>(&self, gap: N, force: N) -> N {
        N::select(N::splat(self.cut_off_gap).below(gap), N::splat(0.0), force)
    }
}

impl Attraction for VanDerWaals {
    #[inline(always)]
    fn cut_off_gap(&self) -> f64 {
        self.cut_off_gap
    }

    #[inline(always)]
    fn force<N: Number>(&self, gap: N, radius_i: N, radius_j: N) -> N {
        let product = radius_i * radius_j;
        let sum = radius_i + radius_j;
        let h = self.held(gap);
        let near = h * (h + sum + sum);
        let far = near + N::splat(4.0) * product;
        // The square of 8 R_i R_j over both brackets: no power of a length beyond the fourth.
        let ratio = N::splat(8.0) * product / (near * far);
        let force = N::splat(self.hamaker / 6.0) * (product * (h + sum)) * (ratio * ratio);
        self.within(gap, force)
    }

    #[inline(always)]
    fn wall_force<N: Number>(&self, gap: N, radius: N) -> N {
        let h = self.held(gap);
        let ratio = radius / (h * (h + radius + radius));
        let force = N::splat(self.hamaker * 2.0 / 3.0) * radius * (ratio * ratio);
        self.within(gap, force)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    const GLASS: VanDerWaals = VanDerWaals {
        hamaker: 6.5e-20,
        smallest_gap: 1e-9,
        cut_off_gap: f64::INFINITY,
    };
    const RADIUS: f64 = 125e-6;

    /// Hamaker's potential of two spheres over H_a.
    fn potential(h: f64, ri: f64, rj: f64) -> f64 {
        let near = h * h + 2.0 * (ri + rj) * h;
        let far = near + 4.0 * ri * rj;
        -(2.0 * ri * rj / near + 2.0 * ri * rj / far + (near / far).ln()) / 6.0
    }

    #[test]
    fn two_grains_of_250_micrometres_attract_by_0_677_micronewton_at_1_nanometre() {
        let force = GLASS.force(1e-9, RADIUS, RADIUS);
        assert!((force - 6.77e-7).abs() < 0.005e-7, "{force}");
    }

    #[test]
    fn the_force_is_the_slope_of_hamakers_potential() {
        for (h, ri, rj) in [
            (20e-6, RADIUS, RADIUS),
            (50e-6, RADIUS, 2.0 * RADIUS),
            (1e-6, 5e-6, 3e-6),
        ] {
            let step = 1e-4 * h;
            let slope = (potential(h + step, ri, rj) - potential(h - step, ri, rj)) / (2.0 * step);
            let force = GLASS.force(h, ri, rj) / GLASS.hamaker;
            assert!((force / slope - 1.0).abs() < 1e-5, "{force} and {slope}");
        }
    }

    #[test]
    fn a_huge_sphere_is_a_wall_and_a_wall_attracts_twice_as_much_as_a_grain() {
        for gap in [1e-9, 1e-7, 1e-5, 1e-3] {
            let wall = GLASS.wall_force(gap, RADIUS);
            let huge = GLASS.force(gap, RADIUS, 1e6 * (RADIUS + gap));
            assert!((huge / wall - 1.0).abs() < 1e-5, "{huge} and {wall}");
        }
        let ratio = GLASS.wall_force(1e-9, RADIUS) / GLASS.force(1e-9, RADIUS, RADIUS);
        assert!((ratio - 2.0).abs() < 1e-4);
    }

    #[test]
    fn small_gaps_keep_their_digits() {
        // Derjaguin: R*/6 h² per H_a, short by terms of order h/R.
        for gap in [1e-9, 1e-11, 1e-13] {
            let law = VanDerWaals {
                smallest_gap: gap,
                ..GLASS
            };
            let derjaguin = law.hamaker * 0.5 * RADIUS / (6.0 * gap * gap);
            let error = law.force(gap, RADIUS, RADIUS) / derjaguin - 1.0;
            assert!(error.abs() < 3.0 * gap / RADIUS + 1e-14, "{error} at {gap}");
        }
    }

    #[test]
    fn contact_holds_the_force_of_the_smallest_gap() {
        let most = GLASS.force(1e-9, RADIUS, RADIUS);
        for gap in [1e-10, 0.0, -1e-7, -1e-5] {
            assert_eq!(GLASS.force(gap, RADIUS, RADIUS), most);
            assert_eq!(GLASS.wall_force(gap, RADIUS), GLASS.wall_force(1e-9, RADIUS));
        }
        assert!(GLASS.force(1.001e-9, RADIUS, RADIUS) < most);
    }

    #[test]
    fn the_cut_off_leaves_out_what_is_under_a_share_of_the_weight_and_no_more() {
        let weight = 2460.0 * PI / 6.0 * (2.0 * RADIUS).powi(3) * 9.81;
        let law = VanDerWaals::weaker_than(1e-3 * weight, 6.5e-20, 1e-9, RADIUS);
        let (under, over) = (0.999 * law.cut_off_gap, 1.001 * law.cut_off_gap);
        let share = law.wall_force(under, RADIUS) / weight;
        assert!((share - 1e-3).abs() < 3e-6, "{share}");
        assert!(law.force(under, RADIUS, RADIUS) > 0.0);
        assert_eq!(law.wall_force(over, RADIUS), 0.0);
        assert_eq!(law.force(over, RADIUS, RADIUS), 0.0);
    }

    #[test]
    fn without_a_hamaker_constant_nothing_attracts_beyond_the_smallest_gap() {
        let law = VanDerWaals::weaker_than(1e-12, 0.0, 1e-9, RADIUS);
        assert!((law.cut_off_gap / 1e-9 - 1.0).abs() < 1e-12);
        assert_eq!(law.force(0.0, RADIUS, RADIUS), 0.0);
    }
}
