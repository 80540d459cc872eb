//! What a formula may be evaluated on: one double, or eight side by side.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Sub};

/// A real number as far as kernels need it. All operations are those of IEEE 754, never fused, so the
/// result does not depend on how many are done at once.
pub trait Number:
    Copy + Debug + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// Yes or no for every lane.
    type Mask: Copy;

    /// The same value in every lane.
    fn splat(value: f64) -> Self;
    fn sqrt(self) -> Self;
    /// The smaller of two numbers; `other` where either is not a number.
    fn min(self, other: Self) -> Self;
    /// The larger of two numbers; `other` where either is not a number.
    fn max(self, other: Self) -> Self;
    /// Where `self < other`.
    fn below(self, other: Self) -> Self::Mask;
    /// `yes` where the mask holds, `no` elsewhere.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// Whether the mask holds in any lane.
    fn any(mask: Self::Mask) -> bool;

    /// The number, or zero where it is negative.
    #[inline(always)]
    fn or_zero(self) -> Self {
        self.max(Self::splat(0.0))
    }

    /// The nearest whole number, halves to the even one; exact below 2⁵¹ in magnitude.
    #[inline(always)]
    fn round(self) -> Self {
        // Adding 3·2⁵¹ leaves no bits behind the point.
        let shift = Self::splat(6_755_399_441_055_744.0);
        (self + shift) - shift
    }
}

impl Number for f64 {
    type Mask = bool;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }

    // As the processors' own instructions do it.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        if self < other { self } else { other }
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if self > other { self } else { other }
    }

    #[inline(always)]
    fn below(self, other: Self) -> bool {
        self < other
    }

    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }

    #[inline(always)]
    fn any(mask: bool) -> bool {
        mask
    }
}
