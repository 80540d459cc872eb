//! Which points there are, which have a result, which will run and why.

use std::collections::{HashMap, HashSet};

use super::{Options, Planned, RunError, State, identify};
use crate::store::model::{PointId, Provenance, Run, Status, leaf};
use crate::store::{Store, canonical};
use crate::study::model::{AxisValue, Point, Study};

/// Every point beside what the store holds, before any limit on their number.
pub(super) fn classify(study: &Study, store: &Store, options: &Options) -> Result<Vec<Planned>, RunError> {
    let points = reseed(study, options.seeds)?;
    check_names(&points, &options.only)?;
    let past = Past::of(store);
    let planned: Vec<Planned> = points
        .into_iter()
        .map(|point| {
            let id = identify(&point);
            let state = match left_out(&point, &options.only) {
                Some(reason) => State::LeftOut(reason),
                None => past.state(&id, &point, options.fresh),
            };
            Planned { point, id, state }
        })
        .collect();
    if planned
        .iter()
        .all(|planned| matches!(planned.state, State::LeftOut(_)))
    {
        return Err(RunError::Input(nothing_selected(study, &planned, options)));
    }
    Ok(planned)
}

/// Leaves out due points beyond the limit.
pub(super) fn apply_limit(planned: &mut [Planned], limit: Option<usize>) {
    let Some(limit) = limit else { return };
    let due = planned
        .iter_mut()
        .filter(|planned| matches!(planned.state, State::Due(_)));
    for planned in due.skip(limit) {
        planned.state = State::LeftOut(format!("beyond --limit {limit}"));
    }
}

/// The plan with seeds 1..=N in place of the study's.
fn reseed(study: &Study, seeds: Option<u64>) -> Result<Vec<Point>, RunError> {
    let points = &study.plan.points;
    let Some(seeds) = seeds else {
        return Ok(points.clone());
    };
    if seeds == 0 {
        return Err(RunError::Input(
            "--seeds 0 leaves no point\n  help: give 1 or more".into(),
        ));
    }
    let mut seen = HashSet::new();
    let distinct = points
        .iter()
        .filter(|point| seen.insert((&point.scene, canonical(&point.settings))));
    let mut all: Vec<Point> = distinct
        .flat_map(|point| {
            (1..=seeds).map(move |seed| Point {
                seed,
                work: point.work.seeded(seed),
                ..point.clone()
            })
        })
        .collect();
    for (index, point) in all.iter_mut().enumerate() {
        point.index = index;
    }
    Ok(all)
}

/// Value of a parameter of a point: `scene`, `seed`, an axis, or the one settings field of that name.
fn parameter(point: &Point, name: &str) -> Option<AxisValue> {
    match name {
        "scene" => Some(AxisValue::Word(point.scene.clone())),
        "seed" => Some(AxisValue::Number(point.seed as f64)),
        _ => {
            let axis = point.axes.iter().find(|(axis, _)| axis == name);
            axis.map(|(_, value)| value.clone())
                .or_else(|| leaf(&point.settings, name))
        }
    }
}

fn check_names(points: &[Point], only: &[(String, AxisValue)]) -> Result<(), RunError> {
    for (name, _) in only {
        if points.iter().all(|point| parameter(point, name).is_none()) {
            let mut known: Vec<&str> = points
                .iter()
                .flat_map(|point| &point.axes)
                .map(|(axis, _)| &**axis)
                .collect();
            known.sort_unstable();
            known.dedup();
            return Err(RunError::Input(format!(
                "--only {name}: no point has a parameter of this name\n  help: the axes are {}; `scene`, `seed` \
                 and any field of the settings are possible too",
                known.join(", ")
            )));
        }
    }
    Ok(())
}

/// Why a point is not among those asked for. Values of one name are alternatives.
fn left_out(point: &Point, only: &[(String, AxisValue)]) -> Option<String> {
    only.iter().map(|(name, _)| name).find_map(|name| {
        let value = parameter(point, name);
        let mut admitted = only
            .iter()
            .filter(|(other, _)| other == name)
            .map(|(_, value)| value);
        match &value {
            Some(value) if admitted.any(|wanted| same(wanted, value)) => None,
            Some(value) => Some(format!("--only: {name} is {}", words(value))),
            None => Some(format!("--only: it has no {name}")),
        }
    })
}

/// Numbers typed in another unit may differ in the last digits.
fn same(one: &AxisValue, other: &AxisValue) -> bool {
    match (one, other) {
        (AxisValue::Number(one), AxisValue::Number(other)) => {
            one == other || (one - other).abs() <= 1e-9 * one.abs().max(other.abs())
        }
        _ => one == other || words(one) == words(other),
    }
}

fn nothing_selected(study: &Study, planned: &[Planned], options: &Options) -> String {
    if planned.is_empty() {
        return format!(
            "study `{}` has no points\n  help: look at `vary` and `exclude`",
            study.name
        );
    }
    let mut asked: Vec<&String> = options.only.iter().map(|(name, _)| name).collect();
    asked.dedup();
    let values = asked.iter().map(|name| {
        let mut found: Vec<String> = Vec::new();
        for value in planned
            .iter()
            .filter_map(|planned| parameter(&planned.point, name))
        {
            if !found.contains(&words(&value)) {
                found.push(words(&value));
            }
        }
        format!("{name}: {}", found.join(", "))
    });
    let values: Vec<String> = values.collect();
    format!(
        "--only selects no point\n  help: the study has {}",
        values.join("; ")
    )
}

pub(super) fn words(value: &AxisValue) -> String {
    value.to_string()
}

/// What the store knows of earlier runs.
struct Past {
    by_id: HashMap<PointId, Run>,
    /// Settings and seeds that were run with other sources of the simulator.
    with_other_simulator: HashSet<(String, u64)>,
}

impl Past {
    fn of(store: &Store) -> Past {
        let runs = store.summaries();
        let other = |run: &&Run| run.timing.provenance.simulator_hash != Provenance::simulator_hash();
        let with_other_simulator = runs
            .iter()
            .filter(other)
            .map(|run| (canonical(&run.settings), run.seed))
            .collect();
        let by_id = runs.into_iter().map(|run| (run.id.clone(), run)).collect();
        Past {
            by_id,
            with_other_simulator,
        }
    }

    fn state(&self, id: &PointId, point: &Point, fresh: bool) -> State {
        if fresh {
            return State::Due("--fresh".into());
        }
        match self.by_id.get(id) {
            Some(run) if run.status == Status::Completed => State::Cached,
            Some(run) => State::Due(format!("last run {}", ending(run))),
            None if self
                .with_other_simulator
                .contains(&(canonical(&point.settings), point.seed)) =>
            {
                State::Due("simulator changed since".into())
            }
            None => State::Due("no result yet".into()),
        }
    }
}

/// How a run ended that did not complete, in words.
pub(super) fn ending(run: &Run) -> String {
    let status = match run.status {
        Status::Completed => "completed",
        Status::Diverged => "diverged",
        Status::Panicked => "panicked",
        Status::TimedOut => "timed out",
        Status::OutOfMemory => "ran out of memory",
    };
    match &run.reason {
        Some(reason) => format!("{status}: {reason}"),
        None => status.to_string(),
    }
}
