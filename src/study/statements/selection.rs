//! Which runs a statement is about.

use super::{Reader, distinct};
use crate::study::axes::si_value;
use crate::study::model::{AxisValue, Selection};
use crate::study::nearest::advice;
use crate::study::problem::Problems;
use crate::study::units::{self, Dimension};
use crate::study::yaml::{Node, Value};

/// Values given in a selection, in SI units; those that no point has are reported.
pub fn admitted(
    node: &Node,
    dimension: Option<Dimension>,
    admitted: &[AxisValue],
    field: &str,
    problems: &mut Problems,
) -> Vec<AxisValue> {
    let nodes = if node.elements().is_empty() {
        std::slice::from_ref(node)
    } else {
        node.elements()
    };
    let shown: Vec<String> = admitted.iter().map(AxisValue::to_string).collect();
    let shown: Vec<&str> = distinct(shown.iter().map(String::as_str));
    let mut values = Vec::new();
    for node in nodes {
        let value = si_value(node, dimension.or_else(|| any_dimension(node)));
        if !admitted.contains(&value) {
            let message = format!("no point has the value {}", node.shown());
            let numbers = admitted.iter().any(|value| matches!(value, AxisValue::Number(_)));
            let help = match numbers {
                true => format!("there are {} (SI units)", shown.join(", ")),
                false => advice(&node.shown(), &shown),
            };
            problems.add(&node.span, field, message, help);
        }
        values.push(value);
    }
    values
}

/// Text that reads as a quantity is one.
fn any_dimension(node: &Node) -> Option<Dimension> {
    match &node.value {
        Value::Text(text) => units::parse(text).ok().map(|found| found.dimension),
        _ => None,
    }
}

impl Reader<'_, '_> {
    /// Reads `where`.
    pub(super) fn selection(&mut self) -> Selection {
        let Some(node) = self.written.fields.get("where") else {
            return Selection::default();
        };
        let before = self.problems.len();
        let selection = self.selection_in(node, "where");
        if self.problems.len() == before && !self.selects(&[&selection]) {
            self.fault(
                "where",
                "this selects no point of the plan",
                "drop one of its conditions",
            );
        }
        selection
    }

    /// Whether some point of the plan is admitted by all of these; true as long as there is no plan.
    pub(super) fn selects(&self, selections: &[&Selection]) -> bool {
        let points = &self.context.plan.points;
        let admitted = |point| selections.iter().all(|selection| selection.admits(point));
        points.is_empty() || points.iter().any(admitted)
    }

    /// Reads a map of conditions.
    pub(super) fn selection_in(&mut self, node: &Node, place: &str) -> Selection {
        let mut selection = Selection::default();
        if !self.context.complete {
            return selection;
        }
        for (key, node) in node.entries() {
            let field = format!("{}.{place}.{}", self.written.path, key.name);
            if key.name == "scene" {
                let scenes = self.context.works.keys();
                let scenes: Vec<AxisValue> = scenes.map(|name| AxisValue::Word(name.clone())).collect();
                let values = self.scene_names(node, &scenes, &field);
                selection.scenes = values;
                continue;
            }
            let Some((dimension, known)) = self.values_of(&key.name) else {
                if self.context.plan.points.is_empty() {
                    continue;
                }
                let known = self.parameters();
                let known: Vec<&str> = known.iter().map(String::as_str).collect();
                let message = format!(
                    "`{}` is neither `scene`, nor an axis, nor a field of a scene",
                    key.name
                );
                self.problems
                    .add(&key.span, &field, message, advice(&key.name, &known));
                continue;
            };
            let values = admitted(node, dimension, &known, &field, self.problems);
            selection.axes.push((key.name.clone(), values));
        }
        selection
    }

    pub(super) fn scene_names(&mut self, node: &Node, scenes: &[AxisValue], field: &str) -> Vec<String> {
        let nodes = if node.elements().is_empty() {
            std::slice::from_ref(node)
        } else {
            node.elements()
        };
        let names: Vec<&String> = self.context.works.keys().collect();
        let names: Vec<&str> = names.iter().map(|name| name.as_str()).collect();
        for node in nodes {
            if !scenes.contains(&AxisValue::Word(node.shown())) {
                let message = format!("there is no scene `{}`", node.shown());
                self.problems
                    .add(&node.span, field, message, advice(&node.shown(), &names));
            }
        }
        nodes.iter().map(Node::shown).collect()
    }

    /// Values that a parameter takes in the plan; `None` when there is no such parameter.
    pub(super) fn values_of(&self, name: &str) -> Option<(Option<Dimension>, Vec<AxisValue>)> {
        if let Some(axis) = self.context.axes.iter().find(|axis| axis.axis.name == name) {
            return Some((axis.dimension, axis.axis.values.clone()));
        }
        let points = self.context.plan.points.iter();
        let mut values: Vec<AxisValue> = Vec::new();
        for value in points.filter_map(|point| point.parameter(name)) {
            if !values.contains(&value) {
                values.push(value);
            }
        }
        (!values.is_empty()).then_some((None, values))
    }
}
