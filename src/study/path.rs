//! Paths inside a scene: following them, and putting a value at their end.

use serde_json::Value as Schema;

use super::shape::Shapes;
use super::yaml::{Key, Node, Value};

/// Where a path breaks off.
#[derive(Debug)]
pub struct Miss {
    pub segment: String,
    pub holder: String,
    pub known: Vec<String>,
    /// How many segments were good.
    pub depth: usize,
    /// The segment is a choice that the scene leaves to its default.
    pub unwritten: bool,
}

/// Follows a path from the kind of a scene downwards. The kind may be left out.
/// Fields that the scene leaves to their defaults exist too.
pub fn bind<'a>(
    shapes: &'a Shapes,
    scene: &Node,
    segments: &[&str],
) -> Result<(Vec<String>, &'a Schema), Miss> {
    let mut schema = shapes.of("SceneSpec");
    let mut node = Some(scene);
    let mut path: Vec<String> = Vec::new();
    let mut rest = segments;
    loop {
        let variants = shapes.variants(schema);
        let chosen = node.and_then(|node| node.entries().first());
        let Some(segment) = rest.first() else {
            return Ok((path, schema));
        };
        let holder = path.last().cloned().unwrap_or_else(|| "scene".to_owned());
        let depth = segments.len() - rest.len();
        let miss = |known: Vec<&str>| Miss {
            segment: (*segment).to_owned(),
            holder,
            known: known.into_iter().map(str::to_owned).collect(),
            depth,
            unwritten: chosen.is_none() && variants.iter().any(|variant| variant.name == *segment),
        };
        if variants.is_empty() {
            let Some(field) = shapes.field(schema, segment) else {
                return Err(miss(shapes.fields(schema)));
            };
            node = node.and_then(|node| node.get(segment));
            schema = field;
        } else {
            let kind = chosen.map(|(key, _)| key.name.as_str());
            let implicit = path.is_empty() && !variants.iter().any(|variant| variant.name == *segment);
            let name = if implicit { kind } else { Some(*segment) };
            let fields = variants
                .iter()
                .find(|variant| Some(variant.name) == name)
                .and_then(|found| found.fields);
            let (Some(name), Some(fields), true) = (name, fields, name == kind) else {
                return Err(miss(kind.into_iter().collect()));
            };
            node = chosen.map(|(_, child)| child);
            schema = fields;
            path.push(name.to_owned());
            if implicit {
                continue;
            }
            rest = &rest[1..];
            continue;
        }
        path.push((*segment).to_owned());
        rest = &rest[1..];
    }
}

/// Puts a value at a path below a scene. Fields left to their defaults are made.
pub fn put(scene: &mut Node, path: &[String], value: &Node, shapes: &Shapes, schema: &Schema) {
    let Some((name, rest)) = path.split_first() else {
        *scene = with_shared_fields(scene, value, shapes, schema);
        return;
    };
    let Value::Map(entries) = &mut scene.value else {
        return;
    };
    let position = entries.iter().position(|(key, _)| key.name == *name);
    let position = position.unwrap_or_else(|| {
        let key = Key {
            name: name.clone(),
            span: value.span.clone(),
        };
        entries.push((
            key,
            Node {
                span: value.span.clone(),
                value: Value::Map(Vec::new()),
            },
        ));
        entries.len() - 1
    });
    if rest.is_empty() {
        entries[position].0.span = value.span.clone();
    }
    put(&mut entries[position].1, rest, value, shapes, schema);
}

/// A word for a choice with fields takes over the fields that both choices have.
fn with_shared_fields(old: &Node, value: &Node, shapes: &Shapes, schema: &Schema) -> Node {
    let variants = shapes.variants(schema);
    let Value::Text(word) = &value.value else {
        return value.clone();
    };
    let Some(fields) = variants
        .iter()
        .find(|variant| variant.name == word)
        .and_then(|found| found.fields)
    else {
        return value.clone();
    };
    let known = shapes.fields(fields);
    let shared = old
        .entries()
        .first()
        .map(|(_, old)| old.entries())
        .unwrap_or_default();
    let shared = shared
        .iter()
        .filter(|(key, _)| known.contains(&key.name.as_str()))
        .cloned()
        .collect();
    let key = Key {
        name: word.clone(),
        span: value.span.clone(),
    };
    let inner = Node {
        span: value.span.clone(),
        value: Value::Map(shared),
    };
    Node {
        span: value.span.clone(),
        value: Value::Map(vec![(key, inner)]),
    }
}
