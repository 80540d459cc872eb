//! Expectations, figures and observables: their names resolved, their selections checked.

use std::collections::BTreeMap;

use kynch_sim::scene::{Observable, ObservableKind};
use serde_json::Value as Schema;

use super::axes::{WrittenAxis, si_value};
use super::model::{AxisValue, Band, Check, Expectation, Figure, FigureKind, Plan, Selection, Work};
use super::names::{REFERENCES, observables};
use super::nearest::advice;
use super::problem::Problems;
use super::shape::{Place, Shapes};
use super::spec::quantity::AnyQuantity;
use super::spec::statement::{Caption, Common, ExpectationSpec, FigureSpec, ValueSpec};
use super::units::{self, Dimension};
use super::yaml::{Key, Node, Value};

/// What statements may refer to.
pub struct Context<'a> {
    /// Scenes by name, without their axes.
    pub works: &'a BTreeMap<String, Work>,
    pub axes: &'a [WrittenAxis],
    /// Without points when a point is at fault.
    pub plan: &'a Plan,
    pub shapes: &'a Shapes,
}

/// One statement as written: `{kind: {fields}}`.
struct Written<'a> {
    kind: &'a Key,
    fields: &'a Node,
    path: String,
}

/// Statements of a list whose shape is sound, with their number from 1.
fn sound<'a>(
    root: &'a Node,
    list: &str,
    schema: &Schema,
    shapes: &Shapes,
) -> Vec<(usize, &'a Node, Written<'a>)> {
    let elements = root.get(list).map(Node::elements).unwrap_or_default();
    let sound = |node: &&Node| {
        let mut problems = Problems::default();
        shapes.check(node, schema, &Place::root(), &mut problems);
        problems.is_empty()
    };
    elements
        .iter()
        .enumerate()
        .filter(|(_, node)| sound(node))
        .filter_map(|(index, node)| {
            let (kind, fields) = node.entries().first()?;
            let path = format!("{list}[{index}].{}", kind.name);
            Some((index + 1, node, Written { kind, fields, path }))
        })
        .collect()
}

/// Reads `expect`; statements at fault are reported and left out.
pub fn expectations(root: &Node, context: &Context, problems: &mut Problems) -> Vec<Expectation> {
    let mut list: Vec<Expectation> = Vec::new();
    let schema = context.shapes.of("ExpectationSpec");
    for (number, node, written) in sound(root, "expect", schema, context.shapes) {
        let spec: ExpectationSpec = match serde_json::from_value(node.json()) {
            Ok(spec) => spec,
            Err(error) => {
                problems.add(
                    &node.span,
                    &written.path,
                    error.to_string(),
                    "correct the expectation",
                );
                continue;
            }
        };
        let mut reader = Reader {
            written: &written,
            context,
            problems,
        };
        let (common, check) = reader.expectation(spec);
        let selection = reader.selection();
        let id = common
            .id
            .unwrap_or_else(|| format!("{}-{number}", written.kind.name));
        reader.check_id(&id, list.iter().any(|other| other.id == id));
        let Common {
            claims, informative, ..
        } = common.rest;
        list.push(Expectation {
            id,
            check,
            selection,
            claims,
            informative,
        });
    }
    list
}

/// Reads `figures`; those at fault are reported and left out.
pub fn figures(root: &Node, context: &Context, problems: &mut Problems) -> Vec<Figure> {
    let mut list: Vec<Figure> = Vec::new();
    let schema = context.shapes.of("FigureSpec");
    for (number, node, written) in sound(root, "figures", schema, context.shapes) {
        let spec: FigureSpec = match serde_json::from_value(node.json()) {
            Ok(spec) => spec,
            Err(error) => {
                problems.add(&node.span, &written.path, error.to_string(), "correct the figure");
                continue;
            }
        };
        let mut reader = Reader {
            written: &written,
            context,
            problems,
        };
        let (caption, kind) = reader.figure(spec);
        let selection = reader.selection();
        let id = caption
            .id
            .unwrap_or_else(|| format!("{}-{number}", written.kind.name));
        reader.check_id(&id, list.iter().any(|other| other.id == id));
        list.push(Figure {
            id,
            title: caption.title,
            kind,
            selection,
            thesis: caption.thesis,
        });
    }
    list
}

