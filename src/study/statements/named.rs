//! Names in a statement: observables, references, axes and fields.

use kynch_sim::scene::ObservableKind;
use serde_json::Value as Schema;

use super::{Reader, distinct};
use crate::study::comparable;
use crate::study::model::{AxisValue, Norm};
use crate::study::names::{is_measured_work, observables, references, work_unit};
use crate::study::nearest::advice;
use crate::study::published::published;
use crate::study::spec::statement::NormSpec;
use crate::study::units::{self, Dimension};
use crate::study::yaml::Node;

/// A name that a statement may be about.
struct Offered<'a> {
    name: &'a str,
    unit: &'a str,
    kind: ObservableKind,
}

impl<'a> Reader<'a, '_> {
    /// Scenes that the statement may be about.
    pub(super) fn scenes(&self) -> Vec<&'a str> {
        let all = || self.context.works.keys().map(String::as_str).collect::<Vec<_>>();
        let Some(node) = self
            .written
            .fields
            .get("where")
            .and_then(|selection| selection.get("scene"))
        else {
            return all();
        };
        let nodes = if node.elements().is_empty() {
            std::slice::from_ref(node)
        } else {
            node.elements()
        };
        let named: Vec<String> = nodes.iter().map(Node::shown).collect();
        all()
            .into_iter()
            .filter(|name| named.iter().any(|other| other == name))
            .collect()
    }

    /// Observables of some scenes, and what the study derives.
    fn offered(&self, scenes: &[&str]) -> Vec<Offered<'a>> {
        let observed = scenes
            .iter()
            .flat_map(|scene| observables(&self.context.works[*scene]))
            .map(|observable| Offered {
                name: observable.name,
                unit: observable.unit,
                kind: observable.kind,
            });
        let derived = self.context.derived.iter().map(|derived| Offered {
            name: &derived.name,
            unit: &derived.unit,
            kind: ObservableKind::Scalar,
        });
        observed.chain(derived).collect()
    }

    fn offered_anywhere(&self) -> Vec<Offered<'a>> {
        let scenes: Vec<&str> = self.context.works.keys().map(String::as_str).collect();
        self.offered(&scenes)
    }

    /// Checks that a selected scene offers an observable of the right kind; gives its unit.
    pub(super) fn observable(
        &mut self,
        field: &str,
        name: &str,
        kinds: &[ObservableKind],
    ) -> Option<Dimension> {
        let scenes = self.scenes();
        if scenes.is_empty() {
            return None;
        }
        if is_measured_work(name) && kinds.contains(&ObservableKind::Scalar) {
            return work_unit(name);
        }
        let offered = self.offered(&scenes);
        let right: Vec<&str> = distinct(
            offered
                .iter()
                .filter(|observable| kinds.contains(&observable.kind))
                .map(|observable| observable.name),
        );
        // A name may be a number and a series too.
        let named = || offered.iter().filter(|observable| observable.name == name);
        let fitting = named().find(|observable| kinds.contains(&observable.kind));
        match fitting.or_else(|| named().next()) {
            Some(found) if kinds.contains(&found.kind) => {
                if found.unit == "1" {
                    return Some(Dimension::NONE);
                }
                units::parse(&format!("1 {}", found.unit))
                    .ok()
                    .map(|unit| unit.dimension)
            }
            Some(found) => {
                let wanted: Vec<&str> = kinds.iter().map(|kind| kind_name(*kind)).collect();
                let message = format!(
                    "`{name}` is {}, this needs {}",
                    kind_name(found.kind),
                    wanted.join(" or ")
                );
                self.fault(field, message, format!("known: {}", right.join(", ")));
                None
            }
            None => {
                self.fault(
                    field,
                    format!("no scene here can observe `{name}`"),
                    advice(name, &right),
                );
                None
            }
        }
    }

    /// Checks that a reference exists that can be drawn beside a series: a curve, or a value as a level.
    pub(super) fn level(&mut self, name: &str, of: Option<&String>) {
        let is_value =
            |(known, kind): &(&str, ObservableKind)| *known == name && *kind == ObservableKind::Scalar;
        let all = references();
        if all.iter().any(is_value) {
            self.same_dimension(name, of);
        } else {
            // An unknown name may have meant either kind.
            let known = all.iter().any(|(known, _)| *known == name);
            self.reference(name, of.filter(|_| known));
        }
    }

    /// Checks that a reference exists, and is a curve exactly when the observable is one.
    pub(super) fn reference(&mut self, name: &str, of: Option<&String>) {
        let offered = self.offered_anywhere();
        let found = || {
            offered
                .iter()
                .filter(|found| of.is_some_and(|of| found.name == of))
        };
        let kinds: Vec<ObservableKind> = found().map(|found| found.kind).collect();
        let other_dimension = |name: &str| {
            let data = published().iter().find(|entry| entry.name == name);
            data.zip(found().next())
                .is_some_and(|(data, found)| comparable(found.unit, &data.unit).is_err())
        };
        let all = references();
        let fitting: Vec<&str> = all
            .iter()
            .filter(|(name, is)| (kinds.is_empty() || kinds.contains(is)) && !other_dimension(name))
            .map(|(name, _)| *name)
            .collect();
        match (all.iter().find(|(known, _)| *known == name), kinds.first()) {
            (None, _) => self.fault(
                "against",
                format!("there is no reference `{name}`"),
                advice(name, &fitting),
            ),
            (Some((_, is)), Some(kind)) if !kinds.contains(is) && *kind != ObservableKind::Profile => {
                let message = format!(
                    "the reference `{name}` is {}, the observable is {}",
                    kind_name(*is),
                    kind_name(*kind)
                );
                self.fault("against", message, format!("known: {}", fitting.join(", ")));
            }
            _ => self.same_dimension(name, of),
        }
    }

    /// Checks that published data have the dimension of the observable.
    fn same_dimension(&mut self, name: &str, of: Option<&String>) {
        let offered = self.offered_anywhere();
        let found = of.and_then(|of| offered.iter().find(|observable| observable.name == of));
        let data = published().iter().find(|entry| entry.name == name);
        let (Some(found), Some(data)) = (found, data) else {
            return;
        };
        if let Err((one, other)) = comparable(found.unit, &data.unit) {
            let message = format!("`{}` is {one}, the reference `{name}` is {other}", found.name);
            self.fault("against", message, "compare quantities of one dimension");
        }
    }

    /// Checks that a norm is asked of a series.
    pub(super) fn norm(&mut self, norm: Option<NormSpec>, of: &str) -> Norm {
        let scalar = |found: &Offered| found.name == of && found.kind == ObservableKind::Scalar;
        if norm.is_some() && self.offered_anywhere().iter().any(scalar) {
            let message = format!("`norm` is for a series, `{of}` is a scalar");
            self.fault("norm", message, "leave `norm` out");
        }
        match norm {
            Some(NormSpec::RootMeanSquare) => Norm::RootMeanSquare,
            Some(NormSpec::Maximum) | None => Norm::Maximum,
        }
    }

    /// Checks that a name is an axis of numbers with at least two values.
    pub(super) fn numeric_axis(&mut self, field: &str, name: &str) {
        if !self.context.complete {
            return;
        }
        let names: Vec<&str> = self
            .context
            .axes
            .iter()
            .map(|axis| axis.axis.name.as_str())
            .collect();
        let Some(axis) = self.context.axes.iter().find(|axis| axis.axis.name == name) else {
            return self.fault(field, format!("there is no axis `{name}`"), advice(name, &names));
        };
        let numbers = axis
            .axis
            .values
            .iter()
            .all(|value| matches!(value, AxisValue::Number(_)));
        if !numbers {
            self.fault(
                field,
                format!("the axis `{name}` does not hold numbers"),
                "choose one that does",
            );
        } else if axis.axis.values.len() < 2 {
            self.fault(
                field,
                format!("the axis `{name}` has a single value"),
                "two are needed at least",
            );
        }
    }

    pub(super) fn group(&mut self, name: &str) {
        let known = self.parameters();
        if !self.context.plan.points.is_empty() && !known.iter().any(|other| other == name) {
            let known: Vec<&str> = known.iter().map(String::as_str).collect();
            let message = format!("`{name}` is neither `scene`, nor an axis, nor a field of a scene");
            self.fault("group", message, advice(name, &known));
        }
    }

    /// `scene`, the axes and every leaf of the settings.
    pub(super) fn parameters(&self) -> Vec<String> {
        let mut names = vec!["scene".to_owned()];
        names.extend(self.context.axes.iter().map(|axis| axis.axis.name.clone()));
        let mut seen: Vec<&str> = Vec::new();
        for point in &self.context.plan.points {
            if !seen.contains(&point.scene.as_str()) {
                seen.push(&point.scene);
                leaves(&point.settings, &mut names);
            }
        }
        names
    }
}

fn kind_name(kind: ObservableKind) -> &'static str {
    match kind {
        ObservableKind::Scalar => "a scalar",
        ObservableKind::Series => "a series",
        ObservableKind::Profile => "a profile",
    }
}

/// Names of the leaves of a tree of settings.
fn leaves(tree: &Schema, names: &mut Vec<String>) {
    for (name, value) in tree.as_object().into_iter().flatten() {
        if value.is_object() {
            leaves(value, names);
        } else if !names.contains(name) {
            names.push(name.clone());
        }
    }
}
