//! The only place that knows YAML: text becomes a tree in which everything has its position.
//!
//! Scalars are resolved strictly: only `true` and `false` are flags, numbers are decimal, the rest
//! is text. Aliases are expanded within a budget, so that a nested-alias bomb ends in an error.

use std::collections::BTreeMap;
use std::ops::Range;

use serde_saphyr::granit_parser::{Event, Parser, ScalarStyle, Span};

use super::problem::{Problem, Problems};

/// Most nodes that a study file may have, aliases expanded.
const MOST_NODES: usize = 20_000;
/// Deepest nesting.
const DEEPEST: usize = 48;

/// A value with the bytes it stands at.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    pub span: Range<usize>,
    pub value: Value,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    Null,
    Flag(bool),
    Number(f64),
    Text(String),
    List(Vec<Node>),
    Map(Vec<(Key, Node)>),
}

#[derive(Clone, Debug, PartialEq)]
pub struct Key {
    pub name: String,
    pub span: Range<usize>,
}

impl Node {
    pub fn get(&self, name: &str) -> Option<&Node> {
        self.entry(name).map(|(_, node)| node)
    }

    pub fn entry(&self, name: &str) -> Option<&(Key, Node)> {
        self.entries().iter().find(|(key, _)| key.name == name)
    }

    /// Entries of a map; nothing for other values.
    pub fn entries(&self) -> &[(Key, Node)] {
        match &self.value {
            Value::Map(entries) => entries,
            _ => &[],
        }
    }

    /// Elements of a list; nothing for other values.
    pub fn elements(&self) -> &[Node] {
        match &self.value {
            Value::List(elements) => elements,
            _ => &[],
        }
    }

    /// "a number", "text": for messages.
    pub fn kind(&self) -> &'static str {
        match self.value {
            Value::Null => "nothing",
            Value::Flag(_) => "true or false",
            Value::Number(_) => "a number",
            Value::Text(_) => "text",
            Value::List(_) => "a list",
            Value::Map(_) => "a map",
        }
    }

    /// A scalar as it may be quoted in a message.
    pub fn shown(&self) -> String {
        match &self.value {
            Value::Flag(flag) => flag.to_string(),
            Value::Number(number) => number.to_string(),
            Value::Text(text) => text.chars().take(60).collect(),
            _ => self.kind().to_owned(),
        }
    }

    /// Text in full, whatever its length.
    pub fn shown_whole(&self) -> String {
        match &self.value {
            Value::Text(text) => text.trim().to_owned(),
            _ => self.shown(),
        }
    }

    /// Plain data without positions.
    pub fn json(&self) -> serde_json::Value {
        match &self.value {
            Value::Null => serde_json::Value::Null,
            Value::Flag(flag) => (*flag).into(),
            Value::Number(number) if number.fract() == 0.0 && number.abs() < 9e15 => (*number as i64).into(),
            Value::Number(number) => (*number).into(),
            Value::Text(text) => text.clone().into(),
            Value::List(elements) => elements.iter().map(Node::json).collect(),
            Value::Map(entries) => entries
                .iter()
                .map(|(key, node)| (key.name.clone(), node.json()))
                .collect::<serde_json::Map<_, _>>()
                .into(),
        }
    }

    fn size(&self) -> usize {
        1 + self.elements().iter().map(Node::size).sum::<usize>()
            + self.entries().iter().map(|(_, node)| node.size()).sum::<usize>()
    }
}

/// The tree of the one document in a file. Repeated keys are reported and the first is kept.
///
/// `None` when the text is no YAML, or has no or several documents; `problems` then says why.
pub fn parse(text: &str, problems: &mut Problems) -> Option<Node> {
    let mut builder = Builder {
        events: Parser::new_from_str(text),
        text,
        anchors: BTreeMap::new(),
        nodes: 0,
        problems,
    };
    match builder.document() {
        Ok(node) => node,
        Err(problem) => {
            builder.problems.push(*problem);
            None
        }
    }
}

type Failed = Box<Problem>;

struct Builder<'text, 'problems> {
    events: Parser<'text, serde_saphyr::granit_parser::StrInput<'text>>,
    text: &'text str,
    anchors: BTreeMap<usize, Node>,
    nodes: usize,
    problems: &'problems mut Problems,
}

