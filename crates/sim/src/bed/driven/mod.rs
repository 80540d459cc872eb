//! Grains driven by a fluid that is solved elsewhere.
//!
//! Over a span of the fluid's time every grain sees a frozen rate of drag, a flow and a force. Whoever
//! can meet nobody within the span flies through it in closed form; the others take equal sub-steps of
//! the contacts, with drag integrated exactly over every kick:
//!
//! ```text
//! m dv/dt = F_contact + m g (1 − ρ_f/ρ) + F + β (U − v)
//! ```
//!
//! Who can meet is decided before the span from bounds on all velocities. What the grains then really
//! did is held against the bounds; a span in which somebody went farther is taken back and done again
//! with more of them sub-stepped, so that no contact is missed.

mod encounters;
mod flight;
mod sub_steps;

use std::f64::consts::PI;

use crate::math::Vec3;
use crate::neighbours::{LANES, Record, Search, in_widest};

use super::contacts::{Interaction, PairSweep};
use super::motion::Stride;
use super::pairs::{History, Standing};
use super::sleep::Sleep;
use super::walls::WallSweep;
use super::{Astray, Bed, Listing};

use encounters::{Encounters, Suspects, pairs_in};
use flight::Flights;
use sub_steps::KickSome;

/// Gap over the smallest diameter up to which pairs are sub-stepped although they cannot meet by
/// themselves: one that is hit may still reach the other.
const FLOOR: f64 = 0.005;
/// Spans after which pairs that were sub-stepped are looked at again.
const SPANS: u32 = 8;
/// How much farther than needed lists reach when grains went too far for them [-].
const SPARE: f64 = 1.5;
/// Share by which steps and bounds may be exceeded by rounding [-].
const ROUNDING: f64 = 1e-9;

/// What a fluid that is solved for does to one grain over a span.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Drive {
    /// β ≥ 0, drag per slip [kg/s].
    pub drag: f64,
    /// U, the flow that the drag pulls towards [m/s].
    pub flow: Vec3,
    /// F, everything else of the fluid that stays the same over the span [N].
    pub force: Vec3,
}

/// What is known of a driven bed between and within spans; all by place.
#[derive(Clone, Debug, Default)]
pub(super) struct Driven {
    /// c_x, c_y, c_z [m/s²], λ [1/s], impulse of the contacts [N s], sum of the changes of velocity
    /// [m/s].
    launches: Vec<Record>,
    /// x, y, z [m], bound on the change of velocity [m/s], v_x, v_y, v_z [m/s].
    flights: Vec<Record>,
    /// Whether a grain is sub-stepped.
    busy: Vec<bool>,
    /// Places of those, in eights.
    some: Vec<[u32; LANES]>,
    /// How many they are.
    count: usize,
    start: Start,
    /// Blocks to look at.
    suspects: Vec<u32>,
    /// Whether the lists are divided into pairs that may meet and others.
    divided: bool,
    /// Spans since they were.
    age: u32,
}

/// How the busy ones were before the span.
#[derive(Clone, Debug, Default)]
struct Start {
    /// Motion, spin and forces in the order of `some`.
    states: Vec<[Record; 3]>,
    pairs: (Vec<History>, Vec<bool>),
    walls: (Vec<History>, Vec<bool>),
}

impl Driven {
    /// Lists have been made anew.
    pub(super) fn forget(&mut self) {
        self.divided = false;
    }
}

/// A span and its sub-steps.
#[derive(Clone, Copy)]
struct Span {
    /// [s]
    time: f64,
    steps: u32,
    /// [s]
    step: f64,
    /// Speed that no grain may reach [m/s].
    limit: f64,
}

