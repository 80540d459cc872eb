//! Beetstra drag in a bed of equal spheres.
//!
//! ```text
//! factor = 10φ/ε² + ε² (1 + 1.5 √φ)
//!          + 0.413 Re/(24 ε²) · [1/ε + 3εφ + 8.4 Re^−0.343] / [1 + 10^(3φ) Re^−(1+4φ)/2]
//! ```
//!
//! φ = 1 − ε; Re of the superficial slip. At low Re and dense packing it is Carman's pressure drop with
//! 180, at ε = 1 and rest Stokes drag. Fitted to lattice Boltzmann simulations at Re ≤ 1000 and
//! 0.4 ≤ ε ≤ 0.9, to 8 %.
//!
//! Numerator and denominator of the second line are multiplied by Re^((1+4φ)/2), so that rest needs no
//! branch. Source: Beetstra, van der Hoef & Kuipers (2007), AIChE J. 53, 489–501; Raso (2014), eqs.
//! 2.85–2.86.

use std::f64::consts::LN_10;

use super::DragLaw;
use crate::math::Number;
use crate::math::elementary::{exp, power};

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beetstra;

impl DragLaw for Beetstra {
    #[inline(always)]
    fn factor<N: Number>(&self, re: N, porosity: N) -> N {
        let (one, half) = (N::splat(1.0), N::splat(0.5));
        let solid = (one - porosity).or_zero();
        let square = porosity * porosity;
        let viscous = N::splat(10.0) * solid / square + square * (one + N::splat(1.5) * solid.sqrt());
        let rise = power(re, half + N::splat(2.0) * solid);
        let bracket = (one / porosity + N::splat(3.0) * porosity * solid) * re
            + N::splat(8.4) * power(re, N::splat(0.657));
        let onset = rise / (rise + exp(N::splat(3.0 * LN_10) * solid));
        viscous + N::splat(0.413 / 24.0) / square * bracket * onset
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::drag::{DiFelice, DragScale};

    #[test]
    fn a_sphere_alone_in_creeping_flow_drags_by_stokes() {
        assert_eq!(Beetstra.factor(0.0, 1.0), 1.0);
        assert!((Beetstra.factor(1e-6, 1.0) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn rest_is_the_limit_of_slow_flow() {
        for porosity in [0.4, 0.7, 1.0] {
            let (rest, slow) = (Beetstra.factor(0.0, porosity), Beetstra.factor(1e-9, porosity));
            assert!((slow / rest - 1.0).abs() < 1e-9, "{porosity}");
        }
    }

    #[test]
    fn a_dense_bed_takes_carmans_pressure_drop() {
        // Carman: ΔP/L = 180 μ φ² u/(ε³ d²), of which the drag of model A is ε. The second term of the law
        // adds what it adds, which falls as ε⁴/φ.
        let excess = |porosity: f64| {
            let solid = 1.0 - porosity;
            let drag = 18.0 * solid * Beetstra.factor(1e-9, porosity);
            drag / (180.0 * solid * solid / porosity.powi(2)) - 1.0
        };
        for porosity in [0.4_f64, 0.3, 0.2, 0.1] {
            let bound = 0.3 * porosity.powi(4) / (1.0 - porosity);
            assert!(excess(porosity) > 0.0 && excess(porosity) < bound, "{porosity}");
        }
    }

    #[test]
    fn drag_coefficients_fall_and_factors_rise_with_speed() {
        for porosity in [0.4, 0.6, 0.8, 0.95] {
            let factor = |step: i32| Beetstra.factor(10f64.powf(f64::from(step) / 20.0), porosity);
            for step in -80..60 {
                assert!(factor(step + 1) > factor(step), "{porosity}");
                assert!(factor(step + 1) < factor(step) * 10f64.powf(0.05), "{porosity}");
            }
        }
    }

    #[test]
    fn the_reference_block_falls_at_3_37_where_di_felice_gives_4_91_millimetres_per_second() {
        let water = DragScale {
            diameter: 1e-4,
            density: 1000.0,
            viscosity: 0.89e-3,
        };
        let pull = 0.9 * PI / 6.0 * 1e-12 * 1500.0 * 9.81;
        let beetstra = water.balance(&Beetstra, pull, 0.9);
        assert!((beetstra - 3.374e-3).abs() < 5e-7, "{beetstra}");
        assert!((water.balance(&DiFelice, pull, 0.9) - 4.912e-3).abs() < 5e-7);
    }
}
