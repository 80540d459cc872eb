//! What the simulator must show: closed forms, observed orders, conservation, failures, bit identity.

mod beads;
mod coupled;
mod failures;
mod hydrostatics;
mod momentum;
mod orders;
mod reproducibility;
mod rest;
mod scenes;
mod settling;
mod waves;
mod work;
