//! What grains and fluid do to each other: porosity, sampled fields, handed-back impulses.

mod breathing;
mod disturbance;
mod exchange;
mod grain_porosity;
mod layers;
pub mod permeability;
pub mod slices;
mod weights;

pub use breathing::Breathing;
pub use disturbance::{Basin, SelfInducedFlow};
pub use exchange::{Exchange, ExchangeRules, Field, GrainSize, Solids};
pub use grain_porosity::{Arrangement, PorosityRules, PorositySums, grain_porosity};
pub use layers::Layers;
pub use slices::Slices;
