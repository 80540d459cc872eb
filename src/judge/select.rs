//! Which completed runs a statement is about, seeds gathered, neighbours along an axis found.

use std::cmp::Ordering;

use super::words::axis_value;
use crate::store::model::{PointId, Run, Status, Timing};
use crate::study::model::{AxisValue, Point, Selection, Study};

/// Numbers closer than this, relative to their size, are one value.
const SAME: f64 = 1e-9;

/// Completed runs that differ in nothing but the seed, in order of the seed; never empty.
#[derive(Clone, Debug)]
pub struct Replicates<'a> {
    pub runs: Vec<&'a Run>,
}

impl<'a> Replicates<'a> {
    /// The run with the lowest seed.
    pub fn first(&self) -> &'a Run {
        self.runs[0]
    }

    /// `scene=block porosity=0.9`, with ` seeds=1,2,3` when there are several.
    pub fn label(&self) -> String {
        let mut label = label(self.first());
        if self.runs.len() > 1 {
            let seeds: Vec<String> = self.runs.iter().map(|run| run.seed.to_string()).collect();
            label += &format!(" seeds={}", seeds.join(","));
        }
        label
    }
}

/// Replicates along one axis with everything else fixed, in rising order of the axis.
#[derive(Clone, Debug)]
pub struct Chain<'a> {
    /// What is fixed: `scene=block porosity=0.9`.
    pub label: String,
    pub steps: Vec<(f64, Replicates<'a>)>,
}

/// The completed runs a selection admits, seeds gathered, in a stable order whatever order they came in.
pub fn selected<'a>(study: &Study, runs: &'a [Run], selection: &Selection) -> Vec<Replicates<'a>> {
    let meant = |run: &&Run| run.status == Status::Completed && admits(selection, run);
    gathered(study, runs.iter().filter(meant).collect())
}

/// The same of runs that completed or diverged.
pub fn ended<'a>(study: &Study, runs: &'a [Run], selection: &Selection) -> Vec<Replicates<'a>> {
    let meant = |run: &&Run| has_ended(run) && admits(selection, run);
    gathered(study, runs.iter().filter(meant).collect())
}

fn has_ended(run: &Run) -> bool {
    matches!(run.status, Status::Completed | Status::Diverged)
}

/// Whether a run diverged where an expectation of the study takes that for an answer.
pub fn answers_by_diverging(study: &Study, run: &Run) -> bool {
    let mut about = study
        .expect
        .iter()
        .filter(|expectation| admits(&expectation.selection, run));
    run.status == Status::Diverged && about.any(|expectation| expectation.check.asks_divergence())
}

/// Runs with their seeds gathered, in a stable order whatever order they came in.
pub fn gathered<'a>(study: &Study, mut chosen: Vec<&'a Run>) -> Vec<Replicates<'a>> {
    chosen.sort_by(|a, b| order(study, a, b));
    chosen.dedup_by(|a, b| a.id == b.id);
    let mut groups: Vec<Replicates> = Vec::new();
    for run in chosen {
        match groups.last_mut() {
            Some(group) if same_setting(group.first(), run) => group.runs.push(run),
            _ => groups.push(Replicates { runs: vec![run] }),
        }
    }
    groups
}

/// Labels of the planned or attempted points that are meant and that have no completed run, or none that
/// diverged either where that is an answer.
pub fn unanswered(
    study: &Study,
    runs: &[Run],
    divergence_answers: bool,
    meant: impl Fn(&Run) -> bool,
) -> Vec<String> {
    let answered = match divergence_answers {
        true => ended(study, runs, &Selection::default()),
        false => selected(study, runs, &Selection::default()),
    };
    let planned: Vec<Run> = study.plan.points.iter().map(sketch).collect();
    let mut open: Vec<&Run> = planned
        .iter()
        .chain(runs)
        .filter(|run| meant(run))
        .filter(|run| !answered.iter().any(|group| same_setting(group.first(), run)))
        .collect();
    open.sort_by(|a, b| order(study, a, b));
    let mut labels: Vec<String> = open.into_iter().map(label).collect();
    labels.dedup();
    labels
}

