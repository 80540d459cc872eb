//! What neighbours make of the drag on one sphere: a factor on it at the same superficial slip.

use super::DragLaw;
use crate::math::Number;
use crate::math::elementary::{exp, log10, power};

/// A voidage function.
pub trait VoidageLaw: Copy {
    /// Drag among neighbours over that of the sphere alone, at porosity ε [-] and the Reynolds number
    /// of the superficial slip [-].
    fn voidage<N: Number>(&self, re: N, porosity: N) -> N;
}

/// Every grain drags as if alone.
impl VoidageLaw for () {
    #[inline(always)]
    fn voidage<N: Number>(&self, _re: N, _porosity: N) -> N {
        N::splat(1.0)
    }
}

/// ε^−χ with χ = 3.7 − 0.65 exp(−(1.5 − log10 Re)²/2).
///
/// Fitted for 0.4 ≤ ε ≤ 1 at all Reynolds numbers. Source: Di Felice (1994), Int. J. Multiphase Flow
/// 20, 153–159; Alvim (2016), eqs. 57–58.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiFelice;

/// ε^−(χ + 2): the interstitial slip squared where the superficial one belongs.
///
/// Source: Alvim (2016), eq. 55 as printed. It overrates drag in creeping flow by ε⁻².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AlvimLiteral;

impl VoidageLaw for DiFelice {
    #[inline(always)]
    fn voidage<N: Number>(&self, re: N, porosity: N) -> N {
        power(porosity, N::splat(0.0) - exponent(re))
    }
}

impl VoidageLaw for AlvimLiteral {
    #[inline(always)]
    fn voidage<N: Number>(&self, re: N, porosity: N) -> N {
        power(porosity, N::splat(-2.0) - exponent(re))
    }
}

/// χ [-]; 3.7 at rest, without a branch.
#[inline(always)]
fn exponent<N: Number>(re: N) -> N {
    let distance = N::splat(1.5) - log10(re);
    N::splat(3.7) - N::splat(0.65) * exp(N::splat(-0.5) * distance * distance)
}

/// The drag of a sphere and what its neighbours make of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hindered<L, V> {
    pub sphere: L,
    pub voidage: V,
}

impl<L: DragLaw, V: VoidageLaw> DragLaw for Hindered<L, V> {
    #[inline(always)]
    fn factor<N: Number>(&self, re: N, porosity: N) -> N {
        self.sphere.factor(re, porosity) * self.voidage.voidage(re, porosity)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::drag::{Dallavalle, DragScale, SchillerNaumann, Stokes};

    /// First settling speed [m/s] of 1000 glass spheres of 250 µm in a box of 10 × 10 × 40 diameters
    /// of still water.
    fn settling_speed(voidage: impl VoidageLaw) -> f64 {
        let (diameter, density) = (250e-6_f64, 1000.0);
        let scale = DragScale {
            diameter,
            density,
            viscosity: 1e-3,
        };
        let volume = PI / 6.0 * diameter.powi(3);
        let porosity = 1.0 - 1000.0 * volume / (4000.0 * diameter.powi(3));
        assert!((porosity - 0.869).abs() < 2e-4);
        let law = Hindered {
            sphere: SchillerNaumann,
            voidage,
        };
        // Model B: buoyancy of the pure fluid, drag over ε.
        let pull = (2460.0 - density) * volume * 9.81;
        scale.balance(&law, porosity * pull, porosity) / porosity
    }

    #[test]
    fn a_dilute_bed_settles_at_21_95_millimetres_per_second_and_at_17_3_as_printed() {
        let (consistent, literal) = (settling_speed(DiFelice), settling_speed(AlvimLiteral));
        assert!((consistent - 21.95e-3).abs() < 0.01e-3, "{consistent}");
        assert!((literal - 17.3e-3).abs() < 0.05e-3, "{literal}");
        assert!(settling_speed(()) > 30e-3);
    }

    #[test]
    fn neighbours_change_nothing_at_full_porosity_and_hinder_below_it() {
        for re in [0.0, 1.0, 30.0, 1e4] {
            assert_eq!(DiFelice.voidage(re, 1.0), 1.0);
            assert_eq!(AlvimLiteral.voidage(re, 1.0), 1.0);
            let mut last = 1.0;
            for porosity in [0.95, 0.8, 0.6, 0.4, 0.3] {
                let now = DiFelice.voidage(re, porosity);
                assert!(now > last);
                assert!(AlvimLiteral.voidage(re, porosity) > now);
                last = now;
            }
        }
    }

    #[test]
    fn the_exponent_is_3_7_at_both_ends_and_least_at_reynolds_number_31_6() {
        let exponent = |re: f64| -DiFelice.voidage(re, 0.5).ln() / 0.5_f64.ln();
        for re in [0.0, 1e-8, 1e12] {
            assert!((exponent(re) - 3.7).abs() < 1e-12, "{}", exponent(re));
        }
        let least = 10f64.powf(1.5);
        assert!((exponent(least) - 3.05).abs() < 1e-12);
        assert!(exponent(0.9 * least) > exponent(least));
        assert!(exponent(1.1 * least) > exponent(least));
    }

    #[test]
    fn any_sphere_goes_with_any_voidage() {
        let hindered = |re| {
            Hindered {
                sphere: Stokes,
                voidage: DiFelice,
            }
            .factor(re, 0.7)
        };
        assert_eq!(hindered(2.0), DiFelice.voidage(2.0, 0.7));
        let alone = Hindered {
            sphere: Dallavalle,
            voidage: (),
        };
        assert_eq!(alone.factor(2.0, 0.7), Dallavalle.factor(2.0, 0.7));
    }
}
