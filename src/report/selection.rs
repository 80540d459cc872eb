//! Which runs a figure shows, how they are grouped and what they are called.

use super::format;
pub use crate::judge::select::{admits, same};
use crate::store::model::{Run, Status};
use crate::study::model::{AxisValue, Selection, Study};

/// Runs that share a value of the grouping parameter.
pub struct Group<'a> {
    /// Empty when nothing groups them.
    pub label: String,
    /// The value alone, for a legend whose heading names the parameter.
    pub value: String,
    pub runs: Vec<&'a Run>,
}

/// The completed runs that a selection admits. Failed points never enter a figure.
pub fn chosen<'a>(runs: &'a [Run], selection: &Selection) -> Vec<&'a Run> {
    runs.iter()
        .filter(|run| run.status == Status::Completed && admits(selection, run))
        .collect()
}

/// Groups in the order in which they first appear.
pub fn grouped<'a>(study: &Study, runs: &[&'a Run], by: Option<&str>) -> Vec<Group<'a>> {
    let Some(name) = by else {
        return vec![Group {
            label: String::new(),
            value: String::new(),
            runs: runs.to_vec(),
        }];
    };
    let mut groups: Vec<(Option<AxisValue>, Group)> = Vec::new();
    for run in runs {
        let value = run.parameter(name);
        let found = groups.iter_mut().find(|(known, _)| match (known, &value) {
            (Some(known), Some(value)) => same(known, value),
            (known, value) => known.is_none() && value.is_none(),
        });
        match found {
            Some((_, group)) => group.runs.push(run),
            None => {
                let (label, alone) = match &value {
                    Some(value) => (named(study, name, value), shown(study, name, value)),
                    None => (format!("without {}", format::words(name)), "none".to_owned()),
                };
                groups.push((
                    value,
                    Group {
                        label,
                        value: alone,
                        runs: vec![run],
                    },
                ));
            }
        }
    }
    groups.into_iter().map(|(_, group)| group).collect()
}

/// The parameter that a legend of groups names once, above the values; a scene needs no name.
pub fn heading(by: &str) -> Option<String> {
    (by != "scene").then(|| format::title_words(by))
}

/// `width 4.2 mm`, `spacing 2 d` in grain diameters; a scene goes by its name alone.
pub fn named(study: &Study, name: &str, value: &AxisValue) -> String {
    if let (Some(length), AxisValue::Number(number)) = (name.strip_suffix("_over_diameter"), value) {
        return format!("{} {} d", format::words(length), format::number(*number));
    }
    if name == "scene" {
        return shown(study, name, value);
    }
    format!("{} {}", format::words(name), shown(study, name, value))
}

/// A parameter's value with its unit.
pub fn shown(study: &Study, name: &str, value: &AxisValue) -> String {
    match value {
        AxisValue::Number(number) => {
            let unit = format::readable(axis_unit(study, name), *number);
            format!("{} {}", format::number(number * unit.factor), unit.label)
                .trim_end()
                .to_owned()
        }
        AxisValue::Flag(true) => "yes".to_owned(),
        AxisValue::Flag(false) => "no".to_owned(),
        AxisValue::Word(word) => format::words(word),
    }
}

/// SI unit of an axis; `1` when the study knows none of that name.
pub fn axis_unit<'a>(study: &'a Study, name: &str) -> &'a str {
    study
        .axes
        .iter()
        .find(|axis| axis.name == name)
        .map_or("1", |axis| &axis.unit)
}

/// A run in words: scene, axes, and the seed where the study has several.
pub fn label(study: &Study, run: &Run) -> String {
    let mut parts = setting(study, run, |_, _| true);
    if study.seeds.len() > 1 {
        parts.push(format!("seed {}", run.seed));
    }
    if parts.is_empty() {
        format::words(&run.scene)
    } else {
        parts.join(", ")
    }
}

/// A run in words: its scene and the axes that are wanted.
pub fn label_of_axes(study: &Study, run: &Run, wanted: impl Fn(&str, &AxisValue) -> bool) -> String {
    let parts = setting(study, run, wanted);
    match parts.is_empty() {
        true => format::words(&run.scene),
        false => parts.join(", "),
    }
}

fn setting(study: &Study, run: &Run, wanted: impl Fn(&str, &AxisValue) -> bool) -> Vec<String> {
    let mut parts = Vec::new();
    if study.scenes.len() > 1 {
        parts.push(format::words(&run.scene));
    }
    let mut kept: Vec<&str> = Vec::new();
    for (name, value) in run.axes.iter().filter(|(name, value)| wanted(name, value)) {
        if !kept
            .iter()
            .any(|earlier| carries(study, &run.scene, earlier, name))
        {
            parts.push(named(study, name, value));
            kept.push(name);
        }
    }
    parts
}

/// Whether an axis moves along with an earlier one, so that naming the earlier one says all: to each
/// of several values of `earlier` belongs one of `axis`.
fn carries(study: &Study, scene: &str, earlier: &str, axis: &str) -> bool {
    let value = |axes: &[(String, AxisValue)], name: &str| {
        axes.iter()
            .find(|(other, _)| other == name)
            .map(|(_, value)| value.clone())
    };
    let mut pairs: Vec<(AxisValue, AxisValue)> = Vec::new();
    for point in study.plan.points.iter().filter(|point| point.scene == scene) {
        let (Some(key), Some(found)) = (value(&point.axes, earlier), value(&point.axes, axis)) else {
            return false;
        };
        match pairs.iter().find(|(known, _)| same(known, &key)) {
            Some((_, known)) if !same(known, &found) => return false,
            Some(_) => {}
            None => pairs.push((key, found)),
        }
    }
    pairs.len() > 1
}

/// `scene` and axes with more than one value among the runs, without those named.
pub fn varying(runs: &[&Run], without: &[&str]) -> Vec<String> {
    let mut names: Vec<String> = vec!["scene".to_owned()];
    names.retain(|name| !without.contains(&name.as_str()));
    for run in runs {
        for (name, _) in &run.axes {
            if !names.contains(name) && !without.contains(&name.as_str()) {
                names.push(name.clone());
            }
        }
    }
    names.retain(|name| {
        let mut values = runs.iter().filter_map(|run| run.parameter(name));
        let first = values.next();
        first.is_some_and(|first| values.any(|value| !same(&first, &value)))
    });
    names
}

/// The number behind a parameter.
pub fn numeric(run: &Run, name: &str) -> Option<f64> {
    match run.parameter(name) {
        Some(AxisValue::Number(value)) => Some(value),
        _ => None,
    }
}
