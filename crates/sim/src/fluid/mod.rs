//! The fluid on particles: locally averaged, weakly compressible Navier–Stokes equations.

mod equation_of_state;
pub mod kernel;
mod particles;
mod sweep;

pub use equation_of_state::EquationOfState;
pub use particles::{Continuity, FluidParticles, Numerics};
pub use sweep::{Coefficients, Rates};
