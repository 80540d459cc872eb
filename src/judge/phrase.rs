//! An expectation in words.

use super::words::{band, percent, relation, selection, significant};
use crate::study::model::{
    Band, Check, Comparison, Ending, FitTarget, FittedLaw, LawFit, Limit, Norm, Parameter, Relation,
};

pub struct Phrase {
    pub statement: String,
    pub quantity: String,
    pub band: String,
}

impl Phrase {
    pub fn of(check: &Check) -> Phrase {
        match check {
            Check::Value { of, band } => value(of, band),
            Check::Error {
                of,
                against,
                below,
                norm,
            } => error((of, against), *below, *norm),
            Check::Order {
                of,
                against,
                over,
                is,
                within,
            } => order((of, against, over), *is, *within),
            Check::Monotone {
                of,
                over,
                rising,
                within_noise,
            } => monotone(of, over, *rising, *within_noise),
            Check::Compare(comparison) => compare(comparison),
            Check::Scaling { of, over, is, within } => scaling(of, over, *is, *within),
            Check::Fit(fit) => fitted(fit),
            Check::Status { is } => status(is),
            Check::Limit(limit) => left(limit),
        }
    }
}

fn value(of: &str, bounds: &Band) -> Phrase {
    let words = band(bounds);
    let link = match (bounds.above, bounds.below) {
        (Some(_), Some(_)) => " in ",
        _ => " ",
    };
    Phrase {
        statement: format!("`{of}`{link}{words}"),
        quantity: of.to_string(),
        band: words,
    }
}

fn error((of, against): (&str, &str), below: f64, norm: Norm) -> Phrase {
    let error = match norm {
        Norm::Maximum => "relative error",
        Norm::RootMeanSquare => "relative root mean square error",
    };
    Phrase {
        statement: format!(
            "{error} of `{of}` against the reference `{against}` < {}",
            percent(below)
        ),
        quantity: of.to_string(),
        band: format!("< {}", significant(below, 6)),
    }
}

fn order((of, against, over): (&str, &str, &str), is: f64, within: f64) -> Phrase {
    let (order, tolerance) = (significant(is, 6), significant(within, 6));
    Phrase {
        statement: format!(
            "order of the error of `{of}` against the reference `{against}` over `{over}` is {order} ± {tolerance}"
        ),
        quantity: format!("order of {of} over {over}"),
        band: format!(
            "{} to {}",
            significant(is - within, 6),
            significant(is + within, 6)
        ),
    }
}

fn monotone(of: &str, over: &str, rising: bool, within_noise: bool) -> Phrase {
    let (direction, band) = match rising {
        true => ("rises", "rising"),
        false => ("falls", "falling"),
    };
    let noise = match within_noise {
        true => ", up to the noise of its seeds",
        false => "",
    };
    Phrase {
        statement: format!("`{of}` {direction} with `{over}`{noise}"),
        quantity: of.to_string(),
        band: band.to_string(),
    }
}

fn scaling(of: &str, over: &str, is: f64, within: f64) -> Phrase {
    let (exponent, tolerance) = (significant(is, 6), significant(within, 6));
    Phrase {
        statement: format!("`{of}` grows like `{over}` to the power {exponent} ± {tolerance}"),
        quantity: format!("exponent of {of} over {over}"),
        band: format!(
            "{} to {}",
            significant(is - within, 6),
            significant(is + within, 6)
        ),
    }
}

fn fitted(fit: &LawFit) -> Phrase {
    let FittedLaw { of, over, .. } = &fit.law;
    let parameter = match fit.parameter {
        Parameter::Exponent => "exponent",
        Parameter::Velocity => "velocity at porosity 1",
    };
    let called = format!("Richardson–Zaki {parameter} of `{of}` over `{over}`");
    let (statement, band) = match &fit.target {
        FitTarget::Reference { against, below } => (
            format!(
                "{called} differs from that of the reference `{against}` by < {}",
                percent(*below)
            ),
            format!("< {}", significant(*below, 6)),
        ),
        FitTarget::Band(bounds) => {
            let words = band(bounds);
            let link = match (bounds.above, bounds.below) {
                (Some(_), Some(_)) => " in ",
                _ => " ",
            };
            (format!("{called}{link}{words}"), words)
        }
    };
    Phrase {
        statement,
        quantity: format!("{parameter} of {of} over {over}"),
        band,
    }
}

fn status(is: &[Ending]) -> Phrase {
    let word = |ending: &Ending| match ending {
        Ending::Completed => "completes",
        Ending::Diverged => "diverges and says why",
    };
    let band = is.iter().map(word).collect::<Vec<_>>().join(" or ");
    Phrase {
        statement: format!("every run {band}"),
        quantity: "status".to_string(),
        band,
    }
}

fn left(limit: &Limit) -> Phrase {
    let Limit {
        of, over, against, ..
    } = limit;
    Phrase {
        statement: format!(
            "`{of}` stays {} up to the `{over}` of the reference `{against}`, within {} of the values on both sides",
            band(&limit.band),
            percent(limit.within)
        ),
        quantity: over.clone(),
        band: format!("within {}", significant(limit.within, 6)),
    }
}

fn compare(comparison: &Comparison) -> Phrase {
    let [first, second] = comparison.between.each_ref().map(selection);
    let band = relation(comparison);
    let link = match comparison.is {
        Relation::Equal => "to that",
        Relation::Greater | Relation::Less => "than",
    };
    let (word, margin) = band.split_once(' ').unwrap_or((&band, ""));
    let margin = match margin {
        "" => String::new(),
        margin => format!(", {margin}"),
    };
    Phrase {
        statement: format!(
            "`{}` at {first} is {word} {link} at {second}{margin}",
            comparison.of
        ),
        quantity: comparison.of.clone(),
        band,
    }
}