/// Observables to keep: those listed, and those that a statement needs.
pub fn observe(
    root: &Node,
    context: &Context,
    expect: &[Expectation],
    figures: &[Figure],
    problems: &mut Problems,
) -> Vec<String> {
    let all: Vec<Observable> = context.works.values().flat_map(observables).collect();
    let names: Vec<&str> = distinct(all.iter().map(|observable| observable.name));
    let mut observe: Vec<String> = Vec::new();
    for (index, node) in root
        .get("observe")
        .map(Node::elements)
        .unwrap_or_default()
        .iter()
        .enumerate()
    {
        let Value::Text(name) = &node.value else { continue };
        let field = format!("observe[{index}]");
        if !names.contains(&name.as_str()) {
            let message = format!("no scene here can observe `{name}`");
            problems.add(&node.span, &field, message, advice(name, &names));
        } else if observe.contains(name) {
            problems.add(
                &node.span,
                &field,
                format!("`{name}` is listed twice"),
                "keep one",
            );
        } else {
            observe.push(name.clone());
        }
    }
    let of_checks = expect.iter().map(|expectation| match &expectation.check {
        Check::Value { of, .. }
        | Check::Error { of, .. }
        | Check::Order { of, .. }
        | Check::Monotone { of, .. } => of,
    });
    let of_figures = figures.iter().flat_map(|figure| match &figure.kind {
        FigureKind::TimeSeries { of, .. } => of.iter().collect::<Vec<_>>(),
        FigureKind::ErrorAgainstResolution { of, .. }
        | FigureKind::RunTimeAgainstError { of, .. }
        | FigureKind::Profile { of, .. } => vec![of],
    });
    for name in of_checks.chain(of_figures) {
        if !observe.contains(name) {
            observe.push(name.clone());
        }
    }
    observe
}

fn distinct<'a>(names: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let mut list = Vec::new();
    for name in names {
        if !list.contains(&name) {
            list.push(name);
        }
    }
    list
}

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

/// Reads one statement; every fault goes to `problems`.
struct Reader<'a, 'p> {
    written: &'a Written<'a>,
    context: &'a Context<'a>,
    problems: &'p mut Problems,
}

/// `Common` with its identifier taken out.
struct Named {
    id: Option<String>,
    rest: Common,
}

impl Reader<'_, '_> {
    fn fault(&mut self, name: &str, message: impl AsRef<str>, help: impl AsRef<str>) {
        let node = self.written.fields.get(name);
        let span = node.map_or(self.written.kind.span.clone(), |node| node.span.clone());
        self.problems
            .add(&span, &format!("{}.{name}", self.written.path), message, help);
    }

    fn expectation(&mut self, spec: ExpectationSpec) -> (Named, Check) {
        use ObservableKind::{Scalar, Series};
        let (common, check) = match spec {
            ExpectationSpec::Value(spec) => {
                let unit = self.observable("of", &spec.of, &[Scalar]);
                let band = self.band(&spec, unit);
                (spec.common, Check::Value { of: spec.of, band })
            }
            ExpectationSpec::Error(spec) => {
                self.observable("of", &spec.of, &[Scalar, Series]);
                self.reference(&spec.against, Some(&spec.of));
                self.above_zero("below", spec.below.0);
                (
                    spec.common,
                    Check::Error {
                        of: spec.of,
                        against: spec.against,
                        below: spec.below.0,
                    },
                )
            }
            ExpectationSpec::Order(spec) => {
                self.observable("of", &spec.of, &[Scalar]);
                self.reference(&spec.against, Some(&spec.of));
                self.numeric_axis(&spec.over);
                self.above_zero("within", spec.within.0);
                let (is, within) = (spec.is.0, spec.within.0);
                (
                    spec.common,
                    Check::Order {
                        of: spec.of,
                        against: spec.against,
                        over: spec.over,
                        is,
                        within,
                    },
                )
            }
            ExpectationSpec::Monotone(spec) => {
                self.observable("of", &spec.of, &[Scalar]);
                self.numeric_axis(&spec.over);
                (
                    spec.common,
                    Check::Monotone {
                        of: spec.of,
                        over: spec.over,
                        rising: spec.rising,
                    },
                )
            }
        };
        (
            Named {
                id: common.id.clone(),
                rest: common,
            },
            check,
        )
    }

