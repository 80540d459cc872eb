//! What must be conserved, and by how much it is not.

use super::{GrainSet, Simulation};
use crate::drag::PolydisperseLaw;
use crate::math::Vec3;

impl<L: PolydisperseLaw, G: GrainSet> Simulation<L, G> {
    /// A step of `dt` [s] like any other; returns what of the change of momentum nothing accounts for [N s].
    pub fn audited_step(&mut self, dt: f64) -> Vec3 {
        let before = self.momentum(dt);
        self.step(dt);
        let weight = self.fluid.mass.iter().sum::<f64>() * self.fluid.numerics.gravity;
        let damper = (self.rules.breathing.as_ref()).map_or(0.0, |breathing| breathing.impulse);
        let on_fluid = self.fluid.wall_force() * dt + Vec3::new(0.0, 0.0, damper - weight * dt);
        self.momentum(dt) - before - self.report.outside - on_fluid
    }

    /// Momentum of fluid and grains [N s] in the middle of the next step of `dt` [s], where the kicks of
    /// the fluid meet: from one middle to the next it changes by whole impulses.
    fn momentum(&self, dt: f64) -> Vec3 {
        self.fluid.momentum_ahead(0.5 * dt) + self.grains.momentum()
    }

    /// Kinetic energy and its bound [J], when it is more than twice what gravity and the compression
    /// at the start can have given.
    pub fn energy_excess(&self) -> Option<(f64, f64)> {
        let fluid = &self.fluid;
        let energy: f64 = (fluid.mass.iter().zip(&fluid.velocity))
            .map(|(m, u)| 0.5 * m * u.norm_squared())
            .sum::<f64>()
            + self.grains.kinetic_energy();
        let fallen = self.start_potential - self.grains.potential_energy();
        let bound = 2.0 * (self.start_energy + fallen.max(self.grains.energy_of_one_diameter()));
        (energy > bound).then_some((energy, bound))
    }
}
