//! The pairs that may touch soon, in blocks of eight, and what their contacts remember.

use crate::math::Vector;
use crate::neighbours::{LANES, Period, Search, squared_distance, visit_near_pairs};

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

/// What is to be expected of a pair until the list is made anew.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    Touching,
    Apart,
    /// Both partners stay where they are.
    Dormant,
}

/// Blocks of pairs with their histories.
#[derive(Clone, Debug, Default)]
pub struct PairList {
    pub blocks: Vec<Block>,
    pub histories: Vec<History>,
    /// Whether a block remembers anything.
    pub live: Vec<bool>,
    /// Blocks that are evaluated; those behind them are dormant.
    pub active: usize,
    /// Pairs in them.
    pub count: usize,
    /// Partners in lanes that are left over: a pair that never touches.
    pub filling: [u32; 2],
}

impl PairList {
    /// Blocks of the pairs, those that touch now first: blocks in which nobody touches are passed over.
    pub fn new(
        pairs: impl Iterator<Item = [u32; 2]>,
        standing: impl Fn([u32; 2]) -> Standing,
        filling: [u32; 2],
    ) -> Self {
        // The order within each part is kept.
        let (mut near, mut apart, mut dormant) = (Vec::new(), Vec::new(), Vec::new());
        for pair in pairs {
            match standing(pair) {
                Standing::Touching => near.push(pair),
                Standing::Apart => apart.push(pair),
                Standing::Dormant => dormant.push(pair),
            }
        }
        near.extend(apart);
        PairList::in_order(&near, &dormant, filling)
    }

    /// Blocks of the pairs as they come.
    fn in_order(near: &[[u32; 2]], dormant: &[[u32; 2]], filling: [u32; 2]) -> Self {
        let mut blocks = packed(near, filling);
        let active = blocks.len();
        blocks.extend(packed(dormant, filling));
        PairList {
            histories: vec![History::default(); blocks.len()],
            live: vec![false; blocks.len()],
            blocks,
            active,
            count: near.len(),
            filling,
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
            pairs.push([i, j]);
        });
        let never = grains.len() as u32;
        PairList::new(
            pairs.into_iter(),
            |pair| standing(grains, period, pair),
            [never, never + 1],
        )
    }

    /// The same pairs with the same memories, sorted by how they stand now.
    pub fn sorted_anew(&self, grains: &Grains, period: Period) -> Self {
        let pairs = self.pairs().map(|(.., pair)| pair);
        let mut sorted = PairList::new(pairs, |pair| standing(grains, period, pair), self.filling);
        let own = |places: [u32; 2]| places;
        sorted.recall(own, &self.memories(own, grains.len()));
        sorted
    }

    /// The same pairs sorted by how they stand, told in their order; whoever is dormant must remember
    /// nothing.
    pub fn divided(&self, standing: &[Standing]) -> Self {
        // Where each pair was: its block and lane.
        let mut parts: [(Vec<[u32; 2]>, Vec<u32>); 3] = Default::default();
        for ((block, lane, pair), standing) in self.pairs().zip(standing) {
            let (pairs, slots) = &mut parts[*standing as usize];
            pairs.push(pair);
            slots.push((block * LANES + lane) as u32);
        }
        let [(mut near, mut slots), (apart, far_slots), (dormant, _)] = parts;
        near.extend(apart);
        slots.extend(far_slots);
        let mut list = PairList::in_order(&near, &dormant, self.filling);
        for (slot, &before) in slots.iter().enumerate() {
            let (block, lane) = (before as usize / LANES, before as usize % LANES);
            if self.live[block] {
                list.histories[slot / LANES].set(slot % LANES, self.histories[block].lane(lane));
                list.live[slot / LANES] = true;
            }
        }
        list
    }

    /// Block, lane and partners of every pair.
    pub fn pairs(&self) -> impl Iterator<Item = (usize, usize, [u32; 2])> + '_ {
        let lanes = self.blocks.iter().enumerate().flat_map(|(place, block)| {
            (0..LANES).map(move |lane| (place, lane, block.members.map(|end| end[lane])))
        });
        lanes.filter(|(.., pair)| pair[0] != self.filling[0])
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
        let pairs: Vec<_> = self.pairs().collect();
        for (block, lane, places) in pairs {
            let [a, b] = names(places);
            if let Some(displacement) = memories.of(a.min(b), a.max(b)) {
                let turned = if a < b { displacement } else { -displacement };
                self.histories[block].set(lane, turned);
                self.live[block] = true;
            }
        }
    }
}

/// Blocks of the pairs in their order.
fn packed(pairs: &[[u32; 2]], filling: [u32; 2]) -> Vec<Block> {
    let lane = |chunk: &[[u32; 2]], end: usize, lane: usize| chunk.get(lane).unwrap_or(&filling)[end];
    let chunks = pairs.chunks(LANES);
    chunks
        .map(|chunk| Block {
            members: [0, 1].map(|end| std::array::from_fn(|place| lane(chunk, end, place))),
        })
        .collect()
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

fn standing(grains: &Grains, period: Period, [i, j]: [u32; 2]) -> Standing {
    let (i, j) = (i as usize, j as usize);
    if grains.stays(i) && grains.stays(j) {
        return Standing::Dormant;
    }
    let (a, b) = (&grains.motion[i].0, &grains.motion[j].0);
    if squared_distance(a, b, period) < (a[3] + b[3]).powi(2) {
        Standing::Touching
    } else {
        Standing::Apart
    }
}
