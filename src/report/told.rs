//! Verdicts as people read them: points by their scene and settings with units, reasons with the
//! numbers of the point that decides.

use super::{format, selection};
use crate::judge::model::{Outcome, PointVerdict, Verdict};
use crate::judge::select::label as words;
use crate::judge::words::axis_value;
use crate::store::model::Run;
use crate::study::model::Study;

/// The same verdicts with points and reasons in words; numbers stay as they are.
pub fn told(study: &Study, runs: &[Run], verdicts: &[Verdict]) -> Vec<Verdict> {
    verdicts
        .iter()
        .map(|verdict| {
            let names: Vec<(String, String)> = verdict
                .points
                .iter()
                .filter_map(|point| Some((point.label.clone(), name(study, runs, point)?)))
                .collect();
            let mut told = verdict.clone();
            for point in &mut told.points {
                if let Some((_, name)) = names.iter().find(|(label, _)| *label == point.label) {
                    point.label = name.clone();
                }
            }
            told.reason =
                failing(&told).or_else(|| verdict.reason.clone().map(|reason| plain(reason, &names)));
            told
        })
        .collect()
}

/// The point whose numbers stand for the whole verdict.
pub fn deciding(verdict: &Verdict) -> Option<&PointVerdict> {
    verdict.computed?;
    verdict
        .points
        .iter()
        .find(|point| point.computed == verdict.computed && point.error == verdict.error)
}

/// `7.26 %, 2.968 mm/s instead of 3.201 mm/s`, or the value alone where there is no reference; with the
/// half width of its confidence interval where it is a mean over seeds.
pub fn found(verdict: &Verdict) -> Option<String> {
    let computed = verdict.computed.map(|value| (value, verdict.half_width));
    let comparison = verdict.points.iter().any(|point| point.label.contains(BESIDE));
    numbers(
        verdict.error,
        computed,
        verdict.expected,
        &verdict.unit,
        comparison,
    )
}

/// The same of one point.
pub fn found_at(point: &PointVerdict, unit: &str) -> Option<String> {
    let computed = point.computed.map(|value| (value, point.half_width));
    let comparison = point.label.contains(BESIDE);
    numbers(point.error, computed, point.expected, unit, comparison)
}

/// Between the two sides of a comparison.
const BESIDE: &str = " beside ";
/// Between what is fixed and the axis that a law is fitted along.
const ALONG: &str = " along ";

fn numbers(
    error: Option<f64>,
    computed: Option<(f64, Option<f64>)>,
    expected: Option<f64>,
    unit: &str,
    comparison: bool,
) -> Option<String> {
    let computed = computed.map(|(value, half_width)| format::measured(value, half_width, unit));
    let expected = expected.map(|value| format::quantity(value, unit));
    match (error, computed, expected) {
        (None, Some(computed), Some(expected)) if comparison => Some(format!("{computed} beside {expected}")),
        (Some(error), Some(computed), Some(expected)) => Some(format!(
            "{}, {computed} instead of {expected}",
            format::percent_found(error)
        )),
        (Some(error), ..) => Some(format::percent_found(error)),
        (None, computed, _) => computed,
    }
}

/// The admitted band; a bound on an error in percent, like the error itself.
pub fn band(verdict: &Verdict) -> String {
    let number = |word: &str| word.replace('−', "-").parse::<f64>();
    let words = verdict.band.split(' ').map(|word| match number(word) {
        Ok(bound) if verdict.error.is_some() => format::percent(bound),
        Ok(bound) => format::number(bound),
        Err(_) => word.to_owned(),
    });
    words.collect::<Vec<_>>().join(" ")
}

/// How many points fail, and what is found where it is worst.
fn failing(verdict: &Verdict) -> Option<String> {
    let fails = verdict
        .points
        .iter()
        .filter(|point| point.holds == Some(false))
        .count();
    let worst = deciding(verdict).filter(|point| point.holds == Some(false))?;
    // The reason of a comparison says by how much the two sides differ.
    if verdict.verdict != Outcome::Fails || worst.label.contains(BESIDE) {
        return None;
    }
    let found = found(verdict)?;
    if verdict.points.len() == 1 {
        return Some(format!("{}: {found}", worst.label));
    }
    // Correlations stand beside a fit and are no points of it.
    let counts = |point: &&PointVerdict| point.holds.is_some() || !point.label.contains(ALONG);
    let of = verdict.points.iter().filter(counts).count();
    if of == 1 {
        return Some(format!("{}: {found}", worst.label));
    }
    Some(format!(
        "{fails} of {of} points fail; farthest off is {}: {found}",
        worst.label
    ))
}

