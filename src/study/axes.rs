//! Axes: where their paths lead in each scene, and their values in SI units.

use std::collections::BTreeMap;
use std::ops::Range;

use serde_json::Value as Schema;

use super::model::{Axis, AxisValue};
use super::nearest::advice;
use super::path::bind;
use super::problem::Problems;
use super::shape::{Place, Shapes};
use super::units::{self, Dimension};
use super::yaml::{Key, Node, Value};

/// A scene as written, with its place in the file.
pub struct WrittenScene {
    pub name: String,
    /// `scene`, or `scenes.NAME`.
    pub path: String,
    pub key: Range<usize>,
    /// `{kind: {fields}}`.
    pub node: Node,
}

/// An axis with everything needed to apply it.
pub struct WrittenAxis {
    pub axis: Axis,
    pub span: Range<usize>,
    /// One node per value.
    pub nodes: Vec<Node>,
    /// Scene name and path from its kind downwards; an axis may act at several places.
    pub bindings: Vec<(String, Vec<String>)>,
    pub dimension: Option<Dimension>,
    /// Position of the axis that it moves along with; its own when it moves alone.
    pub leader: usize,
}

/// Reads `vary`. `None` when an axis is at fault: no plan can then be made.
pub fn read(
    root: &Node,
    scenes: &[WrittenScene],
    shapes: &Shapes,
    problems: &mut Problems,
) -> Option<Vec<WrittenAxis>> {
    let before = problems.len();
    let mut axes = Vec::new();
    for (key, node) in root.get("vary").map(Node::entries).unwrap_or_default() {
        axes.extend(one(key, node, scenes, shapes, problems));
    }
    if problems.len() > before {
        return None;
    }
    link(root, &mut axes, problems);
    (problems.len() == before).then_some(axes)
}

fn one(
    key: &Key,
    node: &Node,
    scenes: &[WrittenScene],
    shapes: &Shapes,
    problems: &mut Problems,
) -> Option<WrittenAxis> {
    let field = format!("vary.{}", key.name);
    check_name(key, &field, problems);
    let mut bindings = Vec::new();
    let mut target = None;
    let paths = node.get("path")?;
    let written = std::slice::from_ref(paths);
    let written = if paths.elements().is_empty() {
        written
    } else {
        paths.elements()
    };
    for path in written {
        let Value::Text(text) = &path.value else { continue };
        match bind_everywhere(text, scenes, shapes) {
            Ok(found) => {
                for (scene, path, schema) in found {
                    target = Some(schema);
                    bindings.push((scene, path));
                }
            }
            Err((message, help)) => problems.add(&path.span, &format!("{field}.path"), message, help),
        }
    }
    let schema = target?;
    let nodes = node.get("values")?.elements().to_vec();
    if nodes.is_empty() {
        let message = format!("the axis `{}` has no values", key.name);
        problems.add(
            &node.get("values")?.span,
            &format!("{field}.values"),
            message,
            "give at least one",
        );
    }
    for (index, value) in nodes.iter().enumerate() {
        check_value(
            value,
            schema,
            &format!("{field}.values[{index}]"),
            shapes,
            problems,
        );
    }
    let dimension = shapes.dimension(schema);
    let values: Vec<AxisValue> = nodes.iter().map(|value| si_value(value, dimension)).collect();
    let mut names: Vec<String> = bindings.iter().map(|(scene, _)| scene.clone()).collect();
    names.dedup();
    let axis = Axis {
        name: key.name.clone(),
        unit: unit(&values, dimension),
        values,
        scenes: names,
    };
    Some(WrittenAxis {
        axis,
        span: key.span.clone(),
        nodes,
        bindings,
        dimension,
        leader: 0,
    })
}

pub fn unit(values: &[AxisValue], dimension: Option<Dimension>) -> String {
    match (dimension, values.first()) {
        (Some(dimension), _) => dimension.unit(),
        (None, Some(AxisValue::Number(_))) => "1".to_owned(),
        _ => String::new(),
    }
}

fn check_name(key: &Key, field: &str, problems: &mut Problems) {
    if ["scene", "seed"].contains(&key.name.as_str()) {
        let message = format!("an axis cannot be called `{}`", key.name);
        problems.add(
            &key.span,
            field,
            message,
            "the name has its own meaning; choose another",
        );
    } else if !is_name(&key.name) {
        let message = format!("`{}` is not a name", key.name);
        problems.add(
            &key.span,
            field,
            message,
            "use small letters, digits and _, beginning with a letter",
        );
    }
}

/// Names become columns, folders and fields: small letters, digits and underscores.
pub fn is_name(text: &str) -> bool {
    text.starts_with(|first: char| first.is_ascii_lowercase())
        && text.len() <= 60
        && text
            .chars()
            .all(|letter| letter.is_ascii_lowercase() || letter.is_ascii_digit() || letter == '_')
}

pub type Bindings<'a> = Vec<(String, Vec<String>, &'a Schema)>;