    fn figure(&mut self, spec: FigureSpec) -> (Caption, FigureKind) {
        use ObservableKind::{Profile, Scalar, Series};
        let (caption, kind) = match spec {
            FigureSpec::TimeSeries(spec) => {
                for of in &spec.of.0 {
                    self.observable("of", of, &[Series]);
                }
                if let Some(against) = &spec.against {
                    self.reference(against, spec.of.0.first());
                }
                let group = spec.caption.group.clone();
                (
                    spec.caption,
                    FigureKind::TimeSeries {
                        of: spec.of.0,
                        against: spec.against,
                        group,
                    },
                )
            }
            FigureSpec::ErrorAgainstResolution(spec) => {
                self.observable("of", &spec.of, &[Scalar, Series]);
                self.reference(&spec.against, Some(&spec.of));
                self.numeric_axis(&spec.over);
                let group = spec.caption.group.clone();
                let (of, against, over) = (spec.of, spec.against, spec.over);
                (
                    spec.caption,
                    FigureKind::ErrorAgainstResolution {
                        of,
                        against,
                        over,
                        group,
                    },
                )
            }
            FigureSpec::RunTimeAgainstError(spec) => {
                self.observable("of", &spec.of, &[Scalar, Series]);
                self.reference(&spec.against, Some(&spec.of));
                let group = spec.caption.group.clone();
                (
                    spec.caption,
                    FigureKind::RunTimeAgainstError {
                        of: spec.of,
                        against: spec.against,
                        group,
                    },
                )
            }
            FigureSpec::Profile(spec) => {
                self.observable("of", &spec.of, &[Profile]);
                let group = spec.caption.group.clone();
                (spec.caption, FigureKind::Profile { of: spec.of, group })
            }
        };
        if let Some(group) = &caption.group {
            self.group(group);
        }
        (caption, kind)
    }

