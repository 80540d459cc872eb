//! A verdict as a row of the page, numbers in readable units.

use serde::Serialize;

use super::format;
use crate::judge::model::{Outcome, Verdict};

#[derive(Serialize)]
pub struct VerdictRow {
    id: String,
    statement: String,
    quantity: String,
    unit: String,
    expected: String,
    computed: String,
    error: String,
    band: String,
    kind: &'static str,
    word: &'static str,
    reason: Option<String>,
    source: String,
    claims: Vec<String>,
    informative: Option<String>,
    points: Vec<PointRow>,
}

#[derive(Serialize)]
pub struct PointRow {
    label: String,
    expected: String,
    computed: String,
    error: String,
    kind: &'static str,
    word: &'static str,
}

fn outcome_words(outcome: Outcome) -> (&'static str, &'static str) {
    match outcome {
        Outcome::Holds => ("holds", "holds"),
        Outcome::Fails => ("fails", "fails"),
        Outcome::NotDecidable => ("open", "not decidable"),
    }
}

/// One verdict in words.
pub fn verdict_row(verdict: &Verdict) -> VerdictRow {
    let (kind, word) = outcome_words(verdict.verdict);
    let values = verdict
        .points
        .iter()
        .flat_map(|point| [point.expected, point.computed]);
    let values = values.chain([verdict.expected, verdict.computed]).flatten();
    // A band on the value itself is in SI units; only then the value has to stay in them.
    let unit = match verdict.error {
        Some(_) => format::readable(
            &verdict.unit,
            values.fold(0.0, |most: f64, value| most.max(value.abs())),
        ),
        None => format::Unit {
            factor: 1.0,
            label: format::pretty_unit(&verdict.unit),
        },
    };
    let value =
        |value: Option<f64>| value.map_or("–".to_owned(), |value| format::number(value * unit.factor));
    let error = |error: Option<f64>| error.map_or("–".to_owned(), format::percent);
    let points = verdict.points.iter().map(|point| PointRow {
        label: point.label.clone(),
        expected: value(point.expected),
        computed: value(point.computed),
        error: error(point.error),
        kind: point
            .holds
            .map_or("open", |holds| if holds { "holds" } else { "fails" }),
        word: point
            .holds
            .map_or("–", |holds| if holds { "holds" } else { "fails" }),
    });
    VerdictRow {
        id: verdict.id.clone(),
        statement: verdict.statement.clone(),
        quantity: format::words(&verdict.quantity),
        expected: value(verdict.expected),
        computed: value(verdict.computed),
        error: error(verdict.error),
        band: band(verdict),
        kind,
        word,
        reason: verdict.reason.clone(),
        source: verdict.source.clone(),
        claims: verdict.claims.clone(),
        informative: verdict.informative.clone(),
        points: points.collect(),
        unit: unit.label,
    }
}

/// A bound on an error in percent, like the error beside it.
fn band(verdict: &Verdict) -> String {
    let bound = verdict
        .band
        .strip_prefix("< ")
        .and_then(|bound| bound.trim().parse::<f64>().ok());
    match (verdict.error, bound) {
        (Some(_), Some(bound)) => format!("< {}", format::percent(bound)),
        _ => verdict.band.clone(),
    }
}
