//! One file per figure kind: from runs to a drawing, a table and notes for the caption.

pub mod error_against_resolution;
pub mod flux;
pub mod limit;
mod lines;
pub mod map;
pub mod profile;
mod replicates;
pub mod response;
pub mod richardson_zaki;
pub mod run_time_against_error;
mod settling;
mod slope;
pub mod snapshots;
pub mod time_series;

use super::numbers::Numbers;
use super::panel::Drawing;
use super::selection;
use super::{ReportError, format};
use crate::store::model::{Run, Status};
use crate::study::model::{Figure, FigureKind, Study};

/// What a figure is drawn from.
pub struct Material<'a> {
    pub study: &'a Study,
    pub figure: &'a Figure,
    /// The completed runs it shows.
    pub runs: Vec<&'a Run>,
    /// Every run of the study, whatever its end.
    pub all: &'a [Run],
    pub numbers: &'a Numbers<'a>,
}

/// A drawn figure with everything that stands around it.
#[derive(Clone, Debug)]
pub struct Plate {
    pub id: String,
    pub title: String,
    pub svg: String,
    /// Sentences below the figure.
    pub notes: Vec<String>,
    pub table: Table,
    /// What the tests look at: nothing may be cut.
    #[cfg(test)]
    pub drawing: Drawing,
}

/// The numbers behind a figure, SI units in the head.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    pub head: Vec<String>,
    pub rows: Vec<Vec<Cell>>,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    Number(f64),
    Words(String),
    Empty,
}

impl From<Option<f64>> for Cell {
    fn from(value: Option<f64>) -> Cell {
        value.map_or(Cell::Empty, Cell::Number)
    }
}

impl Cell {
    fn exact(&self) -> String {
        match self {
            Cell::Number(value) => format::exact(*value),
            Cell::Words(words) if words.contains([',', '"', '\n']) => {
                format!("\"{}\"", words.replace('"', "\"\""))
            }
            Cell::Words(words) => words.clone(),
            Cell::Empty => String::new(),
        }
    }

    pub fn shown(&self) -> String {
        match self {
            Cell::Number(value) => format::number(*value),
            Cell::Words(words) => words.clone(),
            Cell::Empty => "–".to_owned(),
        }
    }
}

impl Table {
    pub fn new(head: &[&str]) -> Table {
        Table {
            head: head.iter().map(|&name| name.to_owned()).collect(),
            rows: Vec::new(),
        }
    }

    /// Comma-separated, all digits.
    pub fn csv(&self) -> String {
        let line = |cells: Vec<String>| cells.join(",") + "\n";
        let head = self
            .head
            .iter()
            .map(|name| Cell::Words(name.clone()).exact())
            .collect();
        let rows = self
            .rows
            .iter()
            .map(|row| line(row.iter().map(Cell::exact).collect()));
        line(head) + &rows.collect::<String>()
    }
}

/// Draws one figure of the study.
///
/// # Errors
/// Says what is missing when there is nothing to draw.
pub fn draw(study: &Study, runs: &[Run], figure: &Figure, numbers: &Numbers) -> Result<Plate, ReportError> {
    let chosen = selection::chosen(runs, &figure.selection);
    if chosen.is_empty() {
        return Err(ReportError("no completed run belongs to this figure".to_owned()));
    }
    let mut plate = match &figure.kind {
        FigureKind::TimeSeries { .. } | FigureKind::Profile { .. } => {
            drawn_as_means(study, figure, (chosen, runs), numbers)?
        }
        _ => Material {
            study,
            figure,
            runs: chosen,
            all: runs,
            numbers,
        }
        .draw()?,
    };
    let left_out = runs
        .iter()
        .filter(|run| run.status != Status::Completed && selection::admits(&figure.selection, run))
        .count();
    if left_out > 0 {
        plate.notes.push(format!("Left out: {left_out} failed."));
    }
    Ok(plate)
}

/// Curves of several seeds as their mean with a band.
fn drawn_as_means(
    study: &Study,
    figure: &Figure,
    (runs, all): (Vec<&Run>, &[Run]),
    numbers: &Numbers,
) -> Result<Plate, ReportError> {
    let Some(means) = replicates::averaged(&runs) else {
        return Material {
            study,
            figure,
            runs,
            all,
            numbers,
        }
        .draw();
    };
    // A mean belongs to no seed: labels leave it out.
    let study = Study {
        seeds: Vec::new(),
        ..study.clone()
    };
    let material = Material {
        study: &study,
        figure,
        runs: means.iter().collect(),
        all: &means,
        numbers,
    };
    let mut plate = material.draw()?;
    plate.notes.push(replicates::note(&runs, means.len()));
    Ok(plate)
}

