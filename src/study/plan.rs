//! From scenes and axes to the points of the plan, each checked.

use std::collections::BTreeMap;
use std::ops::Range;

use super::axes::{WrittenAxis, WrittenScene};
use super::faults::Fault;
use super::model::{AxisValue, Plan, Point, Work};
use super::path;
use super::problem::Problems;
use super::shape::{Place, Shapes};
use super::spec::scene::SceneSpec;
use super::work::{self, Snapshots};
use super::yaml::Node;

/// Most points that a study may have.
const MOST_POINTS: usize = 100_000;

/// Names with the values that leave a point out.
pub type Exclusion = Vec<(String, Vec<AxisValue>)>;

/// What a plan is made of.
pub struct Ingredients<'a> {
    pub scenes: &'a [WrittenScene],
    pub axes: &'a [WrittenAxis],
    pub seeds: &'a [u64],
    pub exclusions: &'a [(Range<usize>, Exclusion)],
    pub shapes: &'a Shapes,
    pub snapshots: &'a Snapshots,
}

/// A scene without its axes: tells which observables there are.
pub fn base(scene: &WrittenScene, snapshots: &Snapshots) -> Option<Work> {
    let spec: SceneSpec = serde_json::from_value(scene.node.json()).ok()?;
    Some(work::work(&work::completed(spec, snapshots)))
}

/// Every point, scenes first, the first axis slowest, seeds fastest.
pub fn expand(ingredients: &Ingredients, problems: &mut Problems) -> Plan {
    let mut plan = Plan::default();
    let mut used = vec![false; ingredients.exclusions.len()];
    for scene in ingredients.scenes {
        let groups = groups(scene, ingredients.axes);
        let lengths = groups.iter().map(|group| ingredients.axes[group[0]].nodes.len());
        let combinations = lengths.fold(ingredients.seeds.len(), usize::saturating_mul);
        if combinations > MOST_POINTS - plan.points.len().min(MOST_POINTS) {
            let message = format!("the study has more than {MOST_POINTS} points");
            problems.add(
                &scene.key,
                &scene.path,
                message,
                "take fewer values, or exclude some in separate studies",
            );
            return Plan::default();
        }
        let mut findings = Findings::default();
        for choice in choices(&groups, ingredients.axes) {
            let axes = chosen(&choice, scene, ingredients);
            if let Some(position) = excluded(scene, &axes, ingredients.exclusions) {
                used[position] = true;
                continue;
            }
            point(
                scene,
                &choice,
                axes,
                ingredients,
                (&mut plan, &mut findings),
                problems,
            );
        }
        findings.report(problems);
    }
    if let (true, Some((span, _))) = (
        plan.points.is_empty() && problems.is_empty(),
        ingredients.exclusions.first(),
    ) {
        problems.add(
            span,
            "exclude",
            "every point of the study is left out",
            "exclude less",
        );
    }
    for ((span, _), used) in ingredients.exclusions.iter().zip(used) {
        if !used {
            problems.add(
                span,
                "exclude",
                "this leaves out no point",
                "correct the values, or remove the line",
            );
        }
    }
    plan
}

/// Axes that bind in the scene, those that move together in one group.
fn groups(scene: &WrittenScene, axes: &[WrittenAxis]) -> Vec<Vec<usize>> {
    let mut groups: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (position, axis) in axes.iter().enumerate() {
        if axis.bindings.iter().any(|(name, _)| *name == scene.name) {
            groups.entry(axis.leader).or_default().push(position);
        }
    }
    groups.into_values().collect()
}

/// Every combination of axis and value, the first group slowest.
fn choices(groups: &[Vec<usize>], axes: &[WrittenAxis]) -> Vec<Vec<(usize, usize)>> {
    let mut choices: Vec<Vec<(usize, usize)>> = vec![Vec::new()];
    for group in groups {
        let length = axes[group[0]].nodes.len();
        choices = choices
            .into_iter()
            .flat_map(|choice| {
                (0..length).map(move |value| {
                    let members = group.iter().map(|axis| (*axis, value));
                    choice.iter().copied().chain(members).collect()
                })
            })
            .collect();
    }
    choices
}

/// The scene with the values put in, and which axes found their place.
struct Chosen {
    tree: Node,
    axes: Vec<(String, AxisValue)>,
}

fn chosen(choice: &[(usize, usize)], scene: &WrittenScene, ingredients: &Ingredients) -> Chosen {
    let mut tree = scene.node.clone();
    // Whole models before the fields inside them.
    let mut steps: Vec<(&Vec<String>, usize, usize)> = choice
        .iter()
        .flat_map(|(axis, value)| {
            let bindings = ingredients.axes[*axis].bindings.iter();
            let here = bindings.filter(|(name, _)| *name == scene.name);
            here.map(|(_, path)| (path, *axis, *value))
        })
        .collect();
    steps.sort_by_key(|(path, ..)| path.len());
    let mut bound = Vec::new();
    for (path, axis, value) in steps {
        let segments: Vec<&str> = path.iter().map(String::as_str).collect();
        // Another axis may have chosen a model without this field: the axis then does not bind.
        let Ok((_, schema)) = path::bind(ingredients.shapes, &tree, &segments) else {
            continue;
        };
        path::put(
            &mut tree,
            path,
            &ingredients.axes[axis].nodes[value],
            ingredients.shapes,
            schema,
        );
        bound.push(axis);
    }
    let tree = ingredients
        .shapes
        .opened(&tree, ingredients.shapes.of("SceneSpec"));
    let axes = choice
        .iter()
        .filter(|(axis, _)| bound.contains(axis))
        .map(|(axis, value)| {
            let axis = &ingredients.axes[*axis].axis;
            (axis.name.clone(), axis.values[*value].clone())
        })
        .collect();
    Chosen { tree, axes }
}

