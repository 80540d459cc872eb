//! A profile table over time and height as a picture: colours between the axes, a bar beside, curves on top.

use super::super::axis::Scale;
use super::super::canvas::{Anchor, Area, Stroke, Text};
use super::super::colour_map;
use super::super::legend::Entry;
use super::super::panel::{Axis, Panel};
use super::super::theme::{self, Marker, Style};
use super::snapshots::one_run;
use super::{Cell, Material, Plate, Table, distinct, lines};
use crate::report::format::Unit;
use crate::report::{ReportError, format, selection};
use crate::store::model::Run;

/// Colours told apart.
const STEPS: usize = 96;
const BAR_WIDTH: i32 = 320;
/// How far a cell reaches up behind the next.
const BEHIND: i32 = 20;
/// What a line stands out by from the colours below it.
const HALO: u32 = 40;

/// Values at times and heights, all of them rising; a value per time and height, in order.
struct Grid {
    times: Vec<f64>,
    heights: Vec<f64>,
    values: Vec<f64>,
    /// Names and units of the three columns.
    columns: [(String, String); 3],
}

/// A height over time.
struct Curve {
    label: String,
    points: Vec<(f64, f64)>,
    style: Style,
}

pub fn draw(
    material: &Material,
    of: &str,
    curves: &[String],
    against: &[String],
) -> Result<Plate, ReportError> {
    let run = one_run(material)?;
    let grid = grid(run, of)?;
    let (mut lines, sources) = (
        series(run, curves)?,
        references(material, run, against, curves.len())?,
    );
    lines.extend(sources.0);
    let time = format::readable(&grid.columns[0].1, lines::largest(&grid.times));
    let height = format::readable(&grid.columns[1].1, lines::largest(&grid.heights));
    let edges = (edges(&grid.times), edges(&grid.heights));
    let axis = |name: &str, unit: &Unit, edges: &[f64]| Axis {
        title: format!("{}{}", format::words(name), unit.in_brackets()),
        scale: Scale::tight(edges.iter().map(|edge| edge * unit.factor)),
    };
    let mut panel = Panel::beside(
        axis(&grid.columns[0].0, &time, &edges.0),
        axis(&grid.columns[1].0, &height, &edges.1),
        bar_room(),
    );
    let range = range(&grid.values);
    picture(
        &mut panel,
        &grid,
        range,
        (&edges.0, &edges.1),
        (time.factor, height.factor),
    );
    for line in &lines {
        on_top(&mut panel, line, (time.factor, height.factor));
    }
    frame(&mut panel);
    bar(&mut panel, &grid.columns[2], range);
    let entries: Vec<Entry> = lines.iter().map(entry).collect();
    let called = format::words(&grid.columns[2].0);
    let suggested = format!(
        "{called} over {} and {}",
        format::words(&grid.columns[0].0),
        format::words(&grid.columns[1].0)
    );
    let title = material.title(&suggested);
    let description = format!("{called} by colour, {} lines on top.", lines.len());
    let drawing = panel.finish(&entries, &material.id(), &title, &description)?;
    let mut notes = vec![format!("Point: {}.", selection::label(material.study, run))];
    if material.runs.len() > 1 {
        notes.push(format!("One of {} seeds.", material.runs.len()));
    }
    notes.extend(distinct(sources.1));
    Ok(material.plate(
        title,
        drawing,
        material.captioned(&suggested, notes),
        table(&grid),
    ))
}

/// The first three columns of a table that is full: every height at every time.
fn grid(run: &Run, of: &str) -> Result<Grid, ReportError> {
    let fault = |what: &str| ReportError(format!("`{of}` of run {} {what}", run.id.0));
    let table = run
        .table(of)
        .ok_or_else(|| fault("is not kept: add it to `observe`"))?;
    let [time, height, value, ..] = table.columns.as_slice() else {
        return Err(fault("needs three columns: time, height and what is shown"));
    };
    let levels = |values: &[f64]| {
        let mut levels = values.to_vec();
        levels.sort_by(f64::total_cmp);
        levels.dedup();
        levels
    };
    let (times, heights) = (levels(&time.values), levels(&height.values));
    if times.len() < 2 || heights.len() < 2 || !times.iter().chain(&heights).all(|level| level.is_finite()) {
        return Err(fault("needs two times and two heights at least"));
    }
    let mut values = vec![f64::NAN; times.len() * heights.len()];
    let rows = time.values.iter().zip(&height.values).zip(&value.values);
    for ((at, up), value) in rows {
        let column = times.partition_point(|time| time < at);
        let row = heights.partition_point(|height| height < up);
        values[column * heights.len() + row] = *value;
    }
    let head = |index: usize| {
        let column = &table.columns[index];
        (column.name.clone(), column.unit.clone())
    };
    Ok(Grid {
        times,
        heights,
        values,
        columns: [head(0), head(1), head(2)],
    })
}

