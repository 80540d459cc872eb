//! Values to judge against: analytic solutions and published data. Shares nothing with the simulator.

use serde_json::Value;

/// What a reference may know of a run.
pub struct Facts<'a> {
    /// Canonical settings of the scene: `{"single_sphere": {…}}`.
    pub settings: &'a Value,
    /// Scalars the run measured, by name (a lattice's true porosity, say).
    pub scalars: &'a dyn Fn(&str) -> Option<f64>,
}

/// A reference value or curve with its origin.
#[derive(Clone, Debug, PartialEq)]
pub struct Expected {
    /// One value, or one per time asked for.
    pub values: Vec<f64>,
    pub unit: &'static str,
    /// Citation with equation.
    pub source: String,
}

#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct ReferenceError(pub String);

/// A line of `kynch list`.
pub struct Entry {
    pub name: &'static str,
    pub meaning: &'static str,
    pub source: &'static str,
}

/// A scalar reference by name.
pub fn scalar(_name: &str, _facts: &Facts) -> Result<Expected, ReferenceError> {
    todo!()
}

/// A reference curve by name, at the given abscissae (times [s], mostly).
pub fn series(_name: &str, _facts: &Facts, _at: &[f64]) -> Result<Expected, ReferenceError> {
    todo!()
}

/// Every reference there is.
pub fn list() -> Vec<Entry> {
    todo!()
}
