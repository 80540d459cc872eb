//! Eight particles side by side, in the widest registers the machine has.
//!
//! The compiler finds these registers by itself on good days only, at a factor of two in speed, so
//! they are named here.

use std::ops::{Add, Div, Mul, Sub};

use super::LANES;
use crate::math::Number;
#[cfg(target_arch = "x86_64")]
use crate::math::bits;

/// Eight numbers of a particle, one cache line.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C, align(64))]
pub struct Record(pub [f64; 8]);

/// One number of each of eight particles.
pub trait Wide: Number {
    /// Eight records turned into eight lanes of each field.
    fn gather(records: &[Record], members: &[u32; LANES]) -> [Self; 8];
    fn from_lanes(lanes: [f64; LANES]) -> Self;
    fn lanes(self) -> [f64; LANES];
    /// Eight lanes of each field turned into eight records.
    fn records(fields: [Self; 8]) -> [Record; LANES];

    /// Sum of the lanes, always in the same order.
    #[inline(always)]
    fn total(self) -> f64 {
        self.lanes().iter().sum()
    }
}

/// Without registers of its own.
#[derive(Clone, Copy, Debug)]
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
    type Mask = [bool; LANES];

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Plain([value; LANES])
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Plain(self.0.map(f64::sqrt))
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Plain(std::array::from_fn(|lane| {
            Number::min(self.0[lane], other.0[lane])
        }))
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Plain(std::array::from_fn(|lane| {
            Number::max(self.0[lane], other.0[lane])
        }))
    }

    #[inline(always)]
    fn below(self, other: Self) -> [bool; LANES] {
        std::array::from_fn(|lane| self.0[lane] < other.0[lane])
    }

    #[inline(always)]
    fn select(mask: [bool; LANES], yes: Self, no: Self) -> Self {
        Plain(std::array::from_fn(|lane| {
            if mask[lane] { yes.0[lane] } else { no.0[lane] }
        }))
    }

    #[inline(always)]
    fn any(mask: [bool; LANES]) -> bool {
        mask.contains(&true)
    }

    #[inline(always)]
    fn split_exponent(self) -> (Self, Self) {
        (
            Plain(self.0.map(|lane| lane.split_exponent().0)),
            Plain(self.0.map(|lane| lane.split_exponent().1)),
        )
    }

    #[inline(always)]
    fn scaled_by_power_of_two(self, exponent: Self) -> Self {
        Plain(std::array::from_fn(|lane| {
            self.0[lane].scaled_by_power_of_two(exponent.0[lane])
        }))
    }
}

impl Wide for Plain {
    #[inline(always)]
    fn gather(records: &[Record], members: &[u32; LANES]) -> [Self; 8] {
        let rows = members.map(|member| &records[member as usize].0);
        std::array::from_fn(|field| Plain(rows.map(|row| row[field])))
    }

    #[inline(always)]
    fn from_lanes(lanes: [f64; LANES]) -> Self {
        Plain(lanes)
    }

