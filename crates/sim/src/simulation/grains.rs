//! What a simulation must know of the grains that its fluid moves.

use crate::math::Vec3;

/// What the fluid does to a grain over a step: drag β (U − v) and a force that does not depend on v.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FluidForce {
    /// β [kg/s].
    pub drag: f64,
    /// Flow velocity U [m/s].
    pub flow: Vec3,
    /// Force of pressure and viscous stress [N].
    pub stress: Vec3,
}

impl FluidForce {
    /// Impulse [N s] that a grain gets in `dt` [s] at the mean velocity `mean` [m/s].
    pub fn impulse(&self, mean: Vec3, dt: f64) -> Vec3 {
        (self.drag * (self.flow - mean) + self.stress) * dt
    }
}

/// How a set of grains moved over a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion {
    /// Impulse of everything but the fluid on all grains [N s]: weight less buoyancy, walls, what holds them.
    pub outside: Vec3,
    /// Largest overlap of a contact over the diameter [-].
    pub overlap: f64,
    /// Steps of the grains.
    pub grain_steps: u64,
}

/// Grains in a fluid that is solved for. They keep their numbers from 0 on.
pub trait GrainSet {
    /// Number of grains; never zero.
    fn len(&self) -> usize;

    /// Whether there is no grain.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Diameter of a grain [m].
    fn diameter(&self, grain: usize) -> f64;

    /// Where a grain is [m]; x and y of any period.
    fn position(&self, grain: usize) -> Vec3;

    /// Velocity of a grain [m/s].
    fn velocity(&self, grain: usize) -> Vec3;

    /// Moves all grains over `dt` [s] under the force of the fluid on each, and writes the impulse [N s]
    /// that each got from it: the fluid gets the same back.
    fn advance(&mut self, forces: &[FluidForce], dt: f64, impulses: &mut [Vec3]) -> Motion;

    /// Momentum of all grains [kg m/s]; zero for held ones.
    fn momentum(&self) -> Vec3;

    /// Kinetic energy of all grains [J].
    fn kinetic_energy(&self) -> f64;

    /// Energy in the field of gravity [J], buoyancy taken off where the fluid does not carry it.
    fn potential_energy(&self) -> f64;

    /// Magnitudes of the weights, each times its grain's diameter [J]: what potential energy is not told
    /// apart from nothing.
    fn energy_of_one_diameter(&self) -> f64;
}
