//! The relative error against a reference stays below a bound, at every point.

use super::{Finding, Part, blank, confidence, erroneous, spread};
use crate::judge::model::PointVerdict;
use crate::judge::point_error::{PointError, mean_error};
use crate::judge::select::Replicates;
use crate::judge::words::{percent, significant};
use crate::study::model::Norm;

pub fn check(groups: &[Replicates], of: &str, against: &str, below: f64, norm: Norm) -> Finding {
    let mut finding = Finding::default();
    let mut widest_spread = 0.0f64;
    for group in groups {
        let error = match mean_error(group, of, against, norm) {
            Ok(error) => error,
            Err(undecided) => {
                finding.points.push(blank(group));
                finding
                    .parts
                    .push(Part::open(format!("{}: {undecided}", group.label())));
                continue;
            }
        };
        if finding.error.is_none_or(|worst| error.error > worst) {
            finding.error = Some(error.error);
            finding.expected = Some(error.expected);
            finding.computed = Some(error.computed);
            finding.half_width = Some(error.half_width_computed);
        }
        widest_spread = widest_spread.max(error.half_width);
        let part = part(group, &error, below);
        finding.points.push(PointVerdict {
            holds: part.decided(),
            ..erroneous(group, &error)
        });
        finding.parts.push(part);
        finding.unit = error.unit;
        finding.source = error.source;
    }
    finding.spread = spread(groups, widest_spread);
    finding
}

fn part(group: &Replicates, error: &PointError, below: f64) -> Part {
    let percent_of = |share: f64| format!("{} %", significant(100.0 * share, 3));
    let found = percent_of(error.error);
    if error.half_width > 0.0 && (error.error - below).abs() <= error.half_width {
        let (over, remedy) = confidence(group.runs.len() > 1);
        return Part::open(format!(
            "{}: the error {found} ± {} (95 % confidence {over}) straddles {}; {remedy}",
            group.label(),
            percent_of(error.half_width),
            percent(below)
        ));
    }
    if error.error < below {
        return Part::holds();
    }
    let unit = match error.unit.as_str() {
        "1" | "" => String::new(),
        unit => format!(" {unit}"),
    };
    Part::fails(format!(
        "{}: the error is {found}, {}{unit} instead of {}{unit}",
        group.label(),
        significant(error.computed, 4),
        significant(error.expected, 4)
    ))
}
