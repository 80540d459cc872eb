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

mod attempt;
mod encounters;
mod flight;
mod lists;
mod sub_steps;
#[cfg(test)]
mod tests;

use crate::math::Vec3;
use crate::neighbours::{LANES, Record, in_widest};

use super::sleep::Sleep;
use super::{Astray, Bed};

use attempt::Start;
use flight::Flights;

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
    /// x, y, z [m], bound on the change of velocity [m/s], v_x, v_y, v_z [m/s], speed that weight and
    /// buoyancy give [m/s].
    flights: Vec<Record>,
    /// Greatest of the bounds on the change of velocity [m/s].
    change: f64,
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
        if let Some(crew) = &mut self.crew {
            crew.learn(&self.pairs, &self.grains);
        }
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

    fn fly(&mut self, drives: &[Drive], span: &Span) -> Result<f64, Astray> {
        let Driven {
            launches, flights, ..
        } = &mut self.driven;
        let grains = &self.grains;
        launches.resize(grains.motion.len(), Record::default());
        flights.resize(grains.motion.len(), Record::default());
        let [fastest, change] = in_widest(Flights {
            surroundings: &self.surroundings,
            motion: &grains.motion,
            number: &grains.number,
            drives,
            launches: &mut launches[..grains.moving],
            flights: &mut flights[..grains.moving],
            span: span.time,
        });
        self.driven.change = change;
        if fastest.is_finite() {
            return Ok(fastest);
        }
        let flights = &self.driven.flights[..self.grains.moving];
        let lost = flights
            .iter()
            .position(|flight| !flight.0.iter().all(|x| x.is_finite()));
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
            let given = self.given(grain, gain) - Vec3::new(sx, sy, sz);
            impulses[self.grains.number[grain] as usize] = given;
        }
        for grain in (0..moving).filter(|grain| !self.driven.busy[*grain]) {
            let [x, y, z, _, vx, vy, vz, _] = self.driven.flights[grain].0;
            let velocity = Vec3::new(vx, vy, vz);
            let before = self.grains.velocity(grain);
            if velocity.norm_squared().max(before.norm_squared()) >= span.limit * span.limit {
                return Err(self.astray_flight(grain));
            }
            impulses[self.grains.number[grain] as usize] = self.given(grain, velocity - before);
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
    fn given(&self, grain: usize, gain: Vec3) -> Vec3 {
        let own = self.driven.flights[grain].0[7];
        Vec3::new(gain.x, gain.y, gain.z - own) * self.grains.mass(grain)
    }
}
