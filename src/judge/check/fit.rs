//! A parameter of a law fitted along an axis, beside the same fit to a reference, or in a band.

use super::{Finding, Part, blank};
use crate::judge::fit::richardson_zaki::{self, RichardsonZaki, Scale};
use crate::judge::fit::{Estimate, FitError};
use crate::judge::model::PointVerdict;
use crate::judge::point_error::{mean_scalar, same_dimension};
use crate::judge::select::Chain;
use crate::judge::words::{self, percent, significant};
use crate::reference::{self, Facts};
use crate::store::model::Run;
use crate::study::model::{Band, FitTarget, LawFit, Parameter};

/// References for the exponent, shown beside the fitted one.
const CORRELATIONS: [&str; 4] = ["wallis", "garside_al_dibouni", "rowe", "khan_richardson"];

/// Means over seeds along the axis, with the reference at each.
struct Points {
    porosities: Vec<f64>,
    velocities: Vec<f64>,
    references: Vec<f64>,
    unit: String,
    source: String,
}

/// What was found along one chain.
struct Judged {
    computed: Estimate,
    law: RichardsonZaki,
    expected: Option<f64>,
    /// Relative difference, and how far that may be trusted.
    error: Option<(f64, f64)>,
}

pub fn check(chains: &[Chain], fit: &LawFit) -> Finding {
    let mut finding = Finding {
        source: "stated in the study".to_string(),
        unit: "1".to_string(),
        ..Finding::default()
    };
    if chains.is_empty() {
        let reason = format!("no selected run has a number `{}` to fit along", fit.law.over);
        finding.parts.push(Part::open(reason));
    }
    let mut least = f64::INFINITY;
    for chain in chains {
        let label = format!("{} along {}", chain.label, fit.law.over);
        let found = points(chain, fit).and_then(|points| Ok((judged(&points, fit)?, points)));
        let (judged, points) = match found {
            Ok(found) => found,
            Err(FitError(why)) => {
                finding.points.push(row(chain, label.clone()));
                finding.parts.push(Part::open(format!("{label}: {why}")));
                continue;
            }
        };
        let (part, room) = part(&label, &judged, fit);
        let point = PointVerdict {
            expected: judged.expected,
            computed: Some(judged.computed.value),
            half_width: Some(judged.computed.half_width()),
            error: judged.error.map(|(error, _)| error),
            holds: part.decided(),
            ..row(chain, label.clone())
        };
        if room < least {
            least = room;
            finding.expected = point.expected;
            finding.computed = point.computed;
            finding.half_width = point.half_width;
            finding.error = point.error;
            finding.spread = Some(summary(&judged, &points));
        }
        if fit.parameter == Parameter::Velocity {
            finding.unit.clone_from(&points.unit);
        }
        if !points.source.is_empty() {
            finding.source = points.source;
        }
        finding.points.push(point);
        finding.parts.push(part);
        if fit.parameter == Parameter::Exponent {
            let beside = correlations(chain, &label, judged.computed.value);
            finding.points.extend(beside);
        }
    }
    finding
}

fn row(chain: &Chain, label: String) -> PointVerdict {
    PointVerdict {
        label,
        ..blank(&chain.steps[0].1)
    }
}

fn points(chain: &Chain, fit: &LawFit) -> Result<Points, FitError> {
    let mut points = Points {
        porosities: Vec::new(),
        velocities: Vec::new(),
        references: Vec::new(),
        unit: "1".to_string(),
        source: String::new(),
    };
    for (porosity, group) in &chain.steps {
        let mean =
            mean_scalar(group, &fit.law.of).map_err(|why| FitError(format!("{}: {why}", group.label())))?;
        points.porosities.push(*porosity);
        points.velocities.push(mean.value);
        points.unit = mean.unit;
        if let FitTarget::Reference { against, .. } = &fit.target {
            let run = group.first();
            let scalars = |name: &str| run.scalar(name).map(|scalar| scalar.value);
            let facts = Facts {
                settings: &run.settings,
                scalars: &scalars,
            };
            let expected = reference::scalar(against, &facts).map_err(|why| FitError(why.0))?;
            same_dimension((&fit.law.of, &points.unit), (against, expected.unit))
                .map_err(|why| FitError(why.0))?;
            points.references.push(expected.values[0]);
            points.source = expected.source;
        }
    }
    Ok(points)
}

