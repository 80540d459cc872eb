//! What a response is drawn beside, and which point and instants snapshots show.

use super::{MOST_PANELS, Reader};
use crate::study::model::{Beside, DataSeries, Point};
use crate::study::names::references;
use crate::study::spec::statement::{BesideSpec, DataSpec, ResponseSpec};
use crate::study::units::{self, Dimension};

impl Reader<'_, '_> {
    /// Reads `against` of a response; `unit` is that of its scalar.
    pub(super) fn beside(&mut self, spec: &ResponseSpec, unit: Option<Dimension>) -> Vec<Beside> {
        let axis = self.context.axes.iter().find(|axis| axis.axis.name == spec.over);
        let across = axis.map(|axis| axis.dimension.unwrap_or(Dimension::NONE));
        let mut beside = Vec::new();
        for one in &spec.against {
            match one {
                BesideSpec::Reference(reference) => {
                    let known = references().iter().any(|(name, _)| *name == reference.name);
                    self.reference(&reference.name, Some(&spec.of).filter(|_| known));
                    beside.push(Beside::Reference(reference.name.clone()));
                }
                BesideSpec::Data(data) => {
                    let factors = (
                        self.factor("x_unit", &data.x_unit, across),
                        self.factor("y_unit", &data.y_unit, unit),
                    );
                    beside.push(Beside::Data(series(data, factors)));
                }
            }
        }
        beside
    }

    /// What turns a column in a unit into SI units.
    fn factor(&mut self, field: &str, unit: &Option<String>, wanted: Option<Dimension>) -> f64 {
        let Some(unit) = unit else { return 1.0 };
        match (units::parse(&format!("1 {unit}")), wanted) {
            (Ok(found), Some(wanted)) if found.dimension != wanted => {
                let message = format!("`{field}` is {}, not {wanted}", found.dimension);
                self.fault("against", message, format!("write a unit like {}", wanted.unit()));
                1.0
            }
            (Ok(found), _) => found.value,
            (Err(message), _) => {
                self.fault(
                    "against",
                    format!("`{field}`: {message}"),
                    "write a unit such as mm/s or g/cm3",
                );
                1.0
            }
        }
    }

    /// Checks that a figure shows one point, whatever its seeds.
    pub(super) fn one_point(&mut self) {
        let selection = self.quietly(|reader| reader.selection());
        let setting = |point: &&Point| (point.scene.clone(), point.axes.clone());
        let points = self.context.plan.points.iter();
        let mut settings: Vec<_> = Vec::new();
        for point in points.filter(|point| selection.admits(point)) {
            if !settings.contains(&setting(&point)) {
                settings.push(setting(&point));
            }
        }
        if settings.len() > 1 {
            let message = format!("these pictures show one point, {} are selected", settings.len());
            let help = "narrow `where` down to one value of each axis";
            self.fault("where", message, help);
        }
    }

    pub(super) fn instants(&mut self, times: &[f64]) {
        if let Some(time) = times.iter().find(|time| **time < 0.0) {
            let help = "times count from the start of the run";
            self.fault("times", format!("the time {time} s lies before the start"), help);
        }
        if times.len() > MOST_PANELS {
            let message = format!("{} panels do not fit on a page", times.len());
            self.fault("times", message, format!("keep at most {MOST_PANELS} times"));
        }
    }
}

fn series(data: &DataSpec, factors: (f64, f64)) -> DataSeries {
    let text = |value: &serde_json::Value| match value {
        serde_json::Value::String(text) => text.clone(),
        other => other.to_string(),
    };
    DataSeries {
        file: data.file.clone(),
        x: data.x.clone(),
        y: data.y.clone(),
        factors,
        rows: data
            .rows
            .iter()
            .map(|(column, value)| (column.clone(), text(&value.0)))
            .collect(),
        label: data.label.clone(),
    }
}
