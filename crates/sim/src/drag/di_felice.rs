//! Di Felice drag in a suspension: Dallavalle drag of the superficial slip times ε^−χ.
//!
//! ```text
//! χ = 3.7 − 0.65 exp(−(1.5 − log10 Re)² / 2)
//! ```
//!
//! Source: Di Felice (1994), Int. J. Multiphase Flow 20, 153–159.

use super::{Dallavalle, DragLaw};

#[derive(Clone, Copy, Debug)]
pub struct DiFelice;

impl DragLaw for DiFelice {
    #[inline]
    fn factor(&self, re: f64, porosity: f64) -> f64 {
        let distance = 1.5 - re.log10();
        let chi = 3.7 - 0.65 * (-0.5 * distance * distance).exp();
        Dallavalle.factor(re, porosity) * porosity.powf(-chi)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_the_single_sphere_law_without_neighbours() {
        for re in [0.0, 1.0, 300.0] {
            assert_eq!(DiFelice.factor(re, 1.0), Dallavalle.factor(re, 1.0));
        }
    }

    #[test]
    fn rests_without_branches() {
        assert!((DiFelice.factor(0.0, 0.5) / (0.96 * 0.5_f64.powf(-3.7)) - 1.0).abs() < 1e-14);
    }
}
