//! `--only axis=value`: from what was typed to values that points of the study have.

use super::magnitude::exact;
use crate::runner::Options;
use crate::store::model::leaf;
use crate::study::model::{AxisValue, Study};

/// `--only name=value,value` as typed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Only {
    pub name: String,
    pub values: Vec<String>,
}

/// Splits `name=value,value`.
///
/// # Errors
/// In words, when a name or a value is missing.
pub fn only(text: &str) -> Result<Only, String> {
    let split = text.split_once('=').map(|(name, values)| Only {
        name: name.trim().into(),
        values: values.split(',').map(|value| value.trim().into()).collect(),
    });
    split
        .filter(|only| !only.name.is_empty() && only.values.iter().all(|value| !value.is_empty()))
        .ok_or_else(|| format!("--only {text}: write axis=value, or axis=value,value for several"))
}

/// The options with the selection in terms of this study: values of one name widen it, further names narrow it.
///
/// # Errors
/// In words, for a name or a value that no point of the study has.
pub fn resolve(study: &Study, selection: &[Only], options: &Options) -> Result<Options, String> {
    let mut resolved = options.clone();
    for only in selection {
        let known = values(study, &only.name);
        if known.is_empty() {
            return Err(unknown_name(study, &only.name));
        }
        for text in &only.values {
            let value = known.iter().find(|value| means(text, value)).ok_or_else(|| {
                let known: Vec<String> = known.iter().map(show).collect();
                format!(
                    "--only {}={text}: nothing selected, no point of `{}` has this value; there are {}",
                    only.name,
                    study.name,
                    known.join(", ")
                )
            })?;
            resolved.only.push((only.name.clone(), value.clone()));
        }
    }
    Ok(resolved)
}

/// Every value that some point of the study has under this name, in plan order.
fn values(study: &Study, name: &str) -> Vec<AxisValue> {
    let mut values: Vec<AxisValue> = Vec::new();
    for point in &study.plan.points {
        let axis = point.axes.iter().find(|(axis, _)| axis == name);
        let value = match axis {
            _ if name == "scene" => Some(AxisValue::Word(point.scene.clone())),
            Some((_, value)) => Some(value.clone()),
            None => leaf(&point.settings, name),
        };
        values.extend(value.filter(|value| !values.contains(value)));
    }
    values
}

/// Whether a text means a value: words as they are, numbers in SI units or with a unit of their own.
fn means(text: &str, value: &AxisValue) -> bool {
    match value {
        AxisValue::Word(word) => word == text,
        AxisValue::Flag(flag) => text == flag.to_string(),
        AxisValue::Number(number) => {
            let typed = text.parse::<f64>().ok();
            typed.is_some_and(|typed| (typed - number).abs() <= 1e-9 * number.abs())
        }
    }
}

fn unknown_name(study: &Study, name: &str) -> String {
    let axes: Vec<&str> = study.axes.iter().map(|axis| axis.name.as_str()).collect();
    format!(
        "--only {name}: `{}` has no axis and no setting of this name; it varies scene{}{}",
        study.name,
        if axes.is_empty() { "" } else { ", " },
        axes.join(", ")
    )
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
    use crate::cli::example;

    #[test]
    fn names_and_values_are_split() {
        let expected = Only {
            name: "a".into(),
            values: vec!["1".into(), "2 mm".into()],
        };
        assert_eq!(only("a=1, 2 mm"), Ok(expected));
        for text in ["a", "=1", "a=", "a=1,,2", ""] {
            assert!(only(text).is_err(), "{text}");
        }
    }

    fn selected(text: &str) -> Result<Vec<(String, AxisValue)>, String> {
        let options = resolve(&example::study(), &[only(text).unwrap()], &Options::default());
        options.map(|options| options.only)
    }

    #[test]
    fn values_are_those_of_the_points() {
        assert_eq!(
            selected("error=0.10"),
            Ok(vec![("error".into(), AxisValue::Number(0.1))])
        );
        assert_eq!(
            selected("scene=slow"),
            Ok(vec![("scene".into(), AxisValue::Word("slow".into()))])
        );
        let both = selected("error=0.1,0.2").unwrap();
        assert_eq!(both.len(), 2);
    }

    #[test]
    fn a_setting_that_is_no_axis_selects_too() {
        assert_eq!(
            selected("order=2"),
            Ok(vec![("order".into(), AxisValue::Number(2.0))])
        );
    }

    #[test]
    fn what_no_point_has_is_told_with_what_there_is() {
        let why = selected("error=7").unwrap_err();
        assert!(
            why.contains("nothing selected") && why.contains("0.1, 0.2"),
            "{why}"
        );
        let why = selected("eror=7").unwrap_err();
        assert!(why.contains("no axis") && why.contains("error"), "{why}");
    }
}
