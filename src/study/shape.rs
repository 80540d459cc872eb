//! Checks the shape of a tree against the schema: every fault, not only the first.

use std::ops::Range;

use serde_json::Value as Schema;

use super::nearest::advice;
use super::problem::Problems;
use super::spec::quantity::{ANYTHING, DIMENSION, ONE_OR_MORE, WORDS};
use super::units::{self, Dimension};
use super::yaml::{Key, Node, Value};

/// The schema of a study file and what can be asked of it.
pub struct Shapes {
    root: Schema,
}

/// One alternative of a choice: a word, or a name with fields.
pub struct Variant<'a> {
    pub name: &'a str,
    pub fields: Option<&'a Schema>,
    /// Whether the name alone will do.
    pub alone: bool,
}

/// Where a node stands: its path, and the key to underline when something is missing from it.
#[derive(Clone)]
pub struct Place {
    pub path: String,
    pub key: Option<Range<usize>>,
    /// What messages call it, where that is not the last name of the path.
    pub called: Option<String>,
}

impl Place {
    pub fn root() -> Place {
        Place {
            path: String::new(),
            key: None,
            called: None,
        }
    }

    pub fn below(&self, name: &str, key: Option<Range<usize>>) -> Place {
        let path = if self.path.is_empty() {
            name.to_owned()
        } else {
            format!("{}.{name}", self.path)
        };
        Place {
            path,
            key,
            called: None,
        }
    }

    fn element(&self, index: usize) -> Place {
        Place {
            path: format!("{}[{index}]", self.path),
            key: None,
            called: None,
        }
    }

    fn name(&self) -> &str {
        let last = self.path.rsplit('.').next().unwrap_or_default();
        let last = last.split('[').next().unwrap_or_default();
        self.called.as_deref().unwrap_or(last)
    }
}

impl Shapes {
    pub fn new() -> Shapes {
        Shapes {
            root: super::spec::schema(),
        }
    }

    pub fn study(&self) -> &Schema {
        &self.root
    }

    /// Schema of a named type.
    pub fn of(&self, name: &str) -> &Schema {
        &self.root["$defs"][name]
    }

    /// Follows references and drops the alternative `null` of an optional field.
    pub fn resolve<'a>(&'a self, schema: &'a Schema) -> &'a Schema {
        if let Some(name) = schema["$ref"]
            .as_str()
            .and_then(|path| path.strip_prefix("#/$defs/"))
        {
            return self.resolve(self.of(name));
        }
        let Some(alternatives) = schema["anyOf"].as_array() else {
            return schema;
        };
        let mut real = alternatives
            .iter()
            .filter(|alternative| alternative["type"] != "null");
        match (real.next(), real.next()) {
            (Some(only), None) => self.resolve(only),
            _ => schema,
        }
    }

    /// Alternatives of a choice; empty for other schemas.
    pub fn variants<'a>(&'a self, schema: &'a Schema) -> Vec<Variant<'a>> {
        let schema = self.resolve(schema);
        let mut variants = Vec::new();
        collect(schema, &mut variants);
        for alternative in schema["oneOf"].as_array().into_iter().flatten() {
            collect(alternative, &mut variants);
        }
        merged(variants)
    }

    /// The node with every name that stands alone in place of its fields given an empty map of them.
    pub fn opened(&self, node: &Node, schema: &Schema) -> Node {
        let schema = self.resolve(schema);
        let mut opened = node.clone();
        let variants = self.variants(schema);
        match &mut opened.value {
            Value::Text(word) => {
                let fielded =
                    |variant: &&Variant| variant.name == word && variant.alone && variant.fields.is_some();
                if variants.iter().any(|variant| fielded(&variant)) {
                    let key = Key {
                        name: word.clone(),
                        span: node.span.clone(),
                    };
                    let fields = Node {
                        span: node.span.clone(),
                        value: Value::Map(Vec::new()),
                    };
                    opened.value = Value::Map(vec![(key, fields)]);
                }
            }
            Value::Map(entries) => {
                for (key, child) in entries {
                    let variant = variants.iter().find(|variant| variant.name == key.name);
                    let below = match variant {
                        Some(variant) => variant.fields,
                        None => self.field(schema, &key.name),
                    };
                    if let Some(below) = below {
                        *child = self.opened(child, below);
                    }
                }
            }
            _ => {}
        }
        opened
    }

