//! The error falls along an axis at an expected order.

use super::{Finding, Part, blank, erroneous};
use crate::judge::convergence::{Honesty, Order, observed_order};
use crate::judge::point_error::{PointError, mean_error};
use crate::judge::select::Chain;
use crate::judge::words::significant;
use crate::study::model::Norm;

/// What is expected of the order.
pub struct Expected {
    pub is: f64,
    pub within: f64,
}

pub fn check(chains: &[Chain], of: &str, against: &str, over: &str, expected: &Expected) -> Finding {
    let mut finding = Finding {
        unit: "1".to_string(),
        expected: Some(expected.is),
        ..Finding::default()
    };
    if chains.is_empty() {
        let reason = format!("no selected run has a number `{over}` to take an order over");
        finding.parts.push(Part::open(reason));
    }
    for chain in chains {
        let mut errors = Vec::new();
        for (_, group) in &chain.steps {
            match mean_error(group, of, against, Norm::Maximum) {
                Ok(error) => {
                    finding.points.push(erroneous(group, &error));
                    finding.source = error.source.clone();
                    errors.push(error);
                }
                Err(undecided) => {
                    finding.points.push(blank(group));
                    finding
                        .parts
                        .push(Part::open(format!("{}: {undecided}", group.label())));
                }
            }
        }
        if errors.len() < chain.steps.len() {
            continue;
        }
        let sizes: Vec<f64> = chain.steps.iter().map(|(size, _)| *size).collect();
        let signed: Vec<f64> = errors.iter().map(|error| error.signed).collect();
        let order = observed_order(&sizes, &signed);
        let off = (order.order - expected.is).abs();
        let known = finding.error.is_none_or(|worst| off > worst);
        if known && order.order.is_finite() {
            finding.computed = Some(order.order);
            finding.error = Some(off);
        }
        finding.parts.push(part(chain, over, &order, &errors, expected));
    }
    // The difference of two orders is no relative error.
    finding.error = None;
    finding
}

fn part(chain: &Chain, over: &str, order: &Order, errors: &[PointError], expected: &Expected) -> Part {
    let label = &chain.label;
    let pairwise: Vec<String> = order.pairwise.iter().map(|p| significant(*p, 3)).collect();
    let pairwise = pairwise.join(", ");
    let values = errors.len();
    match order.honesty {
        Honesty::TooFew => {
            return Part::open(format!(
                "{label}: {values} values of {over}, an order needs three"
            ));
        }
        Honesty::Oscillating => {
            return Part::open(format!(
                "{label}: the error changes its sign along {over}, it has no order"
            ));
        }
        Honesty::NotAsymptotic => {
            return Part::open(format!(
                "{label}: not asymptotic, orders between neighbours {pairwise}; refine {over}"
            ));
        }
        Honesty::Monotone => {}
    }
    let variance = order.weights.iter().zip(errors);
    let noise = variance
        .map(|(weight, error)| (weight * error.spread / error.error).powi(2))
        .sum::<f64>()
        .sqrt();
    let off = (order.order - expected.is).abs();
    let found = significant(order.order, 4);
    if noise > 0.0 && (off - expected.within).abs() <= noise {
        let noise = significant(noise, 3);
        return Part::open(format!(
            "{label}: order {found} ± {noise} over seeds straddles a limit; run more seeds"
        ));
    }
    if off <= expected.within {
        Part::holds()
    } else {
        Part::fails(format!("{label}: order {found}, between neighbours {pairwise}"))
    }
}
