//! Several threads inside one bed, to the same bits as one thread.
//!
//! Blocks of pairs are evaluated side by side into a store; then every grain adds up its own efforts in
//! the order of the list, as the single thread does.

use rayon::ThreadPool;
use rayon::prelude::*;

use crate::neighbours::{LANES, Record, in_widest};

use super::contacts::{Efforts, Interaction, PairSweep, Sink, Stretch, add};
use super::grains::Grains;
use super::motion::{KickAndDrift, Stride, Surroundings};
use super::pairs::{Block, PairList};

/// Blocks and grains that one thread takes at a time.
const BLOCKS: usize = 512;
const GRAINS: usize = 2048;

/// Threads with their store.
pub struct Crew {
    pool: ThreadPool,
    efforts: Vec<Option<Efforts>>,
    /// Start of each grain in `entries`, one past the end last.
    starts: Vec<u32>,
    /// Block, end and lane of every effort on a grain: 16 block + 8 end + lane.
    entries: Vec<u32>,
}

/// Keeps efforts by block.
struct Store<'a>(&'a mut [Option<Efforts>]);

impl Sink for Store<'_> {
    #[inline(always)]
    fn take(&mut self, place: usize, _: &Block, efforts: &Option<Efforts>) {
        self.0[place] = *efforts;
    }
}

impl Crew {
    /// `None` for a single thread, or where the system gives no more.
    pub fn new(threads: usize) -> Option<Crew> {
        if threads < 2 {
            return None;
        }
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .ok()?;
        Some(Crew {
            pool,
            efforts: Vec::new(),
            starts: Vec::new(),
            entries: Vec::new(),
        })
    }

    /// Learns a new list.
    pub fn learn(&mut self, pairs: &PairList, grains: &Grains) {
        let members = || {
            pairs.blocks[..pairs.active]
                .iter()
                .flat_map(|block| block.members.as_flattened())
        };
        self.starts.clear();
        self.starts.resize(grains.motion.len() + 1, 0);
        for member in members() {
            self.starts[*member as usize + 1] += 1;
        }
        for grain in 0..grains.motion.len() {
            self.starts[grain + 1] += self.starts[grain];
        }
        let mut next = self.starts.clone();
        self.entries.resize(pairs.active * 2 * LANES, 0);
        // Pair by pair, as a single thread adds.
        for (place, block) in pairs.blocks[..pairs.active].iter().enumerate() {
            let [first, second] = &block.members;
            for (lane, ends) in first.iter().zip(second).enumerate() {
                for (end, member) in [ends.0, ends.1].into_iter().enumerate() {
                    let slot = &mut next[*member as usize];
                    self.entries[*slot as usize] = (2 * LANES * place + LANES * end + lane) as u32;
                    *slot += 1;
                }
            }
        }
        self.efforts.clear();
        self.efforts.resize_with(pairs.active, || None);
    }

    /// Sums the forces of all pairs; returns the greatest overlap over the smaller diameter.
    pub fn sum(
        &mut self,
        interaction: &Interaction,
        grains: &Grains,
        pairs: &mut PairList,
        elapsed: f64,
        forces: &mut [Record],
    ) -> f64 {
        let Crew {
            pool,
            efforts,
            starts,
            entries,
        } = self;
        pool.install(|| {
            let Stretch {
                blocks,
                histories,
                live,
            } = pairs.whole();
            let deepest = blocks
                .par_chunks(BLOCKS)
                .zip(histories.par_chunks_mut(BLOCKS))
                .zip(live.par_chunks_mut(BLOCKS))
                .zip(efforts.par_chunks_mut(BLOCKS))
                .map(|(((blocks, histories), live), efforts)| {
                    let pairs = Stretch {
                        blocks,
                        histories,
                        live,
                    };
                    in_widest(PairSweep {
                        interaction,
                        grains,
                        pairs,
                        elapsed,
                        sink: Store(efforts),
                    })
                })
                .reduce(|| 0.0, f64::max);
            forces
                .par_chunks_mut(GRAINS)
                .enumerate()
                .for_each(|(chunk, forces)| {
                    for (grain, force) in (chunk * GRAINS..).zip(forces) {
                        for entry in &entries[starts[grain] as usize..starts[grain + 1] as usize] {
                            let (block, end, lane) = (entry / 16, entry / 8 % 2, entry % 8);
                            if let Some(efforts) = &efforts[block as usize] {
                                add(force, &efforts[end as usize][lane as usize]);
                            }
                        }
                    }
                });
            deepest
        })
    }

    /// Kicks and drifts; returns the greatest speed [m/s].
    pub fn move_on(
        &self,
        surroundings: &Surroundings,
        [motion, spin, forces]: [&mut [Record]; 3],
        stride: Stride,
    ) -> f64 {
        self.pool.install(|| {
            motion
                .par_chunks_mut(GRAINS)
                .zip(spin.par_chunks_mut(GRAINS))
                .zip(forces.par_chunks_mut(GRAINS))
                .map(|((motion, spin), forces)| {
                    in_widest(KickAndDrift {
                        surroundings,
                        motion,
                        spin,
                        forces,
                        stride,
                    })
                })
                .reduce(|| 0.0, f64::max)
        })
    }
}
