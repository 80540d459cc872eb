//! Sparse rows of weights between grains and fluid particles.
//!
//! Weights are kept in single precision with a norm in double precision beside each row: the rows are
//! read twice a step and are larger than the caches. What a grain gives and what the fluid gets are the
//! same products, so their balance closes to double precision all the same.
//!
//! Every sum runs over lanes that are kept apart until its end, so it gives the same bits on every
//! instruction set.

use super::Field;
use crate::neighbours::{Wide, WideWork};

/// Pairs of a row summed side by side.
const ABREAST: usize = 4;

/// For each grain the fluid particles around it and their weights.
#[derive(Default)]
pub struct Weights {
    starts: Vec<u32>,
    sources: Vec<u32>,
    weights: Vec<f32>,
    /// What makes the weights of a row shares, which sum to one.
    per_norm: Vec<f64>,
    /// Members of the row being written.
    open: usize,
}

impl Weights {
    /// Forgets all rows; `room` bounds the members to come.
    pub fn clear(&mut self, room: usize) {
        self.starts.clear();
        self.starts.push(0);
        self.per_norm.clear();
        self.sources.resize(room, 0);
        self.weights.resize(room, 0.0);
        self.open = 0;
    }

    /// Writes a member of the open row; it stays only when `inside`, without a branch on it.
    #[inline(always)]
    pub fn offer(&mut self, source: u32, weight: f64, inside: bool) {
        self.sources[self.open] = source;
        self.weights[self.open] = weight as f32;
        self.open += inside as usize;
    }

    /// Ends the open row.
    #[inline(always)]
    pub fn close(&mut self) {
        let first = self.starts[self.starts.len() - 1] as usize;
        let mut norm = 0.0;
        for weight in &self.weights[first..self.open] {
            norm += f64::from(*weight);
        }
        self.per_norm.push(1.0 / norm);
        self.starts.push(self.open as u32);
    }

    /// Members of all rows.
    pub fn members(&self) -> usize {
        self.open
    }

    /// Members of a row and their shares.
    pub fn row(&self, row: usize) -> impl Iterator<Item = (u32, f64)> + '_ {
        let (sources, weights) = self.members_of(row);
        let per_norm = self.per_norm[row];
        sources
            .iter()
            .zip(weights)
            .map(move |(source, weight)| (*source, f64::from(*weight) * per_norm))
    }

    #[inline(always)]
    fn members_of(&self, row: usize) -> (&[u32], &[f32]) {
        let range = self.starts[row] as usize..self.starts[row + 1] as usize;
        (&self.sources[range.clone()], &self.weights[range])
    }
}

/// Weighted means of a field, one for every row.
pub struct Sample<'a> {
    pub weights: &'a Weights,
    pub fields: &'a [Field],
    /// Where the mean of each row belongs.
    pub order: &'a [u32],
    pub means: &'a mut [Field],
}

impl WideWork for Sample<'_> {
    type Output = ();

    #[inline(always)]
    fn run<W: Wide>(self) {
        for (row, &grain) in self.order.iter().enumerate() {
            let (sources, weights) = self.weights.members_of(row);
            let mut sums = [W::splat(0.0); ABREAST];
            let (sources, last_sources) = sources.as_chunks::<ABREAST>();
            let (weights, last_weights) = weights.as_chunks::<ABREAST>();
            for (sources, weights) in sources.iter().zip(weights) {
                for lane in 0..ABREAST {
                    let field = W::from_lanes(self.fields[sources[lane] as usize].0);
                    sums[lane] = sums[lane] + W::splat(f64::from(weights[lane])) * field;
                }
            }
            for (source, weight) in last_sources.iter().zip(last_weights) {
                let field = W::from_lanes(self.fields[*source as usize].0);
                sums[0] = sums[0] + W::splat(f64::from(*weight)) * field;
            }
            let sum = (sums[0] + sums[1]) + (sums[2] + sums[3]);
            let mean = sum * W::splat(self.weights.per_norm[row]);
            self.means[grain as usize] = Field(mean.lanes());
        }
    }
}

/// Adds four numbers of every grain, such as an impulse [N s], to the sums of the fluid particles around.
pub struct Spread<'a> {
    pub weights: &'a Weights,
    /// Whose numbers each row spreads.
    pub order: &'a [u32],
    pub given: &'a [[f64; 4]],
    pub sums: &'a mut [[f64; 4]],
}

impl WideWork for Spread<'_> {
    type Output = ();

    #[inline(always)]
    fn run<W: Wide>(self) {
        for (row, &grain) in self.order.iter().enumerate() {
            let per_norm = self.weights.per_norm[row];
            let [x, y, z, other] = self.given[grain as usize];
            let given = [x * per_norm, y * per_norm, z * per_norm, other * per_norm];
            let (sources, weights) = self.weights.members_of(row);
            for (source, weight) in sources.iter().zip(weights) {
                let weight = f64::from(*weight);
                let sum = &mut self.sums[*source as usize];
                for part in 0..4 {
                    sum[part] += weight * given[part];
                }
            }
        }
    }
}
