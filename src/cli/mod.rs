//! What was typed, what it means, and what is said about it.

pub mod actions;
pub mod arguments;
pub mod command;
pub mod console;
pub mod extract;
pub mod status;

mod estimate;
mod list;
mod magnitude;
mod physics;
mod plan;
mod selection;
mod table;
mod verdicts;

#[cfg(test)]
mod example;

pub use list::list;
