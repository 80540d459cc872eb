//! `--only axis=value`: from what was typed to values; whether points have them is the survey's to say.

use super::magnitude::exact;
use crate::study;
use crate::study::model::AxisValue;

/// Reads `name=value,value`: one pair per value, alternatives of one name.
///
/// # Errors
/// In words, when a name or a value is missing.
pub fn only(text: &str) -> Result<Vec<(String, AxisValue)>, String> {
    let wrong = || format!("--only {text}: write axis=value, or axis=value,value for several");
    let (name, values) = text.split_once('=').ok_or_else(wrong)?;
    let name = name.trim();
    let values: Vec<&str> = values.split(',').map(str::trim).collect();
    if name.is_empty() || values.contains(&"") {
        return Err(wrong());
    }
    Ok(values
        .iter()
        .map(|text| (name.to_string(), value(text)))
        .collect())
}

/// A number in SI units or with a unit of its own, a flag, or else a word.
fn value(text: &str) -> AxisValue {
    if let Ok(flag) = text.parse() {
        return AxisValue::Flag(flag);
    }
    if !text.starts_with(|first: char| first.is_ascii_digit() || "+-.".contains(first)) {
        return AxisValue::Word(text.into());
    }
    let number = text.parse().ok().or_else(|| study::quantity(text));
    number.map_or_else(|| AxisValue::Word(text.into()), AxisValue::Number)
}

/// An axis value as text: shortest exact number, word or flag.
pub fn show(value: &AxisValue) -> String {
    match value {
        AxisValue::Number(number) => exact(*number),
        AxisValue::Flag(flag) => flag.to_string(),
        AxisValue::Word(word) => word.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_gives_alternatives_of_one_name() {
        let pair = |value| ("a".to_string(), value);
        let expected = vec![
            pair(AxisValue::Number(1.5)),
            pair(AxisValue::Word("inf_like".into())),
        ];
        assert_eq!(only("a = 1.5, inf_like"), Ok(expected));
        assert_eq!(only("a=true"), Ok(vec![pair(AxisValue::Flag(true))]));
        assert_eq!(only("a=-2e-3"), Ok(vec![pair(AxisValue::Number(-0.002))]));
    }

    #[test]
    fn words_that_read_like_numbers_stay_words() {
        for word in ["inf", "nan", "infinity"] {
            assert_eq!(value(word), AxisValue::Word(word.into()));
        }
    }

    #[test]
    fn a_missing_name_or_value_is_an_error() {
        for text in ["a", "=1", "a=", "a=1,,2", ""] {
            assert!(only(text).is_err(), "{text}");
        }
    }
}
