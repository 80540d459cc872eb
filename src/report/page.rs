//! What the templates show: every number already in words.

use minijinja::syntax::SyntaxConfig;
use minijinja::value::Serde;
use minijinja::{Environment, Value, context};
use serde::Serialize;

use super::calibrated::{self, CalibratedRow};
use super::cost::{self, Cost};
use super::facts::{self, Facts};
use super::figure::{Plate, Table};
use super::table::{self, Effort};
use super::{ReportError, format, selection, verdict_row};
use crate::judge::model::{Outcome, Verdict};
use crate::judge::select::answers_by_diverging;
use crate::store::model::{Run, Status};
use crate::study::model::{Figure, Study};

/// Rows of a figure's table that a page shows; the file beside it holds all of them.
const SHOWN_ROWS: usize = 60;

#[derive(Serialize)]
pub struct Page {
    study: String,
    question: String,
    exploratory: bool,
    overall: Overall,
    counts: Counts,
    facts: Facts,
    calibrated: Vec<CalibratedRow>,
    verdicts: Vec<verdict_row::VerdictRow>,
    failures: Vec<Failure>,
    figures: Vec<FigureBlock>,
    cost: Option<Cost>,
    work_head: Vec<String>,
    work: Vec<Vec<String>>,
    points_head: Vec<String>,
    points: Vec<Vec<String>>,
    command: String,
}

#[derive(Serialize)]
struct Overall {
    /// `holds`, `fails`, `open`: the style of the badge.
    kind: &'static str,
    mark: &'static str,
    word: &'static str,
    sentence: String,
}

#[derive(Clone, Copy, Default, Serialize)]
struct Counts {
    holds: usize,
    fails: usize,
    not_decidable: usize,
    informative: usize,
    planned: usize,
    completed: usize,
    /// Diverged where an expectation takes that for an answer.
    diverged: usize,
    failed: usize,
    missing: usize,
}

#[derive(Serialize)]
struct Failure {
    label: String,
    status: &'static str,
    reason: String,
}

#[derive(Serialize)]
struct FigureBlock {
    id: String,
    title: String,
    thesis: Option<String>,
    notes: Vec<String>,
    svg: Option<String>,
    /// Why there is no drawing.
    problem: Option<String>,
    head: Vec<String>,
    rows: Vec<Vec<String>>,
    row_count: usize,
    command: String,
}

impl Page {
    pub fn new(
        study: &Study,
        runs: &[Run],
        verdicts: &[Verdict],
        plates: &[(&Figure, Result<Plate, ReportError>)],
        effort: &[Effort],
    ) -> Page {
        let counts = counts(study, runs, verdicts);
        let exploratory = study.expect.is_empty() && verdicts.is_empty();
        let counters = table::counters(runs);
        Page {
            study: study.name.clone(),
            question: study.question.clone(),
            exploratory,
            overall: overall(counts, exploratory),
            counts,
            facts: facts::of(runs),
            calibrated: calibrated::rows(study),
            verdicts: verdicts
                .iter()
                .map(|verdict| verdict_row::verdict_row(study, verdict))
                .collect(),
            failures: failures(study, runs),
            figures: plates
                .iter()
                .map(|(figure, plate)| figure_block(study, figure, plate))
                .collect(),
            cost: cost::of(study, runs),
            work_head: work_head(
                &[
                    "scene",
                    "points",
                    "wall time",
                    "longest",
                    "CPU time",
                    "peak memory",
                ],
                &counters,
            ),
            work: effort.iter().map(effort_row).collect(),
            points_head: work_head(
                &[
                    "point",
                    "status",
                    "wall time",
                    "CPU time",
                    "split of time",
                    "peak memory",
                ],
                &counters,
            ),
            points: runs.iter().map(|run| point_row(study, run, &counters)).collect(),
            command: format!("cargo study {}", study.name),
        }
    }

    /// `index.html`.
    pub fn html(&self) -> Result<String, ReportError> {
        let style = include_str!("templates/style.css");
        render(
            "index.html",
            include_str!("templates/index.html"),
            context! { page => Serde(self), style },
        )
    }

    /// `report.md`.
    pub fn markdown(&self) -> Result<String, ReportError> {
        render(
            "report.md",
            include_str!("templates/report.md"),
            context! { page => Serde(self) },
        )
    }
}

fn render(name: &str, template: &str, values: Value) -> Result<String, ReportError> {
    let mut templates = Environment::new();
    let failed = |error| ReportError(format!("{name} cannot be made: {error}"));
    let syntax = SyntaxConfig::builder()
        .trim_blocks(true)
        .lstrip_blocks(true)
        .build();
    templates.set_syntax(syntax.map_err(failed)?);
    templates.add_filter("code", code);
    templates.add_filter("cell", |text: String| text.replace('|', "\\|").replace('\n', " "));
    templates
        .add_template(name, template)
        .and_then(|()| templates.get_template(name)?.render(values))
        .map_err(failed)
}

/// Text with `names` in the type of code, safe in HTML.
fn code(text: String) -> Value {
    let mut markup = String::new();
    for (index, part) in text.split('`').enumerate() {
        let part = part
            .replace('&', "&amp;")
            .replace('<', "&lt;")
            .replace('>', "&gt;")
            .replace('"', "&quot;");
        match index % 2 {
            0 => markup.push_str(&part),
            _ => markup.push_str(&format!("<code>{part}</code>")),
        }
    }
    Value::from_safe_string(markup)
}

