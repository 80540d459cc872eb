//! Run time against error: what a better answer costs, with the front that no other point beats.

use super::super::axis::Scale;
use super::super::canvas::{Area, Position, Stroke};
use super::super::legend::Entry;
use super::super::numbers::{PointError, RECOMMENDED};
use super::super::panel::{Axis, Panel};
use super::super::theme::{self, Style};
use super::{Cell, Material, Plate, Table, cited};
use crate::report::format::Unit;
use crate::report::{ReportError, format, selection};
use crate::store::model::Run;
use crate::study::model::AxisValue;

/// Seconds below which a clock says nothing: shorter runs are drawn here.
const SHORTEST: f64 = 1e-6;
/// What is drawn where the study names no other measure of work.
pub const RUN_TIME: &str = format::RUN_TIME;

/// Radius of the ring around a recommended resolution.
const RING: i32 = theme::MARKER * 19 / 10;

struct Priced<'a> {
    run: &'a Run,
    group: usize,
    error: PointError,
    /// [s], or a count.
    cost: f64,
}

pub fn draw(
    material: &Material,
    (of, against): (&str, &str),
    work: &str,
    group: Option<&str>,
) -> Result<Plate, ReportError> {
    let groups = selection::grouped(material.study, &material.runs, group);
    let mut priced = Vec::new();
    for (index, members) in groups.iter().enumerate() {
        for run in &members.runs {
            let error = (material.numbers.error)(run, of, against).map_err(ReportError)?;
            let (cost, unit) = run
                .measure(work)
                .ok_or_else(|| ReportError(format!("the runs have no `{work}`")))?;
            let cost = if unit == "s" { cost.max(SHORTEST) } else { cost };
            priced.push(Priced {
                run,
                group: index,
                error,
                cost,
            });
        }
    }
    priced.retain(|point| point.error.error.is_finite());
    once(&mut priced);
    if priced.is_empty() {
        return Err(ReportError("no run of this figure has a finite error".to_owned()));
    }
    let logarithmic = priced.iter().all(|point| point.error.error > 0.0);
    let error_unit = Unit::of_errors(priced.iter().map(|point| point.error.error).fold(0.0, f64::max));
    let unit = if work.starts_with("timings.") { "s" } else { "1" };
    let time_unit = format::readable(unit, priced.iter().map(|point| point.cost).fold(0.0, f64::max));
    let errors = priced.iter().map(|point| point.error.error * error_unit.factor);
    let mut panel = Panel::new(
        Axis {
            title: format!(
                "relative error of {}{}",
                format::words(of),
                error_unit.in_brackets()
            ),
            scale: if logarithmic {
                Scale::logarithmic(errors)
            } else {
                Scale::linear(errors)
            },
        },
        Axis {
            title: format!("{}{}", format::measure(work), time_unit.in_brackets()),
            scale: Scale::logarithmic(priced.iter().map(|point| point.cost * time_unit.factor)),
        },
    );
    let places: Vec<Position> = priced
        .iter()
        .map(|point| {
            panel.at(
                point.error.error * error_unit.factor,
                point.cost * time_unit.factor,
            )
        })
        .collect();
    let fronts = fronts(material, &priced);
    for front in &fronts {
        draw_front(&mut panel, front, &priced, &places);
    }
    let resolution = resolution(material, group);
    draw_points(material, &mut panel, (&priced, &places), resolution.as_deref());
    panel.heading = group.and_then(selection::heading);
    let headed = panel.heading.is_some();

    let mut legend: Vec<Entry> = groups
        .iter()
        .enumerate()
        .map(|(index, members)| Entry {
            label: if members.label.is_empty() {
                "runs".to_owned()
            } else if headed {
                members.value.clone()
            } else {
                members.label.clone()
            },
            style: theme::style(index),
            markers: true,
            line: false,
            open: false,
        })
        .collect();
    let front: Vec<usize> = fronts.concat();
    if front.len() > fronts.len() {
        let style = Style {
            colour: theme::SOFT,
            dash: theme::SOLID,
            marker: theme::Marker::Circle,
        };
        legend.push(Entry {
            label: match fronts.len() {
                1 => "Pareto front".to_owned(),
                _ => "Pareto front of each scene".to_owned(),
            },
            style,
            markers: false,
            line: true,
            open: false,
        });
    }
    let suggested = format!(
        "{} against relative error of {}",
        format::measure(work),
        format::words(of)
    );
    let title = material.title(&suggested);
    let description = format!(
        "{} points, {} of them on the Pareto front.",
        priced.len(),
        front.len()
    );
    let drawing = panel.finish(&legend, &material.id(), &title, &description)?;
    let table = table(material, &priced, &front, (of, work));
    let mut notes = notes(material, &priced, against, resolution.as_deref());
    if work == RUN_TIME {
        notes.push("Wall time of one point; it differs from machine to machine.".to_owned());
    }
    Ok(material.plate(title, drawing, material.captioned(&suggested, notes), table))
}

