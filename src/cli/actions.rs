//! What the commands do, each in the words of the rooms it passes through.

use std::fmt;
use std::path::Path;

use super::arguments::Reporting;
use super::command::Job;
use super::console::Console;
use super::estimate::Rate;
use super::status::{Problem, Status};
use super::{physics, plan, verdicts};
use crate::judge::{derive::derive, judge};
use crate::runner::{self, Options, State, survey};
use crate::store::{self, Store, StoreError};
use crate::study::model::{Point, Study};
use crate::{report, study};

/// How far a study is, among the points that `--only` leaves in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    pub completed: usize,
    /// Diverged where an expectation takes that for an answer.
    pub diverged: usize,
    pub failed: usize,
    pub missing: usize,
}

/// Does something with each study of a job, its store opened. Nothing starts before all studies are
/// read and the selection has points in each; the first problem ends it, after what went before.
///
/// # Errors
/// Whatever is wrong before the first study starts.
pub fn for_each(
    console: &Console,
    job: &Job,
    open: fn(&Path) -> Result<Store, StoreError>,
    act: impl Fn(Study, &Store, &Options) -> Result<Status, Problem>,
) -> Result<Status, Problem> {
    let studies = load(console, &job.names)?;
    let store = open(&job.store)?;
    for study in &studies {
        survey(study, &store, &job.options)?;
    }
    let mut worst = Status::Held;
    for study in studies {
        match act(study, &store, &job.options) {
            Ok(status) => worst = worst.max(status),
            Err(problem) => {
                console.complain_about(&problem);
                return Ok(worst.max(problem.status()));
            }
        }
    }
    Ok(worst)
}

/// Reads all studies, and tells what is wrong with every one that cannot be read.
///
/// # Errors
/// The last of the problems; the others are told at once.
pub fn load(console: &Console, names: &[String]) -> Result<Vec<Study>, Problem> {
    let mut studies = Vec::new();
    let mut problems = Vec::new();
    for name in names {
        match study::find(name).and_then(|path| study::load(&path)) {
            Ok(study) => studies.push(study),
            Err(error) => problems.push(Problem::Study(error)),
        }
    }
    let Some(last) = problems.pop() else {
        return Ok(studies);
    };
    problems
        .iter()
        .for_each(|problem| console.complain_about(problem));
    Err(last)
}

/// Shows the plan of a study.
///
/// # Errors
/// When the selection is empty or the store cannot be read.
pub fn show_plan(
    console: &Console,
    study: &Study,
    store: &Store,
    options: &Options,
) -> Result<Status, Problem> {
    let planned = survey(study, store, options)?;
    let points: Vec<&Point> = planned.iter().map(|planned| &planned.point).collect();
    let nothing_due = !planned
        .iter()
        .any(|planned| matches!(planned.state, State::Due(_)));
    let rate = if nothing_due {
        Rate::DEFAULT
    } else {
        Rate::of_machine(&points, store)
    };
    let cores = || std::thread::available_parallelism().map_or(1, |cores| cores.get());
    let workers = options.jobs.unwrap_or_else(cores);
    console.say(&plan::plan(study, &planned, rate, workers, console.paint))?;
    Ok(Status::Held)
}

/// Runs what is due of a study.
///
/// # Errors
/// When the selection is empty, the store fails, or the run was interrupted.
pub fn run(console: &Console, study: &Study, store: &Store, options: &Options) -> Result<Status, Problem> {
    let summary = runner::run(study, store, options)?;
    let paint = console.paint;
    let mut text = String::new();
    for (label, reason) in &summary.failed {
        text.push_str(&format!("{} {label}: {reason}\n", paint.red("✗")));
    }
    text.push_str(&format!(
        "{}: {} cached, {} completed, {} failed, {} not run\n",
        paint.bold(&study.name),
        summary.cached,
        summary.completed,
        summary.failed.len(),
        summary.not_run
    ));
    console.say(&text)?;
    if summary.interrupted {
        return Err(Problem::Interrupted);
    }
    Ok(Tally::of(study, store, options)?.status())
}

