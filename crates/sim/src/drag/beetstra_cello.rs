//! Beetstra drag in a bed of spheres of several sizes, shared out after Cello, Di Renzo & Di Maio.
//!
//! ```text
//! factor(y) = β f,     β = (1/ε) [1/f + ((3ε − 1)/2 − 1/f) y + ½ φ y²]
//! ```
//!
//! f: [`Beetstra`] at the Reynolds number of the Sauter mean ⟨d⟩, that of the grain over y; y = d/⟨d⟩;
//! φ = 1 − ε. Equal sizes have β = 1. A speck among large spheres feels Stokes drag of the interstitial slip, a large
//! sphere among specks half the pressure gradient that the bed takes from the flow.
//!
//! For size ratios up to about 4. Source: Cello, Di Renzo & Di Maio (2010), Chem. Eng. Sci. 65, 3128–3139;
//! Raso (2014), eqs. 2.80–2.88.

use super::{Beetstra, DragLaw, PolydisperseLaw};
use crate::math::Number;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeetstraCello;

impl PolydisperseLaw for BeetstraCello {
    #[inline(always)]
    fn factor<N: Number>(&self, re: N, porosity: N, relative_diameter: N) -> N {
        let (one, half, y) = (N::splat(1.0), N::splat(0.5), relative_diameter);
        let same = alike(re / y, porosity);
        let solid = (one - porosity).or_zero();
        // β f, so that nothing is divided by f.
        let linear = half * (N::splat(3.0) * porosity - one) * same - one;
        let quadratic = half * solid * same;
        (one + (linear + quadratic * y) * y) / porosity
    }
}

/// Among equal sizes, y = 1.
impl DragLaw for BeetstraCello {
    #[inline(always)]
    fn factor<N: Number>(&self, re: N, porosity: N) -> N {
        alike(re, porosity)
    }
}

/// f: among equal spheres.
#[inline(always)]
fn alike<N: Number>(re: N, porosity: N) -> N {
    DragLaw::factor(&Beetstra, re, porosity)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn factor(re: f64, porosity: f64, y: f64) -> f64 {
        PolydisperseLaw::factor(&BeetstraCello, re, porosity, y)
    }

    #[test]
    fn equal_sizes_have_the_drag_of_equal_spheres() {
        for re in [0.0, 0.5, 100.0] {
            for porosity in [0.4, 0.7, 0.9, 1.0] {
                let ratio = factor(re, porosity, 1.0) / alike(re, porosity);
                assert!((ratio - 1.0).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn grains_far_from_each_other_do_not_feel_the_sizes_of_the_others() {
        // β = 1 + (1 − 1/f)(y − 1) + …: with f = 1 at rest nothing is left of y.
        for y in [0.1, 1.0, 5.0] {
            assert!((factor(0.0, 1.0, y) - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn a_speck_feels_stokes_drag_of_the_interstitial_slip() {
        for porosity in [0.4, 0.6, 0.9] {
            let speck = factor(0.0, porosity, 1e-9);
            assert!((speck * porosity - 1.0).abs() < 1e-7, "{porosity}: {speck}");
        }
    }

    #[test]
    fn a_large_sphere_among_specks_feels_half_the_pressure_gradient_of_the_bed() {
        // The bed takes 18 μ φ f u/(ε ⟨d⟩²) from the pressure.
        let (re, porosity, y) = (0.0, 0.7, 1e7);
        let gradient = 18.0 * (1.0 - porosity) * alike(re, porosity) / porosity;
        // V = π/6 y³ ⟨d⟩³ over 3π y ⟨d⟩ is y² ⟨d⟩²/18.
        let half = 0.5 * gradient * y * y / 18.0;
        assert!((factor(re, porosity, y) / half - 1.0).abs() < 1e-5);
    }

    #[test]
    fn the_bed_as_a_whole_has_the_drag_of_its_sauter_mean_when_sizes_are_close() {
        // Σ_k n_k d_k β_k = Σ_k n_k d_k over equal sizes; for a spread s it departs in second order of s.
        let total = |spread: f64| {
            let sizes = [1.0 - spread, 1.0 + spread];
            let moment = |power: i32| sizes.iter().map(|d| d.powi(power)).sum::<f64>();
            let sauter = moment(3) / moment(2);
            let drag: f64 = sizes.iter().map(|d| d * factor(0.1, 0.8, d / sauter)).sum();
            let alike: f64 = sizes.iter().map(|d| d * factor(0.1, 0.8, 1.0)).sum();
            drag / alike - 1.0
        };
        let (near, far) = (total(0.01), total(0.02));
        assert!((far / near - 4.0).abs() < 0.05, "{near} {far}");
    }
}
