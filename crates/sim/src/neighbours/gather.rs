//! Records of particles, and eight of them at a time turned into lanes.

use super::LANES;

/// Eight numbers of a particle, one cache line.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C, align(64))]
pub struct Record(pub [f64; 8]);

/// One number of each of eight particles.
pub type Lanes = [f64; LANES];

/// Eight records turned into eight lanes of each field.
#[inline(always)]
pub(crate) fn gather(records: &[Record], members: &[u32; LANES]) -> [Lanes; 8] {
    let mut fields = [[0.0; LANES]; 8];
    for (lane, &member) in members.iter().enumerate() {
        let record = &records[member as usize].0;
        for field in 0..8 {
            fields[field][lane] = record[field];
        }
    }
    fields
}

/// The same by whole cache lines: eight loads and an 8 × 8 transposition in registers.
#[cfg(target_arch = "x86_64")]
#[inline]
#[target_feature(enable = "avx512f,avx512dq,avx512vl")]
pub(crate) fn gather_avx512(records: &[Record], members: &[u32; LANES]) -> [Lanes; 8] {
    use std::arch::x86_64::*;
    // SAFETY: a record is 64 aligned bytes and the index is checked.
    let row = members.map(|member| unsafe { _mm512_load_pd(records[member as usize].0.as_ptr()) });
    let t0 = _mm512_unpacklo_pd(row[0], row[1]);
    let t1 = _mm512_unpackhi_pd(row[0], row[1]);
    let t2 = _mm512_unpacklo_pd(row[2], row[3]);
    let t3 = _mm512_unpackhi_pd(row[2], row[3]);
    let t4 = _mm512_unpacklo_pd(row[4], row[5]);
    let t5 = _mm512_unpackhi_pd(row[4], row[5]);
    let t6 = _mm512_unpacklo_pd(row[6], row[7]);
    let t7 = _mm512_unpackhi_pd(row[6], row[7]);
    let low = |a, b| _mm512_shuffle_f64x2::<0x88>(a, b);
    let high = |a, b| _mm512_shuffle_f64x2::<0xdd>(a, b);
    let (a0, a2) = (low(t0, t2), high(t0, t2));
    let (a1, a3) = (low(t1, t3), high(t1, t3));
    let (b0, b2) = (low(t4, t6), high(t4, t6));
    let (b1, b3) = (low(t5, t7), high(t5, t7));
    let columns = [
        low(a0, b0),
        low(a1, b1),
        low(a2, b2),
        low(a3, b3),
        high(a0, b0),
        high(a1, b1),
        high(a2, b2),
        high(a3, b3),
    ];
    columns.map(|column| {
        let mut lanes = [0.0; LANES];
        // SAFETY: eight doubles fit.
        unsafe { _mm512_storeu_pd(lanes.as_mut_ptr(), column) };
        lanes
    })
}