/// Halfway between neighbours; the outer cells are as wide as their neighbours, and none begins below zero
/// where none lies there.
fn edges(levels: &[f64]) -> Vec<f64> {
    let mut edges: Vec<f64> = levels.windows(2).map(|pair| (pair[0] + pair[1]) / 2.0).collect();
    let first = 2.0 * levels[0] - edges[0];
    let last = 2.0 * levels[levels.len() - 1] - edges[edges.len() - 1];
    edges.insert(0, if levels[0] >= 0.0 { first.max(0.0) } else { first });
    edges.push(last);
    edges
}

fn range(values: &[f64]) -> (f64, f64) {
    let finite = values.iter().copied().filter(|value| value.is_finite());
    let (low, high) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (low.min(value), high.max(value))
    });
    match high > low {
        true => (low, high),
        false if low.is_finite() => (low - 0.5, low + 0.5),
        false => (0.0, 1.0),
    }
}

/// Cells of one colour above each other are one rectangle. It reaches to the right behind the next columns
/// and a little up behind the next cell, so that no seam shows.
fn picture(
    panel: &mut Panel,
    grid: &Grid,
    (low, high): (f64, f64),
    (times, heights): (&[f64], &[f64]),
    factors: (f64, f64),
) {
    let step = |value: &f64| {
        let share = (value - low) / (high - low);
        value
            .is_finite()
            .then(|| (share * (STEPS - 1) as f64).round() as usize)
    };
    for (column, cells) in grid.values.chunks(grid.heights.len()).enumerate() {
        let mut row = 0;
        for same in cells.chunk_by(|one, next| step(one) == step(next)) {
            let edge = |row: usize| panel.up(heights[row] * factors.1);
            let area = Area {
                left: panel.across(times[column] * factors.0),
                top: (edge(row + same.len()) - BEHIND).max(panel.plot.top),
                right: panel.plot.right,
                bottom: edge(row),
            };
            row += same.len();
            match step(&same[0]) {
                Some(step) => {
                    let colour = colour_map::colour(step as f64 / (STEPS - 1) as f64);
                    panel.canvas.area(corners(&area), colour, 1.0);
                }
                None => panel.canvas.blank(area),
            }
        }
    }
}

fn corners(area: &Area) -> Vec<(i32, i32)> {
    vec![
        (area.left, area.bottom),
        (area.right, area.bottom),
        (area.right, area.top),
        (area.left, area.top),
    ]
}

/// Ink on a wider line of paper: it shows on dark colours and on bright ones.
fn on_top(panel: &mut Panel, line: &Curve, factors: (f64, f64)) {
    let inside = |panel: &Panel, (x, y): (f64, f64)| {
        let fractions = [panel.x.scale.fraction(x), panel.y.scale.fraction(y)];
        fractions.iter().all(|share| (-1e-9..=1.0 + 1e-9).contains(share))
    };
    let displayed = line
        .points
        .iter()
        .map(|(time, height)| (time * factors.0, height * factors.1));
    let places: Vec<_> = displayed
        .filter(|place| inside(panel, *place))
        .map(|(x, y)| panel.at(x, y))
        .collect();
    let halo = Stroke::solid(theme::PAPER, theme::LINE_STROKE + HALO);
    panel.canvas.path(&places, Stroke { opacity: 0.8, ..halo });
    panel.canvas.path(
        &places,
        Stroke {
            dash: line.style.dash,
            ..Stroke::solid(line.style.colour, theme::LINE_STROKE)
        },
    );
}

fn entry(line: &Curve) -> Entry {
    Entry {
        label: line.label.clone(),
        style: line.style,
        markers: false,
        line: true,
        open: false,
    }
}

fn style(index: usize) -> Style {
    Style {
        colour: theme::INK,
        marker: Marker::Circle,
        dash: theme::style(index).dash,
    }
}

fn series(run: &Run, curves: &[String]) -> Result<Vec<Curve>, ReportError> {
    let curve = |(index, name): (usize, &String)| {
        let table = run.table("time_series");
        let columns = table.and_then(|table| Some((table.columns.first()?, table.column(name)?)));
        let (time, height) =
            columns.ok_or_else(|| ReportError(format!("run {} keeps no series `{name}`", run.id.0)))?;
        Ok(Curve {
            label: format::words(name),
            points: time
                .values
                .iter()
                .copied()
                .zip(height.values.iter().copied())
                .collect(),
            style: style(index),
        })
    };
    curves.iter().enumerate().map(curve).collect()
}

