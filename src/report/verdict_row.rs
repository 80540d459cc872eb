//! A verdict as a row of the page, numbers in readable units.

use serde::Serialize;

use super::{format, told};
use crate::judge::model::{Outcome, Verdict};
use crate::reference;
use crate::study::model::{Check, FitTarget, LawFit, Limit, Study};

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
    mark: &'static str,
    word: &'static str,
    reason: Option<String>,
    /// The point that the numbers of the row belong to, where there are several.
    at: Option<String>,
    /// What the reference is, in words.
    reference: Option<String>,
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
    mark: &'static str,
    word: &'static str,
}

/// Style, symbol and word: a colour alone tells nothing to many, and nothing on paper.
fn outcome_words(outcome: Outcome) -> (&'static str, &'static str, &'static str) {
    match outcome {
        Outcome::Holds => ("holds", "✓", "holds"),
        Outcome::Fails => ("fails", "✗", "fails"),
        Outcome::NotDecidable => ("open", "?", "not decidable"),
    }
}

/// One verdict in words; [`told`] before.
pub fn verdict_row(study: &Study, verdict: &Verdict) -> VerdictRow {
    let (kind, mark, word) = outcome_words(verdict.verdict);
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
        |value: Option<f64>| value.map_or("–".to_owned(), |value| format::four_digits(value * unit.factor));
    let measured = |computed: Option<f64>, half_width: Option<f64>| match (computed, half_width) {
        (Some(computed), Some(half_width)) => {
            format::plus_minus(computed * unit.factor, half_width * unit.factor)
        }
        (computed, _) => value(computed),
    };
    let error = |error: Option<f64>| error.map_or("–".to_owned(), format::percent_found);
    let points = verdict.points.iter().map(|point| {
        let (kind, mark, word) = match point.holds {
            Some(true) => outcome_words(Outcome::Holds),
            Some(false) => outcome_words(Outcome::Fails),
            None => ("open", "", "–"),
        };
        PointRow {
            label: point.label.clone(),
            expected: value(point.expected),
            computed: measured(point.computed, point.half_width),
            error: error(point.error),
            kind,
            mark,
            word,
        }
    });
    let deciding = told::deciding(verdict).filter(|_| verdict.points.len() > 1);
    VerdictRow {
        id: verdict.id.clone(),
        statement: verdict.statement.clone(),
        quantity: format::words(&verdict.quantity),
        expected: value(verdict.expected),
        computed: measured(verdict.computed, verdict.half_width),
        error: error(verdict.error),
        band: told::band(verdict),
        kind,
        mark,
        word,
        reason: verdict.reason.clone(),
        at: deciding.map(|point| point.label.clone()),
        reference: meaning(study, &verdict.id),
        source: verdict.source.clone(),
        claims: verdict.claims.clone(),
        informative: verdict.informative.clone(),
        points: points.collect(),
        unit: unit.label,
    }
}

/// What the reference of an expectation is, as the list of references says it.
fn meaning(study: &Study, id: &str) -> Option<String> {
    let expectation = study.expect.iter().find(|expectation| expectation.id == id)?;
    let (Check::Error { against, .. }
    | Check::Order { against, .. }
    | Check::Limit(Limit { against, .. })
    | Check::Fit(LawFit {
        target: FitTarget::Reference { against, .. },
        ..
    })) = &expectation.check
    else {
        return None;
    };
    let entry = reference::list()
        .into_iter()
        .find(|entry| entry.name == against)?;
    Some(format!("`{}`, {}", entry.name, entry.meaning))
}
