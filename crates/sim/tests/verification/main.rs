//! What the simulator must show: closed forms, observed orders, conservation, failures, bit identity.

mod beads;
mod beds;
mod coupled;
mod failures;
mod hydrostatics;
mod mixtures;
mod momentum;
mod orders;
mod reproducibility;
mod rest;
mod scenes;
mod settling;
mod waves;
mod work;
