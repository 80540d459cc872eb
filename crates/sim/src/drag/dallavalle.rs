//! Dallavalle drag on one sphere: C_D = (0.63 + 4.8/√Re)².
//!
//! ```text
//! factor = C_D Re / 24 = (0.63 √Re + 4.8)² / 24
//! ```
//! At rest 0.96, four per cent under Stokes, as published.
//! Source: Dallavalle (1948), Micromeritics, 2nd ed.

use super::DragLaw;
use crate::math::Number;

#[derive(Clone, Copy, Debug)]
pub struct Dallavalle;

impl DragLaw for Dallavalle {
    #[inline(always)]
    fn factor<N: Number>(&self, re: N, _porosity: N) -> N {
        let root = N::splat(0.63) * re.sqrt() + N::splat(4.8);
        root * root / N::splat(24.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_four_per_cent_under_stokes_at_rest() {
        assert!((Dallavalle.factor(0.0, 1.0) - 0.96).abs() < 1e-15);
    }

    #[test]
    fn tends_to_newton_drag_of_0_4() {
        let re = 1e10;
        assert!((Dallavalle.factor(re, 1.0) * 24.0 / re - 0.3969).abs() < 1e-4);
    }
}
