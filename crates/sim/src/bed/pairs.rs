//! The pairs that may touch soon, in blocks of eight, and what their contacts remember.

use crate::math::Vector;
use crate::neighbours::{LANES, Period, Search, visit_near_pairs};

use super::grains::Grains;

/// One number for each of eight pairs.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C, align(64))]
pub struct Eight(pub [f64; LANES]);

/// Eight pairs.
#[derive(Clone, Copy, Debug)]
pub struct Block {
    /// Places of the first and of the second grains (of the walls, in a list of walls).
    pub members: [[u32; LANES]; 2],
}

/// Tangential displacement ξ of eight contacts [m].
#[derive(Clone, Copy, Debug, Default)]
pub struct History(pub [Eight; 3]);

impl History {
    fn lane(&self, lane: usize) -> Vector<f64> {
        Vector::new(self.0[0].0[lane], self.0[1].0[lane], self.0[2].0[lane])
    }

    fn set(&mut self, lane: usize, vector: Vector<f64>) {
        for (axis, value) in [vector.x, vector.y, vector.z].into_iter().enumerate() {
            self.0[axis].0[lane] = value;
        }
    }
}

/// Blocks of pairs with their histories.
#[derive(Clone, Debug, Default)]
pub struct PairList {
    pub blocks: Vec<Block>,
    pub histories: Vec<History>,
    /// Whether a block remembers anything.
    pub live: Vec<bool>,
    /// Pairs without the filling of the last block.
    pub count: usize,
}

impl PairList {
    /// Blocks of the pairs, those that touch now first: blocks in which nobody touches are passed over.
    /// Lanes left over hold `filling`, a pair that never touches.
    pub fn new(mut pairs: Vec<(u32, u32)>, touching: impl Fn(u32, u32) -> bool, filling: [u32; 2]) -> Self {
        let count = pairs.len();
        // A stable partition: the order within both parts is kept.
        let (mut near, apart): (Vec<_>, Vec<_>) = pairs.drain(..).partition(|&(i, j)| touching(i, j));
        near.extend(apart);
        let blocks: Vec<Block> = near
            .chunks(LANES)
            .map(|chunk| Block {
                members: [0, 1].map(|end| {
                    std::array::from_fn(|lane| {
                        chunk.get(lane).map_or(filling[end], |pair| [pair.0, pair.1][end])
                    })
                }),
            })
            .collect();
        PairList {
            histories: vec![History::default(); blocks.len()],
            live: vec![false; blocks.len()],
            blocks,
            count,
        }
    }

    /// All near pairs of grains.
    pub fn of_grains(
        grains: &Grains,
        search: Search,
        period: Period,
        reach: f64,
        looked_at: &mut u64,
    ) -> Self {
        let mut pairs = Vec::new();
        *looked_at += visit_near_pairs(search, grains.spheres(), grains.moving, period, reach, |i, j| {
            pairs.push((i, j));
        });
        let touching = |i: u32, j: u32| {
            let (a, b) = (&grains.motion[i as usize].0, &grains.motion[j as usize].0);
            let squared: f64 = (0..3)
                .map(|axis| {
                    let mut apart = (a[axis] - b[axis]).abs();
                    if period[axis] > 0.0 {
                        apart = apart.min(period[axis] - apart);
                    }
                    apart * apart
                })
                .sum();
            squared < (a[3] + b[3]).powi(2)
        };
        let never = grains.len() as u32;
        PairList::new(pairs, touching, [never, never + 1])
    }

    fn pairs(&self) -> impl Iterator<Item = (usize, usize, [u32; 2])> + '_ {
        (0..self.count).map(|pair| {
            let (block, lane) = (pair / LANES, pair % LANES);
            (block, lane, self.blocks[block].members.map(|end| end[lane]))
        })
    }

    /// What is remembered, by the names of the partners: `names` turns places into names that outlive
    /// the list.
    pub fn memories(&self, names: impl Fn([u32; 2]) -> [u32; 2], count: usize) -> Memories {
        let mut entries = Vec::new();
        for (block, lane, places) in self.pairs().filter(|(block, ..)| self.live[*block]) {
            let displacement = self.histories[block].lane(lane);
            if displacement != Vector::zeros() {
                let [a, b] = names(places);
                entries.push(if a < b {
                    (a, b, displacement)
                } else {
                    (b, a, -displacement)
                });
            }
        }
        Memories::new(entries, count)
    }

    /// Gives the contacts back what they remember.
    pub fn recall(&mut self, names: impl Fn([u32; 2]) -> [u32; 2], memories: &Memories) {
        for pair in 0..self.count {
            let (block, lane) = (pair / LANES, pair % LANES);
            let [a, b] = names(self.blocks[block].members.map(|end| end[lane]));
            if let Some(displacement) = memories.of(a.min(b), a.max(b)) {
                let turned = if a < b { displacement } else { -displacement };
                self.histories[block].set(lane, turned);
                self.live[block] = true;
            }
        }
    }
}

/// Displacements of contacts by the names of the partners, of the first over the second.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Memories {
    /// Start of each first name in `entries`, one past the end last.
    starts: Vec<u32>,
    entries: Vec<(u32, Vector<f64>)>,
}

impl Memories {
    /// `entries` hold the smaller name first; names lie below `count`.
    fn new(mut entries: Vec<(u32, u32, Vector<f64>)>, count: usize) -> Self {
        entries.sort_unstable_by_key(|&(a, b, _)| (a, b));
        let mut starts = vec![0; count + 1];
        for &(a, ..) in &entries {
            starts[a as usize + 1] += 1;
        }
        for name in 0..count {
            starts[name + 1] += starts[name];
        }
        Memories {
            starts,
            entries: entries
                .into_iter()
                .map(|(_, b, displacement)| (b, displacement))
                .collect(),
        }
    }

    fn of(&self, a: u32, b: u32) -> Option<Vector<f64>> {
        let (first, last) = (*self.starts.get(a as usize)?, *self.starts.get(a as usize + 1)?);
        let found = self.entries[first as usize..last as usize]
            .iter()
            .find(|(other, _)| *other == b);
        found.map(|(_, displacement)| *displacement)
    }
}
