//! A suspension flows through a filter medium; its grains form a cake.

mod model;
mod observables;

pub use model::{
    CakeLength, CakePermeability, Crossflow, Deposited, Feed, Filtrate, Filtration, Held, Resistance,
};

pub(super) use observables::observables;

use super::Description;
use super::check::List;
use crate::outcome::{Control, Failure, Outcome};

pub(super) fn check(_: &Filtration, _: &mut List) {}

pub(super) fn describe(_: &Filtration) -> Description {
    Description::default()
}

pub(super) fn run(_: &Filtration, _: &Control) -> Result<Outcome, Box<Failure>> {
    Ok(Outcome::default())
}
