//! Relative error over a resolution, both logarithmic, with the observed order as a slope triangle,
//! the grid convergence index as bars and the admitted bound as a level.

use super::super::axis::Scale;
use super::super::canvas::{Area, Position, Stroke};
use super::super::legend::Entry;
use super::super::numbers::{Convergence, PointError, Resolved};
use super::super::panel::{Axis, Panel};
use super::super::theme::{self, Style};
use super::slope::{self, middles};
use super::{Cell, Material, Plate, Table, cited};
use crate::report::format::Unit;
use crate::report::{ReportError, format, selection};
use crate::store::model::Run;
use crate::study::model::Check;

/// The points of one group from fine to coarse.
struct Sweep<'a> {
    label: String,
    /// The grouping value alone.
    value: String,
    style: Style,
    points: Vec<(&'a Run, f64, PointError)>,
    convergence: Convergence,
}

pub fn draw(
    material: &Material,
    of: &str,
    against: &str,
    over: &str,
    group: Option<&str>,
) -> Result<Plate, ReportError> {
    let sweeps = sweeps(material, of, against, over, group)?;
    let bounds = bounds(material, of, against);
    let errors: Vec<f64> = sweeps
        .iter()
        .flat_map(|sweep| sweep.points.iter().map(|point| point.2.error))
        .collect();
    let resolutions: Vec<f64> = sweeps
        .iter()
        .flat_map(|sweep| sweep.points.iter().map(|point| point.1))
        .collect();
    let error_unit = Unit::of_errors(errors.iter().copied().fold(0.0, f64::max));
    let axis_unit = selection::axis_unit(material.study, over);
    let unit = format::readable(axis_unit, resolutions.iter().copied().fold(0.0, f64::max));
    let logarithmic = errors.iter().chain(&resolutions).all(|value| *value > 0.0);

    let shown: Vec<f64> = resolutions.iter().map(|value| value * unit.factor).collect();
    let up = heights(&errors, &bounds, logarithmic)
        .into_iter()
        .map(|value| value * error_unit.factor);
    let (x, y) = if logarithmic {
        (Scale::logarithmic(shown.iter().copied()), Scale::logarithmic(up))
    } else {
        (Scale::linear(shown.iter().copied()), Scale::linear(up))
    };
    let mut panel = Panel::new(
        Axis {
            title: format!("{}{}", format::title_words(over), unit.in_brackets()),
            scale: x.with_ticks_at(&shown),
        },
        Axis {
            title: format!(
                "relative error of {}{}",
                format::words(of),
                error_unit.in_brackets()
            ),
            scale: y,
        },
    );
    let places: Vec<Vec<Position>> = sweeps
        .iter()
        .map(|sweep| {
            let point = |point: &(&Run, f64, PointError)| {
                panel.at(point.1 * unit.factor, point.2.error * error_unit.factor)
            };
            sweep.points.iter().map(point).collect()
        })
        .collect();
    for (sweep, places) in sweeps.iter().zip(&places) {
        draw_sweep(&mut panel, sweep, places, error_unit.factor);
    }
    for bound in &bounds {
        panel.level(
            bound * error_unit.factor,
            &format!("admitted: {}", format::percent(*bound)),
        );
    }
    if logarithmic {
        for (sweep, places) in sweeps.iter().zip(&places) {
            if let Some(order) = sweep.convergence.order {
                slope::triangle(&mut panel, places, order, sweep.style);
            }
        }
    }
    let suggested = format!(
        "relative error of {} over {}",
        format::words(of),
        format::title_words(over)
    );
    let title = material.title(&suggested);
    let description = format!("{} points in {} groups.", errors.len(), sweeps.len());
    panel.heading = group.and_then(selection::heading);
    let legend = legend(&sweeps, of, panel.heading.is_some());
    let drawing = panel.finish(&legend, &material.id(), &title, &description)?;
    let table = table(material, &sweeps, over, of);
    let notes = material.captioned(&suggested, notes(material, &sweeps, of, against, over));
    Ok(material.plate(title, drawing, notes, table))
}

