//! The error of one point: the number that verdicts and figures share.

use super::interpolation;
use super::select::Replicates;
use super::statistics::Sample;
use crate::reference::{self, Expected, Facts, Points};
use crate::store::model::{Run, Table};
use crate::study::{self, model::Norm};

/// Why a number cannot be had; what to do.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct Undecided(pub String);

/// A quantity beside its reference.
#[derive(Clone, Debug, PartialEq)]
pub struct PointError {
    /// The reference value; for a series, the one where it is farthest off.
    pub expected: f64,
    /// The value found, at the same place; a mean over seeds.
    pub computed: f64,
    /// Relative error, never negative [-].
    pub error: f64,
    /// With its sign for a scalar; the error itself for a series.
    pub signed: f64,
    /// Standard error of `signed` over seeds; zero for one seed.
    pub spread: f64,
    /// Half width of the 95 % confidence interval of `signed` over seeds; zero for one seed.
    pub half_width: f64,
    /// The same of `computed`.
    pub half_width_computed: f64,
    pub unit: String,
    /// Citation of the reference.
    pub source: String,
}

/// A scalar over seeds.
#[derive(Clone, Debug, PartialEq)]
pub struct Mean {
    pub value: f64,
    pub sample: Sample,
    pub unit: String,
}

/// Relative error of a scalar or a series of one run against a reference.
///
/// Scalar: |x/x_ref − 1|. Series: a norm of x − x_ref over max|x_ref|, both at the run's own times, or at
/// those of a measured curve as far as the run lasts, the run interpolated.
///
/// # Errors
/// An observable the run does not have, a reference that does not hold for its scene, is zero or has
/// another dimension, or a result that is not finite.
pub fn point_error(run: &Run, of: &str, against: &str, norm: Norm) -> Result<PointError, Undecided> {
    let scalar = |name: &str| run.scalar(name).map(|scalar| scalar.value);
    let facts = Facts {
        settings: &run.settings,
        scalars: &scalar,
    };
    let refused = |error: reference::ReferenceError| Undecided(error.to_string());
    // One name may stand for a series and for its last value: the reference says which is meant.
    let curve = reference::is_curve(against) && series(run, of).is_ok();
    let error = if let Some((found, unit)) = run.measure(of).filter(|_| !curve) {
        let expected = reference::scalar(against, &facts).map_err(refused)?;
        same_dimension((of, unit), (against, expected.unit))?;
        let values = (vec![found], expected.values);
        largest(values, unit, expected.source)
    } else {
        let (times, values, unit) = series(run, of)?;
        let measured = reference::points(against, &facts).map_err(refused)?;
        let (values, expected) = match measured {
            Some(points) => beside((times, values), against, points)?,
            None => {
                let expected = reference::series(against, &facts, times).map_err(refused)?;
                (values.to_vec(), expected)
            }
        };
        same_dimension((of, unit), (against, expected.unit))?;
        let root_mean_square = root_mean_square(&values, &expected.values);
        let mut error = largest((values, expected.values), unit, expected.source)?;
        if norm == Norm::RootMeanSquare {
            error.error = root_mean_square;
        }
        error.signed = error.error;
        Ok(error)
    }?;
    if !error.error.is_finite() {
        return Err(Undecided(format!(
            "{of} against {against} is no finite number: the result or the reference is zero or not finite"
        )));
    }
    Ok(error)
}

/// Refuses to compare a speed with a time.
pub(super) fn same_dimension(
    (of, unit): (&str, &str),
    (against, other): (&str, &str),
) -> Result<(), Undecided> {
    study::comparable(unit, other)
        .map_err(|(one, other)| Undecided(format!("`{of}` is {one}, the reference `{against}` is {other}")))
}

/// The series at the times of a measured curve, as far as the series lasts.
fn beside(
    (times, values): (&[f64], &[f64]),
    against: &str,
    points: Points,
) -> Result<(Vec<f64>, Expected), Undecided> {
    let found = points.times.iter().zip(&points.values);
    let (found, expected): (Vec<f64>, Vec<f64>) = found
        .filter_map(|(time, value)| Some((interpolation::at(times, values, *time)?, *value)))
        .unzip();
    if found.is_empty() {
        let (first, last) = (times.first().unwrap_or(&0.0), times.last().unwrap_or(&0.0));
        return Err(Undecided(format!(
            "no point of the reference `{against}` lies within the run, {first} to {last} s"
        )));
    }
    let expected = Expected {
        values: expected,
        unit: points.unit,
        source: points.source,
    };
    Ok((found, expected))
}