/// Selected runs ordered into chains over a numeric axis or parameter.
///
/// Axes that move along with it (each of its values has one of theirs, as a zipped column width has)
/// are not held fixed. A run without the parameter, or with one that is no number, is in no chain.
pub fn chains<'a>(study: &Study, runs: &[Run], groups: &[Replicates<'a>], over: &str) -> Vec<Chain<'a>> {
    let mut chains: Vec<(Vec<(String, AxisValue)>, Chain)> = Vec::new();
    for group in groups {
        let run = group.first();
        let Some(AxisValue::Number(position)) = run.parameter(over) else {
            continue;
        };
        let along = carried(study, runs, &run.scene, over);
        let mut fixed = run.axes.clone();
        fixed.retain(|(axis, _)| axis != over && !along.contains(axis));
        let found = chains
            .iter_mut()
            .find(|(key, chain)| chain.steps[0].1.first().scene == run.scene && same_axes(key, &fixed));
        match found {
            Some((_, chain)) => chain.steps.push((position, group.clone())),
            None => {
                let chain = Chain {
                    label: words(&run.scene, &fixed),
                    steps: vec![(position, group.clone())],
                };
                chains.push((fixed, chain));
            }
        }
    }
    chains
        .into_iter()
        .map(|(_, mut chain)| {
            chain.steps.sort_by(|a, b| a.0.total_cmp(&b.0));
            chain
        })
        .collect()
}

/// Replicates of a first selection beside those of a second that differ in nothing else.
///
/// What the selections name may differ, and what moves along with it: axes that they determine, or that
/// have one value in each of them.
pub fn pairs<'a>(
    study: &Study,
    runs: &[Run],
    groups: &[Replicates<'a>],
    between: &[Selection; 2],
) -> Vec<[Replicates<'a>; 2]> {
    let side = |place: usize| -> Vec<&Replicates<'a>> {
        let mine = |group: &&Replicates| admits(&between[place], group.first());
        groups.iter().filter(mine).collect()
    };
    let sides = [side(0), side(1)];
    let named = |name: &str| {
        between
            .iter()
            .flat_map(|one| &one.axes)
            .any(|(axis, _)| axis == name)
    };
    let across_scenes = between.iter().any(|one| !one.scenes.is_empty());
    let key = |run: &Run| {
        let along: Vec<String> = between
            .iter()
            .flat_map(|one| &one.axes)
            .flat_map(|(name, _)| carried(study, runs, &run.scene, name))
            .collect();
        let mut fixed = run.axes.clone();
        fixed.retain(|(axis, _)| {
            let alone = sides.iter().all(|side| single(side, axis));
            !named(axis) && !along.contains(axis) && !alone
        });
        (
            if across_scenes {
                String::new()
            } else {
                run.scene.clone()
            },
            fixed,
        )
    };
    let mut pairs = Vec::new();
    for first in &sides[0] {
        let (scene, fixed) = key(first.first());
        for second in &sides[1] {
            let (other, others) = key(second.first());
            let itself = same_setting(first.first(), second.first());
            if scene == other && same_axes(&fixed, &others) && !itself {
                pairs.push([(*first).clone(), (*second).clone()]);
            }
        }
    }
    pairs
}

/// Whether an axis has one value, or none, among these.
fn single(groups: &[&Replicates], axis: &str) -> bool {
    let value = |group: &&Replicates| group.first().axis(axis).cloned();
    let mut values = groups.iter().map(value);
    let first = values.next().flatten();
    values.all(|value| match (&first, &value) {
        (Some(first), Some(value)) => same(first, value),
        (first, value) => first.is_none() && value.is_none(),
    })
}

/// Whether a selection admits a run.
pub fn admits(selection: &Selection, run: &Run) -> bool {
    let scene = selection.scenes.is_empty() || selection.scenes.contains(&run.scene);
    scene
        && selection.axes.iter().all(|(name, admitted)| {
            run.parameter(name)
                .is_some_and(|value| admitted.iter().any(|one| same(one, &value)))
        })
}

/// Whether two axis values are one.
pub fn same(a: &AxisValue, b: &AxisValue) -> bool {
    match (a, b) {
        (AxisValue::Number(a), AxisValue::Number(b)) => (a - b).abs() <= SAME * a.abs().max(b.abs()),
        _ => a == b,
    }
}