impl Bed {
    /// Moves all grains on by `span` [s] under a fluid that is solved elsewhere, in equal sub-steps no
    /// longer than the time step where they may meet.
    ///
    /// `drives` and `impulses` go by the grain's number, fixed ones included. An impulse is what the
    /// fluid gave over the span [N s], `F T + ∫ β (U − v) dt`. The momentum of a grain changes by it,
    /// by its weight less the buoyancy that the surroundings give it, and by its contacts, to rounding.
    /// The surroundings' own drag, lift and slices do not act; nobody sleeps; one thread does it.
    ///
    /// # Errors
    /// A grain whose way in one sub-step is longer than half the smallest diameter, or no number.
    ///
    /// # Panics
    /// Where there are not as many drives or impulses as grains.
    pub fn drive(&mut self, drives: &[Drive], span: f64, impulses: &mut [Vec3]) -> Result<(), Astray> {
        assert_eq!(drives.len(), self.grains.len(), "one drive for every grain");
        assert_eq!(impulses.len(), self.grains.len(), "one impulse for every grain");
        impulses.fill(Vec3::zeros());
        if span <= 0.0 {
            return Ok(());
        }
        let steps = (span / self.interaction.time_step * (1.0 - ROUNDING))
            .ceil()
            .max(1.0);
        let span = Span {
            time: span,
            steps: steps as u32,
            step: span / steps,
            limit: 0.5 * self.smallest * steps / span,
        };
        self.rouse();
        let flown = self.set_out(drives, &span)?;
        self.foresee(&span);
        let deepest = self.deepest;
        let fastest = loop {
            self.keep_start();
            self.deepest = deepest;
            let fastest = self.sub_step(&span)?.max(flown);
            if fastest * span.time > self.slack {
                self.take_back();
                self.widen_lists(SPARE * fastest * span.time);
                self.set_out(drives, &span)?;
                self.foresee(&span);
            } else if self.overlooked(&span) {
                self.take_back();
                self.divide(&span);
            } else {
                break fastest;
            }
            self.work.repeats += 1;
        };
        self.slack -= fastest * span.time;
        self.arrive(drives, &span, impulses)
    }

    /// What the contacts gave all grains together in the last span [N s]: the impulse of the walls, since
    /// contacts between grains cancel but for rounding.
    pub fn contact_impulse(&self) -> Vec3 {
        let busy = self.driven.some.as_flattened().iter();
        busy.filter(|place| (**place as usize) < self.grains.moving)
            .map(|place| {
                let [.., x, y, z, _] = self.driven.launches[*place as usize].0;
                Vec3::new(x, y, z)
            })
            .sum()
    }

    /// Wakes all sleepers.
    fn rouse(&mut self) {
        if self.sleep.is_none() || self.asleep() == 0.0 {
            return;
        }
        self.sleep = Some(Sleep::new(&self.grains));
        let moving = self.grains.moving;
        self.grains.spin[..moving]
            .iter_mut()
            .for_each(|spin| spin.0[7] = 1.0);
        self.pairs = self.pairs.sorted_anew(&self.grains, self.interaction.period);
        self.forces.fill(Record::default());
        self.sum_forces(0.0);
    }

    /// Flies everybody on paper, with lists that hold for it; returns the greatest speed [m/s].
    fn set_out(&mut self, drives: &[Drive], span: &Span) -> Result<f64, Astray> {
        let fastest = self.fly(drives, span)?;
        if fastest * span.time <= self.slack {
            return Ok(fastest);
        }
        self.widen_lists(fastest * span.time);
        self.fly(drives, span)
    }

    /// Makes lists that hold while grains go so far [m], and for longer if they may.
    fn widen_lists(&mut self, way: f64) {
        let (search, wanted) = match self.listing {
            Listing::EveryStep(search) => (search, 0.0),
            Listing::Skin(Some(skin)) => (Search::Grid, skin * self.smallest),
            Listing::Skin(None) => (Search::Grid, self.skin_for(way)),
        };
        // Forces stay with their grains.
        let mut forces = vec![Record::default(); self.grains.len()];
        for (number, force) in self.grains.number.iter().zip(&self.forces) {
            forces[*number as usize] = *force;
        }
        self.list_within(search, wanted.max(2.0 * (1.0 + ROUNDING) * way));
        for (number, force) in self.grains.number.iter().zip(&mut self.forces) {
            *force = forces[*number as usize];
        }
    }

