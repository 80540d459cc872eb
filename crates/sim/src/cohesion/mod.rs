//! Forces between grains that need no contact. Attraction is positive throughout.

mod coulomb;
mod van_der_waals;

pub use coulomb::Coulomb;
pub use van_der_waals::VanDerWaals;

use crate::math::Number;

/// An attraction that ends at a gap far below a grain's size.
pub trait Attraction: Copy {
    /// Largest gap [m] at which it acts; negative where it never does.
    fn cut_off_gap(&self) -> f64;

    /// Attraction [N] of two spheres `gap` [m] apart, a negative gap being an overlap.
    fn force<N: Number>(&self, gap: N, radius_i: N, radius_j: N) -> N;

    /// Attraction [N] of a sphere to a flat wall `gap` [m] away.
    fn wall_force<N: Number>(&self, gap: N, radius: N) -> N;
}

/// No attraction.
impl Attraction for () {
    #[inline(always)]
    fn cut_off_gap(&self) -> f64 {
        f64::NEG_INFINITY
    }

    #[inline(always)]
    fn force<N: Number>(&self, _gap: N, _radius_i: N, _radius_j: N) -> N {
        N::splat(0.0)
    }

    #[inline(always)]
    fn wall_force<N: Number>(&self, _gap: N, _radius: N) -> N {
        N::splat(0.0)
    }
}
