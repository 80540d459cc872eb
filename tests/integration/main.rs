//! One binary for all integration tests.

mod crash;
mod readers;
mod rehearsals;
mod runner;
mod store;