    /// Schema of a field of an object.
    pub fn field<'a>(&'a self, schema: &'a Schema, name: &str) -> Option<&'a Schema> {
        self.resolve(schema)["properties"].get(name)
    }

    /// Names of the fields of an object.
    pub fn fields<'a>(&'a self, schema: &'a Schema) -> Vec<&'a str> {
        let properties = self.resolve(schema)["properties"].as_object();
        properties
            .into_iter()
            .flatten()
            .map(|(name, _)| name.as_str())
            .collect()
    }

    /// Dimension of a quantity.
    pub fn dimension(&self, schema: &Schema) -> Option<Dimension> {
        Dimension::named(self.resolve(schema)[DIMENSION].as_str()?)
    }

    /// Reports whatever in `node` departs from `schema`.
    pub fn check(&self, node: &Node, schema: &Schema, place: &Place, problems: &mut Problems) {
        let schema = self.resolve(schema);
        if let Value::Null = node.value {
            let span = place.key.clone().unwrap_or(node.span.clone());
            let message = format!("`{}` has no value", place.name());
            return problems.add(&span, &place.path, message, "write one, or remove the key");
        }
        if schema.get(ANYTHING).is_some() {
            return;
        }
        if schema.get(DIMENSION).is_some() {
            return self.check_quantity(node, schema, place, problems);
        }
        if let Some(element) = schema.get(ONE_OR_MORE) {
            if let Value::List(_) = node.value {
                return self.check_list(node, element, place, problems);
            }
            return self.check(node, element, place, problems);
        }
        let variants = self.variants(schema);
        if !variants.is_empty() {
            return self.check_choice(node, &variants, place, problems);
        }
        match (only_type(schema), &node.value) {
            (Some("object"), Value::Map(_)) => self.check_object(node, schema, place, problems),
            (Some("array"), Value::List(_)) => self.check_elements(node, &schema["items"], place, problems),
            _ => check_scalar(node, schema, place, problems),
        }
    }

    fn check_list(&self, node: &Node, element: &Schema, place: &Place, problems: &mut Problems) {
        if node.elements().is_empty() {
            let message = format!("the list `{}` is empty", place.name());
            problems.add(&node.span, &place.path, message, "give at least one element");
        }
        self.check_elements(node, element, place, problems);
    }

    fn check_elements(&self, node: &Node, element: &Schema, place: &Place, problems: &mut Problems) {
        for (index, child) in node.elements().iter().enumerate() {
            self.check(child, element, &place.element(index), problems);
        }
    }

    fn check_object(&self, node: &Node, schema: &Schema, place: &Place, problems: &mut Problems) {
        let known = self.fields(schema);
        for (key, child) in node.entries() {
            let below = place.below(&key.name, Some(key.span.clone()));
            let field = self.field(schema, &key.name).or(schema["additionalProperties"]
                .as_object()
                .map(|_| &schema["additionalProperties"]));
            match field {
                Some(field) => self.check(child, field, &below, problems),
                None => {
                    let message = format!("unknown key `{}`", key.name);
                    problems.add(&key.span, &below.path, message, advice(&key.name, &known));
                }
            }
        }
        let required = schema["required"].as_array().into_iter().flatten();
        for name in required
            .filter_map(Schema::as_str)
            .filter(|name| node.get(name).is_none())
        {
            let span = place.key.clone().unwrap_or(node.span.clone());
            let holder = if place.path.is_empty() {
                "the study"
            } else {
                place.name()
            };
            let message = format!("`{name}` is missing from {}", quoted(holder));
            problems.add(
                &span,
                &place.below(name, None).path,
                message,
                self.suggestion(schema, name),
            );
        }
    }

