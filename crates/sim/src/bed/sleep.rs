//! Grains that have come to rest stay where they are until something moves them.
//!
//! A grain falls asleep when it and all whom it touches have been slow for a while. Pairs of sleepers
//! are not evaluated; what the awake ones do to a sleeper is compared with what they did when it fell
//! asleep, and a change by more than a small share of its weight wakes it and its neighbours. Spin does
//! not keep a grain awake: one that turns on the spot goes nowhere.

use crate::math::Vec3;
use crate::neighbours::Record;

use super::Bed;
use super::grains::Grains;

/// Steps between two reviews of who may sleep.
const REVIEW: u64 = 50;
/// Reviews over which a grain must have been slow.
const REVIEWS: u8 = 4;
/// Slow is a speed under this share of √(g d) [-].
const SLOW: f64 = 4e-4;
/// Change of force that wakes a sleeper, over its weight [-].
const NUDGE: f64 = 0.02;

#[derive(Clone, Debug, Default)]
pub struct Sleep {
    /// Reviews over which each number has been slow.
    slow: Vec<u8>,
    /// Forces of the awake ones on each sleeper when it fell asleep, by number.
    base: Vec<Record>,
    /// Places of sleepers in pairs with awake ones.
    border: Vec<u32>,
    /// Steps since the last review.
    steps: u64,
    sleepers: usize,
}

impl Grains {
    /// Whether a grain is fixed or asleep.
    pub fn stays(&self, grain: usize) -> bool {
        grain >= self.moving || self.asleep(grain)
    }

    pub fn asleep(&self, grain: usize) -> bool {
        self.spin[grain].0[7] == 0.0
    }

    fn lay_down(&mut self, grain: usize) {
        self.motion[grain].0[4..7].fill(0.0);
        self.spin[grain].0[..3].fill(0.0);
        self.spin[grain].0[7] = 0.0;
    }
}

impl Sleep {
    pub fn new(grains: &Grains) -> Self {
        Sleep {
            slow: vec![0; grains.len()],
            base: vec![Record::default(); grains.len()],
            ..Sleep::default()
        }
    }

    /// Grains have left, `sleepers` of them asleep, others have come: `renamed` gives the new number of
    /// every old one.
    pub fn rename(&mut self, renamed: &[u32], grains: &Grains, sleepers: usize) {
        let (slow, base) = (std::mem::take(&mut self.slow), std::mem::take(&mut self.base));
        self.slow.resize(grains.len(), 0);
        self.base.resize(grains.len(), Record::default());
        for (old, new) in renamed.iter().enumerate() {
            if let Some(place) = self.slow.get_mut(*new as usize) {
                *place = slow[old];
                self.base[*new as usize] = base[old];
            }
        }
        self.sleepers -= sleepers;
    }

    pub fn all(&self, grains: &Grains) -> bool {
        grains.moving > 0 && self.sleepers == grains.moving
    }
}

impl Bed {
    /// Leaves grains at rest out until something moves them.
    pub fn with_sleeping(mut self) -> Self {
        self.sleep = Some(Sleep::new(&self.grains));
        self
    }

    /// Share of the grains asleep [-].
    pub fn asleep(&self) -> f64 {
        let sleepers = self.sleep.as_ref().map_or(0, |sleep| sleep.sleepers);
        sleepers as f64 / self.grains.moving.max(1) as f64
    }

    /// Wakes whom a force has changed for and lets the slow ones fall asleep, when it is time. Forces
    /// must be those of the present state.
    pub(super) fn rouse_and_rest(&mut self) {
        let Some(mut sleep) = self.sleep.take() else {
            return;
        };
        let woken = self.nudged(&sleep);
        sleep.steps += 1;
        let tired = if sleep.steps >= REVIEW {
            self.tired(&mut sleep)
        } else {
            Vec::new()
        };
        if !(woken.is_empty() && tired.is_empty()) {
            self.change(&mut sleep, &woken, &tired);
        }
        self.sleep = Some(sleep);
    }

    /// The list has been made anew: places have changed.
    pub(super) fn find_border(&mut self) {
        let Some(mut sleep) = self.sleep.take() else {
            return;
        };
        sleep.border = self.border();
        self.sleep = Some(sleep);
    }

