//! Runs the points of a plan that have no result yet.

use std::time::Duration;

use crate::store::model::PointId;
use crate::store::{Store, StoreError};
use crate::study::model::{AxisValue, Point, Study};

/// What the command line may ask of a run.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Points at a time; `None` takes the cores there are.
    pub jobs: Option<usize>,
    /// Only points with these axis (or scene, or parameter) values.
    pub only: Vec<(String, AxisValue)>,
    /// At most so many of the due points.
    pub limit: Option<usize>,
    /// Seeds 1..=N in place of the study's.
    pub seeds: Option<u64>,
    pub timeout: Option<Duration>,
    /// Memory limit per point [bytes].
    pub memory: Option<u64>,
    /// Stop starting points after so many failures.
    pub max_failures: Option<usize>,
    /// Run points again though they are finished.
    pub fresh: bool,
}

/// A point of the plan beside the store.
#[derive(Clone, Debug)]
pub struct Planned {
    pub point: Point,
    pub id: PointId,
    pub state: State,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum State {
    /// Finished before; nothing to do.
    Cached,
    /// Will run, with the reason in words.
    Due(String),
    /// Left out by the options, with the reason in words.
    LeftOut(String),
}

/// What a run of a study did.
#[derive(Clone, Debug, Default)]
pub struct Summary {
    pub cached: usize,
    pub completed: usize,
    /// Label and reason of each point that did not complete.
    pub failed: Vec<(String, String)>,
    /// Points that never ran (limit, too many failures, interrupted).
    pub not_run: usize,
    pub interrupted: bool,
}

#[derive(Debug, thiserror::Error)]
pub enum RunError {
    #[error("{0}")]
    Input(String),
    #[error(transparent)]
    Store(#[from] StoreError),
}

/// Identity of a point.
pub fn identify(_point: &Point) -> PointId {
    todo!()
}

/// Every point of the study beside what the store holds, in plan order.
pub fn survey(_study: &Study, _store: &Store, _options: &Options) -> Result<Vec<Planned>, RunError> {
    todo!()
}

/// Runs what is due, in parallel, and keeps each result at once.
pub fn run(_study: &Study, _store: &Store, _options: &Options) -> Result<Summary, RunError> {
    todo!()
}