    /// Acceleration by weight and buoyancy [m/s²], upwards.
    fn own(&self, grain: usize) -> f64 {
        let Record([_, _, _, radius, .., inverse_mass]) = self.grains.motion[grain];
        let displaced = 4.0 / 3.0 * PI * self.surroundings.fluid_density * radius * radius * radius;
        self.surroundings.gravity * (displaced * inverse_mass - 1.0)
    }

    fn fly(&mut self, drives: &[Drive], span: &Span) -> Result<f64, Astray> {
        let mut driven = std::mem::take(&mut self.driven);
        let grains = &self.grains;
        driven.launches.resize(grains.motion.len(), Record::default());
        driven.flights.resize(grains.motion.len(), Record::default());
        for (grain, launch) in driven.launches[..grains.moving].iter_mut().enumerate() {
            let drive = &drives[grains.number[grain] as usize];
            let inverse_mass = grains.motion[grain].0[7];
            let rate = drive.drag * inverse_mass;
            let push = drive.force * inverse_mass + drive.flow * rate;
            let own = self.own(grain);
            *launch = Record([push.x, push.y, push.z + own, rate, 0.0, 0.0, 0.0, 0.0]);
        }
        let fastest = in_widest(Flights {
            motion: &grains.motion,
            launches: &driven.launches,
            flights: &mut driven.flights[..grains.moving],
            span: span.time,
        });
        self.driven = driven;
        if fastest.is_finite() {
            return Ok(fastest);
        }
        let flights = &self.driven.flights[..self.grains.moving];
        let lost = flights
            .iter()
            .position(|flight| !flight.0[..7].iter().all(|x| x.is_finite()));
        Err(self.astray_flight(lost.unwrap_or(0)))
    }

    fn astray_flight(&self, grain: usize) -> Astray {
        let [x, y, z, _, vx, vy, vz, _] = self.driven.flights[grain].0;
        Astray {
            grain: self.grains.number[grain],
            position: Vec3::new(x, y, z),
            velocity: Vec3::new(vx, vy, vz),
        }
    }

    fn encounters<'a>(&'a self, interaction: &'a Interaction, span: &Span, floor: f64) -> Encounters<'a> {
        Encounters {
            interaction,
            motion: &self.grains.motion,
            flights: &self.driven.flights,
            span: span.time,
            floor,
        }
    }

    /// Divides the lists anew where somebody outside may meet, or when it is time.
    fn foresee(&mut self, span: &Span) {
        self.driven.age += 1;
        if !self.driven.divided || self.driven.age >= SPANS || self.somebody_meets_outside(span) {
            self.divide(span);
        }
    }

    /// Whether somebody may meet in a pair that is not sub-stepped.
    fn somebody_meets_outside(&mut self, span: &Span) -> bool {
        let mut found = std::mem::take(&mut self.driven.suspects);
        found.clear();
        let change = self.driven.flights[..self.grains.moving]
            .iter()
            .map(|flight| flight.0[3])
            .fold(0.0, f64::max);
        let blocks = &self.pairs.blocks[self.pairs.active..];
        let encounters = self.encounters(&self.interaction, span, 0.0);
        in_widest(Suspects {
            encounters,
            change,
            blocks,
            found: &mut found,
        });
        let nobody = self.pairs.filling[0];
        let among_grains = found.iter().any(|&block| {
            let mut pairs = pairs_in(&blocks[block as usize], nobody);
            pairs.any(|pair| encounters.standing(pair) != Standing::Dormant)
        });
        let list = &self.walls.list;
        let mut at_walls = list.blocks[list.active..]
            .iter()
            .flat_map(|block| pairs_in(block, nobody));
        let meets = |pair: [u32; 2]| encounters.standing_at_wall(&self.walls, pair) != Standing::Dormant;
        let meets = among_grains || at_walls.any(meets);
        self.driven.suspects = found;
        meets
    }

