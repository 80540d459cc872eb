//! What a response is drawn beside: solutions, published values by name, columns of published tables.

use super::super::{Material, lines};
use super::{Curve, Question};
use crate::judge::statistics::Sample;
use crate::reference::{self, library::Library};
use crate::report::theme::{self, Style};
use crate::report::{ReportError, format};
use crate::study::model::{Beside, DataSeries};

/// What stands beside: a line for a solution, markers for data; SI units.
pub struct Other {
    pub label: String,
    pub style: Style,
    pub points: Vec<(f64, f64)>,
    pub line: bool,
    pub source: String,
}

/// In the order of the figure.
pub fn others(material: &Material, question: &Question, curves: &[Curve]) -> Result<Vec<Other>, ReportError> {
    let mut others = Vec::new();
    let mut library = None;
    for (index, beside) in question.against.iter().enumerate() {
        match beside {
            Beside::Reference(name) if reference::is_published(name) => {
                others.push(published(material, question.of, (name, index), curves)?);
            }
            Beside::Reference(name) => others.extend(solutions(material, question.of, name, curves)?),
            Beside::Data(series) => {
                let library = match &library {
                    Some(library) => library,
                    None => library.insert(Library::above(&material.study.path).map_err(told)?),
                };
                others.push(data(library, series, index)?);
            }
        }
    }
    Ok(others)
}

fn told(error: crate::reference::ReferenceError) -> ReportError {
    ReportError(error.to_string())
}

/// Published values at the points of the curves; a point that the data do not have stays without one.
fn published(
    material: &Material,
    of: &str,
    (name, index): (&str, usize),
    curves: &[Curve],
) -> Result<Other, ReportError> {
    let mut points: Vec<(f64, f64)> = Vec::new();
    let (mut source, mut why) = (String::new(), None);
    for (at, _, replicates) in curves.iter().flat_map(|curve| &curve.points) {
        match (material.numbers.error)(replicates.first(), of, name) {
            Ok(error) => {
                points.extend(error.expected.map(|expected| (*at, expected)));
                source = error.source;
            }
            Err(message) => why = Some(message),
        }
    }
    points.sort_by(|one, other| one.0.total_cmp(&other.0).then(one.1.total_cmp(&other.1)));
    points.dedup();
    match (points.is_empty(), why) {
        (true, Some(why)) => Err(ReportError(why)),
        _ => Ok(Other {
            label: format::words(name),
            style: data_style(index),
            points,
            line: false,
            source,
        }),
    }
}

/// A solution at the points of each curve; equal lines once.
fn solutions(material: &Material, of: &str, name: &str, curves: &[Curve]) -> Result<Vec<Other>, ReportError> {
    let mut found: Vec<Other> = Vec::new();
    for curve in curves {
        let mut points = Vec::new();
        let mut source = String::new();
        for (at, _, replicates) in &curve.points {
            // A solution may know what each run has measured.
            let mut expected = Vec::new();
            for run in &replicates.runs {
                let error = (material.numbers.error)(run, of, name).map_err(ReportError)?;
                let none = || ReportError(format!("the reference `{name}` has no value here"));
                expected.push(error.expected.ok_or_else(none)?);
                source = error.source;
            }
            points.push((*at, Sample::of(expected).mean));
        }
        if !found.iter().any(|other| other.points == points) {
            found.push(Other {
                label: format!("reference ({})", format::words(name)),
                style: lines::reference_style(),
                points,
                line: true,
                source,
            });
        }
    }
    Ok(found)
}

fn data(library: &Library, series: &DataSeries, index: usize) -> Result<Other, ReportError> {
    let set = library.dataset(&series.file).map_err(told)?;
    let pairs = set.pairs((&series.x, &series.y), &series.rows).map_err(told)?;
    let (across, up) = series.factors;
    let mut points: Vec<_> = pairs.into_iter().map(|(x, y)| (x * across, y * up)).collect();
    points.sort_by(|one, other| one.0.total_cmp(&other.0));
    Ok(Other {
        label: series.label.clone().unwrap_or_else(|| format::words(&series.y)),
        style: data_style(index),
        points,
        line: false,
        source: library.source(&series.file).map_err(told)?,
    })
}

/// Of the data set named at this place.
fn data_style(index: usize) -> Style {
    Style {
        colour: theme::INK,
        // From the other end, so that the first data set and the first group differ.
        marker: theme::style(index + 1).marker,
        dash: theme::SOLID,
    }
}
