//! Many grains settle onto the floor of a box.

mod check;
mod describe;
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
    Arrangement, Charge, Cohesion, Container, Detection, Dimensions, Floor, GrainClass, GrainDrag, Lift,
    Placed, Sedimentation, Sides, SlicePorosity, Snapshot, StillFluid, Until, Voidage,
};

pub(super) use check::{check, class_path, time_step};
pub(super) use describe::{ROW_MEMORY, describe};
pub(super) use observables::observables;
pub(super) use run::run;
pub(super) use start::start;
pub(super) use step::{Limits, limits};

#[cfg(test)]
mod tests;
