//! Smoothing kernels with compact support 2h, normalised in three dimensions.
//!
//! With q = r/h: `value` is h³ W(r), `slope` is h⁵ W′(r)/r, which needs no division by r.

use std::f64::consts::PI;

use crate::math::Number;

pub trait Kernel: Copy + Send + Sync {
    /// h³ W at q = r/h [-].
    fn value<N: Number>(&self, q: N) -> N;
    /// h⁵ W′(r)/r at q = r/h [-]; never positive.
    fn slope<N: Number>(&self, q: N) -> N;
}

/// 1 − q/2, and zero beyond the support.
#[inline(always)]
fn rest_of_support<N: Number>(q: N) -> N {
    (N::splat(1.0) - N::splat(0.5) * q).or_zero()
}

/// Wendland C2: W = 21/(16π h³) (1 − q/2)⁴ (1 + 2q).
///
/// Source: Wendland (1995), Adv. Comput. Math. 4, 389–396.
#[derive(Clone, Copy, Debug)]
pub struct WendlandC2;

impl Kernel for WendlandC2 {
    #[inline(always)]
    fn value<N: Number>(&self, q: N) -> N {
        let t = rest_of_support(q);
        let t2 = t * t;
        N::splat(21.0 / (16.0 * PI)) * t2 * t2 * (N::splat(1.0) + N::splat(2.0) * q)
    }

    #[inline(always)]
    fn slope<N: Number>(&self, q: N) -> N {
        let t = rest_of_support(q);
        N::splat(-105.0 / (16.0 * PI)) * (t * t * t)
    }
}

/// Lucy's kernel on the support 2h: W = 105/(128π h³) (1 − q/2)³ (1 + 3q/2).
///
/// Source: Lucy (1977), Astron. J. 82, 1013–1024.
#[derive(Clone, Copy, Debug)]
pub struct Lucy;

impl Kernel for Lucy {
    #[inline(always)]
    fn value<N: Number>(&self, q: N) -> N {
        let t = rest_of_support(q);
        N::splat(105.0 / (128.0 * PI)) * (t * t * t) * (N::splat(1.0) + N::splat(1.5) * q)
    }

    #[inline(always)]
    fn slope<N: Number>(&self, q: N) -> N {
        let t = rest_of_support(q);
        N::splat(-315.0 / (128.0 * PI)) * (t * t)
    }
}

/// A Wendland C2 kernel times (a − b q²), still of integral one.
///
/// A plain kernel smears the edge of a bed: a bed of thickness T loses the share E|z|/T of its own
/// solids fraction, with E|z| the mean distance of the kernel's marginal. The factor takes that back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sharpening {
    pub a: f64,
    pub b: f64,
}

impl Sharpening {
    /// W itself.
    pub const NONE: Sharpening = Sharpening { a: 1.0, b: 0.0 };
    /// Zero second moment: reproduces quadratic fields, E|z| falls from 0.417 h to 0.196 h.
    pub const SECOND_ORDER: Sharpening = Sharpening {
        a: 50.0 / 17.0,
        b: 165.0 / 68.0,
    };
    /// Zero mean distance: the mean over a bed with sharp edges is the bed's own value.
    pub const EDGE_NEUTRAL: Sharpening = Sharpening {
        a: 14.0 / 3.0,
        b: 55.0 / 12.0,
    };

    /// h³ W (a − b q²) at q [-].
    #[inline(always)]
    pub fn value<N: Number>(&self, q: N) -> N {
        WendlandC2.value(q) * (N::splat(self.a) - N::splat(self.b) * q * q)
    }

    /// h³ ∫ W*² dV [-].
    pub fn square(&self) -> f64 {
        integrate(|q| 4.0 * PI * q * q * self.value(q) * self.value(q))
    }
}

/// ∫₀² f(q) dq by Simpson's rule, to 1e-10 for the kernels here.
pub fn integrate(f: impl Fn(f64) -> f64) -> f64 {
    const INTERVALS: usize = 2000;
    let step = 2.0 / INTERVALS as f64;
    let sum: f64 = (0..=INTERVALS)
        .map(|i| {
            let weight = if i == 0 || i == INTERVALS {
                1.0
            } else {
                2.0 + 2.0 * (i % 2) as f64
            };
            weight * f(i as f64 * step)
        })
        .sum();
    sum * step / 3.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moment(value: impl Fn(f64) -> f64, power: i32) -> f64 {
        integrate(|q| 4.0 * PI * q * q * q.powi(power) * value(q))
    }

    #[test]
    fn kernels_integrate_to_one() {
        assert!((moment(|q| WendlandC2.value(q), 0) - 1.0).abs() < 1e-9);
        assert!((moment(|q| Lucy.value(q), 0) - 1.0).abs() < 1e-9);
        for sharpening in [Sharpening::SECOND_ORDER, Sharpening::EDGE_NEUTRAL] {
            assert!((moment(|q| sharpening.value(q), 0) - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn slope_is_the_derivative_of_the_value() {
        let step = 1e-6;
        for q in [0.1, 0.7, 1.3, 1.9] {
            let derivative = (WendlandC2.value(q + step) - WendlandC2.value(q - step)) / (2.0 * step);
            assert!((WendlandC2.slope(q) * q - derivative).abs() < 1e-8);
            let derivative = (Lucy.value(q + step) - Lucy.value(q - step)) / (2.0 * step);
            assert!((Lucy.slope(q) * q - derivative).abs() < 1e-8);
        }
    }

    #[test]
    fn each_sharpening_cancels_its_moment() {
        assert!(moment(|q| Sharpening::SECOND_ORDER.value(q), 2).abs() < 1e-9);
        assert!(moment(|q| Sharpening::EDGE_NEUTRAL.value(q), 1).abs() < 1e-9);
        // E|z| of a radial kernel is half its mean distance: 5/12 and 0.196 h.
        assert!((moment(|q| WendlandC2.value(q), 1) / 2.0 - 5.0 / 12.0).abs() < 1e-9);
        assert!((moment(|q| Sharpening::SECOND_ORDER.value(q), 1) / 2.0 - 0.196).abs() < 1e-3);
    }

    #[test]
    fn vanishes_at_the_edge_of_its_support() {
        assert_eq!(WendlandC2.value(2.0), 0.0);
        assert_eq!(Lucy.slope(2.5), 0.0);
    }
}
