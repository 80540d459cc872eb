//! What is seen of a run: a bar with the time left on a terminal, one line per point elsewhere.

use std::collections::BTreeMap;
use std::io::IsTerminal;
use std::sync::{Mutex, PoisonError};

use indicatif::{ProgressBar, ProgressStyle};

use super::survey::ending;
use super::{Planned, State, label};
use crate::store::model::{Run, Status};

/// Steps of the bar.
const STEPS: f64 = 10_000.0;

pub(super) struct Progress {
    bar: Option<ProgressBar>,
    /// Expected work of each point.
    weights: Vec<f64>,
    state: Mutex<Shown>,
}

struct Shown {
    fractions: Vec<f64>,
    finished: usize,
    failed: usize,
}

impl Progress {
    /// `weights`: the expected work of the points that will run, in any unit.
    pub fn start(weights: Vec<f64>) -> Progress {
        let bar = std::io::stderr().is_terminal().then(|| {
            let style =
                ProgressStyle::with_template("{bar:32} {percent:>3} %  {msg}  {elapsed} gone, {eta} left");
            let bar = ProgressBar::new(STEPS as u64);
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
            bar
        });
        // Points that are expected to cost nothing still count a little.
        let floor = 1e-3 * weights.iter().copied().fold(0.0, f64::max) + f64::MIN_POSITIVE;
        let weights: Vec<f64> = weights.into_iter().map(|weight| weight.max(floor)).collect();
        let state = Mutex::new(Shown {
            fractions: vec![0.0; weights.len()],
            finished: 0,
            failed: 0,
        });
        Progress { bar, weights, state }
    }

    /// The point in this place of the queue has come so far, 0 to 1.
    pub fn advance(&self, place: usize, fraction: f64) {
        if self.bar.is_none() {
            return;
        }
        self.update(|shown| shown.fractions[place] = fraction.clamp(0.0, 1.0));
    }

    pub fn finish(&self, place: usize, planned: &Planned, run: &Run) {
        let failed = run.status != Status::Completed;
        let number = self.update(|shown| {
            shown.fractions[place] = 1.0;
            shown.finished += 1;
            shown.failed += usize::from(failed);
        });
        let mut line = format!(
            "{}: {}, {:.2} s",
            label(&planned.point),
            ending(run),
            run.timing.wall
        );
        if !run.timing.split.is_empty() {
            line += &format!(" ({})", run.timing.split_in_words());
        }
        match &self.bar {
            None => eprintln!("[{number}/{}] {line}", self.weights.len()),
            Some(bar) if failed => bar.println(line),
            Some(_) => {}
        }
    }

    /// Changes what is shown; returns how many points are finished.
    fn update(&self, change: impl FnOnce(&mut Shown)) -> usize {
        let mut shown = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        change(&mut shown);
        if let Some(bar) = &self.bar {
            let done: f64 = self
                .weights
                .iter()
                .zip(&shown.fractions)
                .map(|(weight, part)| weight * part)
                .sum();
            let all: f64 = self.weights.iter().sum();
            let failed = if shown.failed > 0 {
                format!(", {} failed", shown.failed)
            } else {
                String::new()
            };
            bar.set_message(format!(
                "{} of {} points{failed}",
                shown.finished,
                self.weights.len()
            ));
            bar.set_position((STEPS * done / all) as u64);
        }
        shown.finished
    }

    pub fn end(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

/// Says how many points run, and why.
pub(super) fn announce(planned: &[Planned]) {
    let mut reasons: BTreeMap<&str, usize> = BTreeMap::new();
    let mut cached = 0;
    for planned in planned {
        match &planned.state {
            State::Due(reason) => *reasons.entry(reason).or_default() += 1,
            State::Cached => cached += 1,
            State::LeftOut(_) => {}
        }
    }
    if reasons.is_empty() {
        return;
    }
    let due: usize = reasons.values().sum();
    eprintln!("{due} of {} points to run, {cached} cached", planned.len());
    for (reason, count) in reasons {
        eprintln!("  {count} because: {reason}");
    }
}
