//! From runs and references to verdicts.

pub mod model;

use crate::store::model::Run;
use crate::study::model::Study;
use model::Verdict;

/// Judges every expectation of the study on its completed runs.
pub fn judge(_study: &Study, _runs: &[Run]) -> Vec<Verdict> {
    todo!()
}
