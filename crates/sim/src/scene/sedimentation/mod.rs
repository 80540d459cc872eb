//! Many grains settle onto the floor of a box.

mod check;
mod describe;
mod floor;
mod growth;
mod interior;
mod model;
mod observables;
mod observe;
mod population;
mod room;
mod run;
mod settling;
mod snapshot;
mod start;
mod step;
mod warnings;

pub use model::{
    Arrangement, Charge, Cohesion, Container, Detection, Dimensions, Floor, FloorGrains, GrainClass,
    GrainDrag, Lift, Placed, Sedimentation, Sides, SlicePorosity, Snapshot, StillFluid, Until, Voidage,
};

pub(super) use check::check;
pub(super) use describe::describe;
pub(super) use observables::observables;
pub(super) use run::run;

#[cfg(test)]
mod tests;
