//! Particle simulator of kynch: grains, fluids and their coupling.
//!
//! A [`Scene`](scene::Scene) is plain data in SI units. [`scene::check`] finds what cannot be
//! simulated, [`scene::describe`] says which physics is active, [`scene::run`] computes it.

pub mod outcome;
pub mod scene;
