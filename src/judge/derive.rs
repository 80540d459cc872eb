//! Numbers that a study makes of the series of each run.

use super::fit::segmented::{self, Segmented, meeting};
use super::fit::{Estimate, FitError};
use super::interpolation;
use super::point_error::series;
use crate::store::model::{Derived, Run, Scalar, Status};
use crate::study::model::{self, Coordinate, Derivation, Reduction, Segment, Study};

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
        Derivation::Slope {
            of,
            over,
            line,
            falling,
        } => {
            let slope = fitted(run, of, over.as_deref(), line)?.slopes[line.which - 1];
            let sign = if *falling { -1.0 } else { 1.0 };
            Ok(Estimate {
                value: sign * slope.value,
                ..slope
            })
        }
        Derivation::Intercept { of, over, line } => {
            Ok(fitted(run, of, over.as_deref(), line)?.straight(0).at(0.0))
        }
        Derivation::Breakpoint { of, line } => Ok(fitted(run, of, None, line)?.joints[line.which - 1]),
        Derivation::Crossing { of, line, take } => {
            let straight = |of: &String| Ok(fitted(run, of, None, line)?.straight(line.which - 1));
            let [time, value] = meeting(&straight(&of[0])?, &straight(&of[1])?)?;
            Ok(match take {
                Coordinate::Time => time,
                Coordinate::Value => value,
            })
        }
        Derivation::Value { of, at } => {
            let (times, values, _) = series(run, of).map_err(|missing| FitError(missing.0))?;
            let outside = || FitError(format!("`{of}` has no sample at {at} s"));
            interpolation::at(times, values, *at)
                .map(exact)
                .ok_or_else(outside)
        }
        Derivation::Reduced { of, window, to } => {
            let (_, values) = inside(run, of, None, *window)?;
            if values.is_empty() {
                return Err(FitError(format!("`{of}` has no sample in the window")));
            }
            let number = match to {
                Reduction::Mean => values.iter().sum::<f64>() / values.len() as f64,
                Reduction::Smallest => values.iter().copied().fold(f64::INFINITY, f64::min),
                Reduction::Largest => values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            };
            Ok(exact(number))
        }
        Derivation::Passes { of, share } => {
            let (times, values) = inside(run, of, None, [None, None])?;
            passed(&times, &values, *share)
                .map(exact)
                .ok_or_else(|| FitError(format!("`{of}` never comes to {share} of its first value")))
        }
    }
}

/// A number that is no estimate.
fn exact(value: f64) -> Estimate {
    Estimate {
        value,
        standard_error: 0.0,
        freedom: 1.0,
    }
}

/// When values first come to a share of the first one, straight between samples.
fn passed(times: &[f64], values: &[f64], share: f64) -> Option<f64> {
    let level = share * values.first()?;
    let beyond = |value: &f64| {
        if share > 1.0 {
            *value > level
        } else {
            *value < level
        }
    };
    let after = values.iter().position(beyond)?;
    let Some(before) = after.checked_sub(1) else {
        return times.first().copied();
    };
    let part = (level - values[before]) / (values[after] - values[before]);
    Some(times[before] + part * (times[after] - times[before]))
}

/// The segments of a series over a window, along time or another series.
///
/// # Errors
/// A run without the series, or a series that the segments do not fit.
pub fn fitted(run: &Run, of: &str, over: Option<&str>, line: &Segment) -> Result<Segmented, FitError> {
    let (places, values) = inside(run, of, over, line.window)?;
    segmented::fit(&places, &values, line.segments).map_err(|fault| FitError(format!("`{of}`: {fault}")))
}

