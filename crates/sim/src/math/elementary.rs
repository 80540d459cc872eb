//! Exponential and logarithm from the operations of [`Number`] alone, so that one grain and eight
//! side by side get the same bits on every machine.
//!
//! Both split off a power of two and take a polynomial of what is left. Errors against the exact value are
//! under 1e-15 of it.

use std::f64::consts::LOG2_E;

use super::Number;

/// ln 2 in two parts; the first ends in zeros, so that whole multiples of it are exact.
const LN_2_HEAD: f64 = 6.931_471_803_691_238e-1;
const LN_2_TAIL: f64 = 1.908_214_929_270_587_7e-10;

/// e^x. Zero under −709, infinite over 709.5, not a number where x is none.
#[inline(always)]
pub fn exp<N: Number>(x: N) -> N {
    // The argument goes second: this minimum and maximum return the second where one is no number.
    let x = N::splat(-709.0).max(x);
    let x = N::splat(709.7).min(x);
    let twos = (x * N::splat(LOG2_E)).round();
    let rest = x - twos * N::splat(LN_2_HEAD) - twos * N::splat(LN_2_TAIL);
    exp_near_zero(rest).scaled_by_power_of_two(twos)
}

/// Natural logarithm of a positive number. At zero, below it and under 2.2e-308 it is held at −708.4;
/// not a number where x is infinite or none.
#[inline(always)]
pub fn ln<N: Number>(x: N) -> N {
    let (mantissa, twos) = N::splat(f64::MIN_POSITIVE).max(x).split_exponent();
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

/// e^x = 1 + x + x² P(x) for |x| ≤ ln 2 / 2, to 2e-17.
#[inline(always)]
fn exp_near_zero<N: Number>(x: N) -> N {
    /// P meets the function at the nodes of Chebyshev's polynomial of tenth degree.
    const P: [f64; 10] = [
        0.5000000000000001,
        0.16666666666666669,
        0.04166666666662413,
        0.008333333333330062,
        0.0013888888917213717,
        0.00019841269863053618,
        2.4801521295954376e-5,
        2.7557268459997064e-6,
        2.7620088445409746e-7,
        2.510038549551032e-8,
    ];
    let square = x * x;
    let fourth = square * square;
    let high = quartet(&P[4..8], x, square) + pair(&P[8..], x) * fourth;
    let series = quartet(&P[..4], x, square) + high * fourth;
    N::splat(1.0) + (x + square * series)
}

/// ln m = 2 artanh s = 2 s + s³ P(s²), s = (m − 1)/(m + 1), for m between √½ and √2, to 5e-18.
#[inline(always)]
fn ln_near_one<N: Number>(mantissa: N) -> N {
    /// P meets the function at the nodes of Chebyshev's polynomial of seventh degree.
    const P: [f64; 7] = [
        0.666666666666667,
        0.39999999999899444,
        0.2857142862600327,
        0.22222211130259878,
        0.18182889455674947,
        0.15331710618210773,
        0.14616585424888623,
    ];
    let one = N::splat(1.0);
    let s = (mantissa - one) / (mantissa + one);
    let x = s * s;
    let square = x * x;
    let high = pair(&P[4..6], x) + N::splat(P[6]) * square;
    let series = quartet(&P[..4], x, square) + high * (square * square);
    (s + s) + s * x * series
}

// Pairs first: one long chain of sums would wait for itself.

#[inline(always)]
fn quartet<N: Number>(c: &[f64], x: N, square: N) -> N {
    pair(&c[..2], x) + pair(&c[2..], x) * square
}

#[inline(always)]
fn pair<N: Number>(c: &[f64], x: N) -> N {
    N::splat(c[0]) + N::splat(c[1]) * x
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
        for (low, high) in [(-708.0, 709.4), (-2.0, 2.0), (-1e-3, 1e-3)] {
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
        // The last power of two before zero, and the last before infinity.
        for x in [-708.5, 709.4] {
            assert!((exp(x) / x.exp() - 1.0).abs() < 1e-14);
        }
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
