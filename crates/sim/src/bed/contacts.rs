//! Forces between grains, eight pairs at a time.

use crate::contact::{AnyNormal, AnyRolling, AnyTangential, ContactLaws, Couple, Meeting, Motion, Touch};
use crate::math::Vector;
use crate::neighbours::{LANES, Period, Record, Wide, WideWork, prefetch};

use super::attraction::Attraction;
use super::grains::Grains;
use super::pairs::{Block, Eight, History, PairList};

/// Blocks between asking for records and using them: four to sixteen are as good, not asking costs a
/// large bed a third of its speed.
const AHEAD: usize = 4;
/// Grains that lie in near memory all together: asking ahead costs them a tenth of their speed.
const IN_CACHE: usize = 16_384;

/// The contact laws of a bed.
pub type Laws = ContactLaws<AnyNormal, AnyTangential, AnyRolling>;

impl Laws {
    /// Whether contacts turn the grains, and so depend on how they turn.
    #[inline(always)]
    pub fn turn(&self) -> bool {
        !matches!(
            (&self.tangential, &self.rolling),
            (AnyTangential::None, AnyRolling::None)
        )
    }
}

/// What the evaluation of a pair needs to know beside the two grains.
#[derive(Clone, Copy, Debug)]
pub struct Interaction {
    pub laws: Laws,
    /// What acts between grains that do not touch; `None` where nothing does.
    pub attraction: Option<Attraction>,
    /// The couple of all pairs where all grains are equal; `None` where it depends on the pair.
    pub couple: Option<Couple>,
    pub period: Period,
    /// Step over which the forces act [s].
    pub time_step: f64,
}

/// Forces and torques on the first and on the second grains of eight pairs.
pub type Efforts = [[Record; LANES]; 2];

/// Position, size, motion of eight grains.
struct Party<W> {
    radius: W,
    inverse_mass: W,
    inverse_inertia: W,
    motion: Motion<W>,
}

impl<W: Wide> Party<W> {
    #[inline(always)]
    fn new(motion: [W; 8], spin: [W; 8]) -> Self {
        let [x, y, z, radius, u, v, w, inverse_mass] = motion;
        Party {
            radius,
            inverse_mass,
            inverse_inertia: spin[3],
            motion: Motion {
                position: Vector::new(x, y, z),
                velocity: Vector::new(u, v, w),
                angular_velocity: Vector::new(spin[0], spin[1], spin[2]),
            },
        }
    }
}

/// Masses and sizes of eight pairs together; a fixed grain has the inverse mass zero.
#[inline(always)]
fn couple<W: Wide>(a: &Party<W>, b: &Party<W>) -> Couple<W> {
    let (zero, one) = (W::splat(0.0), W::splat(1.0));
    let (wa, wb) = (a.inverse_mass, b.inverse_mass);
    let mass_a = one / W::select(zero.below(wa), wa, wb);
    let mass_b = one / W::select(zero.below(wb), wb, wa);
    Couple {
        reduced_mass: one / (wa + wb),
        mean_mass: W::splat(0.5) * (mass_a + mass_b),
        reduced_radius: a.radius * b.radius / (a.radius + b.radius),
        reduced_inertia: one / (a.inverse_inertia + b.inverse_inertia),
        smaller_radius: a.radius.min(b.radius),
    }
}

impl Interaction {
    /// Forces in a block, or `None` where nobody touches or attracts anybody.
    ///
    /// `deepest` collects the greatest overlap over the smaller diameter.
    #[inline(always)]
    pub fn block<W: Wide>(
        &self,
        grains: &Grains,
        block: &Block,
        memory: (&mut History, &mut bool),
        elapsed: f64,
        deepest: &mut W,
    ) -> Option<Efforts> {
        let (history, live) = memory;
        let [first, second] = &block.members;
        let zero = W::splat(0.0);
        let a = W::gather(&grains.motion, first);
        let b = W::gather(&grains.motion, second);
        let between = self.between(&a, &b);
        let contact_distance = a[3] + b[3];
        let reach = match &self.attraction {
            Some(attraction) => contact_distance + W::splat(attraction.reach()),
            None => contact_distance,
        };
        let squared = between.norm_squared();
        if !W::any(squared.below(reach * reach)) {
            if *live {
                *history = History::default();
                *live = false;
            }
            return None;
        }
        // Smooth grains feel no spin.
        let (spin_a, spin_b) = if self.laws.turn() {
            (W::gather(&grains.spin, first), W::gather(&grains.spin, second))
        } else {
            ([zero; 8], [zero; 8])
        };
        let (a, b) = (Party::new(a, spin_a), Party::new(b, spin_b));
        let couple = match &self.couple {
            Some(couple) => couple.splat(),
            None => couple(&a, &b),
        };
        let meeting = Meeting::of_spheres([a.radius, b.radius], between);
        let touches = zero.below(meeting.overlap);
        let mut force = Vector::zeros();
        let mut torques = [Vector::zeros(); 2];
        if W::any(touches) {
            let touch = Touch::new(&couple, &meeting, [&a.motion, &b.motion]);
            let (reaction, displacement) =
                self.laws
                    .react(&touch, remembered(history), elapsed, self.time_step);
            force = Vector::select(touches, reaction.force, force);
            torques = [
                Vector::select(touches, reaction.torques[0], Vector::zeros()),
                Vector::select(touches, reaction.torques[1], Vector::zeros()),
            ];
            *live = remember(history, touches, displacement);
            *deepest = deepest.max(meeting.overlap / (couple.smaller_radius + couple.smaller_radius));
        } else if *live {
            *history = History::default();
            *live = false;
        }
        if let Some(attraction) = &self.attraction {
            let pull = attraction.between_grains(&meeting, contact_distance, [a.radius, b.radius]);
            force = force - meeting.normal * pull;
        }
        Some([effort(force, torques[0]), effort(-force, torques[1])])
    }

