//! Numbers that a study makes of the series of each run.

use super::fit::segmented::{self, Segmented, meeting};
use super::fit::{Estimate, FitError};
use super::point_error::series;
use crate::store::model::{Derived, Run, Scalar, Status};
use crate::study::model::{self, Coordinate, Derivation, Segment, Study};

/// Gives every completed run what the study derives; where that fails, the reason why.
pub fn derive(study: &Study, runs: &mut [Run]) {
    for run in runs.iter_mut().filter(|run| run.status == Status::Completed) {
        run.derived = study.derive.iter().map(|what| derived(run, what)).collect();
    }
}

fn derived(run: &Run, what: &model::Derived) -> Derived {
    let found = estimate(run, &what.how);
    let finite = |found: &Estimate| found.value.is_finite();
    let (value, half_width, fault) = match found {
        Ok(found) if finite(&found) => (found.value, found.half_width(), None),
        Ok(_) => (f64::NAN, 0.0, Some("the fit gives no finite number".to_string())),
        Err(fault) => (f64::NAN, 0.0, Some(fault.0)),
    };
    Derived {
        scalar: Scalar {
            name: what.name.clone(),
            unit: what.unit.clone(),
            value,
        },
        half_width,
        fault,
    }
}

fn estimate(run: &Run, how: &Derivation) -> Result<Estimate, FitError> {
    match how {
        Derivation::Slope { of, line, falling } => {
            let slope = fitted(run, of, line)?.slopes[line.which - 1];
            let sign = if *falling { -1.0 } else { 1.0 };
            Ok(Estimate {
                value: sign * slope.value,
                ..slope
            })
        }
        Derivation::Breakpoint { of, line } => Ok(fitted(run, of, line)?.joints[line.which - 1]),
        Derivation::Crossing { of, line, take } => {
            let straight = |of: &String| Ok(fitted(run, of, line)?.straight(line.which - 1));
            let [time, value] = meeting(&straight(&of[0])?, &straight(&of[1])?)?;
            Ok(match take {
                Coordinate::Time => time,
                Coordinate::Value => value,
            })
        }
    }
}

/// The segments of a series over a window.
///
/// # Errors
/// A run without the series, or a series that the segments do not fit.
pub fn fitted(run: &Run, of: &str, line: &Segment) -> Result<Segmented, FitError> {
    let (times, values, _) = series(run, of).map_err(|missing| FitError(missing.0))?;
    let [from, to] = line.window;
    let from = from.unwrap_or(f64::NEG_INFINITY);
    let to = to.unwrap_or(f64::INFINITY);
    // A front that is not there yet, or no more, is no number.
    let inside = times
        .iter()
        .zip(values)
        .filter(|(time, value)| (from..=to).contains(*time) && !value.is_nan());
    let (times, values): (Vec<f64>, Vec<f64>) = inside.unzip();
    segmented::fit(&times, &values, line.segments).map_err(|fault| FitError(format!("`{of}`: {fault}")))
}
