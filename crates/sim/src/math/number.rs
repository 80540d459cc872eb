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

    /// A positive number at or above 2.2e-308 as (m, e) with m 2^e, √½ ≤ m < √2, e whole.
    fn split_exponent(self) -> (Self, Self);
    /// The number times 2^`exponent`, a whole number from −1022 to 1023; zero at −1023 and infinite
    /// at 1024.
    fn scaled_by_power_of_two(self, exponent: Self) -> Self;

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

/// How a double holds its exponent and mantissa, for those who reach into its bits.
pub(crate) mod bits {
    /// Bits of the mantissa.
    pub const MANTISSA: u64 = (1 << 52) - 1;
    /// Bits of √½, and how far they are from those of 1: with so much added, the exponent field
    /// changes at √½ times the powers of two.
    pub const ROOT_HALF: u64 = 0x3fe6_a09e_667f_3bcd;
    pub const TO_ONE: u64 = 0x3ff0_0000_0000_0000 - ROOT_HALF;
    /// Bits of 2⁵²: whole numbers up to there stand in the mantissa as they are.
    pub const WHOLE: u64 = 0x4330_0000_0000_0000;
    /// 2⁵² plus what is added to every exponent: 1023.
    pub const SHIFT: f64 = 4_503_599_627_370_496.0 + 1023.0;
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

    #[inline(always)]
    fn split_exponent(self) -> (Self, Self) {
        let all = self.to_bits().wrapping_add(bits::TO_ONE);
        (
            f64::from_bits((all & bits::MANTISSA) + bits::ROOT_HALF),
            f64::from_bits(all >> 52 | bits::WHOLE) - bits::SHIFT,
        )
    }

    #[inline(always)]
    fn scaled_by_power_of_two(self, exponent: Self) -> Self {
        self * f64::from_bits((exponent + bits::SHIFT).to_bits() << 52)
    }
}
