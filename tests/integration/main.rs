//! One binary for all integration tests.

mod architecture;
mod bad_inputs;
mod cli;
mod crash;
mod filtration;
mod readers;
mod rehearsals;
mod runner;
mod sedimentation;
mod store;
mod studies;
mod suspension;