    #[inline(always)]
    fn records(fields: [Self; 8]) -> [Record; LANES] {
        std::array::from_fn(|lane| Record(fields.map(|field| field.0[lane])))
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
    #[derive(Clone, Copy, Debug)]
    pub struct Avx2([__m256d; 2]);

    /// One register of AVX-512, under the same rule.
    #[derive(Clone, Copy, Debug)]
    #[repr(transparent)]
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
        type Mask = [__m256d; 2];

        #[inline(always)]
        fn splat(value: f64) -> Self {
            unsafe { Avx2([_mm256_set1_pd(value); 2]) }
        }

        #[inline(always)]
        fn sqrt(self) -> Self {
            unsafe { Avx2([_mm256_sqrt_pd(self.0[0]), _mm256_sqrt_pd(self.0[1])]) }
        }

        #[inline(always)]
        fn min(self, other: Self) -> Self {
            unsafe {
                Avx2([
                    _mm256_min_pd(self.0[0], other.0[0]),
                    _mm256_min_pd(self.0[1], other.0[1]),
                ])
            }
        }

        #[inline(always)]
        fn max(self, other: Self) -> Self {
            unsafe {
                Avx2([
                    _mm256_max_pd(self.0[0], other.0[0]),
                    _mm256_max_pd(self.0[1], other.0[1]),
                ])
            }
        }

        #[inline(always)]
        fn below(self, other: Self) -> [__m256d; 2] {
            unsafe {
                [
                    _mm256_cmp_pd::<_CMP_LT_OQ>(self.0[0], other.0[0]),
                    _mm256_cmp_pd::<_CMP_LT_OQ>(self.0[1], other.0[1]),
                ]
            }
        }

        #[inline(always)]
        fn select(mask: [__m256d; 2], yes: Self, no: Self) -> Self {
            unsafe {
                Avx2([
                    _mm256_blendv_pd(no.0[0], yes.0[0], mask[0]),
                    _mm256_blendv_pd(no.0[1], yes.0[1], mask[1]),
                ])
            }
        }

        #[inline(always)]
        fn any(mask: [__m256d; 2]) -> bool {
            unsafe { _mm256_movemask_pd(_mm256_or_pd(mask[0], mask[1])) != 0 }
        }

        #[inline(always)]
        fn split_exponent(self) -> (Self, Self) {
            let all = self.0.map(|half| unsafe {
                let to_one = _mm256_set1_epi64x(bits::TO_ONE as i64);
                _mm256_add_epi64(_mm256_castpd_si256(half), to_one)
            });
            let mantissa = all.map(|half| unsafe {
                let kept = _mm256_and_si256(half, _mm256_set1_epi64x(bits::MANTISSA as i64));
                let root_half = _mm256_set1_epi64x(bits::ROOT_HALF as i64);
                _mm256_castsi256_pd(_mm256_add_epi64(kept, root_half))
            });
            let exponent = all.map(|half| unsafe {
                let whole = _mm256_set1_epi64x(bits::WHOLE as i64);
                _mm256_castsi256_pd(_mm256_or_si256(_mm256_srli_epi64::<52>(half), whole))
            });
            (Avx2(mantissa), Avx2(exponent) - Self::splat(bits::SHIFT))
        }

        #[inline(always)]
        fn scaled_by_power_of_two(self, exponent: Self) -> Self {
            let shifted = exponent + Self::splat(bits::SHIFT);
            let power = shifted.0.map(|half| unsafe {
                _mm256_castsi256_pd(_mm256_slli_epi64::<52>(_mm256_castpd_si256(half)))
            });
            self * Avx2(power)
        }
    }

    /// Rows and columns of a square exchanged.
    #[inline(always)]
    fn turned_4(rows: [__m256d; 4]) -> [__m256d; 4] {
        let [r0, r1, r2, r3] = rows;
        unsafe {
            let (t0, t1) = (_mm256_unpacklo_pd(r0, r1), _mm256_unpackhi_pd(r0, r1));
            let (t2, t3) = (_mm256_unpacklo_pd(r2, r3), _mm256_unpackhi_pd(r2, r3));
            [
                _mm256_permute2f128_pd::<0x20>(t0, t2),
                _mm256_permute2f128_pd::<0x20>(t1, t3),
                _mm256_permute2f128_pd::<0x31>(t0, t2),
                _mm256_permute2f128_pd::<0x31>(t1, t3),
            ]
        }
    }