fn excluded(
    scene: &WrittenScene,
    chosen: &Chosen,
    exclusions: &[(Range<usize>, Exclusion)],
) -> Option<usize> {
    exclusions.iter().position(|(_, exclusion)| {
        exclusion.iter().all(|(name, values)| match name.as_str() {
            "scene" => values.contains(&AxisValue::Word(scene.name.clone())),
            _ => chosen
                .axes
                .iter()
                .any(|(axis, value)| axis == name && values.contains(value)),
        })
    })
}

fn point(
    scene: &WrittenScene,
    choice: &[(usize, usize)],
    chosen: Chosen,
    ingredients: &Ingredients,
    (plan, findings): (&mut Plan, &mut Findings),
    problems: &mut Problems,
) {
    let Chosen { tree, axes } = chosen;
    // The same point again, because an axis did not bind here.
    let repeats = axes.len() < choice.len();
    if repeats
        && plan
            .points
            .iter()
            .any(|point| point.scene == scene.name && point.axes == axes)
    {
        return;
    }
    let place = Place {
        path: scene.path.clone(),
        key: Some(scene.key.clone()),
        called: None,
    };
    let before = problems.len();
    ingredients
        .shapes
        .check(&tree, ingredients.shapes.of("SceneSpec"), &place, problems);
    if problems.len() > before {
        return;
    }
    let spec: SceneSpec = match serde_json::from_value(tree.json()) {
        Ok(spec) => spec,
        Err(error) => return problems.add(&scene.key, &scene.path, error.to_string(), "correct the scene"),
    };
    let twice = given_twice(&spec);
    let spec = work::completed(spec, ingredients.snapshots);
    let work = work::work(&spec);
    let label = axes
        .iter()
        .map(|(name, value)| format!("{name}={value}"))
        .collect::<Vec<_>>()
        .join(" ");
    findings.checked += 1;
    for fault in work::refusals(&spec, &work).into_iter().chain(twice) {
        findings.add(fault, scene, &tree, &label);
    }
    let settings = work::settings(&spec);
    for seed in ingredients.seeds {
        plan.points.push(Point {
            index: plan.points.len(),
            scene: scene.name.clone(),
            axes: axes.clone(),
            seed: *seed,
            settings: settings.clone(),
            work: work.seeded(*seed),
        });
    }
}

/// A block is as thick as `thickness` or as `layers` say, not both.
fn given_twice(spec: &SceneSpec) -> Option<Fault> {
    let SceneSpec::ConstantPorosityBlock(block) = spec else {
        return None;
    };
    (block.thickness.is_some() && block.layers.is_some()).then(|| Fault {
        path: "layers".to_owned(),
        message: "`thickness` and `layers` are both given".to_owned(),
        help: "keep one".to_owned(),
    })
}

/// Faults of a scene's points, each distinct one with the points that have it.
#[derive(Default)]
struct Findings {
    checked: usize,
    found: Vec<Finding>,
}

struct Finding {
    span: Range<usize>,
    field: String,
    fault: Fault,
    points: Vec<String>,
}

impl Findings {
    fn add(&mut self, fault: Fault, scene: &WrittenScene, tree: &Node, label: &str) {
        let (span, field) = locate(scene, tree, &fault.path);
        let same = |finding: &&mut Finding| finding.span == span && finding.fault.message == fault.message;
        match self.found.iter_mut().find(same) {
            Some(finding) => finding.points.push(label.to_owned()),
            None => self.found.push(Finding {
                span,
                field,
                fault,
                points: vec![label.to_owned()],
            }),
        }
    }

    fn report(self, problems: &mut Problems) {
        for Finding {
            span,
            field,
            fault,
            points,
        } in self.found
        {
            let mut help = fault.help;
            if points.len() < self.checked {
                let shown = points
                    .iter()
                    .take(3)
                    .map(String::as_str)
                    .collect::<Vec<_>>()
                    .join("; ");
                let rest = points.len().saturating_sub(3);
                let rest = if rest > 0 {
                    format!(" and {rest} more")
                } else {
                    String::new()
                };
                help.push_str(&format!(" (at {shown}{rest})"));
            }
            problems.add(&span, &field, fault.message, help);
        }
    }
}

/// The value that a path inside a scene leads to; where it was left out, the key that should hold it.
fn locate(scene: &WrittenScene, tree: &Node, path: &str) -> (Range<usize>, String) {
    let Some((kind, mut node)) = tree.entries().first().map(|(key, node)| (key, node)) else {
        return (scene.key.clone(), scene.path.clone());
    };
    let mut span = kind.span.clone();
    let field = format!("{}.{}.{path}", scene.path, kind.name);
    for segment in path.split('.') {
        let element = || node.elements().get(segment.parse::<usize>().ok()?);
        match (node.entry(segment), element()) {
            (Some((key, child)), _) => {
                span = key.span.clone();
                node = child;
            }
            (None, Some(child)) => {
                span = child.span.clone();
                node = child;
            }
            (None, None) => return (span, field),
        }
    }
    (node.span.clone(), field)
}
