//! Tangential contact laws: friction from slip and its history.

mod cundall_strack;
mod haff_werner;
mod mindlin;

pub use cundall_strack::CundallStrack;
pub use haff_werner::HaffWerner;
pub use mindlin::{Mindlin, SlipLimit};

use crate::math::Vec3;

/// What a tangential law sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slip {
    /// Velocity of the first surface over the second [m/s], perpendicular to `normal`.
    pub velocity: Vec3,
    /// Unit vector n from the second body to the first.
    pub normal: Vec3,
    /// Normal force [N], never below zero.
    pub normal_force: f64,
    /// Overlap [m], never below zero.
    pub overlap: f64,
    /// m* [kg].
    pub reduced_mass: f64,
    /// Time since the history was last accepted [s].
    pub elapsed: f64,
    /// Step over which the force will act [s].
    pub time_step: f64,
}

impl Slip {
    /// Mass that resists slip [kg]: 2/7 of m*, since spheres turn as well as move.
    #[inline]
    pub fn resisting_mass(&self) -> f64 {
        2.0 / 7.0 * self.reduced_mass
    }

    /// Tangential displacement [m] after `elapsed`: the old one turned into the contact plane at
    /// its old length, and the slip since.
    #[inline]
    pub fn displaced(&self, history: Vec3) -> Vec3 {
        let flat = history - self.normal * history.dot(&self.normal);
        let length = flat.norm();
        let turned = if length > 0.0 {
            flat * (history.norm() / length)
        } else {
            flat
        };
        turned + self.velocity * self.elapsed
    }
}

/// A tangential contact law.
pub trait TangentialLaw: Copy {
    /// Friction on the first body [N] and the new history.
    ///
    /// The history is one vector per contact, zero when the contact begins; laws without memory
    /// leave it as it is.
    fn force(&self, slip: &Slip, history: Vec3) -> (Vec3, Vec3);

    /// Longest step [s] that the law can be integrated with, for a mass that resists slip [kg].
    fn step_limit(&self, resisting_mass: f64) -> f64;
}

/// No friction.
impl TangentialLaw for () {
    #[inline]
    fn force(&self, _: &Slip, history: Vec3) -> (Vec3, Vec3) {
        (Vec3::zeros(), history)
    }

    fn step_limit(&self, _: f64) -> f64 {
        f64::INFINITY
    }
}
