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
mod published;
mod shape;
mod spec;
mod statements;
mod units;
mod work;
mod yaml;

pub use assemble::parse;
pub use file::{Entry, derivations, expectations, figures, find, list, load, scenes};
pub use problem::{Problem, StudyError};

/// A number with a unit (`2 mm`) in SI units; nothing for any other text.
pub fn quantity(text: &str) -> Option<f64> {
    units::parse(text).ok().map(|measured| measured.value)
}

/// Whether two quantities given by their SI units can be compared.
///
/// # Errors
/// Both dimensions in words, when they differ.
pub fn comparable(of: &str, reference: &str) -> Result<(), (String, String)> {
    match (units::dimension(of), units::dimension(reference)) {
        (Some(one), Some(other)) if one == other => Ok(()),
        (Some(one), Some(other)) => Err((one.to_string(), other.to_string())),
        _ if of == reference => Ok(()),
        _ => Err((format!("in {of}"), format!("in {reference}"))),
    }
}

/// JSON Schema of a study file.
pub fn schema() -> serde_json::Value {
    spec::schema()
}
