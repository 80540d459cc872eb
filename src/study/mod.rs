//! From a YAML file to a [`Study`](model::Study): parse, check, expand.

mod assemble;
mod axes;
mod faults;
mod file;
pub mod model;
mod names;
mod nearest;
mod path;
mod plan;
mod problem;
mod shape;
mod spec;
mod statements;
mod units;
mod work;
mod yaml;

pub use assemble::parse;
pub use file::{Entry, find, list, load, scenes};
pub use problem::{Problem, StudyError};

/// A number with a unit (`2 mm`) in SI units; nothing for any other text.
pub fn quantity(text: &str) -> Option<f64> {
    units::parse(text).ok().map(|measured| measured.value)
}

/// JSON Schema of a study file.
pub fn schema() -> serde_json::Value {
    spec::schema()
}
