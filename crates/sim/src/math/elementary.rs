//! Exponential and logarithm from the operations of [`Number`] alone, so that one grain and eight
//! side by side get the same bits on every machine.
//!
//! Both split off a power of two and sum a series on what is left. Errors against the exact value are
//! under 1e-15 of it.

use std::f64::consts::{LOG2_E, SQRT_2};

use super::Number;

/// ln 2 in two parts; the first ends in zeros, so that whole multiples of it are exact.
const LN_2_HEAD: f64 = 6.931_471_803_691_238e-1;
const LN_2_TAIL: f64 = 1.908_214_929_270_587_7e-10;

/// e^x. Zero under −746, infinite over 709.79, not a number where x is none.
#[inline(always)]
pub fn exp<N: Number>(x: N) -> N {
    // The argument goes second: this minimum and maximum return the second where one is no number.
    let x = N::splat(-746.0).max(x);
    let x = N::splat(709.8).min(x);
    let twos = (x * N::splat(LOG2_E)).round();
    let rest = x - twos * N::splat(LN_2_HEAD) - twos * N::splat(LN_2_TAIL);
    // Half at a time: the whole power of two may lie outside the range of numbers.
    let half = (twos * N::splat(0.5)).round();
    exp_near_zero(rest)
        .scaled_by_power_of_two(half)
        .scaled_by_power_of_two(twos - half)
}

/// Natural logarithm of a positive number. At zero, below it and under 2.2e-308 it is held at −708.4;
/// not a number where x is infinite or none.
#[inline(always)]
pub fn ln<N: Number>(x: N) -> N {
    let (mantissa, twos) = N::splat(f64::MIN_POSITIVE).max(x).split_exponent();
    // Centred on 1, where the logarithm vanishes.
    let large = N::splat(SQRT_2).below(mantissa);
    let mantissa = N::select(large, mantissa * N::splat(0.5), mantissa);
    let twos = N::select(large, twos + N::splat(1.0), twos);
    // What is no number has a mantissa all the same.
    let twos = twos + x * N::splat(0.0);
    twos * N::splat(LN_2_HEAD) + (ln_near_one(mantissa) + twos * N::splat(LN_2_TAIL))
}

/// Decimal logarithm, under the limits of [`ln`].
#[inline(always)]
pub fn log10<N: Number>(x: N) -> N {
    ln(x) * N::splat(std::f64::consts::LOG10_E)
}

/// base^exponent of a positive base, to 3e-16 (1 + |ln base^exponent|) of it.
#[inline(always)]
pub fn power<N: Number>(base: N, exponent: N) -> N {
    exp(exponent * ln(base))
}

/// Taylor's series to the thirteenth power, for |x| ≤ ln 2 / 2.
#[inline(always)]
fn exp_near_zero<N: Number>(x: N) -> N {
    const INVERSE_FACTORIALS: [f64; 12] = [
        1.0 / 2.0,
        1.0 / 6.0,
        1.0 / 24.0,
        1.0 / 120.0,
        1.0 / 720.0,
        1.0 / 5_040.0,
        1.0 / 40_320.0,
        1.0 / 362_880.0,
        1.0 / 3_628_800.0,
        1.0 / 39_916_800.0,
        1.0 / 479_001_600.0,
        1.0 / 6_227_020_800.0,
    ];
    let square = x * x;
    N::splat(1.0) + (x + square * polynomial(x, &INVERSE_FACTORIALS))
}

/// ln m = 2 artanh s, s = (m − 1)/(m + 1), by its series to s²³ for m between √½ and √2.
#[inline(always)]
fn ln_near_one<N: Number>(mantissa: N) -> N {
    const TWICE_INVERSE_ODD: [f64; 12] = [
        2.0 / 3.0,
        2.0 / 5.0,
        2.0 / 7.0,
        2.0 / 9.0,
        2.0 / 11.0,
        2.0 / 13.0,
        2.0 / 15.0,
        2.0 / 17.0,
        2.0 / 19.0,
        2.0 / 21.0,
        2.0 / 23.0,
        2.0 / 25.0,
    ];
    let one = N::splat(1.0);
    let s = (mantissa - one) / (mantissa + one);
    let square = s * s;
    (s + s) + s * square * polynomial(square, &TWICE_INVERSE_ODD)
}

/// Σ cₙ xⁿ, pairs first: a chain of twelve would wait for itself.
#[inline(always)]
fn polynomial<N: Number>(x: N, c: &[f64; 12]) -> N {
    let pair = |n: usize| N::splat(c[n]) + N::splat(c[n + 1]) * x;
    let (x2, x4) = (x * x, (x * x) * (x * x));
    let low = pair(0) + pair(2) * x2;
    let middle = pair(4) + pair(6) * x2;
    let high = pair(8) + pair(10) * x2;
    low + (middle + high * x4) * x4
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers over the whole range, none of them special.
    fn scattered(low: f64, high: f64) -> impl Iterator<Item = f64> {
        (0..200_000).map(move |i| low + (high - low) * (f64::from(i) * 0.618_033_988_749_894_9).fract())
    }

    fn largest_error(
        mine: impl Fn(f64) -> f64,
        theirs: impl Fn(f64) -> f64,
        at: impl Iterator<Item = f64>,
    ) -> f64 {
        at.map(|x| (mine(x) / theirs(x) - 1.0).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn exponentials_agree_with_the_standard_library() {
        for (low, high) in [(-708.0, 709.7), (-2.0, 2.0), (-1e-3, 1e-3)] {
            let error = largest_error(exp::<f64>, f64::exp, scattered(low, high));
            assert!(error < 1e-15, "{error} from {low} to {high}");
        }
    }

    #[test]
    fn logarithms_agree_with_the_standard_library() {
        let tens = scattered(-307.0, 308.0).map(|exponent| 10f64.powf(exponent));
        assert!(largest_error(ln::<f64>, f64::ln, tens) < 1e-15);
        for (low, high) in [(0.5, 2.0), (1.0 + 1e-9, 1.0 + 1e-6), (1e3, 1e4)] {
            let error = largest_error(ln::<f64>, f64::ln, scattered(low, high));
            assert!(error < 1e-15, "{error} from {low} to {high}");
        }
    }

    #[test]
    fn ends_of_the_range_are_what_they_should_be() {
        assert_eq!(exp(0.0), 1.0);
        assert_eq!(exp(-1000.0), 0.0);
        assert_eq!(exp(f64::NEG_INFINITY), 0.0);
        assert_eq!(exp(1000.0), f64::INFINITY);
        assert!(exp(f64::NAN).is_nan());
        // One of the numbers under the smallest normal one, which have few digits.
        assert!((exp(-740.0) / (-740.0_f64).exp() - 1.0).abs() < 1e-2);
        assert_eq!(ln(1.0), 0.0);
        assert_eq!(ln(0.0), f64::MIN_POSITIVE.ln());
        assert_eq!(ln(-3.0), ln(0.0));
        assert!(ln(f64::NAN).is_nan());
        assert!(ln(f64::INFINITY).is_nan());
        assert!((ln(f64::MAX) / f64::MAX.ln() - 1.0).abs() < 1e-15);
    }

    #[test]
    fn powers_agree_with_the_standard_library() {
        for exponent in [-3.7, 0.687, 2.0] {
            let error = largest_error(
                |x| power(x, exponent),
                |x| x.powf(exponent),
                scattered(0.3, 1.0).chain(scattered(1e-6, 1e4)),
            );
            assert!(error < 1e-14, "{error} with exponent {exponent}");
        }
        assert!((log10(1e-5) + 5.0).abs() < 1e-14);
    }
}