/// `scene=block spacing_over_diameter=2 porosity=0.9`
pub fn label(run: &Run) -> String {
    words(&run.scene, &run.axes)
}

fn words(scene: &str, axes: &[(String, AxisValue)]) -> String {
    let axes = axes
        .iter()
        .map(|(name, value)| format!(" {name}={}", axis_value(value)));
    format!("scene={scene}{}", axes.collect::<String>())
}

/// Axes of a scene that `over` determines, over everything planned or run there.
fn carried(study: &Study, runs: &[Run], scene: &str, over: &str) -> Vec<String> {
    let planned = study.plan.points.iter().map(|point| (&point.scene, &point.axes));
    let ran = runs.iter().map(|run| (&run.scene, &run.axes));
    let rows: Vec<_> = planned
        .chain(ran)
        .filter(|(name, _)| *name == scene)
        .map(|(_, axes)| axes)
        .collect();
    let value = |axes: &[(String, AxisValue)], name: &str| {
        axes.iter()
            .find(|(axis, _)| axis == name)
            .map(|(_, value)| value.clone())
    };
    let determined = |axis: &str| {
        rows.iter().enumerate().all(|(index, a)| {
            rows[..index]
                .iter()
                .all(|b| match (value(a, over), value(b, over)) {
                    (Some(x), Some(y)) if same(&x, &y) => match (value(a, axis), value(b, axis)) {
                        (Some(x), Some(y)) => same(&x, &y),
                        (None, None) => true,
                        _ => false,
                    },
                    (Some(_), Some(_)) => true,
                    _ => false,
                })
        })
    };
    let names = rows.iter().flat_map(|axes| axes.iter().map(|(name, _)| name));
    let mut found: Vec<String> = Vec::new();
    for name in names {
        if name != over && !found.contains(name) && determined(name) {
            found.push(name.clone());
        }
    }
    found
}

fn same_setting(a: &Run, b: &Run) -> bool {
    a.scene == b.scene && same_axes(&a.axes, &b.axes)
}

fn same_axes(a: &[(String, AxisValue)], b: &[(String, AxisValue)]) -> bool {
    a.len() == b.len()
        && a.iter()
            .zip(b)
            .all(|((x, value), (y, other))| x == y && same(value, other))
}

/// Scenes in the study's order, axis values rising, then seeds.
fn order(study: &Study, a: &Run, b: &Run) -> Ordering {
    let position = |run: &Run| study.scenes.iter().position(|scene| *scene == run.scene);
    let values = a.axes.iter().zip(&b.axes);
    position(a)
        .cmp(&position(b))
        .then_with(|| a.scene.cmp(&b.scene))
        .then_with(|| {
            values
                .map(|((x, value), (y, other))| x.cmp(y).then_with(|| compare(value, other)))
                .find(|order| order.is_ne())
                .unwrap_or(a.axes.len().cmp(&b.axes.len()))
        })
        .then_with(|| a.seed.cmp(&b.seed))
        .then_with(|| a.id.cmp(&b.id))
}

/// A total order: numbers, flags, words.
fn compare(a: &AxisValue, b: &AxisValue) -> Ordering {
    let rank = |value: &AxisValue| match value {
        AxisValue::Number(_) => 0,
        AxisValue::Flag(_) => 1,
        AxisValue::Word(_) => 2,
    };
    match (a, b) {
        (AxisValue::Number(a), AxisValue::Number(b)) => a.total_cmp(b),
        _ => rank(a)
            .cmp(&rank(b))
            .then_with(|| axis_value(a).cmp(&axis_value(b))),
    }
}

/// A planned point in the form of a run, so that both answer the same questions.
fn sketch(point: &Point) -> Run {
    Run {
        id: PointId(String::new()),
        study: String::new(),
        scene: point.scene.clone(),
        axes: point.axes.clone(),
        seed: point.seed,
        settings: point.settings.clone(),
        status: Status::TimedOut,
        reason: None,
        scalars: Vec::new(),
        counters: Vec::new(),
        tables: Vec::new(),
        derived: Vec::new(),
        timing: Timing::default(),
    }
}
