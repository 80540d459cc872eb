//! What acts between grains that do not touch.

use crate::contact::Meeting;
use crate::math::Number;

/// Placeholder until the laws of cohesion are here.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attraction {
    pub cut_off: f64,
}

impl Attraction {
    pub fn reach(&self) -> f64 {
        self.cut_off
    }

    #[inline(always)]
    pub fn between_grains<N: Number>(&self, _: &Meeting<N>, _: N, _: [N; 2]) -> N {
        N::splat(0.0)
    }

    #[inline(always)]
    pub fn to_wall<N: Number>(&self, _: &Meeting<N>, _: N) -> N {
        N::splat(0.0)
    }
}
