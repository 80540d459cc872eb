//! A scalar rises, or falls, along an axis.

use super::{Finding, Part, blank, spread};
use crate::judge::model::PointVerdict;
use crate::judge::point_error::{Mean, mean_scalar};
use crate::judge::select::{Chain, Replicates};
use crate::judge::words::significant;

/// Differences below so many standard errors are noise.
pub(super) const NOISE: f64 = 2.0;

#[derive(Clone, Copy, Debug)]
pub struct Trend {
    pub rising: bool,
    /// Whether a step against the trend may be noise.
    pub within_noise: bool,
}

pub fn check(chains: &[Chain], of: &str, over: &str, trend: &Trend) -> Finding {
    let mut finding = Finding {
        source: "stated in the study".to_string(),
        ..Finding::default()
    };
    if chains.is_empty() {
        let reason = format!("no selected run has a number `{over}` to go along");
        finding.parts.push(Part::open(reason));
    }
    let mut widest = 0.0f64;
    for chain in chains {
        widest = widest.max(along(&mut finding, chain, of, over, trend));
    }
    let groups: Vec<Replicates> = chains
        .iter()
        .flat_map(|chain| chain.steps.iter().map(|(_, group)| group.clone()))
        .collect();
    finding.spread = spread(&groups, widest);
    finding
}

/// One chain; gives back its largest half width.
fn along(finding: &mut Finding, chain: &Chain, of: &str, over: &str, trend: &Trend) -> f64 {
    if chain.steps.len() < 2 {
        let reason = format!("{}: one value of {over}, a trend needs two", chain.label);
        finding.parts.push(Part::open(reason));
    }
    let mut means: Vec<Mean> = Vec::new();
    for (_, group) in &chain.steps {
        let mut point = blank(group);
        match mean_scalar(group, of) {
            Ok(mean) => {
                let half_width = mean.sample.half_width();
                point.computed = Some(mean.value);
                point.half_width = Some(half_width).filter(|width| *width > 0.0);
                finding.unit = mean.unit.clone();
                if let Some(last) = means.last() {
                    let part = part(&group.label(), of, (last, &mean), trend);
                    note(finding, &mut point, part);
                }
                means.push(mean);
            }
            Err(undecided) => {
                let reason = format!("{}: {undecided}", group.label());
                finding.parts.push(Part::open(reason));
            }
        }
        finding.points.push(point);
    }
    // Many steps that each pass for noise may still add up.
    if let (true, [first, _, .., last]) = (trend.within_noise, means.as_slice()) {
        let label = format!("{}, from end to end", chain.label);
        finding.parts.push(part(&label, of, (first, last), trend));
    }
    let widths = means.iter().map(|mean| mean.sample.half_width());
    widths.fold(0.0, f64::max)
}

/// The first failing step decides; else the last point stands for the chain.
fn note(finding: &mut Finding, point: &mut PointVerdict, part: Part) {
    point.holds = part.decided();
    let failed_before = finding.parts.iter().any(|part| part.decided() == Some(false));
    if !failed_before {
        finding.computed = point.computed;
        finding.half_width = point.half_width;
    }
    finding.parts.push(part);
}

fn part(label: &str, of: &str, (last, mean): (&Mean, &Mean), trend: &Trend) -> Part {
    let noise = NOISE * last.sample.standard_error_of_difference(&mean.sample);
    let change = mean.value - last.value;
    let (from, to) = (significant(last.value, 6), significant(mean.value, 6));
    let along = (change > 0.0 && trend.rising) || (change < 0.0 && !trend.rising);
    let is_noise = noise > 0.0 && change.abs() <= noise;
    match (along, is_noise, trend.within_noise) {
        (true, false, _) | (true, true, true) | (false, true, true) => Part::holds(),
        (_, true, false) => Part::open(format!(
            "{label}: {of} goes from {from} to {to}, less than twice its standard error over seeds; run more \
             seeds, or allow it with `within_noise: true`"
        )),
        (false, false, _) if noise > 0.0 => Part::fails(format!(
            "{label}: {of} goes from {from} to {to}, beyond the noise of its seeds"
        )),
        (false, false, _) => Part::fails(format!("{label}: {of} goes from {from} to {to}")),
    }
}
