//! Between which two values of an axis a scalar leaves its band.

use super::point_error::mean_scalar;
use super::select::{Chain, Replicates, chains};
use crate::reference::{self, Facts};
use crate::store::model::{Run, Status};
use crate::study::model::{Band, Limit, Study};

/// Where a scalar leaves its band, everything but the axis fixed.
#[derive(Clone, Debug)]
pub struct Bracket<'a> {
    /// What is fixed.
    pub label: String,
    /// The last run inside, or the first run where none is.
    pub at: &'a Run,
    /// Values of the axis on both sides, or why there are none.
    pub sides: Result<[f64; 2], String>,
    /// The reference for the place and its source, or why there is none.
    pub expected: Result<(f64, String), String>,
}

impl Bracket<'_> {
    /// The place between both sides, in the middle of their logarithms.
    pub fn middle(&self) -> Option<f64> {
        let sides = self.sides.as_ref().ok()?;
        Some((sides[0] * sides[1]).sqrt())
    }
}

/// A bracket for each chain of runs that completed or diverged.
pub fn brackets<'a>(
    study: &Study,
    runs: &[Run],
    groups: &[Replicates<'a>],
    limit: &Limit,
) -> Vec<Bracket<'a>> {
    let chains = chains(study, runs, groups, &limit.over);
    chains.into_iter().map(|chain| bracket(chain, limit)).collect()
}

fn bracket<'a>(chain: Chain<'a>, limit: &Limit) -> Bracket<'a> {
    let inside: Vec<bool> = chain
        .steps
        .iter()
        .map(|(_, group)| is_inside(group, limit))
        .collect();
    let count = inside.iter().take_while(|inside| **inside).count();
    let over = &limit.over;
    let at = chain.steps[count.saturating_sub(1)].1.first();
    let sides = match count {
        0 => Err(format!("outside already at the least {over}; go lower")),
        _ if count == inside.len() => Err(format!("inside still at the greatest {over}; go higher")),
        _ if inside[count..].contains(&true) => Err(format!("inside again beyond a {over} that is outside")),
        _ => Ok([count - 1, count].map(|place| chain.steps[place].0)),
    };
    let scalar = |name: &str| at.scalar(name).map(|scalar| scalar.value);
    let facts = Facts {
        settings: &at.settings,
        scalars: &scalar,
    };
    let expected = reference::scalar(&limit.against, &facts)
        .map(|expected| (expected.values[0], expected.source))
        .map_err(|error| error.to_string());
    Bracket {
        label: chain.label,
        at,
        sides,
        expected,
    }
}

/// Whether all runs completed with a mean in the band.
fn is_inside(group: &Replicates, limit: &Limit) -> bool {
    let completed = group.runs.iter().all(|run| run.status == Status::Completed);
    let Band { above, below } = limit.band;
    completed
        && mean_scalar(group, &limit.of).is_ok_and(|mean| {
            above.is_none_or(|edge| mean.value > edge) && below.is_none_or(|edge| mean.value < edge)
        })
}
