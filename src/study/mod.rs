//! From a YAML file to a [`Study`](model::Study): parse, check, expand.

pub mod model;

use std::path::{Path, PathBuf};

use model::Study;

/// Everything wrong with a study file, all at once. Renders with `miette`.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct StudyError(pub String);

/// A line of `kynch list`.
pub struct Entry {
    pub name: String,
    pub meaning: String,
}

/// The file behind a study name: `studies/NAME.yaml`, or the path itself when it is one.
pub fn find(_name: &str) -> Result<PathBuf, StudyError> {
    todo!()
}

/// Parses, checks and expands a study file.
pub fn load(_path: &Path) -> Result<Study, StudyError> {
    todo!()
}

/// Every study below `studies/`, with its question.
pub fn list() -> Vec<Entry> {
    todo!()
}

/// Every scene a study may name, with one line each.
pub fn scenes() -> Vec<Entry> {
    todo!()
}

/// A number with a unit (`2 mm`) in SI units; nothing for any other text.
pub fn quantity(_text: &str) -> Option<f64> {
    todo!()
}

/// JSON Schema of a study file.
pub fn schema() -> serde_json::Value {
    todo!()
}
