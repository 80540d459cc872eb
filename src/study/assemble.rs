//! From the tree of a study file to the checked [`Study`].

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;

use super::axes::{self, WrittenAxis, WrittenScene};
use super::model::{AxisValue, Plan, PublishedTime, Study, Work};
use super::nearest::advice;
use super::plan::{self, Exclusion, Ingredients};
use super::problem::{Problems, StudyError};
use super::shape::{Place, Shapes};
use super::statements::{self, Context};
use super::units::{self, Dimension};
use super::work::Snapshots;
use super::yaml::{self, Node, Value};

const MOST_SEEDS: u64 = 10_000;

/// Checks and expands the text of a study; `path` gives it its name.
///
/// # Errors
/// Everything wrong with it, all at once.
pub fn parse(path: &Path, text: &str) -> Result<Study, StudyError> {
    let mut problems = Problems::default();
    let study = yaml::parse(text, &mut problems).and_then(|tree| build(path, &tree, &mut problems));
    match study {
        Some(study) if problems.is_empty() => Ok(study),
        _ => Err(StudyError::new(path, text, problems)),
    }
}

fn build(path: &Path, root: &Node, problems: &mut Problems) -> Option<Study> {
    let shapes = Shapes::new();
    let snapshots = Snapshots::beside(path);
    if !matches!(root.value, Value::Map(_)) {
        let message = format!("a study is a map of `name: value`, this is {}", root.kind());
        problems.add(&root.span, "", message, "begin with `question:`");
        return None;
    }
    shapes.check(
        root,
        shapes.study(),
        &Place {
            path: String::new(),
            key: Some(first_key(root)),
            called: None,
        },
        problems,
    );
    let mut written = written_scenes(root, problems);
    for scene in &mut written {
        scene.node = shapes.opened(&scene.node, shapes.of("SceneSpec"));
    }
    let usable: Vec<bool> = written
        .iter()
        .map(|scene| clean(&scene.node, shapes.of("SceneSpec"), &shapes))
        .collect();
    let scenes_hold = !written.is_empty() && usable.iter().all(|usable| *usable);
    let axes_hold = root.get("vary").is_none_or(|vary| {
        matches!(vary.value, Value::Map(_))
            && vary
                .entries()
                .iter()
                .all(|(_, axis)| clean(axis, shapes.of("AxisSpec"), &shapes))
    });
    let seeds = seeds(root, problems);
    let axes = (scenes_hold && axes_hold).then(|| axes::read(root, &written, &shapes, problems));
    let Some(axes) = axes.flatten() else {
        check_the_rest(root, &written, &usable, &shapes, &snapshots, problems);
        return None;
    };
    let works: BTreeMap<String, Work> = written
        .iter()
        .filter_map(|scene| Some((scene.name.clone(), plan::base(scene, &snapshots)?)))
        .collect();
    let exclusions = exclusions(root, &written, &axes, problems);
    let seeds = seeds.unwrap_or_else(|| vec![1]);
    let ingredients = Ingredients {
        scenes: &written,
        axes: &axes,
        seeds: &seeds,
        exclusions: &exclusions,
        shapes: &shapes,
        snapshots: &snapshots,
    };
    let plan = plan::expand(&ingredients, problems);
    let context = Context {
        works: &works,
        axes: &axes,
        derived: &[],
        complete: true,
        plan: &plan,
        shapes: &shapes,
    };
    let derive = statements::derived(root, &context, problems);
    let context = Context {
        derived: &derive,
        ..context
    };
    let expect = statements::expectations(root, &context, problems);
    let figures = statements::figures(root, &context, problems);
    let calibrated = statements::calibrated(root, &written, &context, problems);
    let observe = statements::observe(root, &context, &expect, &figures, problems);
    Some(Study {
        name: path
            .file_stem()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned(),
        path: path.to_owned(),
        question: root
            .get("question")
            .map(|node| node.shown_whole())
            .unwrap_or_default(),
        scenes: written.iter().map(|scene| scene.name.clone()).collect(),
        axes: axes.into_iter().map(|axis| axis.axis).collect(),
        seeds,
        calibrated,
        derive: derive.clone(),
        observe,
        expect,
        figures,
        published_time: published_time(root, problems),
        plan,
    })
}

/// What can still be said when something stands in the way of a plan: physical faults of sound
/// scenes, and statements as far as they do not depend on scenes and axes.
fn check_the_rest(
    root: &Node,
    written: &[WrittenScene],
    usable: &[bool],
    shapes: &Shapes,
    snapshots: &Snapshots,
    problems: &mut Problems,
) {
    for (scene, _) in written.iter().zip(usable).filter(|(_, usable)| **usable) {
        let ingredients = Ingredients {
            scenes: std::slice::from_ref(scene),
            axes: &[],
            seeds: &[1],
            exclusions: &[],
            shapes,
            snapshots,
        };
        plan::expand(&ingredients, problems);
    }
    let context = Context {
        works: &BTreeMap::new(),
        axes: &[],
        derived: &[],
        complete: false,
        plan: &Plan::default(),
        shapes,
    };
    let derive = statements::derived(root, &context, problems);
    let context = Context {
        derived: &derive,
        ..context
    };
    statements::expectations(root, &context, problems);
    statements::figures(root, &context, problems);
}

fn first_key(root: &Node) -> Range<usize> {
    root.entries()
        .first()
        .map_or(root.span.clone(), |(key, _)| key.span.clone())
}