fn sweeps<'a>(
    material: &Material<'a>,
    of: &str,
    against: &str,
    over: &str,
    group: Option<&str>,
) -> Result<Vec<Sweep<'a>>, ReportError> {
    let mut sweeps = Vec::new();
    for (index, members) in selection::grouped(material.study, &material.runs, group)
        .into_iter()
        .enumerate()
    {
        let mut points = Vec::new();
        for run in members.runs {
            let resolution = selection::numeric(run, over).ok_or_else(|| {
                ReportError(format!(
                    "`{over}` is no number in run {}: name a numeric axis",
                    run.id.0
                ))
            })?;
            let error = (material.numbers.error)(run, of, against).map_err(ReportError)?;
            if !error.error.is_finite() {
                return Err(ReportError(format!(
                    "the error of run {} is not finite",
                    run.id.0
                )));
            }
            points.push((run, resolution, error));
        }
        points.sort_by(|one, other| one.1.total_cmp(&other.1));
        let sweep = resolved(of, &points);
        let mut convergence = (material.numbers.convergence)(&sweep);
        convergence.order = convergence.order.filter(|order| order.is_finite());
        convergence.index = convergence.index.filter(|index| index.is_finite());
        sweeps.push(Sweep {
            label: members.label,
            value: members.value,
            style: theme::style(index),
            points,
            convergence,
        });
    }
    Ok(sweeps)
}

/// One entry per resolution, from fine to coarse: the mean of its replicates.
fn resolved(of: &str, points: &[(&Run, f64, PointError)]) -> Vec<Resolved> {
    let same = |one: &(&Run, f64, PointError), other: &(&Run, f64, PointError)| one.1 == other.1;
    let mean = |values: &mut dyn Iterator<Item = f64>, count: usize| values.sum::<f64>() / count as f64;
    points
        .chunk_by(same)
        .map(|replicates| {
            let count = replicates.len();
            // The value of a series is the one where it is farthest off: nothing to extrapolate.
            let values: Option<Vec<f64>> = replicates
                .iter()
                .map(|(run, ..)| run.scalar(of).map(|scalar| scalar.value))
                .collect();
            Resolved {
                resolution: replicates[0].1,
                value: values.map(|values| mean(&mut values.into_iter(), count)),
                error: mean(&mut replicates.iter().map(|point| point.2.signed), count),
            }
        })
        .collect()
}

/// Bounds that expectations of this study set on the same error.
fn bounds(material: &Material, of: &str, against: &str) -> Vec<f64> {
    let mut bounds: Vec<f64> = Vec::new();
    for expectation in &material.study.expect {
        if let Check::Error {
            of: checked,
            against: reference,
            below,
            ..
        } = &expectation.check
        {
            let concerned = material
                .runs
                .iter()
                .any(|run| selection::admits(&expectation.selection, run));
            if checked == of && reference == against && concerned && !bounds.contains(below) {
                bounds.push(*below);
            }
        }
    }
    bounds.sort_by(f64::total_cmp);
    bounds
}

/// What the vertical axis has to hold: the errors, room for a triangle below, and near bounds.
fn heights(errors: &[f64], bounds: &[f64], logarithmic: bool) -> Vec<f64> {
    let low = errors.iter().copied().fold(f64::INFINITY, f64::min);
    let high = errors.iter().copied().fold(0.0, f64::max);
    let mut heights = errors.to_vec();
    if logarithmic {
        heights.push(low / 1.5);
        heights.extend(
            bounds
                .iter()
                .filter(|bound| **bound > low / 30.0 && **bound < high * 30.0),
        );
    } else {
        heights.push(0.0);
        heights.extend(bounds.iter().filter(|bound| **bound < high * 10.0));
    }
    heights
}

fn draw_sweep(panel: &mut Panel, sweep: &Sweep, places: &[Position], factor: f64) {
    let Style { colour, marker, dash } = sweep.style;
    let stroke = Stroke {
        dash,
        ..Stroke::solid(colour, theme::LINE_STROKE)
    };
    // Replicates share a resolution: their markers are drawn, the line passes their middle.
    panel.canvas.path(&middles(places), stroke);
    panel.canvas.take_path(&middles(places));
    if let (Some(index), Some((_, _, finest)), Some(at)) =
        (sweep.convergence.index, sweep.points.first(), places.first())
    {
        let ends = [finest.error + index, finest.error - index].map(|end| end * factor);
        uncertainty(panel, at.0, ends, colour);
    }
    for (at, (_, _, error)) in places.iter().zip(&sweep.points) {
        match error.signed < 0.0 {
            true => panel.canvas.open_marker(marker, *at, colour),
            false => panel.canvas.marker(marker, *at, colour, 1.0),
        }
        panel.canvas.take(Area::around(*at, theme::MARKER + 30));
    }
}