/// References over the times of the series, and where they come from.
fn references(
    material: &Material,
    run: &Run,
    against: &[String],
    before: usize,
) -> Result<(Vec<Curve>, Vec<String>), ReportError> {
    let times = run.table("time_series").and_then(|table| table.columns.first());
    let times = times.map(|time| time.values.clone()).unwrap_or_default();
    let (mut lines, mut sources) = (Vec::new(), Vec::new());
    for (index, name) in against.iter().enumerate() {
        let found = (material.numbers.curve)(run, name, &times).map_err(ReportError)?;
        sources.push(format!(
            "{}: {}.",
            format::sentence(&format::words(name)),
            found.source
        ));
        lines.push(Curve {
            label: format!("reference ({})", format::words(name)),
            points: times.iter().copied().zip(found.values).collect(),
            style: style(before + index),
        });
    }
    Ok((lines, sources))
}

/// The frame again, above the colours.
fn frame(panel: &mut Panel) {
    let area = panel.plot;
    let mut outline = corners(&area);
    outline.push((area.left, area.bottom));
    panel
        .canvas
        .path(&outline, Stroke::solid(theme::INK, theme::AXIS_STROKE));
}

fn bar(panel: &mut Panel, (name, unit): &(String, String), (low, high): (f64, f64)) {
    let left = panel.plot.right + theme::GAP * 3;
    let area = Area {
        left,
        right: left + BAR_WIDTH,
        ..panel.plot
    };
    let unit = format::readable(unit, low.abs().max(high.abs()));
    let up = |share: f64| area.bottom - (share * f64::from(area.bottom - area.top)).round() as i32;
    for step in 0..STEPS {
        let part = Area {
            bottom: up(step as f64 / STEPS as f64),
            ..area
        };
        let colour = colour_map::colour(step as f64 / (STEPS - 1) as f64);
        panel.canvas.area(corners(&part), colour, 1.0);
    }
    let mut outline = corners(&area);
    outline.push((area.left, area.bottom));
    let stroke = Stroke::solid(theme::INK, theme::AXIS_STROKE);
    panel.canvas.path(&outline, stroke);
    let scale = Scale::tight([low * unit.factor, high * unit.factor]).with_at_most(6);
    let span = (high - low) * unit.factor;
    let mut widest = 0;
    for tick in scale.ticks() {
        let share = (tick.at - low * unit.factor) / span;
        let Some(label) = tick.label.as_deref().filter(|_| (0.0..=1.0).contains(&share)) else {
            continue;
        };
        let y = up(share);
        panel
            .canvas
            .line((area.right, y), (area.right + theme::TICK, y), stroke);
        let at = (area.right + theme::TICK + theme::GAP, y);
        widest = widest.max(theme::text_width(label, theme::SMALL_TEXT));
        panel
            .canvas
            .text(Text::new(label, at, theme::SMALL_TEXT, Anchor::Start));
    }
    let x = area.right + theme::TICK + theme::GAP * 2 + widest + theme::TEXT * 6 / 10;
    let label = format!("{}{}", format::words(name), unit.in_brackets());
    let mut title = Text::new(
        label,
        (x, (area.top + area.bottom) / 2),
        theme::TEXT,
        Anchor::Middle,
    );
    title.turned = true;
    panel.canvas.text(title);
}

/// The bar with its numbers and title.
fn bar_room() -> i32 {
    let numbers = theme::text_width("0.000", theme::SMALL_TEXT);
    theme::GAP * 6 + BAR_WIDTH + theme::TICK + numbers + theme::TEXT * 12 / 10 + theme::RIGHT_MARGIN / 2
}

fn table(grid: &Grid) -> Table {
    let heads = grid
        .columns
        .each_ref()
        .map(|(name, unit)| format!("{name} [{unit}]"));
    let mut table = Table::new(&heads.each_ref().map(String::as_str));
    for (column, cells) in grid.values.chunks(grid.heights.len()).enumerate() {
        for (height, value) in grid.heights.iter().zip(cells) {
            let value = Some(*value).filter(|value| value.is_finite());
            table.rows.push(vec![
                Cell::Number(grid.times[column]),
                Cell::Number(*height),
                value.into(),
            ]);
        }
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_fill_the_picture_from_the_floor() {
        assert_eq!(edges(&[0.5, 1.5, 2.5]), [0.0, 1.0, 2.0, 3.0]);
        assert_eq!(edges(&[0.0, 1.0]), [0.0, 0.5, 1.5]);
        assert_eq!(edges(&[-1.0, 0.0]), [-1.5, -0.5, 0.5]);
    }

    #[test]
    fn a_value_everywhere_still_has_a_range() {
        assert_eq!(range(&[0.4, f64::NAN, 0.9]), (0.4, 0.9));
        assert_eq!(range(&[1.0, 1.0]), (0.5, 1.5));
        assert_eq!(range(&[f64::NAN]), (0.0, 1.0));
    }
}
