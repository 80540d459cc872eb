//! What must be conserved, and by how much it is not.

use super::Simulation;
use crate::drag::DragLaw;
use crate::math::Vec3;

impl<L: DragLaw> Simulation<L> {
    /// Momentum of fluid and grains [N s] in the middle of the next step of `dt` [s], where the kicks of
    /// the fluid meet: from one middle to the next it changes by whole impulses.
    pub fn momentum(&self, dt: f64) -> Vec3 {
        let moving = if self.grains.held {
            0.0
        } else {
            self.grains.mass * self.grains.position.len() as f64
        };
        self.fluid.momentum_ahead(0.5 * dt) + self.grains.velocity * moving
    }

    /// Force on fluid and grains from outside, the floor left out [N].
    pub fn external_force(&self) -> Vec3 {
        let count = self.grains.position.len() as f64;
        let fluid: f64 = self.fluid.mass.iter().sum::<f64>() * self.fluid.numerics.gravity;
        let held = Vec3::new(0.0, 0.0, self.report.drag + self.report.stress) * count;
        let grains = if self.grains.held {
            -held
        } else {
            Vec3::new(0.0, 0.0, -self.grains.weight * count)
        };
        grains - Vec3::new(0.0, 0.0, fluid)
    }

    /// Impulse [N s] of the breathing damper on the fluid and of the floor on the grains in the last step.
    pub fn numerical_and_contact_impulse(&self) -> Vec3 {
        let damper = self
            .rules
            .breathing
            .as_ref()
            .map_or(0.0, |breathing| breathing.impulse);
        Vec3::new(0.0, 0.0, damper + self.report.floor_impulse)
    }

    /// Kinetic energy and its bound [J], when it is more than twice what gravity and the compression
    /// at the start can have given.
    pub fn energy_excess(&self) -> Option<(f64, f64)> {
        let count = self.grains.position.len() as f64;
        let kinetic = |mass: f64, velocity: &Vec3| 0.5 * mass * velocity.norm_squared();
        let fluid = &self.fluid;
        let energy: f64 = (fluid.mass.iter().zip(&fluid.velocity))
            .map(|(m, u)| kinetic(*m, u))
            .sum::<f64>()
            + kinetic(self.grains.mass * count, &self.grains.velocity);
        let fallen = (self.start_height - self.grains.position[0].z).max(0.0);
        let bound =
            2.0 * (self.start_energy + self.grains.weight.abs() * count * fallen.max(self.grains.diameter));
        (energy > bound).then_some((energy, bound))
    }
}
