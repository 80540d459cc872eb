//! Series over time, or over another series: one line per run, the reference dashed in black.

use super::super::axis::Scale;
use super::super::canvas::Area;
use super::super::panel::{Axis, Panel};
use super::lines::{self, Line};
use super::replicates::deviation_of;
use super::{Cell, Material, Plate, Table, cited};
use crate::report::numbers::Measured;
use crate::report::{ReportError, format, selection};
use crate::store::model::{Column, Run};

/// Table and column in which scenes keep series and their times.
const TABLE: &str = "time_series";
const TIME: &str = "time";

/// What is drawn over what.
pub struct Question<'a> {
    pub of: &'a [String],
    /// The series in the place of time.
    pub over: Option<&'a str>,
    /// Name of the reference.
    pub against: Option<&'a str>,
}

impl Question<'_> {
    /// Name of what lies along the axis.
    fn along(&self) -> &str {
        self.over.unwrap_or(TIME)
    }
}

pub fn draw(material: &Material, question: &Question, group: Option<&str>) -> Result<Plate, ReportError> {
    let Question { of, against, .. } = *question;
    let looks = lines::looks(material, of, group);
    let (drawn, unit) = computed(material, question, &looks.styles)?;
    let references = references(material, question)?;
    let (along, along_unit) = (format::words(question.along()), unit_along(material, question)?);
    let all = || drawn.iter().chain(references.iter().map(|(line, _)| line));
    let time = format::readable(&along_unit, lines::largest(all().flat_map(|line| &line.x)));
    let value = format::readable(&unit, lines::largest(all().flat_map(|line| &line.y)));
    let quantity = of
        .iter()
        .map(|name| format::words(name))
        .collect::<Vec<_>>()
        .join(", ");
    let mut panel = Panel::new(
        Axis {
            title: format!("{along}{}", time.in_brackets()),
            scale: Scale::tight(all().flat_map(|line| line.x.iter().map(|x| x * time.factor))),
        },
        Axis {
            title: format!("{quantity}{}", value.in_brackets()),
            scale: Scale::linear(all().flat_map(|line| line.all_y().into_iter().map(|y| y * value.factor))),
        },
    );
    let factors = (time.factor, value.factor);
    for line in &drawn {
        lines::shade(&mut panel, line, factors);
    }
    for line in all() {
        lines::draw(&mut panel, line, factors);
    }
    let start = start_inset(&mut panel, &drawn, all, factors);
    let mut legend = looks.legend;
    panel.heading = looks.heading;
    let mut notes: Vec<String> = looks.note.into_iter().collect();
    if let Some(name) = against {
        legend.push(lines::reference_entry(format!(
            "reference ({})",
            format::words(name)
        )));
        let sources = references.iter().map(|(_, source)| source.clone()).collect();
        let values: Vec<f64> = references.iter().flat_map(|(line, _)| line.y.clone()).collect();
        notes.push(format!("Dashed: {}.", cited(name, &values, &unit, sources)));
    }
    if let Some(window) = start {
        notes.push(format!(
            "Inset: the first {} {}.",
            format::number(window),
            time.label
        ));
    }
    let suggested = format!("{quantity} over {along}");
    let title = material.title(&suggested);
    let description = format!("{} lines of {quantity} over {along}.", drawn.len());
    let drawing = panel.finish(&legend, &material.id(), &title, &description)?;
    let table = table(material, question, (&unit, &along_unit))?;
    Ok(material.plate(title, drawing, material.captioned(&suggested, notes), table))
}

