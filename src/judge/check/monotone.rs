//! A scalar rises, or falls, along an axis.

use super::{Finding, Part, blank, spread};
use crate::judge::model::PointVerdict;
use crate::judge::point_error::{Mean, mean_scalar};
use crate::judge::select::{Chain, Replicates};
use crate::judge::words::significant;

pub fn check(chains: &[Chain], of: &str, over: &str, rising: bool) -> Finding {
    let mut finding = Finding {
        source: "stated in the study".to_string(),
        ..Finding::default()
    };
    if chains.is_empty() {
        let reason = format!("no selected run has a number `{over}` to go along");
        finding.parts.push(Part::open(reason));
    }
    let mut widest_spread = 0.0f64;
    for chain in chains {
        if chain.steps.len() < 2 {
            let reason = format!("{}: one value of {over}, a trend needs two", chain.label);
            finding.parts.push(Part::open(reason));
        }
        let mut last: Option<Mean> = None;
        for (_, group) in &chain.steps {
            let mut point = blank(group);
            match mean_scalar(group, of) {
                Ok(mean) => {
                    widest_spread = widest_spread.max(mean.spread);
                    point.computed = Some(mean.value);
                    finding.unit = mean.unit.clone();
                    if let Some(last) = &last {
                        let part = part(group, of, last, &mean, rising);
                        note(&mut finding, &mut point, part);
                    }
                    last = Some(mean);
                }
                Err(undecided) => {
                    finding
                        .parts
                        .push(Part::open(format!("{}: {undecided}", group.label())));
                }
            }
            finding.points.push(point);
        }
    }
    let groups: Vec<Replicates> = chains
        .iter()
        .flat_map(|chain| chain.steps.iter().map(|(_, group)| group.clone()))
        .collect();
    finding.spread = spread(&groups, widest_spread);
    finding
}

/// The first failing step decides; else the last point stands for the chain.
fn note(finding: &mut Finding, point: &mut PointVerdict, part: Part) {
    point.holds = part.decided();
    let failed_before = finding.parts.iter().any(|part| part.decided() == Some(false));
    if !failed_before {
        finding.computed = point.computed;
    }
    finding.parts.push(part);
}

fn part(group: &Replicates, of: &str, last: &Mean, mean: &Mean, rising: bool) -> Part {
    let noise = last.spread.hypot(mean.spread);
    let change = mean.value - last.value;
    let (from, to) = (significant(last.value, 6), significant(mean.value, 6));
    if noise > 0.0 && change.abs() <= noise {
        return Part::open(format!(
            "{}: {of} goes from {from} to {to}, less than its standard error over seeds; run more seeds",
            group.label()
        ));
    }
    if (change > 0.0 && rising) || (change < 0.0 && !rising) {
        return Part::holds();
    }
    Part::fails(format!("{}: {of} goes from {from} to {to}", group.label()))
}