/// Judges a study on what the store holds of it, and writes its report.
///
/// # Errors
/// When the store cannot be read or the report cannot be written.
pub fn make_report(
    console: &Console,
    mut study: Study,
    store: &Store,
    options: &Options,
    reporting: &Reporting,
) -> Result<Status, Problem> {
    let tally = Tally::of(&study, store, options)?;
    // With `--seeds` the points differ from the file's; judge and report see those that count.
    let whole = Options {
        seeds: options.seeds,
        ..Options::default()
    };
    let planned = survey(&study, store, &whole)?;
    let ids: Vec<_> = planned.iter().map(|planned| planned.id.clone()).collect();
    let mut runs = store.load(&ids)?;
    for run in &mut runs {
        // Another study may have run the point first, under names of its own.
        if let Some(planned) = planned.iter().find(|planned| planned.id == run.id) {
            run.relabel(&study.name, &planned.point);
        }
    }
    study.plan.points = planned.into_iter().map(|planned| planned.point).collect();
    if let Some(last) = options.seeds {
        study.seeds = (1..=last).collect();
    }
    derive(&study, &mut runs);
    let judged = judge(&study, &runs);
    let index = report::render(&study, &runs, &judged, &reporting.out.join(&study.name))?;
    let told = report::told::told(&study, &runs, &judged);
    console.say(&verdicts::verdicts(&told, &tally, &index, console.paint))?;
    Ok(tally.status().max(verdicts::amount_to(&judged, reporting.strict)))
}

/// Puts the scenes of studies into words.
///
/// # Errors
/// When a study cannot be read.
pub fn explain(console: &Console, names: &[String]) -> Result<Status, Problem> {
    for study in load(console, names)? {
        console.say(&physics::explain(&study, console.paint))?;
    }
    Ok(Status::Held)
}

/// Checks the files of a store.
///
/// # Errors
/// When there is no store or it cannot be read.
pub fn verify(console: &Console, dir: &Path) -> Result<Status, Problem> {
    if !dir.is_dir() {
        let dir = dir.display();
        return Err(Problem::Input(format!(
            "there is no store at `{dir}`; name one with --store DIR"
        )));
    }
    let damage = Store::inspect(dir)?;
    if damage.is_empty() {
        console.say(&format!("{}: every file is as it was written\n", dir.display()))?;
        return Ok(Status::Held);
    }
    for damage in &damage {
        console.say(&format!(
            "{} {}: {}\n",
            console.paint.red("✗"),
            damage.file,
            damage.problem
        ))?;
    }
    Ok(Status::Damaged)
}

impl Tally {
    /// Counts the points of a study that the options select, however few of them may run at once.
    pub fn of(study: &Study, store: &Store, options: &Options) -> Result<Tally, Problem> {
        let selected = Options {
            only: options.only.clone(),
            seeds: options.seeds,
            ..Options::default()
        };
        let planned = survey(study, store, &selected)?;
        let finished = store.finished()?;
        let mut tally = Tally::default();
        for planned in planned
            .iter()
            .filter(|planned| !matches!(planned.state, State::LeftOut(_)))
        {
            match finished.get(&planned.id) {
                Some(store::model::Status::Completed) => tally.completed += 1,
                Some(store::model::Status::Diverged) if study.asks_divergence(&planned.point) => {
                    tally.diverged += 1;
                }
                Some(_) => tally.failed += 1,
                None => tally.missing += 1,
            }
        }
        Ok(tally)
    }

    pub fn status(&self) -> Status {
        if self.failed + self.missing > 0 {
            Status::Incomplete
        } else {
            Status::Held
        }
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        let all = self.completed + self.diverged + self.failed + self.missing;
        let all = super::magnitude::count(all, "point");
        write!(out, "{all}: {} completed, ", self.completed)?;
        if self.diverged > 0 {
            write!(out, "{} diverged as asked, ", self.diverged)?;
        }
        write!(out, "{} failed, {} missing", self.failed, self.missing)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_that_failed_or_never_ran_leaves_a_study_incomplete() {
        let tally = |completed, failed, missing| {
            Tally {
                completed,
                failed,
                missing,
                ..Tally::default()
            }
            .status()
        };
        assert_eq!(tally(3, 0, 0), Status::Held);
        assert_eq!(tally(3, 1, 0), Status::Incomplete);
        assert_eq!(tally(3, 0, 1), Status::Incomplete);
    }
}
