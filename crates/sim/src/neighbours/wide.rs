//! Eight particles side by side, in the widest registers the machine has.
//!
//! The compiler finds these registers by itself on good days only, at a factor of two in speed, so
//! they are named here.

use std::ops::{Add, Div, Mul, Sub};

use super::LANES;
use crate::math::Number;

/// Eight numbers of a particle, one cache line.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C, align(64))]
pub struct Record(pub [f64; 8]);

/// One number of each of eight particles.
pub trait Wide: Number {
    /// Eight records turned into eight lanes of each field.
    fn gather(records: &[Record], members: &[u32; LANES]) -> [Self; 8];
    fn lanes(self) -> [f64; LANES];

    /// Sum of the lanes, always in the same order.
    #[inline(always)]
    fn total(self) -> f64 {
        self.lanes().iter().sum()
    }
}

/// Without registers of its own.
#[derive(Clone, Copy)]
pub struct Plain([f64; LANES]);

macro_rules! plain_operator {
    ($operator:ident, $function:ident) => {
        impl $operator for Plain {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Plain(std::array::from_fn(|lane| {
                    $operator::$function(self.0[lane], other.0[lane])
                }))
            }
        }
    };
}
plain_operator!(Add, add);
plain_operator!(Sub, sub);
plain_operator!(Mul, mul);
plain_operator!(Div, div);

impl Number for Plain {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Plain([value; LANES])
    }

    #[inline(always)]
    fn or_zero(self) -> Self {
        Plain(self.0.map(|x| x.max(0.0)))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Plain(self.0.map(f64::sqrt))
    }
}

impl Wide for Plain {
    #[inline(always)]
    fn gather(records: &[Record], members: &[u32; LANES]) -> [Self; 8] {
        let rows = members.map(|member| &records[member as usize].0);
        std::array::from_fn(|field| Plain(rows.map(|row| row[field])))
    }

    #[inline(always)]
    fn lanes(self) -> [f64; LANES] {
        self.0
    }
}

#[cfg(target_arch = "x86_64")]
pub use x86::{Avx2, Avx512};

#[cfg(target_arch = "x86_64")]
mod x86 {
    use std::arch::x86_64::*;

    use super::*;

    /// Two registers of AVX2. Made only in functions compiled for it, behind a check that it is there.
    #[derive(Clone, Copy)]
    pub struct Avx2([__m256d; 2]);

    /// One register of AVX-512, under the same rule.
    #[derive(Clone, Copy)]
    pub struct Avx512(__m512d);

    macro_rules! operator {
        ($operator:ident, $function:ident, $half:ident, $whole:ident) => {
            impl $operator for Avx2 {
                type Output = Self;

                #[inline(always)]
                fn $function(self, other: Self) -> Self {
                    // SAFETY: a value exists only where the feature was detected.
                    unsafe { Avx2([$half(self.0[0], other.0[0]), $half(self.0[1], other.0[1])]) }
                }
            }

            impl $operator for Avx512 {
                type Output = Self;

                #[inline(always)]
                fn $function(self, other: Self) -> Self {
                    // SAFETY: a value exists only where the feature was detected.
                    unsafe { Avx512($whole(self.0, other.0)) }
                }
            }
        };
    }
    operator!(Add, add, _mm256_add_pd, _mm512_add_pd);
    operator!(Sub, sub, _mm256_sub_pd, _mm512_sub_pd);
    operator!(Mul, mul, _mm256_mul_pd, _mm512_mul_pd);
    operator!(Div, div, _mm256_div_pd, _mm512_div_pd);

    // SAFETY of all blocks below: called only where the feature was detected.
    impl Number for Avx2 {
        #[inline(always)]
        fn splat(value: f64) -> Self {
            unsafe { Avx2([_mm256_set1_pd(value); 2]) }
        }

        #[inline(always)]
        fn or_zero(self) -> Self {
            unsafe {
                let zero = _mm256_setzero_pd();
                Avx2([_mm256_max_pd(self.0[0], zero), _mm256_max_pd(self.0[1], zero)])
            }
        }

        #[inline(always)]
        fn sqrt(self) -> Self {
            unsafe { Avx2([_mm256_sqrt_pd(self.0[0]), _mm256_sqrt_pd(self.0[1])]) }
        }
    }

