//! Inputs that were fitted, as rows of the page.

use serde::Serialize;

use super::{format, selection};
use crate::reference;
use crate::study::model::{AxisValue, Calibrated, Study};

#[derive(Serialize)]
pub struct CalibratedRow {
    /// Where it stands in the study file.
    path: String,
    value: String,
    /// What had to meet what.
    fitted: String,
    source: String,
    /// The points it was fitted on.
    on: String,
}

pub fn rows(study: &Study) -> Vec<CalibratedRow> {
    study.calibrated.iter().map(|input| row(study, input)).collect()
}

fn row(study: &Study, input: &Calibrated) -> CalibratedRow {
    let entry = reference::list()
        .into_iter()
        .find(|entry| entry.name == input.against);
    let (meaning, source) = entry.map_or((String::new(), String::new()), |entry| {
        (format!(", {}", entry.meaning), entry.source.to_string())
    });
    // The kind of the scene says nothing that its name does not.
    let fields = input.path.get(1..).unwrap_or_default().join(".");
    let scene = match study.scenes.len() {
        1 => "scene".to_owned(),
        _ => format!("scenes.{}", input.scene),
    };
    CalibratedRow {
        path: format!("{scene}.{fields}"),
        value: match &input.value {
            AxisValue::Number(number) => number_with_unit(*number, &input.unit),
            other => other.to_string(),
        },
        fitted: format!("`{}` to `{}`{meaning}", input.of, input.against),
        source,
        on: points(study, input),
    }
}

/// `6 mm`; a number too small or too large for the usual units in SI units.
fn number_with_unit(number: f64, unit: &str) -> String {
    let readable = format::readable(unit, number);
    let scaled = number * readable.factor;
    let (number, label) = match (1e-3..1e6).contains(&scaled.abs()) {
        true => (scaled, readable.label),
        false => (number, format::pretty_unit(unit)),
    };
    format!("{} {label}", format::number(number))
        .trim_end()
        .to_owned()
}

/// `periodic; fluid density 500, 2403.1 kg/m³`
fn points(study: &Study, input: &Calibrated) -> String {
    let scenes = (!input.on.scenes.is_empty()).then(|| {
        let names: Vec<String> = input.on.scenes.iter().map(|name| format::words(name)).collect();
        names.join(", ")
    });
    let axes = input.on.axes.iter().map(|(name, values)| {
        let values: Vec<String> = values
            .iter()
            .map(|value| selection::shown(study, name, value))
            .collect();
        format!("{} {}", format::words(name), values.join(", "))
    });
    scenes.into_iter().chain(axes).collect::<Vec<_>>().join("; ")
}
