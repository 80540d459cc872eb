//! One point, from its settings to a row, whatever happens on the way.

use std::cell::Cell;
use std::time::{Duration, Instant};

use kynch_sim::outcome::{Control, Counters, Failure, FailureKind, Outcome};

use super::{Planned, clock, memory, panics, rehearsal};
use crate::store::model::{Column, Provenance, Run, Scalar, Status, Table, Timing};
use crate::study::model::Work;

/// What a point may use.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Limits {
    pub timeout: Option<Duration>,
    /// [bytes]
    pub memory: Option<u64>,
}

/// What a point is expected to use.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Estimate {
    /// In units that compare points of one study.
    pub work: f64,
    /// [bytes]
    pub memory: u64,
}

pub(super) fn estimate(work: &Work) -> Estimate {
    match work {
        Work::Simulation(scene) => {
            let description = kynch_sim::scene::describe(scene);
            Estimate {
                work: description.work,
                memory: description.memory,
            }
        }
        Work::Rehearsal(scene) => Estimate {
            work: scene.delay,
            memory: 0,
        },
    }
}

/// Why a run was told to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Stop {
    Timeout(Duration),
    /// [bytes]
    Memory(u64),
    Interrupt,
}

/// Runs the point; `None` when it was interrupted, for then there is nothing to keep.
pub(super) fn execute(
    study: &str,
    planned: &Planned,
    limits: Limits,
    interrupted: &dyn Fn() -> bool,
    progress: &dyn Fn(f64),
) -> Option<Run> {
    let mut run = blank(study, planned);
    let start = (Instant::now(), clock::thread_time());
    memory::restart();
    let cause = Cell::new(None);
    let stop = || {
        cause.set(
            cause
                .get()
                .or_else(|| reason_to_stop(limits, start.0, interrupted)),
        );
        cause.get().is_some()
    };
    let split = Cell::new(Vec::new());
    let control = Control {
        stop: &stop,
        progress,
        split: &|parts| split.set(parts.to_vec()),
    };
    let work = &planned.point.work;
    match limits.memory.map(|limit| (limit, estimate(work).memory)) {
        Some((limit, needed)) if needed > limit => {
            let reason = format!(
                "needs about {}, the limit is {}",
                mebibytes(needed),
                mebibytes(limit)
            );
            end(&mut run, Status::OutOfMemory, reason);
        }
        _ => finish(&mut run, panics::caught(|| compute(work, &control)), cause.get())?,
    }
    run.timing = Timing {
        wall: start.0.elapsed().as_secs_f64(),
        cpu: clock::thread_time().saturating_sub(start.1).as_secs_f64(),
        peak_memory: memory::peak(),
        split: split
            .take()
            .into_iter()
            .map(|(part, time)| (part.to_owned(), time))
            .collect(),
        provenance: Provenance::current(),
    };
    Some(run)
}

fn compute(work: &Work, control: &Control) -> Result<Outcome, Box<Failure>> {
    match work {
        Work::Simulation(scene) => kynch_sim::scene::run(scene, control),
        Work::Rehearsal(scene) => rehearsal::run(scene, control),
    }
}

fn reason_to_stop(limits: Limits, start: Instant, interrupted: &dyn Fn() -> bool) -> Option<Stop> {
    if interrupted() {
        return Some(Stop::Interrupt);
    }
    let late = limits
        .timeout
        .filter(|limit| start.elapsed() >= *limit)
        .map(Stop::Timeout);
    late.or_else(|| {
        limits
            .memory
            .filter(|limit| memory::peak() > *limit)
            .map(Stop::Memory)
    })
}

/// Writes down how the computation ended; `None` when it was interrupted.
fn finish(
    run: &mut Run,
    result: Result<Result<Outcome, Box<Failure>>, String>,
    cause: Option<Stop>,
) -> Option<()> {
    match result {
        Err(panic) => end(run, Status::Panicked, panic),
        Ok(Ok(outcome)) => keep(run, outcome),
        Ok(Err(failure)) => match (failure.kind, cause) {
            (FailureKind::Diverged, _) => {
                end(run, Status::Diverged, failure.reason);
                keep(run, failure.partial);
            }
            // How far it came before these depends on the machine: not a result.
            (FailureKind::Stopped, Some(Stop::Timeout(limit))) => {
                let reason = format!("not finished within the limit of {} s", limit.as_secs_f64());
                end(run, Status::TimedOut, reason);
            }
            (FailureKind::Stopped, Some(Stop::Memory(limit))) => {
                let reason = format!("took more than the limit of {}", mebibytes(limit));
                end(run, Status::OutOfMemory, reason);
            }
            (FailureKind::Stopped, Some(Stop::Interrupt) | None) => return None,
        },
    }
    Some(())
}