/// Enlarges the start where it takes little of the whole time and the curves leave room below.
/// Gives back how much time the inset shows, in displayed units.
fn start_inset<'a, I: Iterator<Item = &'a Line>>(
    panel: &mut Panel,
    drawn: &'a [Line],
    all: impl Fn() -> I,
    factors: (f64, f64),
) -> Option<f64> {
    let duration = lines::largest(drawn.iter().flat_map(|line| &line.x)) * factors.0;
    let risen = drawn.iter().map(|line| risen(line).map(|time| time * factors.0));
    let risen = risen
        .collect::<Option<Vec<f64>>>()?
        .into_iter()
        .fold(0.0, f64::max);
    let window = round_up(2.5 * risen).filter(|window| *window <= 0.35 * duration)?;
    let (width, height) = (
        panel.plot.right - panel.plot.left,
        panel.plot.bottom - panel.plot.top,
    );
    let left = panel.plot.left + width * 2 / 5;
    let beyond = |x: f64| panel.across(x * factors.0) >= left - width / 10;
    let lowest = all()
        .flat_map(|line| line.x.iter().zip(&line.y))
        .filter(|(x, y)| beyond(**x) && y.is_finite())
        .fold(f64::INFINITY, |least, (_, y)| least.min(*y));
    let plot = Area {
        left,
        right: panel.plot.right - width / 24,
        top: panel.up(lowest * factors.1).max(panel.plot.top) + height / 7,
        bottom: panel.plot.bottom - height / 7,
    };
    if plot.bottom - plot.top < height * 2 / 5 {
        return None;
    }
    let shown = all().flat_map(|line| line.x.iter().zip(&line.y));
    let shown = shown.filter(|(x, _)| **x * factors.0 <= window);
    let up = Scale::linear(shown.map(|(_, y)| y * factors.1)).with_at_most(6);
    let across = Scale::tight([0.0, window]).with_at_most(5);
    panel.inset(plot, across, up, |inner| {
        for line in drawn {
            lines::shade(inner, line, factors);
        }
        for line in all() {
            lines::draw(inner, line, factors);
        }
    });
    Some(window)
}

/// When a curve that rises from zero comes to nine tenths of its last value [s].
fn risen(line: &Line) -> Option<f64> {
    let last = *line.y.last()?;
    let first = *line.y.first()?;
    if last.is_nan() || last <= 0.0 || first.abs() > 0.1 * last {
        return None;
    }
    let reached = line.x.iter().zip(&line.y).find(|(_, y)| **y >= 0.9 * last);
    reached.map(|(time, _)| *time)
}

/// The next 1, 2 or 5 times a power of ten.
fn round_up(value: f64) -> Option<f64> {
    let power = 10f64.powf(value.log10().floor());
    let round = [1.0, 2.0, 5.0, 10.0].map(|factor| factor * power);
    round.into_iter().find(|round| *round >= value * 0.999)
}

fn series<'a>(run: &'a Run, of: &str) -> Result<&'a Column, ReportError> {
    let found = run.table(TABLE).and_then(|table| table.column(of));
    found.ok_or_else(|| {
        ReportError(format!(
            "run {} keeps no series `{of}`: add it to `observe`",
            run.id.0
        ))
    })
}

/// The scatter over seeds of a mean.
fn scatter(run: &Run, of: &str) -> Option<lines::Band> {
    let column = run.table(TABLE)?.column(&deviation_of(of))?;
    let half = column.values.clone();
    Some(lines::Band { half, across: false })
}

fn computed(
    material: &Material,
    question: &Question,
    looks: &[lines::Look],
) -> Result<(Vec<Line>, String), ReportError> {
    let mut drawn = Vec::new();
    let mut unit: Option<String> = None;
    for (place, quantity) in question.of.iter().enumerate() {
        for (index, run) in material.runs.iter().enumerate() {
            let column = series(run, quantity)?;
            let known = unit.get_or_insert_with(|| column.unit.clone());
            if *known != column.unit {
                let message = format!(
                    "`{quantity}` is in {}, not in {known}: draw two figures",
                    column.unit
                );
                return Err(ReportError(message));
            }
            let (style, opacity, markers) = looks[index + place * material.runs.len()];
            let (x, y) = (places(run, question)?.values.clone(), column.values.clone());
            let band = scatter(run, quantity);
            drawn.push(Line {
                x,
                y,
                style,
                opacity,
                markers,
                band,
            });
        }
    }
    Ok((drawn, unit.unwrap_or_default()))
}

