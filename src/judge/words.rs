//! Numbers and bands in words.

use crate::study::model::{AxisValue, Band, Comparison, Relation, Selection};

/// A number with at most so many significant digits, trailing zeros dropped.
pub fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let rounded: f64 = format!("{value:.*e}", digits.saturating_sub(1))
        .parse()
        .unwrap_or(value);
    if (1e-4..1e7).contains(&rounded.abs()) {
        format!("{rounded}")
    } else {
        format!("{rounded:e}")
    }
}

/// A dimensionless fraction as per cent: `2 %`.
pub fn percent(fraction: f64) -> String {
    format!("{} %", significant(100.0 * fraction, 6))
}

/// `0.95 to 1.05`, `< 1.05`, `> −0.1`.
pub fn band(band: &Band) -> String {
    match (band.above, band.below) {
        (Some(above), Some(below)) => format!("{} to {}", edge(above), edge(below)),
        (Some(above), None) => format!("> {}", edge(above)),
        (None, Some(below)) => format!("< {}", edge(below)),
        (None, None) => "any".to_string(),
    }
}

/// `greater by 5 %`, `equal within 5 % and noise`.
pub fn relation(comparison: &Comparison) -> String {
    let margin = (comparison.margin > 0.0).then(|| percent(comparison.margin));
    let noise = comparison
        .within_noise
        .then(|| "the noise of the seeds".to_string());
    let allowed: Vec<String> = margin.into_iter().chain(noise).collect();
    let (relation, link) = match comparison.is {
        Relation::Greater => ("greater", "by"),
        Relation::Less => ("less", "by"),
        Relation::Equal => ("equal", "within"),
    };
    match allowed.is_empty() {
        true => relation.to_string(),
        false => format!("{relation} {link} {}", allowed.join(" and ")),
    }
}

/// `viscosity=0.001`, several values separated by commas.
pub fn selection(selection: &Selection) -> String {
    let scenes = (!selection.scenes.is_empty()).then(|| format!("scene={}", selection.scenes.join(",")));
    let axes = selection.axes.iter().map(|(name, values)| {
        let values: Vec<String> = values.iter().map(axis_value).collect();
        format!("{name}={}", values.join(","))
    });
    scenes.into_iter().chain(axes).collect::<Vec<_>>().join(" ")
}

/// An edge of a band, with the minus sign of text; exponents keep the one that numbers are parsed with.
fn edge(value: f64) -> String {
    let digits = significant(value.abs(), 6);
    if value < 0.0 {
        format!("−{digits}")
    } else {
        digits
    }
}

/// The value of an axis as written in labels.
pub fn axis_value(value: &AxisValue) -> String {
    match value {
        AxisValue::Number(number) => significant(*number, 10),
        AxisValue::Flag(flag) => flag.to_string(),
        AxisValue::Word(word) => word.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_noise_is_not_shown() {
        assert_eq!(percent(0.07), "7 %");
        assert_eq!(significant(0.1 + 0.2, 6), "0.3");
        assert_eq!(significant(4.92393e-3, 3), "0.00492");
        assert_eq!(significant(6.93428e-9, 6), "6.93428e-9");
        assert_eq!(significant(0.0, 6), "0");
        assert_eq!(significant(f64::NAN, 6), "NaN");
    }

    #[test]
    fn negative_edges_have_a_minus_sign() {
        let between = |above, below| band(&Band { above, below });
        assert_eq!(between(Some(-0.1), Some(0.1)), "−0.1 to 0.1");
        assert_eq!(between(Some(-1e-12), None), "> −1e-12");
        assert_eq!(between(None, Some(2e-6)), "< 2e-6");
    }
}