/// Over the largest reference value.
fn root_mean_square(found: &[f64], expected: &[f64]) -> f64 {
    let scale = expected
        .iter()
        .fold(0.0, |scale: f64, value| scale.max(value.abs()));
    let squares: f64 = found.iter().zip(expected).map(|(x, y)| (x - y).powi(2)).sum();
    (squares / found.len() as f64).sqrt() / scale
}

/// The same over seeds: the error of the mean for a scalar, the mean error for a series.
///
/// # Errors
/// As [`point_error`], for any of the runs.
pub fn mean_error(
    replicates: &Replicates,
    of: &str,
    against: &str,
    norm: Norm,
) -> Result<PointError, Undecided> {
    let errors: Vec<PointError> = replicates
        .runs
        .iter()
        .map(|run| point_error(run, of, against, norm))
        .collect::<Result<_, _>>()?;
    let sample = |number: fn(&PointError) -> f64| Sample::of(errors.iter().map(number));
    let (mut signed, mut computed) = (sample(|error| error.signed), sample(|error| error.computed));
    if let [run] = replicates.runs.as_slice() {
        computed.own = run.derived(of).map_or(0.0, |derived| derived.half_width);
        signed.own = computed.own / errors[0].expected.abs();
    }
    Ok(PointError {
        expected: sample(|error| error.expected).mean,
        computed: computed.mean,
        error: signed.mean.abs(),
        signed: signed.mean,
        spread: signed.standard_error(),
        half_width: signed.half_width(),
        half_width_computed: computed.half_width(),
        ..errors[0].clone()
    })
}

/// A scalar, or a measure of work, over seeds.
///
/// # Errors
/// A run without it, or a value that is not finite.
pub fn mean_scalar(replicates: &Replicates, of: &str) -> Result<Mean, Undecided> {
    let mut values = Vec::new();
    let mut unit = String::new();
    for run in &replicates.runs {
        let (value, its_unit) = run.measure(of).ok_or_else(|| missing(run, of))?;
        if !value.is_finite() {
            return Err(Undecided(format!("{of} is {value}")));
        }
        values.push(value);
        unit = its_unit.to_string();
    }
    let mut sample = Sample::of(values);
    if let [run] = replicates.runs.as_slice() {
        sample.own = run.derived(of).map_or(0.0, |derived| derived.half_width);
    }
    Ok(Mean {
        value: sample.mean,
        sample,
        unit,
    })
}

/// Times, values and unit of a time series.
pub(super) fn series<'a>(run: &'a Run, of: &str) -> Result<(&'a [f64], &'a [f64], &'a str), Undecided> {
    let table: Option<&Table> = run.table("time_series");
    let column = table.and_then(|table| table.column(of));
    match (table.and_then(|table| table.columns.first()), column) {
        (Some(time), Some(column)) if !time.values.is_empty() => {
            Ok((&time.values, &column.values, &column.unit))
        }
        _ => Err(missing(run, of)),
    }
}

fn missing(run: &Run, of: &str) -> Undecided {
    if let Some(fault) = run.derived(of).and_then(|derived| derived.fault.as_ref()) {
        return Undecided(format!("`{of}` cannot be derived: {fault}"));
    }
    let mut names: Vec<&str> = run.scalars.iter().map(|scalar| scalar.name.as_str()).collect();
    if let Some(table) = run.table("time_series") {
        names.extend(table.columns.iter().skip(1).map(|column| column.name.as_str()));
    }
    let known = if names.is_empty() {
        "nothing".to_string()
    } else {
        names.join(", ")
    };
    Undecided(format!(
        "the run has no `{of}`, only {known}; add it to `observe` and run the study again"
    ))
}

/// The place where found and expected are farthest apart.
fn largest(
    (found, expected): (Vec<f64>, Vec<f64>),
    unit: &str,
    source: String,
) -> Result<PointError, Undecided> {
    let scale = expected
        .iter()
        .fold(0.0, |scale: f64, value| scale.max(value.abs()));
    let pairs = found.iter().zip(&expected);
    // A difference that is not a number ranks above all others, so that it is seen.
    let worst = pairs.max_by(|a, b| (a.0 - a.1).abs().total_cmp(&(b.0 - b.1).abs()));
    let (&computed, &expected) = worst.ok_or_else(|| Undecided("the series is empty".to_string()))?;
    let error = (computed - expected).abs() / scale;
    let signed = if found.len() == 1 {
        computed / expected - 1.0
    } else {
        error
    };
    Ok(PointError {
        expected,
        computed,
        error,
        signed,
        spread: 0.0,
        half_width: 0.0,
        half_width_computed: 0.0,
        unit: unit.to_string(),
        source,
    })
}