/// A bar from end to end, cut where the axes end; only an end inside the plot has a cap.
fn uncertainty(panel: &mut Panel, x: i32, ends: [f64; 2], colour: theme::Colour) {
    let stroke = Stroke::solid(colour, theme::THIN_STROKE);
    let place = |end: f64| {
        let fraction = if panel.y.scale.logarithmic && end <= 0.0 {
            -1.0
        } else {
            panel.y.scale.fraction(end)
        };
        let cut = fraction.clamp(0.0, 1.0);
        let height = f64::from(panel.plot.bottom - panel.plot.top);
        (panel.plot.bottom - (cut * height).round() as i32, cut == fraction)
    };
    let [(top, top_inside), (bottom, bottom_inside)] = ends.map(place);
    panel.canvas.line((x, top), (x, bottom), stroke);
    panel.canvas.take_path(&[(x, top), (x, bottom)]);
    for (y, inside) in [(top, top_inside), (bottom, bottom_inside)] {
        if inside {
            panel
                .canvas
                .line((x - theme::CAP, y), (x + theme::CAP, y), stroke);
        }
    }
}

fn legend(sweeps: &[Sweep], of: &str, headed: bool) -> Vec<Entry> {
    // One line that the vertical axis names needs no legend, unless its order stands there.
    if let [sweep] = sweeps
        && sweep.label.is_empty()
        && sweep.convergence.order.is_none()
    {
        return Vec::new();
    }
    sweeps
        .iter()
        .map(|sweep| {
            let name = if sweep.label.is_empty() {
                format::words(of)
            } else if headed {
                sweep.value.clone()
            } else {
                sweep.label.clone()
            };
            let order = sweep
                .convergence
                .order
                .map(|order| format!(" (order {order:.1})").replace('-', "−"));
            Entry {
                label: name + &order.unwrap_or_default(),
                style: sweep.style,
                markers: true,
                line: true,
                open: sweep.points.iter().all(|point| point.2.signed < 0.0),
            }
        })
        .collect()
}

fn notes(material: &Material, sweeps: &[Sweep], of: &str, against: &str, over: &str) -> Vec<String> {
    let errors = || {
        sweeps
            .iter()
            .flat_map(|sweep| sweep.points.iter().map(|point| &point.2))
    };
    let sources = errors().map(|error| error.source.clone()).collect();
    let expected: Option<Vec<f64>> = errors().map(|error| error.expected).collect();
    let unit = material.runs.iter().find_map(|run| run.scalar(of));
    let (expected, unit) = match (expected, unit) {
        (Some(expected), Some(scalar)) => (expected, scalar.unit.as_str()),
        _ => (Vec::new(), ""),
    };
    let mut notes = vec![format!("Reference {}.", cited(against, &expected, unit, sources))];
    let below = errors().filter(|error| error.signed < 0.0).count();
    if below > 0 && below == errors().count() {
        notes.push("Open markers: every value lies below the reference.".to_owned());
    } else if below > 0 {
        notes.push("Filled markers: value above the reference; open ones: below it.".to_owned());
    }
    if sweeps.iter().any(|sweep| sweep.convergence.order.is_some()) {
        notes.push(format!(
            "Triangles and numbers: observed order in {}.",
            format::title_words(over)
        ));
    }
    if sweeps.iter().any(|sweep| sweep.convergence.index.is_some()) {
        notes.push("Bars: grid convergence index of the finest point.".to_owned());
    }
    for sweep in sweeps {
        let Some(doubts) = sweep.convergence.doubts() else {
            continue;
        };
        notes.push(match sweep.label.is_empty() {
            true => format!("{}.", format::sentence(&doubts)),
            false => format!("{}: {doubts}.", format::sentence(&sweep.label)),
        });
    }
    notes
}

fn table(material: &Material, sweeps: &[Sweep], over: &str, of: &str) -> Table {
    let unit = material
        .runs
        .iter()
        .find_map(|run| run.scalar(of))
        .map_or("SI", |scalar| &scalar.unit);
    let over = format!("{over} [{}]", selection::axis_unit(material.study, over));
    let (computed, expected) = (format!("computed [{unit}]"), format!("expected [{unit}]"));
    let head = [
        "run",
        &over,
        &computed,
        &expected,
        "relative error [1]",
        "observed order [1]",
        "grid convergence index [1]",
    ];
    let mut table = Table::new(&head);
    for sweep in sweeps {
        for (index, (run, resolution, error)) in sweep.points.iter().enumerate() {
            let finest = if index == 0 { sweep.convergence.index } else { None };
            table.rows.push(vec![
                Cell::Words(selection::label(material.study, run)),
                Cell::Number(*resolution),
                error.computed.into(),
                error.expected.into(),
                Cell::Number(error.error),
                sweep.convergence.order.into(),
                finest.into(),
            ]);
        }
    }
    table
}
