//! Tangential contact laws: friction from slip and its history.

mod cundall_strack;
mod haff_werner;
mod mindlin;

pub use cundall_strack::CundallStrack;
pub use haff_werner::HaffWerner;
pub use mindlin::{Mindlin, SlipLimit};

use crate::math::{Number, Vector};

/// What a tangential law sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slip<N = f64> {
    /// Velocity of the first surface over the second [m/s], perpendicular to `normal`.
    pub velocity: Vector<N>,
    /// Unit vector n from the second body to the first.
    pub normal: Vector<N>,
    /// Normal force [N], never below zero.
    pub normal_force: N,
    /// Overlap [m], never below zero.
    pub overlap: N,
    /// m* [kg].
    pub reduced_mass: N,
    /// Time since the history was last accepted [s].
    pub elapsed: f64,
    /// Step over which the force will act [s].
    pub time_step: f64,
}

impl<N: Number> Slip<N> {
    /// Mass that resists slip [kg]: 2/7 of m*, since spheres turn as well as move.
    #[inline(always)]
    pub fn resisting_mass(&self) -> N {
        N::splat(2.0 / 7.0) * self.reduced_mass
    }

    /// Tangential displacement [m] after `elapsed`: the old one turned into the contact plane at
    /// its old length, and the slip since.
    #[inline(always)]
    pub fn displaced(&self, history: Vector<N>) -> Vector<N> {
        let flat = history - self.normal * history.dot(&self.normal);
        let (old, new) = (history.norm_squared(), flat.norm_squared());
        let zero = N::splat(0.0);
        let stretch = N::select(zero.below(new), (old / new).sqrt(), zero);
        flat * stretch + self.velocity * N::splat(self.elapsed)
    }
}

/// A tangential contact law.
pub trait TangentialLaw: Copy {
    /// Friction on the first body [N] and the new history.
    ///
    /// The history is one vector per contact, zero when the contact begins; laws without memory
    /// leave it as it is.
    fn force<N: Number>(&self, slip: &Slip<N>, history: Vector<N>) -> (Vector<N>, Vector<N>);

    /// Longest step [s] that the law can be integrated with, for a mass that resists slip [kg].
    fn step_limit(&self, resisting_mass: f64) -> f64;
}

/// No friction.
impl TangentialLaw for () {
    #[inline(always)]
    fn force<N: Number>(&self, _: &Slip<N>, history: Vector<N>) -> (Vector<N>, Vector<N>) {
        (Vector::zeros(), history)
    }

    fn step_limit(&self, _: f64) -> f64 {
        f64::INFINITY
    }
}