/// Seeds that change nothing are one point.
fn once(priced: &mut Vec<Priced>) {
    let same = |one: &Priced, other: &Priced| {
        let (a, b) = (one.run, other.run);
        (a.scene == b.scene && a.axes == b.axes)
            && (one.error.computed == other.error.computed && one.error.error == other.error.error)
            && one.cost == other.cost
    };
    let mut place = 0;
    while place < priced.len() {
        match priced[..place].iter().any(|other| same(other, &priced[place])) {
            true => drop(priced.remove(place)),
            false => place += 1,
        }
    }
}

/// Indices on the front of each scene, from the smallest error upwards. Scenes are different problems:
/// the cheap answer to one is no answer to another.
fn fronts(material: &Material, priced: &[Priced]) -> Vec<Vec<usize>> {
    let mut scenes: Vec<&str> = priced.iter().map(|point| point.run.scene.as_str()).collect();
    scenes.sort();
    scenes.dedup();
    let front = |scene: &&str| {
        let members: Vec<usize> = (0..priced.len())
            .filter(|index| priced[*index].run.scene == *scene)
            .collect();
        let pairs: Vec<(f64, f64)> = members
            .iter()
            .map(|index| (priced[*index].cost, priced[*index].error.error))
            .collect();
        let mut front = (material.numbers.front)(&pairs);
        front.sort_by(|one, other| pairs[*one].1.total_cmp(&pairs[*other].1));
        front.into_iter().map(|index| members[index]).collect()
    };
    scenes.iter().map(front).collect()
}

/// The front as steps: between two of its points nothing better is known than the worse of both.
fn draw_front(panel: &mut Panel, front: &[usize], priced: &[Priced], places: &[Position]) {
    let mut groups: Vec<usize> = front.iter().map(|index| priced[*index].group).collect();
    groups.dedup();
    let colour = match groups.as_slice() {
        [group] if priced.iter().any(|point| point.group != *group) => theme::style(*group).colour,
        _ => theme::SOFT,
    };
    let mut steps: Vec<Position> = Vec::new();
    for index in front {
        let here = places[*index];
        if let Some(last) = steps.last().copied() {
            steps.push((here.0, last.1));
        }
        steps.push(here);
    }
    panel
        .canvas
        .path(&steps, Stroke::solid(colour, theme::THIN_STROKE));
    panel.canvas.take_path(&steps);
}

/// The axis by which points are labelled: a recommended one, or the first numeric one that varies.
fn resolution(material: &Material, group: Option<&str>) -> Option<String> {
    let varying = selection::varying(&material.runs, group.as_slice());
    let numeric = |name: &String| {
        material
            .runs
            .iter()
            .any(|run| selection::numeric(run, name).is_some())
    };
    let recommended = RECOMMENDED
        .iter()
        .map(|(name, _)| (*name).to_owned())
        .find(|name| varying.contains(name));
    recommended.or_else(|| varying.into_iter().find(numeric))
}

