//! Two grains, or a grain and a flat wall, from first touch to separation.

mod check;
mod describe;
mod model;
mod observables;
mod pair;
mod run;
mod setup;

pub use model::{BinaryCollision, IntegratorChoice, Material, Normal, Partner, Rolling, Tangential};

pub(super) use check::{check, check_laws};
pub(super) use describe::{describe, describe_laws, integrator};

pub(super) use observables::observables;
pub(super) use run::run;

#[cfg(test)]
mod tests;