fn judged(points: &Points, fit: &LawFit) -> Result<Judged, FitError> {
    let scale = match fit.law.linear {
        true => Scale::Linear,
        false => Scale::Logarithmic,
    };
    let law = richardson_zaki::fit(&points.porosities, &points.velocities, scale)?;
    let parameter = |law: &RichardsonZaki| match fit.parameter {
        Parameter::Exponent => law.exponent,
        Parameter::Velocity => law.velocity,
    };
    let computed = parameter(&law);
    if let FitTarget::Band(_) = fit.target {
        return Ok(Judged {
            computed,
            law,
            expected: None,
            error: None,
        });
    }
    let of_reference = |why: FitError| FitError(format!("of the reference: {why}"));
    let reference =
        richardson_zaki::fit(&points.porosities, &points.references, scale).map_err(of_reference)?;
    let expected = parameter(&reference).value;
    let difference = richardson_zaki::difference(&points.porosities, &points.velocities, &points.references)?;
    let half_width = match fit.parameter {
        Parameter::Exponent => difference.exponent.half_width() / expected.abs(),
        Parameter::Velocity => difference.velocity.half_width(),
    };
    Ok(Judged {
        error: Some(((computed.value / expected - 1.0).abs(), half_width)),
        expected: Some(expected),
        computed,
        law,
    })
}

/// Whether a chain holds, and how far from failing it is.
fn part(label: &str, judged: &Judged, fit: &LawFit) -> (Part, f64) {
    let found = plus_minus(&judged.computed);
    match (&fit.target, judged.error, judged.expected) {
        (FitTarget::Reference { below, .. }, Some((error, half_width)), Some(expected)) => {
            let room = below - error;
            let expected = significant(expected, 4);
            let error = percent(rounded(error));
            if room.abs() <= half_width {
                let reason = format!(
                    "{label}: {found} beside {expected}; the difference {error} ± {} (95 % confidence of the fit) \
                     straddles {}; add porosities, or run more seeds",
                    percent(rounded(half_width)),
                    percent(*below)
                );
                return (Part::open(reason), room);
            }
            let failed = || Part::fails(format!("{label}: {found}, {error} from {expected}"));
            (if room > 0.0 { Part::holds() } else { failed() }, room)
        }
        (FitTarget::Band(band), ..) => in_band(label, &found, &judged.computed, band),
        _ => (
            Part::open(format!("{label}: there is nothing to compare with")),
            f64::NEG_INFINITY,
        ),
    }
}

fn in_band(label: &str, found: &str, computed: &Estimate, band: &Band) -> (Part, f64) {
    let above = band.above.map_or(f64::INFINITY, |edge| computed.value - edge);
    let below = band.below.map_or(f64::INFINITY, |edge| edge - computed.value);
    let room = above.min(below);
    if room.abs() <= computed.half_width() {
        let reason = format!(
            "{label}: {found} (95 % confidence of the fit) straddles a limit of {}; add porosities, or run more seeds",
            words::band(band)
        );
        return (Part::open(reason), room);
    }
    let failed = || Part::fails(format!("{label}: {found} is not {}", words::band(band)));
    (if room > 0.0 { Part::holds() } else { failed() }, room)
}

/// `4.382 ± 0.021`
fn plus_minus(estimate: &Estimate) -> String {
    format!(
        "{} ± {}",
        significant(estimate.value, 4),
        significant(estimate.half_width(), 2)
    )
}

fn rounded(share: f64) -> f64 {
    significant(share, 3).parse().unwrap_or(share)
}

fn summary(judged: &Judged, points: &Points) -> String {
    let unit = match points.unit.as_str() {
        "1" => String::new(),
        unit => format!(" {unit}"),
    };
    format!(
        "exponent {}, velocity at porosity 1 {}{unit} (95 % confidence of the fit, {} porosities)",
        plus_minus(&judged.law.exponent),
        plus_minus(&judged.law.velocity),
        points.porosities.len()
    )
}

/// The exponents of the correlations for the grain and fluid of a chain, where they hold; they decide nothing.
fn correlations(chain: &Chain, label: &str, computed: f64) -> Vec<PointVerdict> {
    let found = correlations_of(chain.steps[0].1.first()).into_iter();
    let rows = found.map(|(author, expected)| PointVerdict {
        expected: Some(expected),
        computed: Some(computed),
        error: Some((computed / expected - 1.0).abs()),
        ..row(chain, format!("{label}: {author}"))
    });
    rows.collect()
}

/// Author and exponent of the correlations that hold for the grain and fluid of a run.
pub fn correlations_of(run: &Run) -> Vec<(String, f64)> {
    let scalars = |name: &str| run.scalar(name).map(|scalar| scalar.value);
    let facts = Facts {
        settings: &run.settings,
        scalars: &scalars,
    };
    let found = CORRELATIONS.iter().filter_map(|name| {
        let correlation = reference::scalar(name, &facts).ok()?;
        let author = correlation.source.split(", ").next().unwrap_or(name);
        Some((author.to_string(), correlation.values[0]))
    });
    found.collect()
}
