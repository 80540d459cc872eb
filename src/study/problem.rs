//! What is wrong with a study file, where, and what to do about it.

use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, NamedSource, SourceCode};

/// Most problems that are written out; the rest is counted.
const MOST_SHOWN: usize = 30;

/// One fault.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// Bytes of the file; `None` when the whole file is meant.
    pub span: Option<Range<usize>>,
    /// Path of the field: `scene.fluid.sph.density`. May be empty.
    pub field: String,
    pub message: String,
    pub help: String,
}

impl Problem {
    pub fn at(span: Range<usize>, field: &str, message: &str, help: &str) -> Problem {
        Problem {
            span: Some(span),
            field: field.to_owned(),
            message: message.to_owned(),
            help: help.to_owned(),
        }
    }

    pub fn of_file(message: &str, help: &str) -> Problem {
        Problem {
            span: None,
            field: String::new(),
            message: message.to_owned(),
            help: help.to_owned(),
        }
    }
}

/// Problems in the order found, none twice.
#[derive(Clone, Debug, Default)]
pub struct Problems(Vec<Problem>);

impl Problems {
    pub fn push(&mut self, problem: Problem) {
        let known = |other: &Problem| other.span == problem.span && other.message == problem.message;
        if !self.0.iter().any(known) {
            self.0.push(problem);
        }
    }

    pub fn add(&mut self, span: &Range<usize>, field: &str, message: impl AsRef<str>, help: impl AsRef<str>) {
        self.push(Problem::at(span.clone(), field, message.as_ref(), help.as_ref()));
    }

    pub fn len(&self) -> usize {
        self.0.len()
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

/// Everything wrong with a study file, all at once, in the order of the file.
#[derive(Clone, Debug)]
pub struct StudyError {
    pub path: PathBuf,
    pub problems: Vec<Problem>,
    text: Arc<str>,
}

impl StudyError {
    pub fn new(path: &Path, text: &str, problems: Problems) -> StudyError {
        let mut problems = problems.0;
        for problem in &mut problems {
            problem.span = problem.span.take().map(|span| on_one_line(text, span));
        }
        problems.sort_by_key(|problem| problem.span.as_ref().map_or(0, |span| span.start));
        StudyError {
            path: path.to_owned(),
            problems,
            text: text.into(),
        }
    }

    /// A fault of the file as a whole.
    pub fn of_file(path: &Path, message: &str, help: &str) -> StudyError {
        let mut problems = Problems::default();
        problems.push(Problem::of_file(message, help));
        StudyError::new(path, "", problems)
    }

    /// Line and column of a problem, both from 1.
    pub fn position(&self, problem: &Problem) -> Option<(usize, usize)> {
        let start = problem.span.as_ref()?.start;
        let before = &self.text[..start];
        let line = 1 + before.matches('\n').count();
        let column = 1 + before.rsplit('\n').next().unwrap_or_default().chars().count();
        Some((line, column))
    }

    /// The underlined text of a problem.
    pub fn excerpt(&self, problem: &Problem) -> &str {
        problem.span.as_ref().map_or("", |span| &self.text[span.clone()])
    }

    /// The text for a terminal of the given width, in colour or without.
    pub fn render(&self, colour: bool, width: usize) -> String {
        let theme = if colour {
            GraphicalTheme::unicode()
        } else {
            GraphicalTheme::unicode_nocolor()
        };
        let handler = GraphicalReportHandler::new_themed(theme)
            .with_width(width.max(40))
            .with_links(false)
            .with_context_lines(1);
        let mut out = String::new();
        for problem in self.problems.iter().take(MOST_SHOWN) {
            let shown = Shown {
                problem,
                source: self.source_of(problem),
            };
            if handler.render_report(&mut out, &shown).is_err() {
                out.push_str(&problem.message);
            }
            out.push('\n');
        }
        let count = self.problems.len();
        let plural = if count == 1 { "error" } else { "errors" };
        let hidden = count.saturating_sub(MOST_SHOWN);
        let rest = if hidden > 0 {
            format!(" ({hidden} not shown)")
        } else {
            String::new()
        };
        out.push_str(&format!("{count} {plural} in {}{rest}", self.path.display()));
        out
    }

    fn source_of(&self, problem: &Problem) -> Option<NamedSource<Arc<str>>> {
        problem.span.as_ref()?;
        Some(NamedSource::new(
            self.path.display().to_string(),
            Arc::clone(&self.text),
        ))
    }
}

impl fmt::Display for StudyError {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        out.write_str(&self.render(false, 110))
    }
}

impl std::error::Error for StudyError {}

impl Diagnostic for StudyError {
    fn source_code(&self) -> Option<&dyn SourceCode> {
        Some(&self.text)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        Some(Box::new(self.problems.iter().filter_map(|problem| {
            let span = problem.span.clone()?;
            Some(LabeledSpan::new_with_span(Some(problem.message.clone()), span))
        })))
    }
}

/// Cuts a span to its first line, so that one line is underlined.
fn on_one_line(text: &str, span: Range<usize>) -> Range<usize> {
    let start = text.floor_char_boundary(span.start);
    let end = text.floor_char_boundary(span.end.max(start));
    let line = text[start..end].lines().next().unwrap_or_default();
    start..start + line.trim_end().len()
}

/// One problem as `miette` draws it.
#[derive(Debug)]
struct Shown<'a> {
    problem: &'a Problem,
    source: Option<NamedSource<Arc<str>>>,
}

impl fmt::Display for Shown<'_> {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        out.write_str(&self.problem.message)
    }
}

impl std::error::Error for Shown<'_> {}

impl Diagnostic for Shown<'_> {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        (!self.problem.help.is_empty()).then(|| Box::new(&self.problem.help) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.source.as_ref().map(|source| source as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let span = self.problem.span.clone()?;
        let field = (!self.problem.field.is_empty()).then(|| self.problem.field.clone());
        Some(Box::new(std::iter::once(LabeledSpan::new_with_span(field, span))))
    }
}