    fn border(&self) -> Vec<u32> {
        let grains = &self.grains;
        let active = self
            .pairs
            .pairs()
            .filter(|(block, ..)| *block < self.pairs.active);
        let members = active.flat_map(|(.., pair)| pair);
        let mut border: Vec<u32> = members
            .filter(|member| (*member as usize) < grains.moving && grains.asleep(*member as usize))
            .collect();
        border.sort_unstable();
        border.dedup();
        border
    }

    /// Sleepers whose force has changed, and those who touch them.
    fn nudged(&self, sleep: &Sleep) -> Vec<u32> {
        let grains = &self.grains;
        let changed = |place: &u32| {
            let grain = *place as usize;
            let base = &sleep.base[grains.number[grain] as usize].0;
            let force = &self.forces[grain].0;
            let change = Vec3::new(force[0] - base[0], force[1] - base[1], force[2] - base[2]);
            let still = change.norm() <= NUDGE * self.surroundings.gravity * grains.mass(grain);
            // What is no number must not sleep on.
            !still
        };
        let first: Vec<u32> = sleep.border.iter().copied().filter(changed).collect();
        if first.is_empty() {
            return first;
        }
        let mut woken = vec![false; grains.len()];
        first.iter().for_each(|place| woken[*place as usize] = true);
        let ring = woken.clone();
        for [i, j] in self.contacts().pairs {
            woken[i as usize] |= ring[j as usize];
            woken[j as usize] |= ring[i as usize];
        }
        let asleep = |place: &u32| woken[*place as usize] && grains.asleep(*place as usize);
        (0..grains.moving as u32).filter(asleep).collect()
    }

    /// Awake grains that may fall asleep now.
    fn tired(&self, sleep: &mut Sleep) -> Vec<u32> {
        sleep.steps = 0;
        let grains = &self.grains;
        let mut ready = vec![true; grains.len()];
        for (grain, ready) in ready.iter_mut().enumerate().take(grains.moving) {
            if grains.asleep(grain) {
                continue;
            }
            let radius = grains.radius(grain);
            let limit = SLOW * (2.0 * radius * self.surroundings.gravity).sqrt();
            let speed = grains.velocity(grain).norm();
            let slow = &mut sleep.slow[grains.number[grain] as usize];
            *slow = if speed < limit { slow.saturating_add(1) } else { 0 };
            *ready = *slow >= REVIEWS;
        }
        let touching = self.contacts();
        let mut held = vec![false; grains.len()];
        let mut free = ready.clone();
        for &[i, j] in &touching.pairs {
            let (i, j) = (i as usize, j as usize);
            free[i] &= ready[j];
            free[j] &= ready[i];
            (held[i], held[j]) = (true, true);
        }
        touching
            .walls
            .iter()
            .for_each(|(grain, _)| held[*grain as usize] = true);
        let tired = |place: &u32| {
            let grain = *place as usize;
            free[grain] && held[grain] && !grains.asleep(grain)
        };
        (0..grains.moving as u32).filter(tired).collect()
    }

    fn change(&mut self, sleep: &mut Sleep, woken: &[u32], tired: &[u32]) {
        let before = self.forces.clone();
        for &place in woken {
            self.grains.spin[place as usize].0[7] = 1.0;
            sleep.slow[self.grains.number[place as usize] as usize] = 0;
        }
        let awake = |grain: &u32| !woken.contains(grain);
        let tired: Vec<u32> = tired.iter().copied().filter(awake).collect();
        tired
            .iter()
            .for_each(|place| self.grains.lay_down(*place as usize));
        sleep.sleepers = sleep.sleepers + tired.len() - woken.len();
        self.pairs = self.pairs.sorted_anew(&self.grains, self.interaction.period);
        if let Some(crew) = &mut self.crew {
            crew.learn(&self.pairs, &self.grains);
        }
        self.forces.fill(Record::default());
        self.sum_forces(0.0);
        // Sleepers keep their bases but for what changed now on their account.
        for grain in (0..self.grains.moving).filter(|grain| self.grains.asleep(*grain)) {
            let base = &mut sleep.base[self.grains.number[grain] as usize].0;
            for ((base, now), then) in base.iter_mut().zip(&self.forces[grain].0).zip(&before[grain].0) {
                *base += now - then;
            }
        }
        for place in tired {
            let grain = place as usize;
            sleep.base[self.grains.number[grain] as usize] = self.forces[grain];
        }
        sleep.border = self.border();
    }
}