fn counts(study: &Study, runs: &[Run], verdicts: &[Verdict]) -> Counts {
    let gating = |outcome| {
        verdicts
            .iter()
            .filter(|verdict| verdict.informative.is_none() && verdict.verdict == outcome)
            .count()
    };
    let completed = runs.iter().filter(|run| run.status == Status::Completed).count();
    let planned = study.plan.points.len().max(runs.len());
    let diverged = runs.iter().filter(|run| answers_by_diverging(study, run)).count();
    Counts {
        holds: gating(Outcome::Holds),
        fails: gating(Outcome::Fails),
        not_decidable: gating(Outcome::NotDecidable),
        informative: verdicts
            .iter()
            .filter(|verdict| verdict.informative.is_some())
            .count(),
        planned,
        completed,
        diverged,
        failed: runs.len() - completed - diverged,
        missing: planned - runs.len(),
    }
}

fn overall(counts: Counts, exploratory: bool) -> Overall {
    let gating = counts.holds + counts.fails + counts.not_decidable;
    let absent = counts.failed + counts.missing;
    let points = format!("{} of {} points missing or failed", absent, counts.planned);
    let (kind, word, mut sentence) = if counts.fails > 0 {
        (
            "fails",
            "Fails",
            format!("{} of {gating} expectations do not hold", counts.fails),
        )
    } else if exploratory {
        (
            "open",
            "Exploratory",
            "this study expects nothing: it shows, and judges nothing".to_owned(),
        )
    } else if absent > 0 {
        return Overall {
            kind: "open",
            mark: mark("open"),
            word: "Incomplete",
            sentence: format::sentence(&points) + ".",
        };
    } else if counts.not_decidable > 0 {
        let sentence = format!(
            "{} of {gating} expectations cannot be decided",
            counts.not_decidable
        );
        ("open", "Not decided", sentence)
    } else if gating == 0 {
        (
            "open",
            "Informative",
            "no expectation of this study gates".to_owned(),
        )
    } else if gating == 1 {
        ("holds", "Holds", "the one expectation holds".to_owned())
    } else {
        ("holds", "Holds", format!("all {gating} expectations hold"))
    };
    if absent > 0 {
        sentence = format!("{sentence}; {points}");
    }
    Overall {
        kind,
        mark: mark(kind),
        word,
        sentence: format::sentence(&sentence) + ".",
    }
}

/// The symbol beside a verdict: colours alone are not enough.
fn mark(kind: &str) -> &'static str {
    match kind {
        "holds" => "✓",
        "fails" => "✗",
        _ => "?",
    }
}

fn failures(study: &Study, runs: &[Run]) -> Vec<Failure> {
    let failed = runs
        .iter()
        .filter(|run| run.status != Status::Completed && !answers_by_diverging(study, run));
    failed
        .map(|run| Failure {
            label: selection::label(study, run),
            status: table::status_word(run.status),
            reason: run
                .reason
                .clone()
                .unwrap_or_else(|| "no reason is known".to_owned()),
        })
        .collect()
}

fn figure_block(study: &Study, figure: &Figure, plate: &Result<Plate, ReportError>) -> FigureBlock {
    let command = format!("cargo study {}", study.name);
    let thesis = figure.thesis.as_deref().map(format::thesis_figure);
    match plate {
        Ok(plate) => {
            let (rows, row_count) = shown_rows(&plate.table);
            FigureBlock {
                id: plate.id.clone(),
                title: plate.title.clone(),
                thesis,
                notes: plate.notes.clone(),
                svg: Some(plate.svg.clone()),
                problem: None,
                head: plate.table.head.clone(),
                rows,
                row_count,
                command,
            }
        }
        Err(error) => FigureBlock {
            id: figure.id.clone(),
            title: figure.title.clone().unwrap_or_else(|| figure.id.clone()),
            thesis,
            notes: Vec::new(),
            svg: None,
            problem: Some(error.to_string()),
            head: Vec::new(),
            rows: Vec::new(),
            row_count: 0,
            command,
        },
    }
}

/// Evenly thinned rows, and how many there are in all.
fn shown_rows(table: &Table) -> (Vec<Vec<String>>, usize) {
    let every = table.rows.len().div_ceil(SHOWN_ROWS).max(1);
    let rows = table.rows.iter().step_by(every);
    (
        rows.map(|row| row.iter().map(|cell| cell.shown()).collect())
            .collect(),
        table.rows.len(),
    )
}

fn work_head(first: &[&str], counters: &[String]) -> Vec<String> {
    first
        .iter()
        .map(|&name| name.to_owned())
        .chain(counters.iter().map(|name| format::words(name)))
        .collect()
}

fn effort_row(effort: &Effort) -> Vec<String> {
    let mut row = vec![
        format::words(&effort.scene),
        effort.points.to_string(),
        format::duration(effort.wall),
        format::duration(effort.longest),
        format::duration(effort.cpu),
        format::memory(effort.memory),
    ];
    row.extend(effort.work.iter().map(|count| format::count(*count)));
    row
}

fn point_row(study: &Study, run: &Run, counters: &[String]) -> Vec<String> {
    let mut row = vec![
        selection::label(study, run),
        table::status_word(run.status).to_owned(),
        format::duration(run.timing.wall),
        format::duration(run.timing.cpu),
        match run.timing.split_in_words() {
            words if words.is_empty() => "–".to_owned(),
            words => words,
        },
        format::memory(run.timing.peak_memory),
    ];
    row.extend(counters.iter().map(|name| {
        let count = run.counters.iter().find(|(other, _)| other == name);
        count.map_or("–".to_owned(), |(_, count)| format::count(*count))
    }));
    row
}