fn end(run: &mut Run, status: Status, reason: String) {
    run.status = status;
    run.reason = Some(reason);
}

fn mebibytes(bytes: u64) -> String {
    format!("{:.1} MiB", bytes as f64 / f64::from(1 << 20))
}

fn blank(study: &str, planned: &Planned) -> Run {
    let point = &planned.point;
    Run {
        id: planned.id.clone(),
        study: study.to_string(),
        scene: point.scene.clone(),
        axes: point.axes.clone(),
        seed: point.seed,
        settings: point.settings.clone(),
        status: Status::Completed,
        reason: None,
        scalars: Vec::new(),
        counters: Vec::new(),
        tables: Vec::new(),
        derived: Vec::new(),
        timing: Timing::default(),
    }
}

/// What the simulator computed, in the nouns of the store.
fn keep(run: &mut Run, outcome: Outcome) {
    let scalar = |scalar: kynch_sim::outcome::Scalar| Scalar {
        name: scalar.name.to_string(),
        unit: scalar.unit.to_string(),
        value: scalar.value,
    };
    run.scalars = outcome.scalars.into_iter().map(scalar).collect();
    run.tables = outcome.tables.into_iter().map(table).collect();
    run.counters = counters(outcome.counters);
}

fn table(table: kynch_sim::outcome::Table) -> Table {
    // A run that failed between two columns may leave them of unequal length.
    let length = table
        .columns
        .iter()
        .map(|column| column.values.len())
        .min()
        .unwrap_or(0);
    let column = |column: kynch_sim::outcome::Column| Column {
        name: column.name.to_string(),
        unit: column.unit.to_string(),
        values: column.values.into_iter().take(length).collect(),
    };
    Table {
        name: table.name.to_string(),
        columns: table.columns.into_iter().map(column).collect(),
    }
}

fn counters(counters: Counters) -> Vec<(String, u64)> {
    // Taken apart by name, so that a new counter cannot be forgotten here.
    let Counters {
        steps,
        grain_steps,
        fluid_pairs,
        coupling_pairs,
        list_rebuilds,
        grain_pairs,
        searched_pairs,
        porosity_clips,
    } = counters;
    let named = [
        ("steps", steps),
        ("grain_steps", grain_steps),
        ("fluid_pairs", fluid_pairs),
        ("coupling_pairs", coupling_pairs),
        ("list_rebuilds", list_rebuilds),
        ("grain_pairs", grain_pairs),
        ("searched_pairs", searched_pairs),
        ("porosity_clips", porosity_clips),
    ];
    named
        .into_iter()
        .map(|(name, value)| (name.to_string(), value))
        .collect()
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;

    use super::*;
    use crate::runner::State;
    use crate::store::model::PointId;
    use crate::study::model::{Point, Rehearsal, RehearsalEnding};

    fn planned() -> Planned {
        let work = Work::Rehearsal(Rehearsal {
            limit: 1.0,
            time_constant: 1.0,
            duration: 1.0,
            samples: 3,
            scale: 1.0,
            order: 1.0,
            error: 0.0,
            grains: 0,
            delay: 20.0,
            ending: RehearsalEnding::Completes,
        });
        let settings = serde_json::json!({});
        let point = Point {
            index: 0,
            scene: "scene".into(),
            axes: vec![],
            seed: 1,
            settings,
            work,
        };
        Planned {
            point,
            id: PointId("id".into()),
            state: State::Due("a test".into()),
        }
    }

    #[test]
    fn a_run_that_takes_too_much_memory_is_stopped() {
        let taken = RefCell::new(Vec::new());
        let take = |_| taken.borrow_mut().push(vec![1_u8; 1 << 20]);
        let limits = Limits {
            memory: Some(3 << 20),
            ..Limits::default()
        };
        let run = execute("study", &planned(), limits, &|| false, &take).unwrap();
        assert_eq!(run.status, Status::OutOfMemory);
        assert_eq!(run.reason.as_deref(), Some("took more than the limit of 3.0 MiB"));
        assert!((3..6).contains(&taken.borrow().len()));
    }

    #[test]
    fn an_interrupted_run_leaves_nothing() {
        let run = execute("study", &planned(), Limits::default(), &|| true, &|_| {});
        assert_eq!(run, None);
    }
}
