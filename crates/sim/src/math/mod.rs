//! Vectors and the few numbers every room needs.

mod curve;
pub mod elementary;
mod number;
mod random;
mod vector;

pub use curve::along_curve;
pub use number::Number;
pub(crate) use number::bits;
pub use random::Random;
pub use vector::Vector;

/// A vector in SI units.
pub type Vec3 = nalgebra::Vector3<f64>;

/// Root of a rising function between `low` and `high`, by bisection to full precision.
///
/// The caller guarantees `f(low) ≤ 0 ≤ f(high)`; otherwise the nearer end is returned.
pub fn bisect(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if f(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_root_of_a_cubic_to_rounding() {
        let root = bisect(0.0, 10.0, |x| x * x * x - 2.0);
        assert!((root * root * root - 2.0).abs() < 1e-14);
    }
}
