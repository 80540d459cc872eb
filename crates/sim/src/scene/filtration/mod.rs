//! A suspension flows through a filter medium; its grains form a cake.

mod cake;
mod feeder;
mod model;
mod observables;
mod operation;
mod outcome;
mod run;
mod start;
mod surface;
mod watch;

pub use model::{
    CakeLength, CakePermeability, Crossflow, Deposited, Feed, Filtrate, Filtration, Held, Resistance,
};

pub(super) use observables::observables;
pub(super) use run::run;

use super::Description;
use super::check::List;

pub(super) fn check(_: &Filtration, _: &mut List) {}

pub(super) fn describe(_: &Filtration) -> Description {
    Description::default()
}
