//! Beds under the scheme a scene names.

use crate::bed::{Astray, Bed, Scheme};
use crate::integrator::{Gear, RungeKutta4};
use crate::scene::IntegratorChoice;

/// The bed's own steps, or those of a general scheme.
pub enum Mover {
    VelocityVerlet,
    Gear5(Box<Scheme<Gear<5>>>),
    Gear6(Box<Scheme<Gear<6>>>),
    RungeKutta4(Box<Scheme<RungeKutta4>>),
}

impl Mover {
    pub fn start(integrator: IntegratorChoice, bed: &mut Bed) -> Mover {
        match integrator {
            IntegratorChoice::VelocityVerlet => Mover::VelocityVerlet,
            IntegratorChoice::Gear5 => Mover::Gear5(Box::new(Scheme::start(bed))),
            IntegratorChoice::Gear6 => Mover::Gear6(Box::new(Scheme::start(bed))),
            IntegratorChoice::RungeKutta4 => Mover::RungeKutta4(Box::new(Scheme::start(bed))),
        }
    }

    /// # Errors
    /// A grain that leaps, or no number.
    pub fn advance(&mut self, bed: &mut Bed, steps: u64) -> Result<(), Astray> {
        match self {
            Mover::VelocityVerlet => bed.advance(steps),
            Mover::Gear5(scheme) => scheme.advance(bed, steps),
            Mover::Gear6(scheme) => scheme.advance(bed, steps),
            Mover::RungeKutta4(scheme) => scheme.advance(bed, steps),
        }
    }
}
