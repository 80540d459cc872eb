//! Runs the points of a plan that have no result yet.

mod clock;
mod cores;
mod interrupt;
mod memory;
mod panics;
mod point;
mod pool;
mod progress;
mod rehearsal;
mod survey;

use std::collections::HashSet;
use std::time::Duration;

use crate::store::model::{PointId, Provenance};
use crate::store::{Store, StoreError, canonical};
use crate::study::model::{AxisValue, Point, Study, Work};

/// What the command line may ask of a run.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Threads at a time: points, each counted with the threads it keeps busy; `None` takes the cores
    /// there are.
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

/// Changes whenever the meaning of stored results does: all points are due again then.
const SCHEMA: u32 = 1;

/// Identity of a point: BLAKE3 of its canonical settings (which name the kind of scene), its seed,
/// the simulator's sources and the schema of the results. A rehearsal does not depend on the
/// simulator.
pub fn identify(point: &Point) -> PointId {
    let simulator = match point.work {
        Work::Simulation(_) => Provenance::simulator_hash(),
        Work::Rehearsal(_) => "none",
    };
    let settings = canonical(&point.settings);
    let text = format!(
        "schema {SCHEMA}\nsimulator {simulator}\nseed {}\n{settings}",
        point.seed
    );
    PointId(blake3::hash(text.as_bytes()).to_hex().to_string())
}

/// A point in words: scene, axes, seed.
pub fn label(point: &Point) -> String {
    let axes = point
        .axes
        .iter()
        .map(|(name, value)| format!(" {name}={}", survey::words(value)));
    format!("{}{} seed={}", point.scene, axes.collect::<String>(), point.seed)
}

/// Every point of the study beside what the store holds, in plan order.
///
/// # Errors
/// [`RunError::Input`] when the options select nothing.
pub fn survey(study: &Study, store: &Store, options: &Options) -> Result<Vec<Planned>, RunError> {
    let mut planned = survey::classify(study, store, options)?;
    survey::apply_limit(&mut planned, options.limit);
    Ok(planned)
}

/// Runs what is due, in parallel, and keeps each result at once.
///
/// # Errors
/// [`RunError::Input`] when the options select nothing, [`RunError::Store`] when a result cannot be
/// kept. A point that fails is no error: it is a row with its reason.
pub fn run(study: &Study, store: &Store, options: &Options) -> Result<Summary, RunError> {
    let jobs = match options.jobs {
        Some(0) => {
            return Err(RunError::Input(
                "--jobs 0 runs nothing\n  help: give 1 or more".into(),
            ));
        }
        Some(jobs) => jobs,
        None => std::thread::available_parallelism().map_or(1, usize::from),
    };
    let mut planned = survey::classify(study, store, options)?;
    let due = |planned: &Planned| matches!(planned.state, State::Due(_));
    let wanted: HashSet<PointId> = planned
        .iter()
        .filter(|at| due(at))
        .map(|at| at.id.clone())
        .collect();
    let cached = planned
        .iter()
        .filter(|planned| planned.state == State::Cached)
        .count();
    mark_twins(&mut planned);
    survey::apply_limit(&mut planned, options.limit);
    let due: Vec<&Planned> = planned.iter().filter(|planned| due(planned)).collect();
    store.set_axis_units(
        study
            .axes
            .iter()
            .map(|axis| (axis.name.as_str(), axis.unit.as_str())),
    );
    progress::announce(&planned);
    let pool = pool::Pool {
        study: &study.name,
        store,
        jobs,
        limits: point::Limits {
            timeout: options.timeout,
            memory: options.memory,
        },
        max_failures: options.max_failures,
    };
    let tally = pool.run(&due)?;
    store.compact()?;
    Ok(Summary {
        cached,
        completed: tally.completed,
        not_run: wanted.len() - tally.completed - tally.failed.len(),
        failed: tally
            .failed
            .into_iter()
            .map(|(_, label, reason)| (label, reason))
            .collect(),
        interrupted: tally.interrupted,
    })
}

/// Two places of a plan may hold the same point: it runs once.
fn mark_twins(planned: &mut [Planned]) {
    let mut seen = HashSet::new();
    for planned in planned
        .iter_mut()
        .filter(|planned| matches!(planned.state, State::Due(_)))
    {
        if !seen.insert(planned.id.clone()) {
            planned.state = State::LeftOut("the same point as an earlier one".into());
        }
    }
}
