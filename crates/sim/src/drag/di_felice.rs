//! Di Felice drag in a suspension: Dallavalle drag of the superficial slip times the voidage function
//! [`voidage::DiFelice`].
//!
//! Source: Di Felice (1994), Int. J. Multiphase Flow 20, 153–159.

use super::{Dallavalle, DragLaw, Hindered, voidage};
use crate::math::Number;

#[derive(Clone, Copy, Debug)]
pub struct DiFelice;

impl DragLaw for DiFelice {
    #[inline(always)]
    fn factor<N: Number>(&self, re: N, porosity: N) -> N {
        let law = Hindered {
            sphere: Dallavalle,
            voidage: voidage::DiFelice,
        };
        law.factor(re, porosity)
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