fn name(study: &Study, runs: &[Run], point: &PointVerdict) -> Option<String> {
    if let Some((first, second)) = point.label.split_once(BESIDE) {
        let side = |label: &str| {
            let setting = label.split(" seeds=").next();
            let run = runs.iter().find(|run| Some(words(run).as_str()) == setting)?;
            Some(named(study, run, label))
        };
        return Some(format!("{}{BESIDE}{}", side(first)?, side(second)?));
    }
    let run = runs.iter().find(|run| run.id.0 == point.id)?;
    if let Some((fixed, axis)) = point.label.split_once(ALONG) {
        let fixed = selection::label_of_axes(study, run, |name, value| {
            fixed
                .split(' ')
                .any(|part| part == format!("{name}={}", axis_value(value)))
        });
        return Some(format!("{fixed}{ALONG}{}", format::words(axis)));
    }
    Some(named(study, run, &point.label))
}

fn named(study: &Study, run: &Run, label: &str) -> String {
    // A mean over seeds belongs to no single one.
    match label.split_once(" seeds=") {
        Some((_, seeds)) => {
            let one = Study {
                seeds: Vec::new(),
                ..study.clone()
            };
            format!("{}, mean of seeds {seeds}", selection::label(&one, run))
        }
        None => selection::label(study, run),
    }
}

/// A reason with the points' names in words; longer labels first, as they may begin alike.
fn plain(mut reason: String, names: &[(String, String)]) -> String {
    let mut names: Vec<&(String, String)> = names.iter().collect();
    names.sort_by_key(|(label, _)| std::cmp::Reverse(label.len()));
    for (label, name) in names {
        reason = reason.replace(label.as_str(), name);
    }
    reason
}

#[cfg(test)]
mod tests {
    use super::*;

    fn verdict(error: Option<f64>, band: &str) -> Verdict {
        let point = |label: &str, computed, holds: bool| PointVerdict {
            id: String::new(),
            label: label.into(),
            expected: error.map(|_| 0.003_201),
            computed: Some(computed),
            half_width: None,
            error: error.filter(|_| !holds),
            holds: Some(holds),
        };
        Verdict {
            id: "block".into(),
            statement: String::new(),
            quantity: "terminal_velocity".into(),
            unit: "m/s".into(),
            expected: error.map(|_| 0.003_201),
            computed: Some(0.002_968),
            half_width: None,
            error,
            band: band.into(),
            verdict: Outcome::Fails,
            reason: Some("the first is off".into()),
            source: String::new(),
            claims: Vec::new(),
            informative: None,
            points: vec![
                point("near", 0.0032, true),
                point("middle", 0.0031, false),
                point("far", 0.002_968, false),
            ],
        }
    }

    #[test]
    fn the_reason_names_the_worst_point_with_units() {
        let told = failing(&verdict(Some(0.0726), "< 0.01")).unwrap();
        assert_eq!(
            told,
            "2 of 3 points fail; farthest off is far: 7.26 %, 2.968 mm/s instead of 3.201 mm/s"
        );
    }

    #[test]
    fn a_reason_that_no_point_explains_is_kept() {
        let mut open = verdict(Some(0.0726), "< 0.01");
        open.computed = Some(1.9);
        assert_eq!(failing(&open), None);
    }

    #[test]
    fn means_over_seeds_are_told_with_their_half_width() {
        let mut one = verdict(None, "< 0.01");
        one.half_width = Some(0.000_034_1);
        assert_eq!(found(&one).unwrap(), "2.968 ± 0.034 mm/s");
    }

    #[test]
    fn the_reason_of_a_comparison_is_kept() {
        let mut one = verdict(None, "greater");
        one.expected = Some(0.0031);
        for point in &mut one.points {
            point.label = format!("{0}{BESIDE}{0} too", point.label);
        }
        assert_eq!(found(&one).unwrap(), "2.968 mm/s beside 3.100 mm/s");
        assert_eq!(failing(&one), None);
    }

    #[test]
    fn bands_are_in_the_form_of_their_numbers() {
        assert_eq!(band(&verdict(Some(0.02), "< 0.01")), "< 1 %");
        assert_eq!(band(&verdict(None, "−0.1 to 0.1")), "−0.1 to 0.1");
        assert_eq!(band(&verdict(None, "< 1e-12")), "< 10⁻¹²");
        assert_eq!(band(&verdict(None, "rising")), "rising");
    }
}
