//! A suspension flows through a filter medium; its grains form a cake.

mod cake;
mod check;
mod describe;
mod feeder;
mod model;
mod observables;
mod operation;
mod outcome;
mod run;
mod series;
mod start;
mod surface;
mod watch;

pub use model::{
    CakeLength, CakePermeability, Crossflow, Deposited, Feed, Filtrate, Filtration, Held, Resistance,
};

pub(super) use check::check;
pub(super) use describe::describe;
pub(super) use observables::observables;
pub(super) use run::run;

#[cfg(test)]
mod tests;