impl<'text> Builder<'text, '_> {
    fn document(&mut self) -> Result<Option<Node>, Failed> {
        let mut document = None;
        loop {
            let (event, range) = self.next()?;
            match event {
                Event::StreamEnd => break,
                Event::StreamStart | Event::DocumentEnd => {}
                Event::DocumentStart(..) if document.is_some() => {
                    return Err(self.fault(
                        range,
                        "a second document begins here",
                        "one study, one file: move it to its own",
                    ));
                }
                Event::DocumentStart(..) => {
                    let (event, range) = self.next()?;
                    document = Some(self.node(event, range, 0)?);
                }
                _ => return Err(self.fault(range, "something stands outside the document", "remove it")),
            }
        }
        let empty = matches!(
            document,
            None | Some(Node {
                value: Value::Null,
                ..
            })
        );
        if empty {
            self.problems.push(Problem::of_file(
                "the file is empty",
                "a study begins with `question:`",
            ));
            return Ok(None);
        }
        Ok(document)
    }

    fn next(&mut self) -> Result<(Event<'text>, Range<usize>), Failed> {
        loop {
            match self.events.next() {
                None => return Ok((Event::StreamEnd, self.text.len()..self.text.len())),
                Some(Ok((Event::Comment(..), _))) => {}
                Some(Ok((event, span))) => return Ok((event, self.range(&span))),
                Some(Err(error)) => {
                    let at = error
                        .marker()
                        .byte_offset()
                        .unwrap_or_else(|| self.byte(error.marker().index()));
                    let at = self.text.floor_char_boundary(at);
                    let end = self.text[at..]
                        .chars()
                        .next()
                        .map_or(at, |letter| at + letter.len_utf8());
                    let message = format!("this is not YAML: {}", error.info());
                    return Err(self.fault(at..end, &message, self.hint(at)));
                }
            }
        }
    }

    /// The commonest reason for unreadable YAML is a tab in the indentation.
    fn hint(&self, at: usize) -> &'static str {
        let from = self.text[..at].rfind('\n').map_or(0, |newline| newline + 1);
        let to = self.text[at..]
            .find('\n')
            .map_or(self.text.len(), |newline| at + newline);
        if self.text[from..to].contains('\t') {
            "a tab stands in this line: indent with spaces"
        } else {
            "look for a missing bracket, quote, colon or a wrong indentation here or just above"
        }
    }

    fn node(&mut self, event: Event<'text>, range: Range<usize>, depth: usize) -> Result<Node, Failed> {
        self.count(1, &range)?;
        if depth > DEEPEST {
            return Err(self.fault(
                range,
                "the file is nested too deeply",
                "a study needs no more than ten levels",
            ));
        }
        let (node, anchor) = match event {
            Event::Scalar(text, style, anchor, tag) => {
                if tag.is_some() {
                    let problem = self.fault(
                        range.clone(),
                        "tags (`!…`) mean nothing in a study",
                        "remove the tag",
                    );
                    self.problems.push(*problem);
                }
                let value = match style {
                    ScalarStyle::Plain => plain(&text),
                    _ => Value::Text(text.into_owned()),
                };
                (Node { span: range, value }, anchor)
            }
            Event::SequenceStart(_, anchor, _) => (self.list(range, depth)?, anchor),
            Event::MappingStart(_, anchor, _) => (self.map(range, depth)?, anchor),
            Event::Alias(anchor) => {
                let Some(node) = self.anchors.get(&anchor).cloned() else {
                    return Err(self.fault(range, "an alias refers to itself", "write the value out"));
                };
                self.count(node.size(), &range)?;
                (node, 0)
            }
            _ => return Err(self.fault(range, "a value is missing here", "write one")),
        };
        if anchor > 0 {
            self.anchors.insert(anchor, node.clone());
        }
        Ok(node)
    }

    fn list(&mut self, start: Range<usize>, depth: usize) -> Result<Node, Failed> {
        let mut elements = Vec::new();
        loop {
            let (event, range) = self.next()?;
            if matches!(event, Event::SequenceEnd) {
                let span = start.start..range.end.max(start.end);
                return Ok(Node {
                    span,
                    value: Value::List(elements),
                });
            }
            elements.push(self.node(event, range, depth + 1)?);
        }
    }

    fn map(&mut self, start: Range<usize>, depth: usize) -> Result<Node, Failed> {
        let mut entries: Vec<(Key, Node)> = Vec::new();
        loop {
            let (event, range) = self.next()?;
            if matches!(event, Event::MappingEnd) {
                let span = start.start..range.end.max(start.end);
                return Ok(Node {
                    span,
                    value: Value::Map(entries),
                });
            }
            let Event::Scalar(name, ..) = event else {
                return Err(self.fault(range, "a key must be a word", "write `name: value`"));
            };
            let key = Key {
                name: name.into_owned(),
                span: range,
            };
            let (event, range) = self.next()?;
            let value = self.node(event, range, depth + 1)?;
            if let Some((first, _)) = entries.iter().find(|(other, _)| other.name == key.name) {
                let line = 1 + self.text[..first.span.start].matches('\n').count();
                let message = format!("`{}` is given twice", key.name);
                let problem = self.fault(
                    key.span,
                    &message,
                    &format!("it already stands in line {line}: keep one"),
                );
                self.problems.push(*problem);
            } else {
                entries.push((key, value));
            }
        }
    }

    fn count(&mut self, more: usize, at: &Range<usize>) -> Result<(), Failed> {
        self.nodes += more;
        if self.nodes <= MOST_NODES {
            return Ok(());
        }
        let message = format!("the file holds more than {MOST_NODES} values");
        Err(self.fault(
            at.clone(),
            &message,
            "a study needs a few hundred; aliases count each time they are used",
        ))
    }

    fn fault(&self, range: Range<usize>, message: &str, help: &str) -> Failed {
        Box::new(Problem::at(range, "", message, help))
    }

    fn range(&self, span: &Span) -> Range<usize> {
        span.byte_range()
            .unwrap_or_else(|| self.byte(span.start.index())..self.byte(span.end.index()))
    }

    fn byte(&self, character: usize) -> usize {
        self.text
            .char_indices()
            .nth(character)
            .map_or(self.text.len(), |(byte, _)| byte)
    }
}

fn plain(text: &str) -> Value {
    match text {
        "" | "~" | "null" | "Null" | "NULL" => return Value::Null,
        "true" => return Value::Flag(true),
        "false" => return Value::Flag(false),
        _ => {}
    }
    let numeric = text.starts_with(|first: char| first.is_ascii_digit() || "+-.".contains(first))
        && text
            .chars()
            .all(|letter| letter.is_ascii_digit() || "+-.eE".contains(letter));
    match text.parse::<f64>() {
        Ok(number) if numeric && number.is_finite() => Value::Number(number),
        _ => Value::Text(text.to_owned()),
    }
}
