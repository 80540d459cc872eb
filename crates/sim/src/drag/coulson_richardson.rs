//! Coulson–Richardson drag on one sphere.
//!
//! ```text
//! f = (π/4) d² ρ_f |u_s| u_s (1.84 Re^−0.31 + 0.293 Re^0.06)^3.45
//! factor = (Re/12) (…)^3.45
//! ```
//!
//! The bracket diverges at rest as Re^−1.07, a little faster than Stokes drag allows, so Re is
//! floored at 1e-3, where the factor is within 8 % of 1.
//! Source: Coulson & Richardson (1993), vol. 2; Raso (2014) eq. 2.75 with the slip vector restored.

use super::DragLaw;
use crate::math::Number;
use crate::math::elementary::power;

/// Reynolds number under which the factor is held.
const REYNOLDS_FLOOR: f64 = 1e-3;

#[derive(Clone, Copy, Debug)]
pub struct CoulsonRichardson;

impl DragLaw for CoulsonRichardson {
    #[inline(always)]
    fn factor<N: Number>(&self, re: N, _porosity: N) -> N {
        let re = N::splat(REYNOLDS_FLOOR).max(re);
        let bracket =
            N::splat(1.84) * power(re, N::splat(-0.31)) + N::splat(0.293) * power(re, N::splat(0.06));
        re / N::splat(12.0) * power(bracket, N::splat(3.45))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_finite_at_rest_and_near_stokes_at_low_reynolds_numbers() {
        // At Re 0.01 the drag coefficient over 2 is 1246/2 against Stokes 1200/2.
        assert!((CoulsonRichardson.factor(0.01, 1.0) - 1246.0 / 1200.0).abs() < 2e-3);
        assert!((CoulsonRichardson.factor(0.0, 1.0) - 1.0).abs() < 0.25);
    }
}
