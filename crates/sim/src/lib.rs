//! Particle simulator of kynch: grains, fluids and their coupling.
//!
//! A [`Scene`](scene::Scene) is plain data in SI units. [`scene::check`] finds what cannot be
//! simulated, [`scene::describe`] says which physics is active, [`scene::run`] computes it.

pub mod arrangement;
pub mod bed;
pub mod cohesion;
pub mod contact;
pub mod coupling;
pub mod drag;
pub mod fluid;
pub mod integrator;
pub mod math;
pub mod neighbours;
pub mod outcome;
pub mod scene;
pub mod simulation;