/// A series in a window of times, with those times or the values of another series.
fn inside(
    run: &Run,
    of: &str,
    over: Option<&str>,
    [from, to]: [Option<f64>; 2],
) -> Result<(Vec<f64>, Vec<f64>), FitError> {
    let found = |name: &str| series(run, name).map_err(|missing| FitError(missing.0));
    let (times, values, _) = found(of)?;
    let places = match over {
        Some(over) => found(over)?.1,
        None => times,
    };
    let window = from.unwrap_or(f64::NEG_INFINITY)..=to.unwrap_or(f64::INFINITY);
    // A front that is not there yet, or no more, is no number.
    Ok(times
        .iter()
        .zip(places.iter().zip(values))
        .filter(|(time, (place, value))| window.contains(*time) && !value.is_nan() && !place.is_nan())
        .map(|(_, pair)| pair)
        .unzip())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::store::model::{Column, PointId, Table, Timing};

    /// 1 + 2 x over x = t², and a fall from 10 to 0 in 10 s.
    fn run() -> Run {
        let times: Vec<f64> = (0..=20).map(|index| 0.5 * f64::from(index)).collect();
        let column = |name: &str, value: fn(f64) -> f64| Column {
            name: name.into(),
            unit: "1".into(),
            values: times.iter().map(|time| value(*time)).collect(),
        };
        Run {
            id: PointId("a".into()),
            study: String::new(),
            scene: "scene".into(),
            axes: Vec::new(),
            seed: 1,
            settings: serde_json::Value::Null,
            status: Status::Completed,
            reason: None,
            scalars: Vec::new(),
            counters: Vec::new(),
            tables: vec![Table {
                name: "time_series".into(),
                columns: vec![
                    column("time", |time| time),
                    column("place", |time| time * time),
                    column("line", |time| {
                        if time < 1.0 {
                            f64::NAN
                        } else {
                            1.0 + 2.0 * time * time
                        }
                    }),
                    column("fall", |time| 10.0 - time),
                ],
            }],
            derived: Vec::new(),
            timing: Timing::default(),
        }
    }

    fn value(how: &Derivation) -> Result<f64, FitError> {
        estimate(&run(), how).map(|found| found.value)
    }

    const WHOLE: Segment = Segment {
        window: [None, None],
        segments: 1,
        which: 1,
    };

    #[test]
    fn a_line_over_another_series_has_its_slope_and_begins_where_it_begins() {
        let (of, over, line) = ("line".to_owned(), Some("place".to_owned()), WHOLE);
        let slope = Derivation::Slope {
            of: of.clone(),
            over: over.clone(),
            line,
            falling: false,
        };
        assert!((value(&slope).unwrap() - 2.0).abs() < 1e-9);
        let intercept = Derivation::Intercept { of, over, line };
        assert!((value(&intercept).unwrap() - 1.0).abs() < 1e-9);
    }

    #[test]
    fn values_and_extremes_are_those_of_the_window() {
        let of = "fall".to_owned();
        let at = |at: f64| value(&Derivation::Value { of: of.clone(), at });
        assert_eq!(at(2.25).unwrap(), 7.75);
        assert!(at(11.0).unwrap_err().0.contains("no sample at 11 s"));
        let reduced = |to: Reduction, window| {
            let of = of.clone();
            value(&Derivation::Reduced { of, window, to })
        };
        assert_eq!(reduced(Reduction::Mean, [Some(2.0), Some(4.0)]).unwrap(), 7.0);
        assert_eq!(reduced(Reduction::Smallest, [None, Some(4.0)]).unwrap(), 6.0);
        assert_eq!(reduced(Reduction::Largest, [None, None]).unwrap(), 10.0);
        assert!(reduced(Reduction::Mean, [Some(20.0), None]).is_err());
    }

    #[test]
    fn a_series_passes_a_share_of_its_first_value_once() {
        let passes = |of: &str, share: f64| {
            let of = of.to_owned();
            value(&Derivation::Passes { of, share })
        };
        assert!((passes("fall", 0.98).unwrap() - 0.2).abs() < 1e-12);
        assert!((passes("line", 3.0).unwrap() - 2.0).abs() < 1e-12);
        assert!(passes("fall", 1.5).unwrap_err().0.contains("never comes to 1.5"));
    }
}