    /// Divides the lists into pairs that may meet and others, and finds who is to be sub-stepped.
    fn divide(&mut self, span: &Span) {
        let encounters = self.encounters(&self.interaction, span, FLOOR * self.smallest);
        let pairs = self.pairs.divided(|pair| encounters.standing(pair));
        let walls = self
            .walls
            .list
            .divided(|pair| encounters.standing_at_wall(&self.walls, pair));
        (self.pairs, self.walls.list) = (pairs, walls);
        let (moving, nobody) = (self.grains.moving, self.grains.len() as u32);
        let driven = &mut self.driven;
        driven.busy.clear();
        driven.busy.resize(self.grains.motion.len(), false);
        for block in &self.pairs.blocks[..self.pairs.active] {
            for member in block.members.as_flattened() {
                driven.busy[*member as usize] = true;
            }
        }
        for block in &self.walls.list.blocks[..self.walls.list.active] {
            for member in block.members[0] {
                driven.busy[member as usize] = true;
            }
        }
        let some: Vec<u32> = (0..moving as u32)
            .filter(|grain| driven.busy[*grain as usize])
            .collect();
        driven.count = some.len();
        driven.some.clear();
        driven.some.extend(some.chunks(LANES).map(|chunk| {
            let mut places = [nobody; LANES];
            places[..chunk.len()].copy_from_slice(chunk);
            places
        }));
        (driven.divided, driven.age) = (true, 0);
    }

    /// Makes the lists whole again.
    pub(super) fn join_lists(&mut self) {
        if !self.driven.divided {
            return;
        }
        self.driven.divided = false;
        self.pairs = self.pairs.sorted_anew(&self.grains, self.interaction.period);
        self.walls.list = self.walls.list.divided(|_| Standing::Apart);
        if let Some(crew) = &mut self.crew {
            crew.learn(&self.pairs, &self.grains);
        }
    }

    fn keep_start(&mut self) {
        let Driven { some, start, .. } = &mut self.driven;
        start.states.clear();
        for &place in some.as_flattened() {
            let place = place as usize;
            start.states.push([
                self.grains.motion[place],
                self.grains.spin[place],
                self.forces[place],
            ]);
        }
        let lists = [
            (&mut start.pairs, &self.pairs),
            (&mut start.walls, &self.walls.list),
        ];
        for (kept, list) in lists {
            kept.0.clear();
            kept.0.extend_from_slice(&list.histories[..list.active]);
            kept.1.clear();
            kept.1.extend_from_slice(&list.live[..list.active]);
        }
    }

    /// Puts the busy ones back to the start of the span.
    fn take_back(&mut self) {
        let Driven {
            some,
            start,
            launches,
            ..
        } = &mut self.driven;
        for (&place, state) in some.as_flattened().iter().zip(&start.states) {
            let place = place as usize;
            [
                self.grains.motion[place],
                self.grains.spin[place],
                self.forces[place],
            ] = *state;
            launches[place].0[4..].fill(0.0);
        }
        let lists = [
            (&start.pairs, &mut self.pairs),
            (&start.walls, &mut self.walls.list),
        ];
        for (kept, list) in lists {
            list.histories[..list.active].copy_from_slice(&kept.0);
            list.live[..list.active].copy_from_slice(&kept.1);
        }
    }

    /// Takes the busy ones through the span; returns the greatest speed [m/s].
    fn sub_step(&mut self, span: &Span) -> Result<f64, Astray> {
        let interaction = Interaction {
            time_step: span.step,
            ..self.interaction
        };
        let mut fastest = 0.0_f64;
        if self.driven.count == 0 {
            return Ok(fastest);
        }
        for step in 0..span.steps {
            let kick = if step == 0 { 0.5 * span.step } else { span.step };
            fastest = fastest.max(self.kick(kick, span.step, span.limit)?);
            self.sum_active(&interaction);
        }
        fastest = fastest.max(self.kick(0.5 * span.step, 0.0, span.limit)?);
        self.work.steps += u64::from(span.steps);
        self.work.sub_steps += u64::from(span.steps) * self.driven.count as u64;
        Ok(fastest)
    }

    fn kick(&mut self, kick: f64, drift: f64, limit: f64) -> Result<f64, Astray> {
        // What acts on fixed grains moves nobody.
        self.forces[self.grains.moving..].fill(Record::default());
        let fastest = in_widest(KickSome {
            motion: &mut self.grains.motion,
            spin: &mut self.grains.spin,
            forces: &mut self.forces,
            launches: &mut self.driven.launches,
            some: &self.driven.some,
            stride: Stride { kick, drift, limit },
        });
        if fastest.is_finite() {
            Ok(fastest)
        } else {
            Err(self.astray(limit))
        }
    }