    impl Wide for Avx2 {
        #[inline(always)]
        fn gather(records: &[Record], members: &[u32; LANES]) -> [Self; 8] {
            // A square of four fields of four particles at a time.
            macro_rules! square {
                ($particle:literal, $field:literal) => {{
                    macro_rules! row {
                        ($i:literal) => {
                            _mm256_load_pd(
                                records[members[$particle + $i] as usize].0[$field..$field + 4].as_ptr(),
                            )
                        };
                    }
                    let (r0, r1, r2, r3) = (row!(0), row!(1), row!(2), row!(3));
                    let (t0, t1) = (_mm256_unpacklo_pd(r0, r1), _mm256_unpackhi_pd(r0, r1));
                    let (t2, t3) = (_mm256_unpacklo_pd(r2, r3), _mm256_unpackhi_pd(r2, r3));
                    [
                        _mm256_permute2f128_pd::<0x20>(t0, t2),
                        _mm256_permute2f128_pd::<0x20>(t1, t3),
                        _mm256_permute2f128_pd::<0x31>(t0, t2),
                        _mm256_permute2f128_pd::<0x31>(t1, t3),
                    ]
                }};
            }
            // SAFETY: half a record is 32 aligned bytes and its index is checked.
            unsafe {
                let (a, b) = (square!(0, 0), square!(4, 0));
                let (c, d) = (square!(0, 4), square!(4, 4));
                [
                    Avx2([a[0], b[0]]),
                    Avx2([a[1], b[1]]),
                    Avx2([a[2], b[2]]),
                    Avx2([a[3], b[3]]),
                    Avx2([c[0], d[0]]),
                    Avx2([c[1], d[1]]),
                    Avx2([c[2], d[2]]),
                    Avx2([c[3], d[3]]),
                ]
            }
        }

        #[inline(always)]
        fn lanes(self) -> [f64; LANES] {
            // SAFETY: both are eight doubles.
            unsafe { std::mem::transmute(self.0) }
        }
    }

    impl Number for Avx512 {
        #[inline(always)]
        fn splat(value: f64) -> Self {
            unsafe { Avx512(_mm512_set1_pd(value)) }
        }

        #[inline(always)]
        fn or_zero(self) -> Self {
            unsafe { Avx512(_mm512_max_pd(self.0, _mm512_setzero_pd())) }
        }

        #[inline(always)]
        fn sqrt(self) -> Self {
            unsafe { Avx512(_mm512_sqrt_pd(self.0)) }
        }
    }

    impl Wide for Avx512 {
        /// Eight whole cache lines and an 8 × 8 transposition in registers.
        #[inline(always)]
        fn gather(records: &[Record], members: &[u32; LANES]) -> [Self; 8] {
            // SAFETY: a record is 64 aligned bytes and its index is checked.
            unsafe {
                macro_rules! row {
                    ($i:literal) => {
                        _mm512_load_pd(records[members[$i] as usize].0.as_ptr())
                    };
                }
                let (r0, r1, r2, r3) = (row!(0), row!(1), row!(2), row!(3));
                let (r4, r5, r6, r7) = (row!(4), row!(5), row!(6), row!(7));
                let (t0, t1) = (_mm512_unpacklo_pd(r0, r1), _mm512_unpackhi_pd(r0, r1));
                let (t2, t3) = (_mm512_unpacklo_pd(r2, r3), _mm512_unpackhi_pd(r2, r3));
                let (t4, t5) = (_mm512_unpacklo_pd(r4, r5), _mm512_unpackhi_pd(r4, r5));
                let (t6, t7) = (_mm512_unpacklo_pd(r6, r7), _mm512_unpackhi_pd(r6, r7));
                macro_rules! low {
                    ($a:expr, $b:expr) => {
                        _mm512_shuffle_f64x2::<0x88>($a, $b)
                    };
                }
                macro_rules! high {
                    ($a:expr, $b:expr) => {
                        _mm512_shuffle_f64x2::<0xdd>($a, $b)
                    };
                }
                let (a0, a1, a2, a3) = (low!(t0, t2), low!(t1, t3), high!(t0, t2), high!(t1, t3));
                let (b0, b1, b2, b3) = (low!(t4, t6), low!(t5, t7), high!(t4, t6), high!(t5, t7));
                [
                    Avx512(low!(a0, b0)),
                    Avx512(low!(a1, b1)),
                    Avx512(low!(a2, b2)),
                    Avx512(low!(a3, b3)),
                    Avx512(high!(a0, b0)),
                    Avx512(high!(a1, b1)),
                    Avx512(high!(a2, b2)),
                    Avx512(high!(a3, b3)),
                ]
            }
        }

        #[inline(always)]
        fn lanes(self) -> [f64; LANES] {
            // SAFETY: both are eight doubles.
            unsafe { std::mem::transmute(self.0) }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every operation once, on records that share no value.
    fn exercise<W: Wide>() -> Vec<f64> {
        let records: Vec<Record> = (0..20)
            .map(|i| Record(std::array::from_fn(|field| (i * 8 + field) as f64 * 0.37 - 20.0)))
            .collect();
        let fields = W::gather(&records, &[3, 19, 0, 7, 7, 11, 2, 5]);
        let mut numbers: Vec<f64> = fields.iter().flat_map(|field| field.lanes()).collect();
        let [a, b, ..] = fields;
        let mixed = (a + b) * a - b / (a * a + W::splat(1.0));
        numbers.extend(mixed.or_zero().sqrt().lanes());
        numbers.push(mixed.total());
        numbers
    }

    #[test]
    fn all_registers_give_the_same_bits() {
        let plain = exercise::<Plain>();
        assert_eq!(plain[..3], [24.0 * 0.37 - 20.0, 152.0 * 0.37 - 20.0, -20.0]);
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx2") {
                assert_eq!(exercise::<Avx2>(), plain);
            }
            if is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq") {
                assert_eq!(exercise::<Avx512>(), plain);
            }
        }
    }
}
