//! A fixed number of threads, each taking the next point until none is left. A point that keeps
//! several threads busy takes as many of the jobs.

use std::collections::VecDeque;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;

use super::cores::Cores;
use super::interrupt::Watch;
use super::point::{Limits, estimate, execute};
use super::progress::Progress;
use super::survey::ending;
use super::{Planned, RunError, label};
use crate::store::model::{Run, Status};
use crate::store::{Store, StoreError};

/// Stack of a worker: scenes may recurse over trees of cells.
const STACK: usize = 8 << 20;

pub(super) struct Pool<'a> {
    pub study: &'a str,
    pub store: &'a Store,
    pub jobs: usize,
    pub limits: Limits,
    pub max_failures: Option<usize>,
}

/// What came of the points.
#[derive(Default)]
pub(super) struct Tally {
    pub completed: usize,
    /// Place in the plan, label and reason.
    pub failed: Vec<(usize, String, String)>,
    pub interrupted: bool,
    error: Option<StoreError>,
}

struct Shared<'a> {
    queue: Mutex<VecDeque<(usize, &'a Planned)>>,
    tally: Mutex<Tally>,
    cores: Cores,
    watch: Watch,
    progress: Progress,
}

impl Pool<'_> {
    /// Runs the points, those with most work first, and keeps each result as soon as it is there.
    ///
    /// # Errors
    /// The first result that could not be kept; the points in flight are finished nevertheless.
    pub fn run(&self, due: &[&Planned]) -> Result<Tally, RunError> {
        let mut queue: Vec<(f64, &Planned)> = due
            .iter()
            .map(|planned| (estimate(&planned.point.work).work, *planned))
            .collect();
        queue.sort_by(|one, other| other.0.total_cmp(&one.0));
        let shared = Shared {
            progress: Progress::start(queue.iter().map(|(work, _)| *work).collect()),
            queue: Mutex::new(
                queue
                    .into_iter()
                    .map(|(_, planned)| planned)
                    .enumerate()
                    .collect(),
            ),
            tally: Mutex::default(),
            cores: Cores::new(self.jobs),
            watch: Watch::start(),
        };
        let spawned = thread::scope(|scope| {
            let work = || while self.step(&shared) {};
            for _ in 0..self.jobs.min(due.len()) {
                thread::Builder::new()
                    .stack_size(STACK)
                    .spawn_scoped(scope, work)?;
            }
            Ok::<(), std::io::Error>(())
        });
        shared.progress.end();
        let mut tally = shared.tally.into_inner().unwrap_or_else(PoisonError::into_inner);
        tally.interrupted = shared.watch.interrupted();
        tally.failed.sort();
        spawned.map_err(|error| {
            RunError::Input(format!(
                "cannot start {} threads: {error}\n  help: lower --jobs",
                self.jobs
            ))
        })?;
        match tally.error.take() {
            Some(error) => Err(error.into()),
            None => Ok(tally),
        }
    }

    /// Runs the next point; false when there is none to start.
    fn step(&self, shared: &Shared) -> bool {
        if shared.watch.interrupted() || self.given_up(&lock(&shared.tally)) {
            return false;
        }
        let interrupted = || shared.watch.interrupted();
        let mut queue = lock(&shared.queue);
        let Some((place, planned)) = queue.pop_front() else {
            return false;
        };
        // The queue waits with the point, or small points would keep a large one waiting.
        let _taken = shared.cores.take(planned.point.work.threads());
        drop(queue);
        if interrupted() {
            return false;
        }
        let progress = |fraction| shared.progress.advance(place, fraction);
        if let Some(run) = execute(self.study, planned, self.limits, &interrupted, &progress) {
            self.keep(planned, &run, shared);
            shared.progress.finish(place, planned, &run);
        }
        true
    }

    fn given_up(&self, tally: &Tally) -> bool {
        let too_many = self
            .max_failures
            .is_some_and(|most| tally.failed.len() >= most.max(1));
        tally.error.is_some() || too_many
    }

    fn keep(&self, planned: &Planned, run: &Run, shared: &Shared) {
        let kept = self.store.append(run);
        let mut tally = lock(&shared.tally);
        match kept {
            Err(error) => drop(tally.error.get_or_insert(error)),
            Ok(()) if run.status == Status::Completed => tally.completed += 1,
            Ok(()) => {
                let point = &planned.point;
                tally.failed.push((point.index, label(point), ending(run)));
            }
        }
    }
}

/// A worker never panics while it holds one of these.
fn lock<Value>(mutex: &Mutex<Value>) -> MutexGuard<'_, Value> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
