//! Sparse rows of weights between grains and fluid particles.
//!
//! Every sum runs over lanes that are kept apart until its end, so it gives the same bits on every
//! instruction set.

use super::Field;

/// Pairs of a row summed side by side.
const ABREAST: usize = 4;

/// For each grain the fluid particles around it and their shares, which sum to one.
#[derive(Default)]
pub struct Weights {
    starts: Vec<u32>,
    sources: Vec<u32>,
    shares: Vec<f64>,
    /// Members of the row being written.
    open: usize,
}

impl Weights {
    /// Forgets all rows; `room` bounds the members to come.
    pub fn clear(&mut self, room: usize) {
        self.starts.clear();
        self.starts.push(0);
        self.sources.resize(room, 0);
        self.shares.resize(room, 0.0);
        self.open = 0;
    }

    /// Writes a member of the open row; it stays only when `inside`, without a branch on it.
    #[inline(always)]
    pub fn offer(&mut self, source: u32, share: f64, inside: bool) {
        self.sources[self.open] = source;
        self.shares[self.open] = share;
        self.open += inside as usize;
    }

    /// Ends the open row whose shares sum to `norm`, and divides them by it.
    #[inline(always)]
    pub fn close(&mut self, norm: f64) {
        let first = self.starts[self.starts.len() - 1] as usize;
        let per_norm = 1.0 / norm;
        self.shares[first..self.open]
            .iter_mut()
            .for_each(|share| *share *= per_norm);
        self.starts.push(self.open as u32);
    }

    /// Members of all rows.
    pub fn members(&self) -> usize {
        self.open
    }

    /// Members of a grain's row and their shares.
    #[inline(always)]
    pub fn row(&self, grain: usize) -> (&[u32], &[f64]) {
        let range = self.starts[grain] as usize..self.starts[grain + 1] as usize;
        (&self.sources[range.clone()], &self.shares[range])
    }

    /// Weighted mean of a field around a grain.
    pub fn sample(&self, grain: usize, fields: &[Field]) -> Field {
        let (sources, shares) = self.row(grain);
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx512f") {
                // SAFETY: the feature was just detected.
                return unsafe { mean_avx512(sources, shares, fields) };
            }
            if is_x86_feature_detected!("avx2") {
                // SAFETY: the feature was just detected.
                return unsafe { mean_avx2(sources, shares, fields) };
            }
        }
        mean(sources, shares, fields)
    }

    /// Adds four sums of a grain to those of the fluid particles around it.
    pub fn spread(&self, grain: usize, impulse: [f64; 4], impulses: &mut [[f64; 4]]) {
        let (sources, shares) = self.row(grain);
        #[cfg(target_arch = "x86_64")]
        if is_x86_feature_detected!("avx2") {
            // SAFETY: the feature was just detected.
            return unsafe { scatter_avx2(sources, shares, impulse, impulses) };
        }
        scatter(sources, shares, impulse, impulses);
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl")]
fn mean_avx512(sources: &[u32], shares: &[f64], fields: &[Field]) -> Field {
    mean(sources, shares, fields)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn mean_avx2(sources: &[u32], shares: &[f64], fields: &[Field]) -> Field {
    mean(sources, shares, fields)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn scatter_avx2(sources: &[u32], shares: &[f64], impulse: [f64; 4], impulses: &mut [[f64; 4]]) {
    scatter(sources, shares, impulse, impulses);
}

#[inline(always)]
fn mean(sources: &[u32], shares: &[f64], fields: &[Field]) -> Field {
    let mut sums = [[0.0; 8]; ABREAST];
    let (sources, last_sources) = sources.as_chunks::<ABREAST>();
    let (shares, last_shares) = shares.as_chunks::<ABREAST>();
    for (sources, shares) in sources.iter().zip(shares) {
        for lane in 0..ABREAST {
            let field = &fields[sources[lane] as usize].0;
            for (sum, value) in sums[lane].iter_mut().zip(field) {
                *sum += shares[lane] * value;
            }
        }
    }
    for (source, share) in last_sources.iter().zip(last_shares) {
        for (sum, value) in sums[0].iter_mut().zip(&fields[*source as usize].0) {
            *sum += share * value;
        }
    }
    let mut mean = [0.0; 8];
    for (i, mean) in mean.iter_mut().enumerate() {
        *mean = (sums[0][i] + sums[1][i]) + (sums[2][i] + sums[3][i]);
    }
    Field(mean)
}

#[inline(always)]
fn scatter(sources: &[u32], shares: &[f64], impulse: [f64; 4], impulses: &mut [[f64; 4]]) {
    for (source, share) in sources.iter().zip(shares) {
        for (sum, value) in impulses[*source as usize].iter_mut().zip(&impulse) {
            *sum += share * value;
        }
    }
}
