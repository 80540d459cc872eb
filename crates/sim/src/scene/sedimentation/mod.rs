//! Many grains settle onto the floor of a box.

pub(super) mod check;
pub(super) mod describe;
pub(super) mod floor;
pub(super) mod growth;
pub(super) mod interior;
pub(super) mod model;
pub(super) mod mover;
pub(super) mod observables;
pub(super) mod observe;
pub(super) mod population;
pub(super) mod room;
pub(super) mod run;
pub(super) mod settling;
pub(super) mod snapshot;
pub(super) mod start;
pub(super) mod step;
pub(super) mod warnings;

pub use model::{
    Arrangement, Charge, Cohesion, Container, Detection, Dimensions, Floor, FloorGrains, GrainClass,
    GrainDrag, Lift, Placed, Sedimentation, Sides, SlicePorosity, Snapshot, StillFluid, Until, Voidage,
};

pub(super) use check::{check, class_path, time_step};
pub(super) use describe::{ROW_MEMORY, describe};
pub(super) use observables::observables;
pub(super) use run::run;
pub(super) use start::start;
pub(super) use step::{Limits, limits};

#[cfg(test)]
mod tests;
