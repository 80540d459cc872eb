//! `kynch export`: which point is meant, and its tables into a folder.

use super::actions::load;
use super::command::{Extraction, Job};
use super::console::Console;
use super::status::{Problem, Status};
use crate::export;
use crate::runner::{self, Planned, State, survey};
use crate::store::Store;
use crate::store::model::Status as Ending;

/// Points that a message lists.
const LISTED: usize = 8;

/// Writes the tables of the one point that is meant.
///
/// # Errors
/// When no point or several are meant, when it has no completed run or not what is wanted, or when the files
/// cannot be written.
pub fn extract(console: &Console, job: &Job, extraction: &Extraction) -> Result<Status, Problem> {
    let mut studies = load(console, &job.names)?;
    let study = studies.remove(0);
    let store = Store::read(&job.store)?;
    let planned = survey(&study, &store, &job.options)?;
    let chosen = chosen(&planned, extraction.point)?;
    let label = runner::label(&chosen.point);
    let mut runs = store.load(std::slice::from_ref(&chosen.id))?;
    let run = match runs.pop() {
        Some(run) if run.status == Ending::Completed => run,
        Some(run) => {
            let why = run.reason.unwrap_or_else(|| run.status.name().to_owned());
            return Err(Problem::Missing(format!("{label} did not complete: {why}")));
        }
        None => {
            let name = &study.name;
            return Err(Problem::Missing(format!(
                "{label} has no result in {}\n  help: run it with `kynch run {name}`, or name a store with --store",
                job.store.display()
            )));
        }
    };
    let written = export::export(&run, &extraction.wanted, &extraction.out)?;
    let mut text = String::new();
    for path in &written {
        text.push_str(&format!("{}\n", path.display()));
    }
    text.push_str(&format!(
        "{label}: {} written\n",
        super::magnitude::count(written.len(), "file")
    ));
    console.say(&text)?;
    Ok(Status::Held)
}

/// The one point that number or selection leave.
fn chosen(planned: &[Planned], number: Option<usize>) -> Result<&Planned, Problem> {
    if let Some(number) = number {
        let found = planned.iter().find(|planned| planned.point.index == number);
        return found.ok_or_else(|| {
            let last = planned.len().saturating_sub(1);
            Problem::Input(format!(
                "--point {number}: the points are 0 to {last}\n  help: `kynch plan` lists them"
            ))
        });
    }
    let left: Vec<&Planned> = planned
        .iter()
        .filter(|planned| !matches!(planned.state, State::LeftOut(_)))
        .collect();
    match left.as_slice() {
        [one] => Ok(one),
        several => {
            let listed = several.iter().take(LISTED).map(|planned| {
                format!(
                    "\n  --point {}: {}",
                    planned.point.index,
                    runner::label(&planned.point)
                )
            });
            let more = match several.len().saturating_sub(LISTED) {
                0 => String::new(),
                more => format!("\n  and {more} more"),
            };
            Err(Problem::Input(format!(
                "one point is written at a time, {} are selected{}{more}\n  help: choose one with --point N, or narrow \
                 --only axis=value (seed=1, too)",
                several.len(),
                listed.collect::<String>()
            )))
        }
    }
}
