//! Where grains are before anything moves: at random, evenly at random, on a lattice, or densely packed.
//!
//! Pure geometry. An arrangement follows from the box, the radii and the seed, bit for bit, whatever
//! the number of threads. No two grains overlap, and no grain reaches through a wall.

mod even;
mod fault;
mod insertion;
mod lattice;
mod levels;
mod packing;
mod region;
mod relaxation;
mod shaking;
mod sizes;
#[cfg(test)]
mod tests;

pub use even::even;
pub use fault::Fault;
pub use lattice::lattice;
pub use packing::{largest_solids_fraction, packed, random};
pub use region::{Dimensions, Region};
pub use sizes::spread;

/// Gap kept between grains, and between grains and walls, over the sum of radii [-]: far above
/// rounding, so that nobody who computes the overlap in another way finds one, and far below physics.
const CLEARANCE: f64 = 1e-9;