fn clean(node: &Node, schema: &serde_json::Value, shapes: &Shapes) -> bool {
    let mut problems = Problems::default();
    shapes.check(node, schema, &Place::root(), &mut problems);
    problems.is_empty()
}

fn written_scenes(root: &Node, problems: &mut Problems) -> Vec<WrittenScene> {
    let scene = |name: &str, path: String, key: &yaml::Key, node: &Node| WrittenScene {
        name: name.to_owned(),
        path,
        key: key.span.clone(),
        node: node.clone(),
    };
    match (root.entry("scene"), root.entry("scenes")) {
        (Some((key, node)), None) => vec![scene("scene", "scene".to_owned(), key, node)],
        (None, Some((key, node))) => {
            if node.entries().is_empty() && matches!(node.value, Value::Map(_)) {
                problems.add(
                    &key.span,
                    "scenes",
                    "`scenes` names no scene",
                    "add one, or use `scene:`",
                );
            }
            for (key, _) in node.entries().iter().filter(|(key, _)| !axes::is_name(&key.name)) {
                let message = format!("`{}` is not a name", key.name);
                let help = "use small letters, digits and _, beginning with a letter";
                problems.add(&key.span, &format!("scenes.{}", key.name), message, help);
            }
            let entries = node.entries().iter();
            entries
                .map(|(key, node)| scene(&key.name, format!("scenes.{}", key.name), key, node))
                .collect()
        }
        (Some(_), Some((key, _))) => {
            let message = "`scene` and `scenes` are both given";
            problems.add(
                &key.span,
                "scenes",
                message,
                "move the one under `scene` to a name under `scenes`",
            );
            Vec::new()
        }
        (None, None) => {
            let help = "add `scene:` with one of single_sphere, constant_porosity_block, binary_collision, sedimentation, filtration, rehearsal";
            problems.add(
                &first_key(root),
                "scene",
                "`scene` is missing from the study",
                help,
            );
            Vec::new()
        }
    }
}

/// Seeds of the study; `None` when they are at fault.
fn seeds(root: &Node, problems: &mut Problems) -> Option<Vec<u64>> {
    let Some(node) = root.get("seeds") else {
        return Some(vec![1]);
    };
    let whole = |node: &Node| match node.value {
        Value::Number(number) if number >= 0.0 && number.fract() == 0.0 && number < 9e15 => {
            Some(number as u64)
        }
        _ => None,
    };
    if let Value::List(elements) = &node.value {
        let seeds: Vec<u64> = elements.iter().map(whole).collect::<Option<_>>()?;
        for (position, seed) in seeds
            .iter()
            .enumerate()
            .filter(|(at, seed)| seeds[..*at].contains(seed))
        {
            let message = format!("the seed {seed} is given twice");
            problems.add(&elements[position].span, "seeds", message, "keep one");
        }
        return Some(seeds);
    }
    let count = whole(node)?;
    if count == 0 || count > MOST_SEEDS {
        let message = format!("`seeds` is {count}, it must lie between 1 and {MOST_SEEDS}");
        problems.add(
            &node.span,
            "seeds",
            message,
            "a number N stands for the seeds 1 to N",
        );
        return None;
    }
    Some((1..=count).collect())
}

/// What a point took elsewhere, where that is given and sound.
fn published_time(root: &Node, problems: &mut Problems) -> Option<PublishedTime> {
    let node = root.get("published_time")?;
    let time = node.get("is")?;
    let seconds = match &time.value {
        Value::Number(number) => *number,
        Value::Text(text) => units::parse_as(text, Dimension::TIME).ok()?,
        _ => return None,
    };
    if !(seconds > 0.0 && seconds.is_finite()) {
        let message = format!("`published_time` is {seconds} s, it must be above 0");
        problems.add(&time.span, "published_time.is", message, "write a positive time");
    }
    Some(PublishedTime {
        seconds,
        source: node.get("source").map(Node::shown_whole).unwrap_or_default(),
    })
}

fn exclusions(
    root: &Node,
    scenes: &[WrittenScene],
    axes: &[WrittenAxis],
    problems: &mut Problems,
) -> Vec<(Range<usize>, Exclusion)> {
    let mut known: Vec<&str> = vec!["scene"];
    known.extend(axes.iter().map(|axis| axis.axis.name.as_str()));
    let names: Vec<AxisValue> = scenes
        .iter()
        .map(|scene| AxisValue::Word(scene.name.clone()))
        .collect();
    let mut all = Vec::new();
    for (index, entry) in root
        .get("exclude")
        .map(Node::elements)
        .unwrap_or_default()
        .iter()
        .enumerate()
    {
        let before = problems.len();
        let mut exclusion = Vec::new();
        for (key, node) in entry.entries() {
            let field = format!("exclude[{index}].{}", key.name);
            let axis = axes.iter().find(|axis| axis.axis.name == key.name);
            let admitted = match (key.name.as_str(), axis) {
                ("scene", _) => &names,
                (_, Some(axis)) => &axis.axis.values,
                _ => {
                    let message = format!("`{}` is neither `scene` nor an axis", key.name);
                    problems.add(&key.span, &field, message, advice(&key.name, &known));
                    continue;
                }
            };
            let dimension = axis.and_then(|axis| axis.dimension);
            let values = statements::admitted(node, dimension, admitted, &field, problems);
            exclusion.push((key.name.clone(), values));
        }
        if problems.len() == before && !exclusion.is_empty() {
            all.push((entry.span.clone(), exclusion));
        }
    }
    all
}