    fn sum_active(&mut self, interaction: &Interaction) {
        let deepest = in_widest(PairSweep {
            interaction,
            grains: &self.grains,
            pairs: self.pairs.whole(),
            elapsed: interaction.time_step,
            sink: &mut self.forces[..],
        });
        let at_walls = in_widest(WallSweep {
            interaction,
            grains: &self.grains,
            walls: &mut self.walls,
            elapsed: interaction.time_step,
            forces: &mut self.forces,
        });
        self.deepest = self.deepest.max(deepest).max(at_walls);
        self.work.pairs += self.pairs.count as u64;
    }

    /// Whether a busy grain changed its velocity by more than was foreseen and so may have met somebody
    /// outside. Bounds hold for what happened after it.
    fn overlooked(&mut self, span: &Span) -> bool {
        let Driven {
            some,
            launches,
            flights,
            ..
        } = &mut self.driven;
        let mut farther = false;
        for &place in some.as_flattened() {
            let (bound, changed) = (&mut flights[place as usize].0[3], launches[place as usize].0[7]);
            if changed > *bound * (1.0 + ROUNDING) {
                (*bound, farther) = (changed, true);
            }
        }
        if !farther {
            return false;
        }
        self.swap_start();
        let overlooked = self.somebody_meets_outside(span);
        self.swap_start();
        overlooked
    }

    /// Exchanges the motion of the busy ones now and at the start of the span.
    fn swap_start(&mut self) {
        let Driven { some, start, .. } = &mut self.driven;
        // Empty lanes stand for one that does not move.
        for (&place, state) in some.as_flattened().iter().zip(&mut start.states) {
            std::mem::swap(&mut self.grains.motion[place as usize], &mut state[0]);
        }
    }

    /// Flyers land; everybody tells what the fluid gave.
    fn arrive(&mut self, drives: &[Drive], span: &Span, impulses: &mut [Vec3]) -> Result<(), Astray> {
        let moving = self.grains.moving;
        for (place, state) in self
            .driven
            .some
            .as_flattened()
            .iter()
            .zip(&self.driven.start.states)
        {
            let grain = *place as usize;
            if grain >= moving {
                continue;
            }
            let [_, _, _, _, x, y, z, _] = state[0].0;
            let gain = self.grains.velocity(grain) - Vec3::new(x, y, z);
            let [_, _, _, _, sx, sy, sz, _] = self.driven.launches[grain].0;
            let given = self.given(grain, span, gain) - Vec3::new(sx, sy, sz);
            impulses[self.grains.number[grain] as usize] = given;
        }
        for grain in (0..moving).filter(|grain| !self.driven.busy[*grain]) {
            let [x, y, z, _, vx, vy, vz, _] = self.driven.flights[grain].0;
            let velocity = Vec3::new(vx, vy, vz);
            let before = self.grains.velocity(grain);
            if !(velocity.norm_squared().max(before.norm_squared()) < span.limit * span.limit) {
                return Err(self.astray_flight(grain));
            }
            impulses[self.grains.number[grain] as usize] = self.given(grain, span, velocity - before);
            let motion = &mut self.grains.motion[grain].0;
            (motion[0], motion[1], motion[2]) = (x, y, z);
            (motion[4], motion[5], motion[6]) = (vx, vy, vz);
        }
        for grain in moving..self.grains.len() {
            let number = self.grains.number[grain] as usize;
            let Drive { drag, flow, force } = drives[number];
            impulses[number] = (force + flow * drag) * span.time;
        }
        self.work.flights += (moving - self.driven.count) as u64;
        Ok(())
    }

    /// What everything but weight and buoyancy gave a grain that gained a velocity [N s].
    fn given(&self, grain: usize, span: &Span, gain: Vec3) -> Vec3 {
        (gain - Vec3::new(0.0, 0.0, self.own(grain) * span.time)) * self.grains.mass(grain)
    }
}