    /// From the second centres to the first, the nearest way round periodic sides.
    #[inline(always)]
    pub(super) fn between<W: Wide>(&self, a: &[W; 8], b: &[W; 8]) -> Vector<W> {
        Vector::new(
            nearest(a[0] - b[0], self.period[0]),
            nearest(a[1] - b[1], self.period[1]),
            nearest(a[2] - b[2], self.period[2]),
        )
    }
}

/// The shortest way between two positions on a periodic side; a side of zero is open.
#[inline(always)]
fn nearest<W: Wide>(apart: W, side: f64) -> W {
    if side > 0.0 {
        apart - W::splat(side) * (apart * W::splat(1.0 / side)).round()
    } else {
        apart
    }
}

/// Eight records of a force and a torque.
#[inline(always)]
pub(super) fn effort<W: Wide>(force: Vector<W>, torque: Vector<W>) -> [Record; LANES] {
    let zero = W::splat(0.0);
    W::records([
        force.x, force.y, force.z, zero, torque.x, torque.y, torque.z, zero,
    ])
}

#[inline(always)]
pub(super) fn remembered<W: Wide>(history: &History) -> Vector<W> {
    let [x, y, z] = &history.0;
    Vector::new(W::from_lanes(x.0), W::from_lanes(y.0), W::from_lanes(z.0))
}

/// Keeps the displacements of pairs that touch; says whether there is anything to remember.
#[inline(always)]
pub(super) fn remember<W: Wide>(history: &mut History, touches: W::Mask, displacement: Vector<W>) -> bool {
    let kept = Vector::select(touches, displacement, Vector::zeros());
    history.0 = [
        Eight(kept.x.lanes()),
        Eight(kept.y.lanes()),
        Eight(kept.z.lanes()),
    ];
    true
}

/// Where the efforts of a block go.
pub trait Sink {
    /// A block at this place of the list will be needed soon.
    fn expect(&mut self, _: &Block) {}
    fn take(&mut self, place: usize, block: &Block, efforts: &Option<Efforts>);
}

/// Adds them to the forces of the grains: F_x, F_y, F_z [N], spare, T_x, T_y, T_z [N m], spare.
impl Sink for &mut [Record] {
    #[inline(always)]
    fn expect(&mut self, block: &Block) {
        for member in block.members.as_flattened() {
            prefetch(self, *member);
        }
    }

    #[inline(always)]
    fn take(&mut self, _: usize, block: &Block, efforts: &Option<Efforts>) {
        // By reference: moving a kilobyte at every block costs more than adding it up.
        let [first, second] = &block.members;
        if let Some([on_first, on_second]) = efforts {
            let partners = first.iter().zip(second);
            for ((i, j), (a, b)) in partners.zip(on_first.iter().zip(on_second)) {
                add(&mut self[*i as usize], a);
                add(&mut self[*j as usize], b);
            }
        }
    }
}

/// A stretch of a list of pairs.
pub struct Stretch<'a> {
    pub blocks: &'a [Block],
    pub histories: &'a mut [History],
    pub live: &'a mut [bool],
}

impl PairList {
    pub fn whole(&mut self) -> Stretch<'_> {
        Stretch {
            blocks: &self.blocks[..self.active],
            histories: &mut self.histories[..self.active],
            live: &mut self.live[..self.active],
        }
    }
}

/// Evaluates pairs in the order of the list. Returns the greatest overlap over the smaller diameter.
pub struct PairSweep<'a, S> {
    pub interaction: &'a Interaction,
    pub grains: &'a Grains,
    pub pairs: Stretch<'a>,
    /// Time since the histories were last moved on [s].
    pub elapsed: f64,
    pub sink: S,
}

impl<S: Sink> WideWork for PairSweep<'_, S> {
    type Output = f64;

    #[inline(always)]
    fn run<W: Wide>(mut self) -> f64 {
        let mut deepest = W::splat(0.0);
        let ahead = if self.grains.len() > IN_CACHE {
            AHEAD
        } else {
            usize::MAX / 2
        };
        let turn = self.interaction.laws.turn();
        let Stretch {
            blocks,
            histories,
            live,
        } = self.pairs;
        for (place, ((block, history), live)) in blocks.iter().zip(histories).zip(live).enumerate() {
            // Partners lie scattered: large beds would wait for memory at every block.
            if let Some(next) = blocks.get(place + ahead) {
                for member in next.members.as_flattened() {
                    prefetch(&self.grains.motion, *member);
                    if turn {
                        prefetch(&self.grains.spin, *member);
                    }
                }
                self.sink.expect(next);
            }
            let efforts =
                self.interaction
                    .block(self.grains, block, (history, live), self.elapsed, &mut deepest);
            self.sink.take(place, block, &efforts);
        }
        deepest.lanes().into_iter().fold(0.0, f64::max)
    }
}

#[inline(always)]
pub(super) fn add(sum: &mut Record, part: &Record) {
    for (sum, part) in sum.0.iter_mut().zip(&part.0) {
        *sum += part;
    }
}
