//! Inputs that were fitted to some of the points.

use kynch_sim::scene::ObservableKind;

use super::{Context, Reader, Written};
use crate::study::axes::{self, WrittenScene};
use crate::study::model::{Calibrated, Point, Selection};
use crate::study::problem::Problems;
use crate::study::shape::Place;
use crate::study::spec::statement::CalibratedSpec;
use crate::study::yaml::Node;

/// Reads `calibrated`; entries at fault are reported and left out.
pub fn calibrated(
    root: &Node,
    scenes: &[WrittenScene],
    context: &Context,
    problems: &mut Problems,
) -> Vec<Calibrated> {
    let elements = root.get("calibrated").map(Node::elements).unwrap_or_default();
    let schema = context.shapes.of("CalibratedSpec");
    let mut list: Vec<Calibrated> = Vec::new();
    for (index, node) in elements.iter().enumerate() {
        let mut unsound = Problems::default();
        context.shapes.check(node, schema, &Place::root(), &mut unsound);
        let Some((key, _)) = node.entries().first().filter(|_| unsound.is_empty()) else {
            continue;
        };
        let Ok(spec) = serde_json::from_value::<CalibratedSpec>(node.json()) else {
            continue;
        };
        let written = Written {
            kind: key,
            fields: node,
            path: format!("calibrated[{index}]"),
        };
        let mut reader = Reader {
            written: &written,
            context,
            problems,
        };
        for input in reader.fitted(&spec, scenes) {
            if list
                .iter()
                .any(|other| (&other.scene, &other.path) == (&input.scene, &input.path))
            {
                reader.fault("path", format!("`{}` is listed twice", spec.path), "keep one");
            } else {
                list.push(input);
            }
        }
    }
    list
}

impl Reader<'_, '_> {
    /// An input of every scene in which the path leads to a value.
    fn fitted(&mut self, spec: &CalibratedSpec, scenes: &[WrittenScene]) -> Vec<Calibrated> {
        self.observable("of", &spec.of, &[ObservableKind::Scalar]);
        self.reference(&spec.against, Some(&spec.of));
        let Some(on) = self.fitting_points() else {
            return Vec::new();
        };
        let found = match axes::bind_everywhere(&spec.path, scenes, self.context.shapes) {
            Ok(found) => found,
            Err((message, help)) => {
                self.fault("path", message, help);
                return Vec::new();
            }
        };
        let mut list = Vec::new();
        for (scene, path, schema) in found {
            let Some(node) = self.value_at(&scene, &path, scenes) else {
                continue;
            };
            let admitted = |point: &Point| point.scene == scene && on.admits(point);
            let points = &self.context.plan.points;
            if !points.is_empty() && !points.iter().any(admitted) {
                let message = format!("this selects no point of the scene `{scene}`");
                self.fault("on", message, "name points of the scene that the path leads into");
                continue;
            }
            let dimension = self.context.shapes.dimension(schema);
            let value = axes::si_value(node, dimension);
            list.push(Calibrated {
                unit: axes::unit(std::slice::from_ref(&value), dimension),
                value,
                scene,
                path,
                of: spec.of.clone(),
                against: spec.against.clone(),
                on: on.clone(),
            });
        }
        list
    }

    /// Reads `on`, which must leave points to predict; `None` when it is at fault.
    fn fitting_points(&mut self) -> Option<Selection> {
        let node = self.written.fields.get("on")?;
        let before = self.problems.len();
        let on = self.selection_in(node, "on");
        let points = &self.context.plan.points;
        if self.problems.len() == before && !points.is_empty() && points.iter().all(|point| on.admits(point))
        {
            let help = "name the points that it was fitted on, by `scene` and axes";
            self.fault("on", "this selects every point: none is left to predict", help);
        }
        (self.problems.len() == before).then_some(on)
    }

    /// The one value that the scene gives to an input.
    fn value_at<'a>(&mut self, scene: &str, path: &[String], scenes: &'a [WrittenScene]) -> Option<&'a Node> {
        let moved = self.context.axes.iter().find(|axis| {
            let mut bindings = axis.bindings.iter();
            bindings.any(|(other, place)| other == scene && path.starts_with(place))
        });
        if let Some(axis) = moved {
            let message = format!("the axis `{}` varies it: it has no one value", axis.axis.name);
            self.fault("path", message, "name an input that is the same at every point");
            return None;
        }
        let written = scenes.iter().find(|written| written.name == scene)?;
        let node = path.iter().try_fold(&written.node, |node, name| node.get(name));
        match node {
            Some(node) if node.entries().is_empty() => Some(node),
            Some(_) => {
                let message = format!("`{}` is not a single value", path.join("."));
                self.fault("path", message, "name a field that holds a number or a word");
                None
            }
            None => {
                let message = format!("the scene `{scene}` leaves it to its default");
                self.fault("path", message, "write the fitted value in the scene");
                None
            }
        }
    }
}
