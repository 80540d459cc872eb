//! Homogeneous suspensions that settle.

mod bed;
mod check;
mod column;
mod describe;
mod model;
mod observables;
mod observe;
mod particles;
mod profile;
mod run;
mod sph;
mod terminal;
mod watch;

pub use model::{Homogeneity, SoftContact, SuspendedClass, SuspendingFluid, Suspension};

pub(super) use check::check;
pub(super) use describe::describe;
pub(super) use observables::observables;
pub(super) use observe::MOST_CLASSES;
pub(super) use run::run;
