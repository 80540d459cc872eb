//! One file per kind of expectation: from selected runs to what was found.

pub mod compare;
pub mod error;
pub mod fit;
pub mod limit;
pub mod monotone;
pub mod order;
pub mod scaling;
pub mod status;
pub mod value;

use super::model::{Outcome, PointVerdict};
use super::point_error::PointError;
use super::select::Replicates;

/// What a check found, before anything is said about missing runs.
#[derive(Clone, Debug, Default)]
pub struct Finding {
    pub unit: String,
    pub expected: Option<f64>,
    pub computed: Option<f64>,
    /// Half width of the 95 % confidence interval of `computed`.
    pub half_width: Option<f64>,
    pub error: Option<f64>,
    pub source: String,
    pub points: Vec<PointVerdict>,
    /// Each part of the statement: it holds, fails, or cannot be told.
    pub parts: Vec<Part>,
    /// Largest confidence half width over seeds, in words; nothing with one seed each.
    pub spread: Option<String>,
}

/// One part of a statement: a point, a step or a chain.
#[derive(Clone, Debug)]
pub struct Part {
    pub outcome: Outcome,
    /// Why, unless it holds.
    pub reason: String,
}

impl Part {
    pub fn holds() -> Part {
        Part {
            outcome: Outcome::Holds,
            reason: String::new(),
        }
    }

    pub fn fails(reason: String) -> Part {
        Part {
            outcome: Outcome::Fails,
            reason,
        }
    }

    pub fn open(reason: String) -> Part {
        Part {
            outcome: Outcome::NotDecidable,
            reason,
        }
    }

    /// As a point's share.
    pub fn decided(&self) -> Option<bool> {
        match self.outcome {
            Outcome::Holds => Some(true),
            Outcome::Fails => Some(false),
            Outcome::NotDecidable => None,
        }
    }
}

impl Finding {
    /// Fails if a part fails, else is open if a part is open, else holds; with the first such reason.
    pub fn outcome(&self) -> (Outcome, Option<String>) {
        for outcome in [Outcome::Fails, Outcome::NotDecidable] {
            let mut parts = self.parts.iter().filter(|part| part.outcome == outcome);
            if let Some(first) = parts.next() {
                let others = parts.count();
                let reason = match others {
                    0 => first.reason.clone(),
                    _ => format!("{} ({others} more)", first.reason),
                };
                return (outcome, Some(reason));
            }
        }
        (Outcome::Holds, self.spread.clone())
    }
}

/// A point without numbers.
pub fn blank(replicates: &Replicates) -> PointVerdict {
    PointVerdict {
        id: replicates.first().id.0.clone(),
        label: replicates.label(),
        expected: None,
        computed: None,
        half_width: None,
        error: None,
        holds: None,
    }
}

/// A point with its error.
pub fn erroneous(replicates: &Replicates, error: &PointError) -> PointVerdict {
    PointVerdict {
        expected: Some(error.expected),
        computed: Some(error.computed),
        half_width: Some(error.half_width_computed).filter(|width| *width > 0.0),
        error: Some(error.error),
        ..blank(replicates)
    }
}

/// The largest half width of a confidence interval, in words.
pub fn spread(replicates: &[Replicates], largest: f64) -> Option<String> {
    let several = replicates.iter().any(|group| group.runs.len() > 1);
    let (over, _) = confidence(several);
    (several || largest > 0.0).then(|| {
        let words = super::words::significant(largest, 3);
        format!("95 % confidence half width {over} at most {words}")
    })
}

/// What an interval is about, and what makes it narrower.
pub fn confidence(several_seeds: bool) -> (&'static str, &'static str) {
    match several_seeds {
        true => ("over seeds", "run more seeds"),
        false => ("of the fit", "run several seeds, or fit a longer window"),
    }
}
