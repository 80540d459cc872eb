//! Schiller–Naumann drag on one rigid sphere.
//!
//! ```text
//! factor = 1 + 0.15 Re^0.687     Re ≤ 1000
//! factor = 0.44 Re / 24          Re > 1000, Newton regime
//! ```
//!
//! Source: Schiller & Naumann (1935), Z. VDI 77, 318–320.
//! The branches differ by 0.4 % at Re = 1000; the step is kept as published.

use super::DragLaw;
use crate::math::Number;
use crate::math::elementary::power;

#[derive(Clone, Copy, Debug)]
pub struct SchillerNaumann;

impl DragLaw for SchillerNaumann {
    #[inline(always)]
    fn factor<N: Number>(&self, re: N, _porosity: N) -> N {
        let newton = N::splat(1000.0).below(re);
        let viscous = N::splat(1.0) + N::splat(0.15) * power(re, N::splat(0.687));
        N::select(newton, N::splat(0.44) * re / N::splat(24.0), viscous)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_stokes_drag_at_rest() {
        assert_eq!(SchillerNaumann.factor(0.0, 1.0), 1.0);
    }

    #[test]
    fn branches_meet_within_half_a_percent() {
        let below = SchillerNaumann.factor(1000.0, 1.0);
        let above = SchillerNaumann.factor(1000.0_f64.next_up(), 1.0);
        assert!((above / below - 1.0).abs() < 5e-3, "{below} and {above}");
    }
}
