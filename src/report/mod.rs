//! From runs and verdicts to pages and figures.

use std::path::{Path, PathBuf};

use crate::judge::model::Verdict;
use crate::store::model::Run;
use crate::study::model::Study;

#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct ReportError(pub String);

/// Writes `index.html`, `report.md`, `verdicts.json`, `junit.xml` and the figures into `out`
/// (`reports/<study>/`); gives back the path of `index.html`.
pub fn render(
    _study: &Study,
    _runs: &[Run],
    _verdicts: &[Verdict],
    _out: &Path,
) -> Result<PathBuf, ReportError> {
    todo!()
}