    /// Scenes that the statement may be about.
    fn scenes(&self) -> Vec<&str> {
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

    /// Checks that a selected scene offers an observable of the right kind; gives its unit.
    fn observable(&mut self, field: &str, name: &str, kinds: &[ObservableKind]) -> Option<Dimension> {
        let scenes = self.scenes();
        if scenes.is_empty() {
            return None;
        }
        let offered: Vec<Observable> = scenes
            .iter()
            .flat_map(|scene| observables(&self.context.works[*scene]))
            .collect();
        let right: Vec<&str> = distinct(
            offered
                .iter()
                .filter(|observable| kinds.contains(&observable.kind))
                .map(|observable| observable.name),
        );
        match offered.iter().find(|observable| observable.name == name) {
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

    /// Checks that a reference exists, and is a curve exactly when the observable is one.
    fn reference(&mut self, name: &str, of: Option<&String>) {
        let works = self.context.works.values();
        let offered: Vec<Observable> = works.flat_map(observables).collect();
        let kind = of
            .and_then(|of| offered.iter().find(|observable| observable.name == of))
            .map(|found| found.kind);
        let fitting: Vec<&str> = REFERENCES
            .iter()
            .filter(|(_, is)| kind.is_none_or(|kind| kind == *is))
            .map(|(name, _)| *name)
            .collect();
        match (REFERENCES.iter().find(|(known, _)| *known == name), kind) {
            (None, _) => self.fault(
                "against",
                format!("there is no reference `{name}`"),
                advice(name, &fitting),
            ),
            (Some((_, is)), Some(kind)) if *is != kind && kind != ObservableKind::Profile => {
                let message = format!(
                    "the reference `{name}` is {}, the observable is {}",
                    kind_name(*is),
                    kind_name(kind)
                );
                self.fault("against", message, format!("known: {}", fitting.join(", ")));
            }
            _ => {}
        }
    }

    /// Checks that a name is an axis of numbers with at least two values.
    fn numeric_axis(&mut self, name: &str) {
        let names: Vec<&str> = self
            .context
            .axes
            .iter()
            .map(|axis| axis.axis.name.as_str())
            .collect();
        let Some(axis) = self.context.axes.iter().find(|axis| axis.axis.name == name) else {
            return self.fault("over", format!("there is no axis `{name}`"), advice(name, &names));
        };
        let numbers = axis
            .axis
            .values
            .iter()
            .all(|value| matches!(value, AxisValue::Number(_)));
        if !numbers {
            self.fault(
                "over",
                format!("the axis `{name}` does not hold numbers"),
                "choose one that does",
            );
        } else if axis.axis.values.len() < 2 {
            self.fault(
                "over",
                format!("the axis `{name}` has a single value"),
                "two are needed at least",
            );
        }
    }

    fn group(&mut self, name: &str) {
        let known = self.parameters();
        if !self.context.plan.points.is_empty() && !known.iter().any(|other| other == name) {
            let known: Vec<&str> = known.iter().map(String::as_str).collect();
            let message = format!("`{name}` is neither `scene`, nor an axis, nor a field of a scene");
            self.fault("group", message, advice(name, &known));
        }
    }

    /// `scene`, the axes and every leaf of the settings.
    fn parameters(&self) -> Vec<String> {
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

    fn band(&mut self, spec: &ValueSpec, unit: Option<Dimension>) -> Band {
        for (name, bound) in [("is", spec.is), ("above", spec.above), ("below", spec.below)] {
            if let (
                Some(AnyQuantity {
                    dimension: Some(found),
                    ..
                }),
                Some(unit),
            ) = (bound, unit)
            {
                if found != unit {
                    let message = format!("`{name}` is {found}, `{}` is {unit}", spec.of);
                    self.fault(name, message, format!("write it in {}", unit.unit()));
                }
            }
        }
        let bound = |quantity: Option<AnyQuantity>| quantity.map(|quantity| quantity.value);
        let band = Band {
            above: bound(spec.above),
            below: bound(spec.below),
        };
        match (spec.is, spec.within, band) {
            (
                Some(is),
                Some(within),
                Band {
                    above: None,
                    below: None,
                },
            ) => {
                self.above_zero("within", within.0);
                let half = is.value.abs() * within.0;
                Band {
                    above: Some(is.value - half),
                    below: Some(is.value + half),
                }
            }
            (
                None,
                None,
                Band {
                    above: Some(above),
                    below: Some(below),
                },
            ) if above >= below => {
                let message = format!("no value lies above {above} and below {below}");
                self.fault("above", message, "`above` is the lower bound");
                band
            }
            (
                None,
                None,
                Band {
                    above: None,
                    below: None,
                },
            ) => {
                self.fault(
                    "of",
                    "this expects no particular value",
                    "add `is` with `within`, or `above`, or `below`",
                );
                band
            }
            (None, None, band) => band,
            (Some(_), None, _) => {
                self.fault(
                    "is",
                    "`is` needs `within`",
                    "add `within: 1 %`, the relative half width of the band",
                );
                band
            }
            (None, Some(_), _) => {
                self.fault(
                    "within",
                    "`within` needs `is`",
                    "add `is:` with the value expected",
                );
                band
            }
            (Some(_), Some(_), _) => {
                self.fault(
                    "is",
                    "`is` stands beside `above` or `below`",
                    "keep one of the two forms",
                );
                band
            }
        }
    }

    fn above_zero(&mut self, name: &str, value: f64) {
        if value <= 0.0 {
            self.fault(
                name,
                format!("`{name}` is {value}, it must be above 0"),
                "write a positive number",
            );
        }
    }

    fn check_id(&mut self, id: &str, taken: bool) {
        let letters =
            |letter: char| letter.is_ascii_lowercase() || letter.is_ascii_digit() || "-_.".contains(letter);
        if !id.starts_with(|first: char| first.is_ascii_alphanumeric())
            || !id.chars().all(letters)
            || id.len() > 80
        {
            let help = "use small letters, digits, -, _ and ., beginning with a letter or digit";
            self.fault("id", format!("`{id}` cannot be an identifier"), help);
        } else if taken {
            self.fault("id", format!("the identifier `{id}` is taken"), "choose another");
        }
    }

    /// Reads `where`.
    fn selection(&mut self) -> Selection {
        let mut selection = Selection::default();
        let Some(node) = self.written.fields.get("where") else {
            return selection;
        };
        let before = self.problems.len();
        for (key, node) in node.entries() {
            let field = format!("{}.where.{}", self.written.path, key.name);
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
        let points = &self.context.plan.points;
        if self.problems.len() == before
            && !points.is_empty()
            && !points.iter().any(|point| selection.admits(point))
        {
            self.fault(
                "where",
                "this selects no point of the plan",
                "drop one of its conditions",
            );
        }
        selection
    }

    fn scene_names(&mut self, node: &Node, scenes: &[AxisValue], field: &str) -> Vec<String> {
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
    fn values_of(&self, name: &str) -> Option<(Option<Dimension>, Vec<AxisValue>)> {
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