/// Each distinct reference curve once.
fn references(material: &Material, question: &Question) -> Result<Vec<(Line, String)>, ReportError> {
    let Some(name) = question.against else {
        return Ok(Vec::new());
    };
    let mut found: Vec<(Line, String)> = Vec::new();
    for run in &material.runs {
        if let Some(points) = (material.numbers.points)(run, name).map_err(ReportError)? {
            measured(points, &places(run, question)?.values, &mut found);
            continue;
        }
        let times = places(run, question)?.values.clone();
        let curve = (material.numbers.curve)(run, name, &times).map_err(ReportError)?;
        let known = found
            .iter()
            .any(|(line, _)| line.y == curve.values && line.x == times);
        if !known {
            let style = lines::reference_style();
            let line = Line {
                x: times,
                y: curve.values,
                style,
                opacity: 1.0,
                markers: None,
                band: None,
            };
            found.push((line, curve.source));
        }
    }
    Ok(found)
}

/// Adds a measured curve, as far as the run lasts, unless it is there.
fn measured(points: Measured, times: &[f64], found: &mut Vec<(Line, String)>) {
    let last = times.last().copied().unwrap_or(0.0);
    let within = points.times.iter().zip(&points.values);
    let (x, y): (Vec<f64>, Vec<f64>) = within.filter(|(time, _)| **time <= last).unzip();
    if found.iter().any(|(line, _)| line.x == x && line.y == y) {
        return;
    }
    let line = Line {
        x,
        y,
        style: lines::reference_style(),
        opacity: 1.0,
        markers: None,
        band: None,
    };
    found.push((line, points.source));
}

/// What lies along the axis.
fn places<'a>(run: &'a Run, question: &Question) -> Result<&'a Column, ReportError> {
    series(run, question.along())
}

fn unit_along(material: &Material, question: &Question) -> Result<String, ReportError> {
    let first = material.runs.first();
    let unit = first.map(|run| Ok(places(run, question)?.unit.clone()));
    unit.unwrap_or_else(|| Ok("s".to_owned()))
}

fn table(
    material: &Material,
    question: &Question,
    (unit, along_unit): (&str, &str),
) -> Result<Table, ReportError> {
    let Question { of, against, .. } = *question;
    let mut head = vec!["run".to_owned(), format!("{} [{along_unit}]", question.along())];
    head.extend(of.iter().map(|name| format!("{name} [{unit}]")));
    let means = material.runs.iter().any(|run| scatter(run, &of[0]).is_some());
    if means {
        head.extend(of.iter().map(|name| format!("{} [{unit}]", deviation_of(name))));
    }
    let computed = head.len() - 2;
    head.extend(against.map(|name| format!("{name} [{unit}]")));
    let mut rows = Vec::new();
    for run in &material.runs {
        let times = places(run, question)?.values.clone();
        let columns = of.iter().map(|name| Ok(&series(run, name)?.values));
        let columns = columns.collect::<Result<Vec<_>, ReportError>>()?;
        let scatters: Vec<_> = of.iter().map(|name| scatter(run, name)).collect();
        let label = selection::label(material.study, run);
        let mut reference = None;
        if let Some(name) = against {
            match (material.numbers.points)(run, name).map_err(ReportError)? {
                Some(points) => rows.extend(own_rows(&points, &label, computed)),
                None => {
                    let curve = (material.numbers.curve)(run, name, &times).map_err(ReportError)?;
                    reference = Some(curve);
                }
            }
        }
        for (index, time) in times.iter().enumerate() {
            let mut row = vec![Cell::Words(label.clone()), Cell::Number(*time)];
            row.extend(
                columns
                    .iter()
                    .map(|column| Cell::from(column.get(index).copied())),
            );
            if means {
                let scatter = scatters.iter();
                row.extend(
                    scatter
                        .map(|band| Cell::from(band.as_ref().and_then(|band| band.half.get(index).copied()))),
                );
            }
            row.extend(against.map(|_| {
                let values = reference.as_ref().map(|curve| &curve.values);
                Cell::from(values.and_then(|values| values.get(index).copied()))
            }));
            rows.push(row);
        }
    }
    Ok(Table { head, rows })
}

/// Measured points stand at their own times, in rows without a computed value.
fn own_rows(points: &Measured, label: &str, computed: usize) -> Vec<Vec<Cell>> {
    let pairs = points.times.iter().zip(&points.values);
    let row = |(time, value): (&f64, &f64)| {
        let mut row = vec![Cell::Words(label.to_owned()), Cell::Number(*time)];
        row.extend(vec![Cell::Empty; computed]);
        row.push(Cell::Number(*value));
        row
    };
    pairs.map(row).collect()
}