    /// Rows and columns of a square exchanged.
    #[inline(always)]
    fn turned_8(rows: [__m512d; 8]) -> [__m512d; 8] {
        let [r0, r1, r2, r3, r4, r5, r6, r7] = rows;
        unsafe {
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
                low!(a0, b0),
                low!(a1, b1),
                low!(a2, b2),
                low!(a3, b3),
                high!(a0, b0),
                high!(a1, b1),
                high!(a2, b2),
                high!(a3, b3),
            ]
        }
    }

    // Closures are not compiled with the instructions of their caller: lists are written out.
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
                    // SAFETY: half a record is 32 aligned bytes and its index is checked.
                    turned_4(unsafe { [row!(0), row!(1), row!(2), row!(3)] })
                }};
            }
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

        #[inline(always)]
        fn from_lanes(lanes: [f64; LANES]) -> Self {
            // SAFETY: both are eight doubles.
            Avx2(unsafe { std::mem::transmute::<[f64; LANES], [__m256d; 2]>(lanes) })
        }

        #[inline(always)]
        fn records(fields: [Self; 8]) -> [Record; LANES] {
            macro_rules! square {
                ($half:literal, $field:literal) => {
                    turned_4([
                        fields[$field].0[$half],
                        fields[$field + 1].0[$half],
                        fields[$field + 2].0[$half],
                        fields[$field + 3].0[$half],
                    ])
                };
            }
            let (a, b) = (square!(0, 0), square!(0, 4));
            let (c, d) = (square!(1, 0), square!(1, 4));
            // SAFETY: both are eight times eight doubles.
            unsafe {
                std::mem::transmute::<[[__m256d; 2]; 8], [Record; LANES]>([
                    [a[0], b[0]],
                    [a[1], b[1]],
                    [a[2], b[2]],
                    [a[3], b[3]],
                    [c[0], d[0]],
                    [c[1], d[1]],
                    [c[2], d[2]],
                    [c[3], d[3]],
                ])
            }
        }

        #[inline(always)]
        fn lanes(self) -> [f64; LANES] {
            // SAFETY: both are eight doubles.
            unsafe { std::mem::transmute(self.0) }
        }
    }

    impl Number for Avx512 {
        type Mask = __mmask8;

        #[inline(always)]
        fn splat(value: f64) -> Self {
            unsafe { Avx512(_mm512_set1_pd(value)) }
        }

        #[inline(always)]
        fn sqrt(self) -> Self {
            unsafe { Avx512(_mm512_sqrt_pd(self.0)) }
        }

        #[inline(always)]
        fn min(self, other: Self) -> Self {
            unsafe { Avx512(_mm512_min_pd(self.0, other.0)) }
        }

        #[inline(always)]
        fn max(self, other: Self) -> Self {
            unsafe { Avx512(_mm512_max_pd(self.0, other.0)) }
        }

        #[inline(always)]
        fn below(self, other: Self) -> __mmask8 {
            unsafe { _mm512_cmp_pd_mask::<_CMP_LT_OQ>(self.0, other.0) }
        }

        #[inline(always)]
        fn select(mask: __mmask8, yes: Self, no: Self) -> Self {
            unsafe { Avx512(_mm512_mask_blend_pd(mask, no.0, yes.0)) }
        }

        #[inline(always)]
        fn any(mask: __mmask8) -> bool {
            mask != 0
        }

        #[inline(always)]
        fn split_exponent(self) -> (Self, Self) {
            unsafe {
                let to_one = _mm512_set1_epi64(bits::TO_ONE as i64);
                let all = _mm512_add_epi64(_mm512_castpd_si512(self.0), to_one);
                let kept = _mm512_and_si512(all, _mm512_set1_epi64(bits::MANTISSA as i64));
                let mantissa = _mm512_add_epi64(kept, _mm512_set1_epi64(bits::ROOT_HALF as i64));
                let whole = _mm512_set1_epi64(bits::WHOLE as i64);
                let exponent = _mm512_or_si512(_mm512_srli_epi64::<52>(all), whole);
                (
                    Avx512(_mm512_castsi512_pd(mantissa)),
                    Avx512(_mm512_castsi512_pd(exponent)) - Self::splat(bits::SHIFT),
                )
            }
        }

        #[inline(always)]
        fn scaled_by_power_of_two(self, exponent: Self) -> Self {
            let shifted = exponent + Self::splat(bits::SHIFT);
            let power =
                unsafe { _mm512_castsi512_pd(_mm512_slli_epi64::<52>(_mm512_castpd_si512(shifted.0))) };
            self * Avx512(power)
        }
    }

    impl Wide for Avx512 {
        /// Eight whole cache lines and an 8 × 8 transposition in registers.
        #[inline(always)]
        fn gather(records: &[Record], members: &[u32; LANES]) -> [Self; 8] {
            macro_rules! row {
                ($i:literal) => {
                    _mm512_load_pd(records[members[$i] as usize].0.as_ptr())
                };
            }
            // SAFETY: a record is 64 aligned bytes and its index is checked; both are eight registers.
            unsafe {
                let rows = [
                    row!(0),
                    row!(1),
                    row!(2),
                    row!(3),
                    row!(4),
                    row!(5),
                    row!(6),
                    row!(7),
                ];
                std::mem::transmute::<[__m512d; 8], [Avx512; 8]>(turned_8(rows))
            }
        }

        #[inline(always)]
        fn from_lanes(lanes: [f64; LANES]) -> Self {
            // SAFETY: both are eight doubles.
            Avx512(unsafe { std::mem::transmute::<[f64; LANES], __m512d>(lanes) })
        }

        #[inline(always)]
        fn records(fields: [Self; 8]) -> [Record; LANES] {
            // SAFETY: all are eight times eight doubles.
            unsafe {
                let rows = turned_8(std::mem::transmute::<[Avx512; 8], [__m512d; 8]>(fields));
                std::mem::transmute::<[__m512d; 8], [Record; LANES]>(rows)
            }
        }

        #[inline(always)]
        fn lanes(self) -> [f64; LANES] {
            // SAFETY: both are eight doubles.
            unsafe { std::mem::transmute(self.0) }
        }
    }
}

