//! A scalar of one selection of points is greater than, less than or equal to that of another.

use super::monotone::NOISE;
use super::{Finding, Part, blank, confidence, spread};
use crate::judge::model::PointVerdict;
use crate::judge::point_error::{Mean, mean_scalar};
use crate::judge::select::Replicates;
use crate::judge::words::{percent, relation, significant};
use crate::study::model::{Comparison, Relation};

pub fn check(pairs: &[[Replicates; 2]], comparison: &Comparison) -> Finding {
    let mut finding = Finding {
        source: "stated in the study".to_string(),
        ..Finding::default()
    };
    if pairs.is_empty() {
        let reason = "no completed run of the one selection has a partner in the other that differs in nothing \
                      else; look at `between`, or run the study";
        finding.parts.push(Part::open(reason.to_string()));
    }
    let (mut least, mut widest) = (f64::INFINITY, 0.0f64);
    for pair in pairs {
        let means = pair.each_ref().map(|group| mean_scalar(group, &comparison.of));
        let label = format!("{} beside {}", pair[0].label(), pair[1].label());
        let [Ok(first), Ok(second)] = &means else {
            let undecided = means.into_iter().find_map(Result::err);
            let why = undecided.map_or(String::new(), |why| why.to_string());
            finding.points.push(PointVerdict {
                label: label.clone(),
                ..blank(&pair[0])
            });
            finding.parts.push(Part::open(format!("{label}: {why}")));
            continue;
        };
        let (part, margin) = part(&label, first, second, comparison);
        let half_width = Some(first.sample.half_width()).filter(|width| *width > 0.0);
        // The pair nearest to failing, or farthest beyond, stands for all.
        if margin < least {
            least = margin;
            finding.computed = Some(first.value);
            finding.half_width = half_width;
            finding.expected = Some(second.value);
        }
        widest = widest.max(first.sample.half_width_of_difference(&second.sample));
        finding.unit = first.unit.clone();
        finding.points.push(PointVerdict {
            label,
            expected: Some(second.value),
            computed: Some(first.value),
            half_width,
            holds: part.decided(),
            ..blank(&pair[0])
        });
        finding.parts.push(part);
    }
    finding.spread = spread(&pairs.concat(), widest).map(|words| format!("{words}, of a difference"));
    finding
}

/// Whether a pair holds, and by how much, relative to the second value.
fn part(label: &str, first: &Mean, second: &Mean, comparison: &Comparison) -> (Part, f64) {
    let scale = second.value.abs();
    if scale == 0.0 && comparison.margin > 0.0 {
        let reason = format!("{label}: the second value is zero, a share of it says nothing");
        return (Part::open(reason), f64::NEG_INFINITY);
    }
    let difference = first.value - second.value;
    let noise = NOISE * first.sample.standard_error_of_difference(&second.sample);
    if comparison.within_noise && noise == 0.0 {
        let reason = format!("{label}: nothing is known of the noise; run at least two seeds that differ");
        return (Part::open(reason), f64::NEG_INFINITY);
    }
    let allowed = comparison.margin * scale;
    let room = match (comparison.is, comparison.within_noise) {
        (Relation::Greater, _) => difference - allowed,
        (Relation::Less, _) => -difference - allowed,
        (Relation::Equal, true) => allowed + noise - difference.abs(),
        (Relation::Equal, false) => allowed - difference.abs(),
    };
    let uncertain = match comparison.within_noise {
        true => 0.0,
        false => first.sample.half_width_of_difference(&second.sample),
    };
    let share = if scale > 0.0 { room / scale } else { room };
    let found = found(first, second);
    if uncertain > 0.0 && room.abs() <= uncertain {
        let (over, remedy) = confidence(pairs_have_seeds(first, second));
        let reason = format!(
            "{label}: {found}; the difference {} ± {} (95 % confidence {over}) straddles the limit; {remedy}",
            significant(difference, 3),
            significant(uncertain, 3)
        );
        return (Part::open(reason), share);
    }
    let holds = room > 0.0 || (room == 0.0 && comparison.is == Relation::Equal);
    let part = match holds {
        true => Part::holds(),
        false => Part::fails(format!("{label}: {found}, not {}", relation(comparison))),
    };
    (part, share)
}

fn pairs_have_seeds(first: &Mean, second: &Mean) -> bool {
    first.sample.count > 1 || second.sample.count > 1
}

/// `0.412 beside 0.409, 0.7 % more`
fn found(first: &Mean, second: &Mean) -> String {
    let both = format!(
        "{} beside {}",
        significant(first.value, 6),
        significant(second.value, 6)
    );
    if second.value == 0.0 {
        return both;
    }
    let share = (first.value - second.value) / second.value.abs();
    let share_words = percent(significant(share.abs(), 3).parse().unwrap_or(share.abs()));
    match share {
        share if share > 0.0 => format!("{both}, {share_words} more"),
        share if share < 0.0 => format!("{both}, {share_words} less"),
        _ => both,
    }
}
