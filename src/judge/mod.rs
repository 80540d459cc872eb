//! From runs and references to verdicts.

mod check;
pub mod convergence;
pub mod exit;
mod interpolation;
pub mod model;
pub mod pareto;
pub mod point_error;
pub mod select;
#[cfg(test)]
mod tests;
pub mod words;

use crate::store::model::Run;
use crate::study::model::{Check, Expectation, Norm, Selection, Study};
use check::Finding;
use model::{Outcome, Verdict};

/// Judges every expectation of the study on its completed runs.
pub fn judge(study: &Study, runs: &[Run]) -> Vec<Verdict> {
    study
        .expect
        .iter()
        .map(|expectation| verdict(study, runs, expectation))
        .collect()
}

fn verdict(study: &Study, runs: &[Run], expectation: &Expectation) -> Verdict {
    let groups = select::selected(study, runs, &expectation.selection);
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
        Check::Monotone { of, over, rising } => {
            let chains = select::chains(study, runs, &groups, over);
            check::monotone::check(&chains, of, over, *rising)
        }
    };
    let open = select::unanswered(study, runs, &expectation.selection);
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

/// An expectation in words.
struct Phrase {
    statement: String,
    quantity: String,
    band: String,
}

impl Phrase {
    fn of(check: &Check) -> Phrase {
        match check {
            Check::Value { of, band } => {
                let words = words::band(band);
                let link = if band.above.is_some() && band.below.is_some() {
                    " in "
                } else {
                    " "
                };
                Phrase {
                    statement: format!("`{of}`{link}{words}"),
                    quantity: of.clone(),
                    band: words,
                }
            }
            Check::Error {
                of,
                against,
                below,
                norm,
            } => Phrase {
                statement: format!(
                    "{} of `{of}` against the reference `{against}` < {}",
                    match norm {
                        Norm::Maximum => "relative error",
                        Norm::RootMeanSquare => "relative root mean square error",
                    },
                    words::percent(*below)
                ),
                quantity: of.clone(),
                band: format!("< {}", words::significant(*below, 6)),
            },
            Check::Order {
                of,
                against,
                over,
                is,
                within,
            } => {
                let (order, tolerance) = (words::significant(*is, 6), words::significant(*within, 6));
                Phrase {
                    statement: format!(
                        "order of the error of `{of}` against the reference `{against}` over `{over}` is {order} ± {tolerance}"
                    ),
                    quantity: format!("order of {of} over {over}"),
                    band: format!(
                        "{} to {}",
                        words::significant(is - within, 6),
                        words::significant(is + within, 6)
                    ),
                }
            }
            Check::Monotone { of, over, rising } => {
                let direction = if *rising { "rises" } else { "falls" };
                Phrase {
                    statement: format!("`{of}` {direction} with `{over}`"),
                    quantity: of.clone(),
                    band: if *rising { "rising" } else { "falling" }.to_string(),
                }
            }
        }
    }
}