/// Asks for a record that will be needed soon; the machine may ignore it.
#[inline(always)]
pub fn prefetch(records: &[Record], member: u32) {
    #[cfg(target_arch = "x86_64")]
    if let Some(record) = records.get(member as usize) {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        // SAFETY: a prefetch of any address is harmless, and the instruction is in the baseline.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(std::ptr::from_ref(record).cast()) };
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (records, member);
}

/// Work written once and compiled for each kind of register.
pub trait WideWork {
    type Output;

    /// Must be `#[inline(always)]`, to be compiled with the instructions of its caller.
    fn run<W: Wide>(self) -> Self::Output;
}

/// Does the work in the widest registers the machine has.
pub fn in_widest<J: WideWork>(work: J) -> J::Output {
    #[cfg(target_arch = "x86_64")]
    {
        if is_x86_feature_detected!("avx512f")
            && is_x86_feature_detected!("avx512dq")
            && is_x86_feature_detected!("avx512vl")
        {
            // SAFETY: the features were just detected.
            return unsafe { in_avx512(work) };
        }
        if is_x86_feature_detected!("avx2") {
            // SAFETY: the feature was just detected.
            return unsafe { in_avx2(work) };
        }
    }
    work.run::<Plain>()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl")]
fn in_avx512<J: WideWork>(work: J) -> J::Output {
    work.run::<Avx512>()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn in_avx2<J: WideWork>(work: J) -> J::Output {
    work.run::<Avx2>()
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
        let smaller = a.below(b);
        numbers.extend(W::select(smaller, a.min(b), mixed.max(b)).lanes());
        numbers.extend(mixed.round().lanes());
        numbers.push(if W::any(smaller) { 1.0 } else { 0.0 });
        numbers.extend(W::from_lanes(a.lanes()).lanes());
        numbers.extend(W::records(fields).iter().flat_map(|record| record.0));
        numbers
    }

    /// Exponentials and logarithms, the ends of their range among them.
    fn elementary<W: Wide>() -> Vec<u64> {
        use crate::math::elementary::{exp, ln, power};
        let mut values = vec![0.0, 1e-310, f64::INFINITY, f64::NAN, -5.0, 1.0, 800.0, -800.0];
        values.extend((0..4096).map(|i| (f64::from(i) * 0.618_033_988_749_894_9).fract() * 1400.0 - 700.0));
        let (groups, _) = values.as_chunks::<LANES>();
        let mut numbers = Vec::new();
        for &lanes in groups {
            let x = W::from_lanes(lanes);
            numbers.extend(exp(x).lanes());
            numbers.extend(ln(x).lanes());
            let raised = power(x * x, W::splat(-0.3)).lanes();
            numbers.extend(raised);
            assert_eq!(
                raised.map(f64::to_bits),
                lanes.map(|x| power(x * x, -0.3).to_bits())
            );
        }
        numbers.iter().map(|number| number.to_bits()).collect()
    }

    #[test]
    fn elementary_functions_have_the_same_bits_on_all_registers() {
        let plain = elementary::<Plain>();
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx2") {
                assert!(elementary::<Avx2>() == plain);
            }
            if is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq") {
                assert!(elementary::<Avx512>() == plain);
            }
        }
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
