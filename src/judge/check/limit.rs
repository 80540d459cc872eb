//! A scalar leaves its band along an axis where a reference says.

use super::{Finding, Part};
use crate::judge::bracket::Bracket;
use crate::judge::model::PointVerdict;
use crate::judge::words::significant;
use crate::study::model::{Limit, Study};

pub fn check(study: &Study, brackets: &[Bracket], limit: &Limit) -> Finding {
    let axis = study.axes.iter().find(|axis| axis.name == limit.over);
    let mut finding = Finding {
        unit: axis.map_or("1".to_string(), |axis| axis.unit.clone()),
        ..Finding::default()
    };
    if brackets.is_empty() {
        let reason = format!("no selected run has a number `{}` to go along", limit.over);
        finding.parts.push(Part::open(reason));
    }
    for bracket in brackets {
        let part = part(bracket, limit);
        let expected = bracket.expected.as_ref().ok();
        let error = match (bracket.middle(), expected) {
            (Some(middle), Some((expected, _))) => Some((middle / expected - 1.0).abs()),
            _ => None,
        };
        let point = PointVerdict {
            id: bracket.at.id.0.clone(),
            label: bracket.label.clone(),
            expected: expected.map(|(value, _)| *value),
            computed: bracket.middle(),
            half_width: None,
            error,
            holds: part.decided(),
        };
        if let Some((_, source)) = expected {
            finding.source.clone_from(source);
        }
        if error.is_some() && error.unwrap_or_default() >= finding.error.unwrap_or_default() {
            finding.error = error;
            finding.computed = point.computed;
            finding.expected = point.expected;
        }
        finding.points.push(point);
        finding.parts.push(part);
    }
    finding
}

fn part(bracket: &Bracket, limit: &Limit) -> Part {
    let label = &bracket.label;
    let (sides, expected) = match (&bracket.sides, &bracket.expected) {
        (Ok(sides), Ok((expected, _))) => (sides, expected),
        (Err(why), _) | (_, Err(why)) => return Part::open(format!("{label}: {why}")),
    };
    let [low, high] = [sides[0] * (1.0 - limit.within), sides[1] * (1.0 + limit.within)];
    match (low..=high).contains(expected) {
        true => Part::holds(),
        false => Part::fails(format!(
            "{label}: between {} and {}, the reference says {}",
            significant(sides[0], 4),
            significant(sides[1], 4),
            significant(*expected, 4)
        )),
    }
}
