//! Numbers and bands in words.

use crate::study::model::{AxisValue, Band};

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

/// `0.95 to 1.05`, `< 1.05`, `> 0.95`.
pub fn band(band: &Band) -> String {
    match (band.above, band.below) {
        (Some(above), Some(below)) => format!("{} to {}", significant(above, 6), significant(below, 6)),
        (Some(above), None) => format!("> {}", significant(above, 6)),
        (None, Some(below)) => format!("< {}", significant(below, 6)),
        (None, None) => "any".to_string(),
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
}
