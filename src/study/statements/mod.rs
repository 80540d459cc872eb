//! Expectations, figures and observables: their names resolved, their selections checked.

mod band;
mod beside;
mod calibrated;
mod comparison;
mod derived;
mod fitted;
mod named;
mod selection;

use std::collections::BTreeMap;

use kynch_sim::scene::{Observable, ObservableKind};
use serde_json::Value as Schema;

pub use calibrated::calibrated;
pub use derived::derived;
pub use selection::admitted;

use super::axes::WrittenAxis;
use super::model::{
    Check, Comparison, Derived, Ending, Expectation, Figure, FigureKind, FittedLaw, LawFit, Limit, Plan, Work,
};
use super::names::{is_measured_work, measures_of_work, observables};
use super::nearest::advice;
use super::problem::Problems;
use super::shape::{Place, Shapes};
use super::spec::quantity::Fraction;
use super::spec::statement::{Caption, Common, EndingSpec, ExpectationSpec, FigureSpec, LimitSpec};
use super::yaml::{Key, Node, Value};

/// The table in which scenes keep their grains.
const SNAPSHOTS: &str = "snapshots";
/// Panels that one figure has room for.
const MOST_PANELS: usize = 8;

/// What statements may refer to.
pub struct Context<'a> {
    /// Scenes by name, without their axes.
    pub works: &'a BTreeMap<String, Work>,
    pub axes: &'a [WrittenAxis],
    /// What the study derives of its series.
    pub derived: &'a [Derived],
    /// Whether scenes and axes could be read; if not, only what does not depend on them is checked.
    pub complete: bool,
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
        | Check::Monotone { of, .. }
        | Check::Scaling { of, .. }
        | Check::Limit(Limit { of, .. })
        | Check::Fit(LawFit {
            law: FittedLaw { of, .. },
            ..
        })
        | Check::Compare(Comparison { of, .. }) => Some(of),
        Check::Status { .. } => None,
    });
    let of_figures = figures.iter().flat_map(|figure| match &figure.kind {
        FigureKind::TimeSeries { of, over, .. } => of.iter().chain(over).cloned().collect(),
        FigureKind::ErrorAgainstResolution { of, .. }
        | FigureKind::RunTimeAgainstError { of, .. }
        | FigureKind::Response { of, .. }
        | FigureKind::Profile { of, .. } => vec![of.clone()],
        FigureKind::Limit { limit, .. } => vec![limit.of.clone()],
        FigureKind::Map { of, curves, .. } => std::iter::once(of).chain(curves).cloned().collect(),
        FigureKind::RichardsonZaki { law, .. } => vec![law.of.clone()],
        FigureKind::Flux { of, deposit, .. } => std::iter::once(of).chain(deposit).cloned().collect(),
        FigureKind::Snapshots { .. } => vec![SNAPSHOTS.to_owned()],
    });
    let derived = |name: &String| context.derived.iter().any(|derived| derived.name == *name);
    let sources = context.derived.iter().flat_map(|derived| derived.how.sources());
    let named = of_checks.flatten().cloned().chain(of_figures);
    for name in named.chain(sources.cloned()) {
        if !observe.contains(&name) && !is_measured_work(&name) && !derived(&name) {
            observe.push(name);
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
        // `a.b`: the field b of the field a.
        let node = name
            .split('.')
            .try_fold(self.written.fields, |node, field| node.get(field));
        let node = node.or_else(|| self.written.fields.get(name.split('.').next()?));
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
                let norm = self.norm(spec.norm, &spec.of);
                (
                    spec.common,
                    Check::Error {
                        norm,
                        of: spec.of,
                        against: spec.against,
                        below: spec.below.0,
                    },
                )
            }
            ExpectationSpec::Order(spec) => {
                self.observable("of", &spec.of, &[Scalar]);
                self.reference(&spec.against, Some(&spec.of));
                self.numeric_axis("over", &spec.over);
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
                self.numeric_axis("over", &spec.over);
                (
                    spec.common,
                    Check::Monotone {
                        of: spec.of,
                        over: spec.over,
                        rising: spec.rising,
                        within_noise: spec.within_noise,
                    },
                )
            }
            ExpectationSpec::Compare(spec) => {
                self.observable("of", &spec.of, &[Scalar]);
                let comparison = self.comparison(&spec);
                (spec.common, Check::Compare(comparison))
            }
            ExpectationSpec::Scaling(spec) => {
                self.observable("of", &spec.of, &[Scalar]);
                self.numeric_axis("over", &spec.over);
                self.above_zero("within", spec.within.0);
                let (is, within) = (spec.is.0, spec.within.0);
                let (of, over) = (spec.of, spec.over);
                (spec.common, Check::Scaling { of, over, is, within })
            }
            ExpectationSpec::Fit(spec) => {
                let fit = self.fit(&spec);
                (spec.common, Check::Fit(fit))
            }
            ExpectationSpec::Status(spec) => {
                let ending = |ending: &EndingSpec| match ending {
                    EndingSpec::Completed => Ending::Completed,
                    EndingSpec::Diverged => Ending::Diverged,
                };
                let is = spec.is.0.iter().map(ending).collect();
                (spec.common, Check::Status { is })
            }
            ExpectationSpec::Limit(spec) => {
                self.above_zero("within", spec.within.0);
                let limit = self.limit(&spec);
                (spec.common, Check::Limit(limit))
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
                if let Some(over) = &spec.over {
                    self.observable("over", over, &[Series]);
                }
                if let Some(against) = &spec.against {
                    self.level(against, spec.of.0.first());
                }
                let group = spec.caption.group.clone();
                (
                    spec.caption,
                    FigureKind::TimeSeries {
                        of: spec.of.0,
                        over: spec.over,
                        against: spec.against,
                        group,
                    },
                )
            }
            FigureSpec::ErrorAgainstResolution(spec) => {
                self.observable("of", &spec.of, &[Scalar, Series]);
                self.reference(&spec.against, Some(&spec.of));
                self.numeric_axis("over", &spec.over);
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
                if let Some(work) = spec.work.as_deref().filter(|work| !is_measured_work(work)) {
                    let message = format!("`{work}` is no measure of work");
                    self.fault("work", message, advice(work, &measures_of_work()));
                }
                let group = spec.caption.group.clone();
                (
                    spec.caption,
                    FigureKind::RunTimeAgainstError {
                        of: spec.of,
                        against: spec.against,
                        work: spec.work,
                        group,
                    },
                )
            }
            FigureSpec::Profile(spec) => {
                self.observable("of", &spec.of, &[Profile]);
                let group = spec.caption.group.clone();
                (spec.caption, FigureKind::Profile { of: spec.of, group })
            }
            FigureSpec::Response(spec) => {
                let unit = self.observable("of", &spec.of, &[Scalar]);
                self.numeric_axis("over", &spec.over);
                let against = self.beside(&spec, unit);
                let group = spec.caption.group.clone();
                let (of, over) = (spec.of, spec.over);
                (
                    spec.caption,
                    FigureKind::Response {
                        of,
                        over,
                        group,
                        against,
                    },
                )
            }
            FigureSpec::Limit(spec) => {
                let (of, over, against) = (spec.of, spec.over, spec.against);
                let limit = self.limit(&LimitSpec {
                    of,
                    above: spec.above,
                    below: spec.below,
                    over,
                    against,
                    within: Fraction(0.0),
                    common: Common::default(),
                });
                let (across, group) = (spec.across, spec.caption.group.clone());
                self.numeric_axis("across", &across);
                (spec.caption, FigureKind::Limit { limit, across, group })
            }
            FigureSpec::Map(spec) => return self.map(spec),
            FigureSpec::RichardsonZaki(spec) => self.settling(spec),
            FigureSpec::Flux(spec) => self.flux(spec),
            FigureSpec::Snapshots(spec) => {
                self.observable("snapshots", SNAPSHOTS, &[Profile]);
                self.one_point();
                let times: Vec<f64> = spec.times.0.iter().map(|time| time.0).collect();
                self.instants(&times);
                if spec.caption.group.is_some() {
                    let message = "`group` does not go with pictures of one point";
                    self.fault("group", message, "leave it out");
                }
                return (spec.caption, FigureKind::Snapshots { times });
            }
        };
        if let Some(group) = &caption.group {
            self.group(group);
        }
        (caption, kind)
    }
}
