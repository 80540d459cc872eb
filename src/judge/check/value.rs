//! A scalar lies in a band, at every point.

use super::{Finding, Part, blank, confidence, spread};
use crate::judge::model::PointVerdict;
use crate::judge::point_error::{Mean, mean_scalar};
use crate::judge::select::Replicates;
use crate::judge::words;
use crate::study::model::Band;

pub fn check(groups: &[Replicates], of: &str, band: &Band) -> Finding {
    let mut finding = Finding {
        source: "stated in the study".to_string(),
        ..Finding::default()
    };
    let (mut narrowest, mut widest_spread) = (f64::INFINITY, 0.0f64);
    for group in groups {
        let mean = match mean_scalar(group, of) {
            Ok(mean) => mean,
            Err(undecided) => {
                finding.points.push(blank(group));
                finding
                    .parts
                    .push(Part::open(format!("{}: {undecided}", group.label())));
                continue;
            }
        };
        let margin = margin(band, mean.value);
        if margin < narrowest {
            narrowest = margin;
            finding.computed = Some(mean.value);
            finding.half_width = Some(mean.sample.half_width());
        }
        widest_spread = widest_spread.max(mean.sample.half_width());
        let part = part(group, of, band, &mean);
        finding.points.push(PointVerdict {
            computed: Some(mean.value),
            half_width: Some(mean.sample.half_width()).filter(|width| *width > 0.0),
            holds: part.decided(),
            ..blank(group)
        });
        finding.parts.push(part);
        finding.unit = mean.unit;
    }
    finding.spread = spread(groups, widest_spread);
    finding
}

fn part(group: &Replicates, of: &str, band: &Band, mean: &Mean) -> Part {
    let margin = margin(band, mean.value);
    let found = words::significant(mean.value, 6);
    let half_width = mean.sample.half_width();
    if margin.abs() <= half_width && half_width > 0.0 {
        let (over, remedy) = confidence(group.runs.len() > 1);
        return Part::open(format!(
            "{}: {of} = {found} ± {} (95 % confidence {over}) straddles a limit; {remedy}",
            group.label(),
            words::significant(half_width, 3)
        ));
    }
    // The edge belongs to a two-sided band and not to a bound.
    let holds = margin > 0.0 || (margin == 0.0 && band.above.is_some() && band.below.is_some());
    if holds {
        Part::holds()
    } else {
        Part::fails(format!(
            "{}: {of} = {found} is not {}",
            group.label(),
            words::band(band)
        ))
    }
}

/// Distance to the nearest edge, negative outside.
fn margin(band: &Band, value: f64) -> f64 {
    let above = band.above.map_or(f64::INFINITY, |edge| value - edge);
    let below = band.below.map_or(f64::INFINITY, |edge| edge - value);
    above.min(below)
}
