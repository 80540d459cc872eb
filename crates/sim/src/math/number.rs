//! What a formula may be evaluated on: one double, or eight side by side.

use std::ops::{Add, Div, Mul, Sub};

/// A real number as far as kernels need it. All operations are those of IEEE 754, never fused, so the
/// result does not depend on how many are done at once.
pub trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// The same value in every lane.
    fn splat(value: f64) -> Self;
    /// The number, or zero where it is negative.
    fn or_zero(self) -> Self;
    fn sqrt(self) -> Self;
}

impl Number for f64 {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn or_zero(self) -> Self {
        self.max(0.0)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }
}