fn is_recommended(run: &Run, resolution: Option<&str>) -> bool {
    let recommended = RECOMMENDED.iter().find(|(name, _)| Some(*name) == resolution);
    recommended.is_some_and(|(name, value)| {
        selection::numeric(run, name).is_some_and(|number| (number - value).abs() < 1e-9 * value)
    })
}

fn draw_points(
    material: &Material,
    panel: &mut Panel,
    (priced, places): (&[Priced], &[Position]),
    resolution: Option<&str>,
) {
    for (point, at) in priced.iter().zip(places) {
        let Style { colour, marker, .. } = theme::style(point.group);
        panel.canvas.marker(marker, *at, colour, 1.0);
        let mut half = theme::MARKER + 20;
        if is_recommended(point.run, resolution) {
            half = RING;
            panel
                .canvas
                .path(&ring(*at, half), Stroke::solid(theme::INK, theme::THIN_STROKE));
        }
        panel.canvas.take(Area::around(*at, half));
    }
    let Some(name) = resolution else { return };
    for (point, at) in priced.iter().zip(places) {
        if let Some(value) = selection::numeric(point.run, name) {
            let half = match is_recommended(point.run, resolution) {
                true => RING,
                false => theme::MARKER + 20,
            };
            let colour = theme::style(point.group).colour;
            let label = match selection::axis_unit(material.study, name) {
                "1" | "" => format::number(value),
                _ => selection::shown(material.study, name, &AxisValue::Number(value)),
            };
            panel.label_beside(*at, half, &label, colour);
        }
    }
}

fn ring(centre: Position, radius: i32) -> Vec<Position> {
    let corner = |index: i32| {
        let angle = f64::from(index) / 32.0 * std::f64::consts::TAU;
        let reach = f64::from(radius);
        (
            centre.0 + (reach * angle.cos()).round() as i32,
            centre.1 + (reach * angle.sin()).round() as i32,
        )
    };
    (0..=32).map(corner).collect()
}

fn notes(material: &Material, priced: &[Priced], against: &str, resolution: Option<&str>) -> Vec<String> {
    let sources = priced.iter().map(|point| point.error.source.clone()).collect();
    let mut notes = vec![format!("Reference {}.", cited(against, &[], "", sources))];
    if let Some(name) = resolution {
        notes.push(format!("Numbers at the points: {}.", format::title_words(name)));
        let ringed = priced.iter().find(|point| is_recommended(point.run, resolution));
        if let Some(value) = ringed.and_then(|point| point.run.parameter(name)) {
            let value = selection::named(material.study, name, &value);
            notes.push(format!("Ringed: the recommended resolution, {value}."));
        }
    }
    notes
}

fn table(material: &Material, priced: &[Priced], front: &[usize], (of, work): (&str, &str)) -> Table {
    let unit = material
        .runs
        .iter()
        .find_map(|run| run.scalar(of))
        .map_or("SI", |scalar| &scalar.unit);
    let (computed, expected) = (format!("computed [{unit}]"), format!("expected [{unit}]"));
    let head = [
        "run",
        &computed,
        &expected,
        "relative error [1]",
        "wall time [s]",
        "steps [1]",
        "on the front",
    ];
    let cost = format!("{} [1]", format::measure(work));
    let head: Vec<&str> = match work {
        RUN_TIME => head.to_vec(),
        _ => head.into_iter().chain([cost.as_str()]).collect(),
    };
    let mut table = Table::new(&head);
    for (index, point) in priced.iter().enumerate() {
        let steps = point.run.counters.iter().find(|(name, _)| name == "steps");
        let mut row = vec![
            Cell::Words(selection::label(material.study, point.run)),
            point.error.computed.into(),
            point.error.expected.into(),
            Cell::Number(point.error.error),
            Cell::Number(point.run.timing.wall),
            steps.map(|(_, count)| *count as f64).into(),
            Cell::Words(if front.contains(&index) { "yes" } else { "no" }.to_owned()),
        ];
        if work != RUN_TIME {
            row.push(Cell::Number(point.cost));
        }
        table.rows.push(row);
    }
    table
}