/// A file stem and identifier made of what is safe in both.
fn stem(id: &str) -> String {
    let safe = |letter: char| letter.is_ascii_alphanumeric() || ['-', '_', '.'].contains(&letter);
    let stem: String = id
        .chars()
        .map(|letter| if safe(letter) { letter } else { '-' })
        .collect();
    stem.trim_start_matches('.').to_owned()
}

impl Material<'_> {
    fn draw(&self) -> Result<Plate, ReportError> {
        match &self.figure.kind {
            FigureKind::TimeSeries {
                of,
                over,
                against,
                group,
            } => {
                let question = time_series::Question {
                    of,
                    over: over.as_deref(),
                    against: against.as_deref(),
                };
                time_series::draw(self, &question, group.as_deref())
            }
            FigureKind::ErrorAgainstResolution {
                of,
                against,
                over,
                group,
            } => error_against_resolution::draw(self, of, against, over, group.as_deref()),
            FigureKind::RunTimeAgainstError {
                of,
                against,
                work,
                group,
            } => {
                let work = work.as_deref().unwrap_or(run_time_against_error::RUN_TIME);
                run_time_against_error::draw(self, (of, against), work, group.as_deref())
            }
            FigureKind::Limit { limit, across, group } => limit::draw(self, limit, across, group.as_deref()),
            FigureKind::Profile { of, group } => profile::draw(self, of, group.as_deref()),
            FigureKind::Response {
                of,
                over,
                group,
                against,
            } => response::draw(self, &response::Question { of, over, against }, group.as_deref()),
            FigureKind::Map { of, curves, against } => map::draw(self, of, curves, against),
            FigureKind::RichardsonZaki { law, against, group } => {
                richardson_zaki::draw(self, law, against.as_deref(), group.as_deref())
            }
            FigureKind::Flux {
                of,
                over,
                against,
                deposit,
                group,
            } => {
                let question = flux::Question {
                    of,
                    over,
                    against,
                    deposit: deposit.as_deref(),
                };
                flux::draw(self, &question, group.as_deref())
            }
            FigureKind::Snapshots { times } => snapshots::draw(self, times),
        }
    }

    /// File stem of the figure, unique in a report.
    fn id(&self) -> String {
        stem(&self.figure.id)
    }

    /// The title given in the study, or the one the kind suggests.
    fn title(&self, suggested: &str) -> String {
        let scenes: Vec<String> = self
            .figure
            .selection
            .scenes
            .iter()
            .map(|scene| format::words(scene))
            .collect();
        let of = match scenes.is_empty() {
            true => String::new(),
            false => format!(": {}", scenes.join(", ")),
        };
        let given = self.figure.title.clone();
        given.unwrap_or_else(|| format::sentence(suggested) + &of)
    }

    /// Notes for the caption, led by what is plotted where the study's title does not say it.
    fn captioned(&self, suggested: &str, mut notes: Vec<String>) -> Vec<String> {
        if self.figure.title.is_some() {
            notes.insert(0, format!("{}.", format::sentence(suggested)));
        }
        notes
    }

    /// The finished figure with its surroundings.
    fn plate(&self, title: String, drawing: Drawing, notes: Vec<String>, table: Table) -> Plate {
        Plate {
            id: self.id(),
            title,
            svg: drawing.svg.clone(),
            notes,
            table,
            #[cfg(test)]
            drawing,
        }
    }

    /// A parameter's value, for a legend that names the parameter once.
    fn value(&self, run: &Run, name: &str) -> String {
        let value = run.parameter(name);
        value.map_or("none".to_owned(), |value| {
            selection::shown(self.study, name, &value)
        })
    }

    /// What tells the runs of one group apart, for labels.
    fn distinction(&self, run: &Run, names: &[String]) -> String {
        let parts: Vec<String> = names
            .iter()
            .filter_map(|name| {
                run.parameter(name)
                    .map(|value| selection::named(self.study, name, &value))
            })
            .collect();
        parts.join(", ")
    }
}

/// `force balance, 4.912 mm/s: Raso (2014), eq. 4.4`: a reference for a caption, with its value where
/// there is a single one.
pub(super) fn cited(against: &str, values: &[f64], unit: &str, sources: Vec<String>) -> String {
    let single = values
        .split_first()
        .filter(|(first, others)| others.iter().all(|other| other == *first));
    let value = single.map(|(value, _)| format!(", {}", format::quantity(*value, unit)));
    let sources = distinct(sources);
    let sources = match sources.is_empty() {
        true => String::new(),
        false => format!(": {}", sources.join("; ")),
    };
    format!("{}{}{sources}", format::words(against), value.unwrap_or_default())
}

/// Sorted, without repetition: sources for a caption.
pub(super) fn distinct(mut texts: Vec<String>) -> Vec<String> {
    texts.retain(|text| !text.is_empty());
    texts.sort();
    texts.dedup();
    texts
}
