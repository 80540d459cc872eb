//! Grains that move freely: each follows the fluid around it and those it touches.

use super::grains::{FluidForce, GrainSet, Motion};
use crate::bed::{Astray, Bed, Drive};
use crate::math::Vec3;

/// A bed whose fluid is solved for. Gravity and buoyancy are those of the bed's surroundings.
pub struct FreeGrains {
    bed: Bed,
    /// Place in the bed of each number.
    places: Vec<u32>,
    drives: Vec<Drive>,
    /// Weight less buoyancy of all grains [N].
    weight: f64,
    astray: Option<Astray>,
    /// Held in place: feel the fluid and push it, but do not move.
    pub held: bool,
}

impl FreeGrains {
    pub fn new(bed: Bed) -> Self {
        let mut grains = FreeGrains {
            places: bed.grains.places(),
            drives: vec![Drive::default(); bed.grains.len()],
            weight: 0.0,
            astray: None,
            held: false,
            bed,
        };
        grains.weight = (0..grains.len()).map(|grain| grains.weight_of(grain)).sum();
        grains
    }

    pub fn bed(&self) -> &Bed {
        &self.bed
    }

    /// Forgets the deepest overlap so far.
    pub fn forget_deepest(&mut self) {
        self.bed.deepest = 0.0;
    }

    /// The grain that went where no grain can, after which none moves any more.
    pub fn astray(&self) -> Option<&Astray> {
        self.astray.as_ref()
    }

    /// Weight less buoyancy of a grain [N].
    fn weight_of(&self, grain: usize) -> f64 {
        let surroundings = &self.bed.surroundings;
        let place = self.places[grain] as usize;
        let radius = self.bed.grains.radius(place);
        let displaced = 4.0 / 3.0 * std::f64::consts::PI * radius * radius * radius;
        surroundings.gravity * (self.bed.grains.mass(place) - surroundings.fluid_density * displaced)
    }

    fn place(&self, grain: usize) -> usize {
        self.places[grain] as usize
    }
}

impl GrainSet for FreeGrains {
    fn len(&self) -> usize {
        self.bed.grains.len()
    }

    fn diameter(&self, grain: usize) -> f64 {
        2.0 * self.bed.grains.radius(self.place(grain))
    }

    fn position(&self, grain: usize) -> Vec3 {
        self.bed.grains.position(self.place(grain))
    }

    fn velocity(&self, grain: usize) -> Vec3 {
        self.bed.grains.velocity(self.place(grain))
    }

    fn advance(&mut self, forces: &[FluidForce], dt: f64, impulses: &mut [Vec3]) -> Motion {
        if self.astray.is_some() {
            impulses.fill(Vec3::zeros());
            return Motion::default();
        }
        if self.held {
            for (impulse, force) in impulses.iter_mut().zip(forces) {
                *impulse = force.impulse(Vec3::zeros(), dt);
            }
            return Motion {
                outside: -impulses.iter().sum::<Vec3>(),
                ..Motion::default()
            };
        }
        for (drive, force) in self.drives.iter_mut().zip(forces) {
            *drive = Drive {
                drag: force.drag,
                flow: force.flow,
                force: force.stress,
            };
        }
        let (steps, lists) = (self.bed.work.steps, self.bed.work.lists);
        self.astray = self.bed.drive(&self.drives, dt, impulses).err();
        if self.bed.work.lists != lists {
            self.places = self.bed.grains.places();
        }
        Motion {
            outside: self.bed.contact_impulse() - Vec3::new(0.0, 0.0, self.weight * dt),
            overlap: self.bed.deepest,
            grain_steps: self.bed.work.steps - steps,
        }
    }

    fn momentum(&self) -> Vec3 {
        if self.held {
            return Vec3::zeros();
        }
        let own = |grain| self.velocity(grain) * self.bed.grains.mass(self.place(grain));
        (0..self.len()).map(own).sum()
    }

    fn kinetic_energy(&self) -> f64 {
        let own = |grain| self.velocity(grain).norm_squared() * self.bed.grains.mass(self.place(grain));
        (0..self.len()).map(own).sum::<f64>() * 0.5
    }

    fn potential_energy(&self) -> f64 {
        (0..self.len())
            .map(|grain| self.weight_of(grain) * self.position(grain).z)
            .sum()
    }

    fn energy_of_one_diameter(&self) -> f64 {
        (0..self.len())
            .map(|grain| self.weight_of(grain).abs() * self.diameter(grain))
            .sum()
    }
}