pub fn bind_everywhere<'a>(
    text: &str,
    scenes: &[WrittenScene],
    shapes: &'a Shapes,
) -> Result<Bindings<'a>, (String, String)> {
    let segments: Vec<&str> = text.split('.').collect();
    let (candidates, rest): (Vec<&WrittenScene>, &[&str]) = match segments.as_slice() {
        ["scene", rest @ ..] => (scenes.iter().collect(), rest),
        ["scenes", name, rest @ ..] => {
            let Some(scene) = scenes.iter().find(|scene| scene.name == *name) else {
                let names: Vec<&str> = scenes.iter().map(|scene| scene.name.as_str()).collect();
                return Err((format!("there is no scene `{name}`"), advice(name, &names)));
            };
            (vec![scene], rest)
        }
        _ => {
            let message = format!("the path `{text}` leads nowhere");
            return Err((
                message,
                "a path begins with `scene.` or `scenes.NAME.`".to_owned(),
            ));
        }
    };
    if rest.is_empty() {
        return Err((
            format!("the path `{text}` names a whole scene"),
            "name a field of it".to_owned(),
        ));
    }
    let mut found = Vec::new();
    let mut misses = Vec::new();
    for scene in candidates {
        match bind(shapes, &scene.node, rest) {
            Ok((path, schema)) => found.push((scene.name.clone(), path, schema)),
            Err(miss) => misses.push(miss),
        }
    }
    let nearest = misses.into_iter().max_by_key(|miss| miss.depth);
    match (found.is_empty(), nearest) {
        (true, Some(miss)) => {
            let known: Vec<&str> = miss.known.iter().map(String::as_str).collect();
            let message = format!(
                "the path binds in no scene: `{}` has no `{}`",
                miss.holder, miss.segment
            );
            let help = if miss.unwritten {
                format!(
                    "write `{}: {{{}: {{…}}}}` in the scene",
                    miss.holder, miss.segment
                )
            } else {
                advice(&miss.segment, &known)
            };
            Err((message, help))
        }
        (true, None) => Err((
            "the path binds in no scene".to_owned(),
            "the study has no scene".to_owned(),
        )),
        _ => Ok(found),
    }
}

/// Checks a value against the field it goes to. A word for a choice with fields is checked at the
/// point, once the fields it shares are known.
fn check_value(value: &Node, schema: &Schema, field: &str, shapes: &Shapes, problems: &mut Problems) {
    let name = field.split('.').nth(1).unwrap_or_default();
    let variants = shapes.variants(schema);
    let word = matches!(&value.value, Value::Text(word)
        if variants.iter().any(|variant| variant.name == word && variant.fields.is_some()));
    if !word {
        let key = matches!(value.value, Value::Null).then(|| value.span.clone());
        shapes.check(
            value,
            schema,
            &Place {
                path: field.to_owned(),
                key,
                called: Some(name.to_owned()),
            },
            problems,
        );
    }
}

/// A value in SI units; a choice with fields is known by its name.
pub fn si_value(node: &Node, dimension: Option<Dimension>) -> AxisValue {
    match &node.value {
        Value::Number(number) => AxisValue::Number(*number),
        Value::Flag(flag) => AxisValue::Flag(*flag),
        Value::Text(text) => match dimension.map(|dimension| units::parse_as(text, dimension)) {
            Some(Ok(number)) => AxisValue::Number(number),
            _ => AxisValue::Word(text.clone()),
        },
        _ => AxisValue::Word(
            node.entries()
                .first()
                .map(|(key, _)| key.name.clone())
                .unwrap_or_default(),
        ),
    }
}

/// Resolves `with`, and refuses repeated values on an axis of its own.
fn link(root: &Node, axes: &mut [WrittenAxis], problems: &mut Problems) {
    let positions: BTreeMap<String, usize> = axes
        .iter()
        .enumerate()
        .map(|(position, axis)| (axis.axis.name.clone(), position))
        .collect();
    let names: Vec<String> = axes.iter().map(|axis| axis.axis.name.clone()).collect();
    let partner = |name: &str| root.get("vary")?.get(name)?.get("with");
    for (position, name) in names.iter().enumerate() {
        let Some(with) = partner(name) else {
            axes[position].leader = position;
            refuse_repeats(&axes[position], problems);
            continue;
        };
        let field = format!("vary.{name}.with");
        let leader = with.shown();
        match positions.get(&leader) {
            None => {
                let others: Vec<&str> = names
                    .iter()
                    .filter(|other| *other != name)
                    .map(String::as_str)
                    .collect();
                problems.add(
                    &with.span,
                    &field,
                    format!("there is no axis `{leader}`"),
                    advice(&leader, &others),
                );
            }
            Some(_) if partner(&leader).is_some() || leader == *name => {
                let message = format!("`{leader}` does not move on its own");
                problems.add(&with.span, &field, message, "name the axis that leads");
            }
            Some(found) if axes[*found].nodes.len() != axes[position].nodes.len() => {
                let message = format!(
                    "`{name}` has {} values, `{leader}` has {}",
                    axes[position].nodes.len(),
                    axes[*found].nodes.len()
                );
                problems.add(
                    &axes[position].span,
                    &field,
                    message,
                    "axes that move together need equally many",
                );
            }
            Some(found) => axes[position].leader = *found,
        }
    }
}

fn refuse_repeats(axis: &WrittenAxis, problems: &mut Problems) {
    for (position, node) in axis.nodes.iter().enumerate() {
        // Two maps with one name may differ in their fields.
        let scalar = node.entries().is_empty();
        if scalar && axis.axis.values[..position].contains(&axis.axis.values[position]) {
            let message = format!("the axis `{}` takes {} twice", axis.axis.name, node.shown());
            let field = format!("vary.{}.values[{position}]", axis.axis.name);
            problems.add(&node.span, &field, message, "keep one");
        }
    }
}
