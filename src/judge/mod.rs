//! From runs and references to verdicts.

pub mod bracket;
pub mod check;
pub mod convergence;
pub mod derive;
pub mod exit;
pub mod fit;
mod interpolation;
pub mod model;
pub mod pareto;
mod phrase;
pub mod point_error;
pub mod select;
pub mod statistics;
#[cfg(test)]
mod tests;
pub mod words;

use crate::store::model::Run;
use crate::study::model::{Check, Expectation, Selection, Study};
use check::Finding;
use model::{Outcome, Verdict};
use phrase::Phrase;

/// Judges every expectation of the study on its completed runs.
pub fn judge(study: &Study, runs: &[Run]) -> Vec<Verdict> {
    study
        .expect
        .iter()
        .map(|expectation| verdict(study, runs, expectation))
        .collect()
}

fn verdict(study: &Study, runs: &[Run], expectation: &Expectation) -> Verdict {
    let divergence_answers = expectation.check.asks_divergence();
    let groups = match &expectation.check {
        Check::Status { .. } | Check::Limit(_) => select::ended(study, runs, &expectation.selection),
        _ => select::selected(study, runs, &expectation.selection),
    };
    let finding = match &expectation.check {
        _ if groups.is_empty() => Finding::default(),
        Check::Value { of, band } => check::value::check(&groups, of, band),
        Check::Error {
            of,
            against,
            below,
            norm,
        } => check::error::check(&groups, of, against, *below, *norm),
        Check::Order {
            of,
            against,
            over,
            is,
            within,
        } => {
            let chains = select::chains(study, runs, &groups, over);
            let expected = check::order::Expected {
                is: *is,
                within: *within,
            };
            check::order::check(&chains, of, against, over, &expected)
        }
        Check::Monotone {
            of,
            over,
            rising,
            within_noise,
        } => {
            let chains = select::chains(study, runs, &groups, over);
            check::monotone::check(&chains, of, over, &trend(*rising, *within_noise))
        }
        Check::Compare(comparison) => {
            let pairs = select::pairs(study, runs, &groups, &comparison.between);
            check::compare::check(&pairs, comparison)
        }
        Check::Scaling { of, over, is, within } => {
            let chains = select::chains(study, runs, &groups, over);
            check::scaling::check(&chains, of, over, *is, *within)
        }
        Check::Fit(fit) => {
            let chains = select::chains(study, runs, &groups, &fit.law.over);
            check::fit::check(&chains, fit)
        }
        Check::Status { is } => check::status::check(&groups, is),
        Check::Limit(limit) => {
            check::limit::check(study, &bracket::brackets(study, runs, &groups, limit), limit)
        }
    };
    let open = select::unanswered(study, runs, divergence_answers, |run| {
        select::admits(&expectation.selection, run)
            && match &expectation.check {
                Check::Compare(comparison) => comparison
                    .between
                    .iter()
                    .any(|selection| select::admits(selection, run)),
                _ => true,
            }
    });
    let (verdict, reason) = if groups.is_empty() {
        (
            Outcome::NotDecidable,
            Some(nothing(&expectation.selection, &open)),
        )
    } else {
        complete(finding.outcome(), &open)
    };
    let phrase = Phrase::of(&expectation.check);
    Verdict {
        id: expectation.id.clone(),
        statement: phrase.statement,
        quantity: phrase.quantity,
        unit: finding.unit,
        expected: finding.expected,
        computed: finding.computed,
        half_width: finding.half_width.filter(|width| *width > 0.0),
        error: finding.error,
        band: phrase.band,
        verdict,
        reason,
        source: finding.source,
        claims: expectation.claims.clone(),
        informative: expectation.informative.clone(),
        points: finding.points,
    }
}

fn trend(rising: bool, within_noise: bool) -> check::monotone::Trend {
    check::monotone::Trend { rising, within_noise }
}

/// A statement about every point cannot hold while points are missing; one failing point is enough to fail.
fn complete(found: (Outcome, Option<String>), open: &[String]) -> (Outcome, Option<String>) {
    match (found, open) {
        ((Outcome::Holds, _), [first, others @ ..]) => {
            let more = match others.len() {
                0 => String::new(),
                count => format!(" and {count} more"),
            };
            let reason = format!("no completed run for {first}{more}; what completed holds");
            (Outcome::NotDecidable, Some(reason))
        }
        (found, _) => found,
    }
}

fn nothing(selection: &Selection, open: &[String]) -> String {
    if open.is_empty() {
        let mut names: Vec<&str> = selection.axes.iter().map(|(name, _)| name.as_str()).collect();
        if !selection.scenes.is_empty() {
            names.insert(0, "scene");
        }
        let names = names.join(", ");
        return match names.is_empty() {
            true => "there is no completed run; run the study".to_string(),
            false => format!("no point of the study is selected; look at `{names}` under `where`"),
        };
    }
    format!(
        "none of the {} selected points has a completed run ({}, …); run the study",
        open.len(),
        open[0]
    )
}