    /// What to write for a missing field.
    fn suggestion(&self, schema: &Schema, name: &str) -> String {
        let field = self.field(schema, name).map(|field| self.resolve(field));
        let variants = field.map(|field| self.variants(field)).unwrap_or_default();
        if !variants.is_empty() {
            let names: Vec<&str> = variants.iter().map(|variant| variant.name).collect();
            return format!("add `{name}:` with one of {}", names.join(", "));
        }
        match field.and_then(|field| self.dimension(field)) {
            Some(dimension) => format!("add `{name}:` with {dimension}"),
            None => format!("add `{name}:`"),
        }
    }

    fn check_choice(&self, node: &Node, variants: &[Variant], place: &Place, problems: &mut Problems) {
        let names: Vec<&str> = variants.iter().map(|variant| variant.name).collect();
        match &node.value {
            Value::Text(word) => match variants.iter().find(|variant| variant.name == word) {
                Some(Variant { alone: true, .. }) => {}
                Some(_) => {
                    let message = format!("`{word}` needs its fields");
                    problems.add(&node.span, &place.path, message, format!("write `{word}: {{…}}`"));
                }
                None => {
                    let message = format!("`{word}` is not a value of `{}`", place.name());
                    problems.add(&node.span, &place.path, message, advice(word, &names));
                }
            },
            Value::Map(entries) if entries.len() == 1 => {
                let (key, child) = &entries[0];
                let below = place.below(&key.name, Some(key.span.clone()));
                match variants.iter().find(|variant| variant.name == key.name) {
                    Some(Variant {
                        fields: Some(fields), ..
                    }) => self.check(child, fields, &below, problems),
                    Some(_) => {
                        let message = format!("`{}` takes no fields", key.name);
                        problems.add(
                            &key.span,
                            &below.path,
                            message,
                            format!("write `{}` alone", key.name),
                        );
                    }
                    None => {
                        let message = format!("unknown name `{}` in `{}`", key.name, place.name());
                        problems.add(&key.span, &below.path, message, advice(&key.name, &names));
                    }
                }
            }
            Value::Map(entries) => {
                let second = entries.get(1).map(|(key, _)| key.span.clone());
                let span = second.or(place.key.clone()).unwrap_or(node.span.clone());
                let message = format!(
                    "`{}` takes exactly one name, {} are given",
                    place.name(),
                    entries.len()
                );
                let help = format!(
                    "keep one of its names; indent what belongs to it. Known: {}",
                    names.join(", ")
                );
                problems.add(&span, &place.path, message, help);
            }
            _ => {
                let message = format!("`{}` cannot be {}", place.name(), node.kind());
                problems.add(
                    &node.span,
                    &place.path,
                    message,
                    format!("write one of {}", names.join(", ")),
                );
            }
        }
    }

    fn check_quantity(&self, node: &Node, schema: &Schema, place: &Place, problems: &mut Problems) {
        let wanted = self.dimension(schema);
        let words: Vec<&str> = schema[WORDS]
            .as_array()
            .into_iter()
            .flatten()
            .filter_map(Schema::as_str)
            .collect();
        let fault = match &node.value {
            Value::Number(_) => return,
            Value::Text(text) if words.contains(&text.as_str()) => return,
            Value::Text(text) => match wanted {
                Some(dimension) => units::parse_as(text, dimension).err(),
                None => units::parse(text).err(),
            },
            _ => Some(format!("`{}` cannot be {}", place.name(), node.kind())),
        };
        let Some(message) = fault else { return };
        let mut help = match wanted {
            Some(Dimension::NONE) => "write a number, or one with %".to_owned(),
            Some(dimension) => format!(
                "write a number in {0}, or one with a unit such as `1 {0}`",
                dimension.unit()
            ),
            None => "write a number in SI units, or one with its unit".to_owned(),
        };
        if !words.is_empty() {
            help.push_str(&format!("; or {}", words.join(", ")));
        }
        problems.add(&node.span, &place.path, message, help);
    }
}

