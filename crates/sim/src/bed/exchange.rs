//! Grains that come and go while a bed moves.

use crate::neighbours::Record;

use super::Bed;
use super::grains::{Grain, Grains};

/// Name of those who have left. Walls have names above it, grains below.
const GONE: u32 = u32::MAX / 2;

impl Grains {
    /// Lets grains go by their numbers and takes others in. Moving grains stay numbered from zero in the
    /// order in which they came, fixed ones follow. Gives the new number of every old one.
    fn exchange(&mut self, leaving: &[u32], arriving: &[Grain]) -> Vec<u32> {
        let (moving, all) = (self.moving, self.len());
        let mut renamed: Vec<u32> = (0..all as u32).collect();
        leaving.iter().for_each(|number| renamed[*number as usize] = GONE);
        let mut next = 0;
        for (number, name) in renamed.iter_mut().enumerate() {
            if number == moving {
                next += arriving.len() as u32;
            }
            if *name != GONE {
                *name = next;
                next += 1;
            }
        }
        let stays = |place: &usize| renamed[self.number[*place] as usize] != GONE;
        let kept: Vec<usize> = (0..moving).filter(stays).collect();
        let mut grains = Grains::new(arriving, &[]);
        for (offset, number) in grains.number.iter_mut().enumerate() {
            *number = (kept.len() + offset) as u32;
        }
        let fillings = arriving.len()..arriving.len() + 2;
        let join = |old: &[Record], new: &[Record]| -> Vec<Record> {
            let own = kept.iter().map(|place| old[*place]);
            let fixed = old[moving..all].iter().copied();
            own.chain(new[..arriving.len()].iter().copied())
                .chain(fixed)
                .chain(new[fillings.clone()].iter().copied())
                .collect()
        };
        let motion = join(&self.motion, &grains.motion);
        let spin = join(&self.spin, &grains.spin);
        let name = |place: &usize| renamed[self.number[*place] as usize];
        let fixed: Vec<usize> = (moving..all).collect();
        let number = kept.iter().map(name).chain(grains.number.iter().copied());
        let number = number.chain(fixed.iter().map(name)).collect();
        let class = |place: &usize| self.class[*place];
        let classes = kept.iter().map(class).chain(grains.class.iter().copied());
        let class = classes.chain(fixed.iter().map(class)).collect();
        *self = Grains {
            motion,
            spin,
            number,
            class,
            moving: kept.len() + arriving.len(),
        };
        renamed
    }
}

impl Bed {
    /// Lets moving grains go by their numbers and takes others in; contacts among those who stay keep
    /// their histories. Moving grains stay numbered from zero in the order in which they came. Belongs
    /// between two calls of [`advance`](Self::advance).
    pub fn exchange(&mut self, leaving: &[u32], arriving: &[Grain]) {
        let moving = self.grains.moving;
        let asleep = |number: &u32| {
            let place = self.grains.number[..moving].iter().position(|own| own == number);
            place.is_some_and(|place| self.grains.asleep(place))
        };
        let sleepers = leaving.iter().filter(|number| asleep(number)).count();
        let before = self.grains.clone();
        let renamed = self.grains.exchange(leaving, arriving);
        let name = |place: u32| renamed[before.number[place as usize] as usize];
        let memories = self.pairs.memories(|places| places.map(name), self.grains.len());
        let wall_memories = self.walls.memories(name, self.grains.len());
        if let Some(sleep) = &mut self.sleep {
            sleep.rename(&renamed, &self.grains, sleepers);
        }
        let mut forces = vec![Record::default(); self.grains.motion.len()];
        for (place, force) in self.forces[..before.len()].iter().enumerate() {
            if let Some(kept) = forces.get_mut(name(place as u32) as usize) {
                *kept = *force;
            }
        }
        self.smallest = smallest_diameter(&self.grains);
        let fastest = arriving.iter().map(|grain| grain.velocity.norm());
        let fastest = (0..self.grains.moving)
            .map(|grain| self.grains.velocity(grain).norm())
            .chain(fastest)
            .fold(0.0, f64::max);
        self.relist(fastest, &memories, &wall_memories);
        if let Some(porosity) = &mut self.porosity {
            porosity.refresh(&mut self.grains, &self.surroundings);
        }
        // Until the next step who comes touches nobody; who leaves may have touched many.
        self.forces.clear();
        if leaving.is_empty() {
            let numbers = self.grains.number.iter();
            self.forces.extend(numbers.map(|number| forces[*number as usize]));
            self.forces.resize(self.grains.motion.len(), Record::default());
        } else {
            self.forces.resize(self.grains.motion.len(), Record::default());
            self.sum_forces(0.0);
        }
    }

    /// Draws a volume flux q [m/s] through the floor from now on.
    pub fn draw(&mut self, flux: f64) {
        if let Some(porosity) = &mut self.porosity {
            porosity.draw(flux);
            porosity.refresh(&mut self.grains, &self.surroundings);
        }
    }
}

/// Smallest diameter of all grains [m].
pub(super) fn smallest_diameter(grains: &Grains) -> f64 {
    let diameters = grains.spheres().iter().map(|sphere| 2.0 * sphere.0[3]);
    diameters.fold(f64::INFINITY, f64::min)
}
