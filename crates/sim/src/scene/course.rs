//! The course of a run that is recorded row by row.

use crate::bed::Bed;
use crate::outcome::{Control, Counters, Failure, FailureKind, Outcome};

/// Rows of a time series at least.
const FEWEST_ROWS: f64 = 100.0;
/// Time between two rows [s] where the duration allows for it.
const ROW: f64 = 5e-3;

/// A run under way, with its record.
pub trait Recorded {
    /// Steps between two questions whether to stop.
    fn patience(&self) -> u64;

    /// Goes on by so many steps after those that are `done`.
    ///
    /// # Errors
    /// Why the state can no longer be trusted.
    fn advance(&mut self, done: u64, steps: u64) -> Result<(), String>;

    /// Takes a row after so many steps.
    fn look(&mut self, done: u64);

    /// Why the run makes no sense any more, by its last row.
    fn diverged(&self) -> Option<String>;

    /// Whether nothing that is asked for will happen any more.
    fn is_over(&self) -> bool;

    fn outcome(&mut self) -> Outcome;

    /// What the run spent its time on so far [s], by name.
    fn split_of_time(&self) -> Vec<(&'static str, f64)> {
        Vec::new()
    }
}

/// Follows a run of so many steps over its `duration` [s] to its end, with `most_rows` at most.
///
/// # Errors
/// A run that diverges or is stopped; it keeps what was computed.
pub fn follow(
    mut run: impl Recorded,
    duration: f64,
    steps: u64,
    most_rows: f64,
    control: &Control,
) -> Result<Outcome, Box<Failure>> {
    // No row without a step since the last one.
    let rows = (duration / ROW)
        .ceil()
        .clamp(FEWEST_ROWS, most_rows)
        .min(steps as f64);
    run.look(0);
    let mut done = 0;
    for row in 1..=rows as u64 {
        let target = (row as f64 / rows * steps as f64).round() as u64;
        while done < target {
            let batch = (target - done).min(run.patience());
            if let Err(reason) = run.advance(done, batch) {
                return Err(failed(FailureKind::Diverged, reason, run.outcome()));
            }
            done += batch;
            if (control.stop)() {
                let reason = "stopped from outside".to_owned();
                return Err(failed(FailureKind::Stopped, reason, run.outcome()));
            }
        }
        run.look(done);
        if let Some(reason) = run.diverged() {
            return Err(failed(FailureKind::Diverged, reason, run.outcome()));
        }
        (control.progress)(row as f64 / rows);
        if run.is_over() {
            break;
        }
    }
    (control.split)(&run.split_of_time());
    Ok(run.outcome())
}

/// A run that ends early, with what it has computed.
pub fn failed(kind: FailureKind, reason: String, partial: Outcome) -> Box<Failure> {
    Box::new(Failure {
        kind,
        reason,
        partial,
    })
}

/// A run that cannot begin because its grains do not find room.
pub fn without_room(fault: &crate::arrangement::Fault) -> Box<Failure> {
    let reason = format!("the grains do not find room: {fault}; {}", fault.help());
    failed(FailureKind::Diverged, reason, Outcome::default())
}

/// Work of a bed whose fluid is not solved for.
pub fn work_of(bed: &Bed) -> Counters {
    let work = &bed.work;
    Counters {
        steps: work.steps,
        grain_steps: work.steps,
        grain_pairs: work.pairs,
        searched_pairs: work.looked_at,
        list_rebuilds: work.lists,
        porosity_clips: bed.porosity.as_ref().map_or(0, |porosity| porosity.clips()),
        ..Counters::default()
    }
}