/// One variant per name: a name that is a word and has fields may do without them.
fn merged(variants: Vec<Variant>) -> Vec<Variant> {
    let mut merged: Vec<Variant> = Vec::new();
    for variant in variants {
        match merged.iter_mut().find(|other| other.name == variant.name) {
            Some(other) => {
                other.fields = other.fields.or(variant.fields);
                other.alone |= variant.alone;
            }
            None => merged.push(variant),
        }
    }
    merged
}

fn collect<'a>(schema: &'a Schema, variants: &mut Vec<Variant<'a>>) {
    let words = schema["enum"]
        .as_array()
        .into_iter()
        .flatten()
        .chain(schema.get("const"));
    variants.extend(words.filter_map(Schema::as_str).map(|name| Variant {
        name,
        fields: None,
        alone: true,
    }));
    // A variant with fields is an object with exactly one property, which is required.
    let closed =
        schema["additionalProperties"] == false && schema["required"].as_array().map(Vec::len) == Some(1);
    if let (true, Some(properties)) = (closed, schema["properties"].as_object()) {
        variants.extend(
            properties
                .iter()
                .take(usize::from(properties.len() == 1))
                .map(|(name, fields)| Variant {
                    name,
                    fields: Some(fields),
                    alone: false,
                }),
        );
    }
}

/// The type of a schema; `null` beside it means only that the field is optional.
fn only_type(schema: &Schema) -> Option<&str> {
    let types = schema["type"].as_array();
    let listed = types
        .into_iter()
        .flatten()
        .filter_map(Schema::as_str)
        .find(|name| *name != "null");
    schema["type"].as_str().or(listed)
}

fn check_scalar(node: &Node, schema: &Schema, place: &Place, problems: &mut Problems) {
    let wanted = match (&schema["type"], only_type(schema)) {
        (Schema::Array(types), _) if types.len() == 3 => "any",
        (_, Some(wanted)) => wanted,
        _ => "any",
    };
    let whole = |number: f64, bits: i32| number.fract() == 0.0 && number >= 0.0 && number < 2f64.powi(bits);
    let bits = if schema["format"] == "uint32" { 32 } else { 53 };
    let (holds, name) = match (wanted, &node.value) {
        ("string", Value::Text(text)) => (!text.trim().is_empty(), "text that is not empty"),
        ("string", _) => (false, "text"),
        ("boolean", value) => (matches!(value, Value::Flag(_)), "`true` or `false`"),
        ("integer", Value::Number(number)) => (whole(*number, bits), "a whole number from 0"),
        ("integer", _) => (false, "a whole number"),
        ("number", value) => (matches!(value, Value::Number(_)), "a number"),
        ("object", value) => (matches!(value, Value::Map(_)), "a map of `name: value`"),
        ("array", value) => (matches!(value, Value::List(_)), "a list: `[a, b]`"),
        (_, value) => (
            !matches!(value, Value::List(_) | Value::Map(_)),
            "a number, a word or a quantity",
        ),
    };
    if holds {
        return;
    }
    let holder = if place.path.is_empty() {
        "the study"
    } else {
        place.name()
    };
    let message = format!("{} cannot be {}", quoted(holder), scalar_shown(node));
    problems.add(&node.span, &place.path, message, format!("write {name}"));
}

fn scalar_shown(node: &Node) -> String {
    match node.value {
        Value::List(_) | Value::Map(_) => node.kind().to_owned(),
        Value::Text(_) => format!("the text `{}`", node.shown()),
        _ => format!("`{}`", node.shown()),
    }
}

fn quoted(name: &str) -> String {
    if name.contains(' ') {
        name.to_owned()
    } else {
        format!("`{name}`")
    }
}
