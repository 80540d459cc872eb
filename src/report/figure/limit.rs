//! The place on an axis at which a scalar leaves a band, over another axis: tried values on both sides,
//! the reference as a line.

use super::super::axis::Scale;
use super::super::canvas::{Area, Stroke};
use super::super::legend::Entry;
use super::super::panel::{Axis, Panel};
use super::super::theme::{self, Style};
use super::{Cell, Material, Plate, Table, distinct};
use crate::judge::bracket::{Bracket, brackets};
use crate::judge::select::ended;
use crate::report::format::Unit;
use crate::report::{ReportError, format, selection};
use crate::study::model::{AxisValue, Limit};

/// Brackets of one value of the group, over the other axis.
struct Row<'a> {
    label: String,
    style: Style,
    brackets: Vec<(f64, Bracket<'a>)>,
}

pub fn draw(
    material: &Material,
    limit: &Limit,
    across: &str,
    group: Option<&str>,
) -> Result<Plate, ReportError> {
    let rows = rows(material, limit, across, group)?;
    let all = || rows.iter().flat_map(|row| &row.brackets);
    let across_unit = selection::axis_unit(material.study, across).to_owned();
    let over_unit = selection::axis_unit(material.study, &limit.over).to_owned();
    let places: Vec<f64> = all().map(|(place, _)| *place).collect();
    let values: Vec<f64> = all().flat_map(|(_, bracket)| values(bracket)).collect();
    let units = [
        format::readable(&across_unit, largest(&places)),
        format::readable(&over_unit, largest(&values)),
    ];
    let mut panel = panel(limit, across, &units, (&places, &values));
    panel.heading = group.and_then(selection::heading);
    let factors = [units[0].factor, units[1].factor];
    for row in &rows {
        draw_row(&mut panel, row, factors);
    }
    let suggested = format!(
        "greatest {} that holds, over {}",
        format::words(&limit.over),
        format::words(across)
    );
    let title = material.title(&suggested);
    let description = format!("{} limits on {} lines.", places.len(), rows.len());
    let drawing = panel.finish(&legend(&rows, limit), &material.id(), &title, &description)?;
    let table = table(&rows, limit, across, [&across_unit, &over_unit]);
    let notes = material.captioned(&suggested, notes(&rows, limit));
    Ok(material.plate(title, drawing, notes, table))
}

fn rows<'a>(
    material: &Material<'a>,
    limit: &Limit,
    across: &str,
    group: Option<&str>,
) -> Result<Vec<Row<'a>>, ReportError> {
    let groups = ended(material.study, material.all, &material.figure.selection);
    let mut rows: Vec<Row> = Vec::new();
    for bracket in brackets(material.study, material.all, &groups, limit) {
        let Some(AxisValue::Number(place)) = bracket.at.parameter(across) else {
            continue;
        };
        let label = group.map_or(String::new(), |name| material.value(bracket.at, name));
        let index = rows.iter().position(|row| row.label == label).unwrap_or_else(|| {
            let style = Style {
                dash: theme::SOLID,
                ..theme::style(rows.len())
            };
            let brackets = Vec::new();
            rows.push(Row {
                label,
                style,
                brackets,
            });
            rows.len() - 1
        });
        rows[index].brackets.push((place, bracket));
    }
    for row in &mut rows {
        row.brackets.sort_by(|one, other| one.0.total_cmp(&other.0));
    }
    match rows.is_empty() {
        true => Err(ReportError(format!(
            "no run of this figure has numbers `{across}` and `{}`",
            limit.over
        ))),
        false => Ok(rows),
    }
}

/// Everything that the vertical axis has to cover.
fn values(bracket: &Bracket) -> Vec<f64> {
    let sides = bracket.sides.iter().flatten().copied();
    sides
        .chain(bracket.expected.iter().map(|(value, _)| *value))
        .collect()
}

fn largest(values: &[f64]) -> f64 {
    values
        .iter()
        .copied()
        .fold(0.0, |most: f64, value| most.max(value.abs()))
}

fn panel(limit: &Limit, across: &str, units: &[Unit; 2], (places, values): (&[f64], &[f64])) -> Panel {
    let scaled = |values: &[f64], unit: &Unit| -> Vec<f64> {
        values.iter().map(|value| value * unit.factor).collect()
    };
    let own = scaled(places, &units[0]);
    Panel::new(
        Axis {
            title: format!("{}{}", format::title_words(across), units[0].in_brackets()),
            scale: Scale::linear(own.iter().copied()).with_ticks_at(&own),
        },
        Axis {
            title: format!("{}{}", format::title_words(&limit.over), units[1].in_brackets()),
            scale: Scale::logarithmic(scaled(values, &units[1])),
        },
    )
}

/// Bars between the tried values on both sides, a line through the reference.
fn draw_row(panel: &mut Panel, row: &Row, [across, up]: [f64; 2]) {
    let Style { colour, marker, .. } = row.style;
    let expected: Vec<_> = row
        .brackets
        .iter()
        .filter_map(|(place, bracket)| Some((place, bracket.expected.as_ref().ok()?.0)))
        .map(|(place, value)| panel.at(place * across, value * up))
        .collect();
    panel
        .canvas
        .path(&expected, Stroke::solid(colour, theme::LINE_STROKE));
    for (place, bracket) in &row.brackets {
        let (Ok(sides), Some(middle)) = (&bracket.sides, bracket.middle()) else {
            continue;
        };
        let at = panel.at(place * across, middle * up);
        let ends = sides.map(|side| panel.up(side * up));
        let thin = Stroke::solid(colour, theme::THIN_STROKE);
        panel.canvas.line((at.0, ends[0]), (at.0, ends[1]), thin);
        for end in ends {
            panel
                .canvas
                .line((at.0 - theme::CAP, end), (at.0 + theme::CAP, end), thin);
        }
        panel.canvas.marker(marker, at, colour, 1.0);
        panel.canvas.take(Area::around(at, theme::MARKER));
    }
}

fn legend(rows: &[Row], limit: &Limit) -> Vec<Entry> {
    let entry = |row: &Row| Entry {
        label: match row.label.is_empty() {
            true => format::words(&limit.over),
            false => row.label.clone(),
        },
        style: row.style,
        markers: true,
        line: true,
        open: false,
    };
    rows.iter().map(entry).collect()
}

fn notes(rows: &[Row], limit: &Limit) -> Vec<String> {
    let all = || rows.iter().flat_map(|row| &row.brackets);
    let sources = distinct(
        all()
            .filter_map(|(_, bracket)| Some(bracket.expected.as_ref().ok()?.1.clone()))
            .collect(),
    );
    let mut notes = vec![format!(
        "Bars: from the last tried value at which {} is {} to the first at which it is not; lines: {}, {}.",
        format::words(&limit.of),
        crate::judge::words::band(&limit.band),
        format::words(&limit.against),
        sources.join("; ")
    )];
    let mut open: Vec<String> = all()
        .filter_map(|(_, bracket)| Some(format!("{}: {}.", bracket.label, bracket.sides.as_ref().err()?)))
        .collect();
    open.sort();
    notes.extend(open);
    notes
}

fn table(rows: &[Row], limit: &Limit, across: &str, [across_unit, over_unit]: [&str; 2]) -> Table {
    let over = &limit.over;
    let mut table = Table::new(&[
        "series",
        &format!("{across} [{across_unit}]"),
        &format!("last {over} inside [{over_unit}]"),
        &format!("first {over} outside [{over_unit}]"),
        &format!("{} [{over_unit}]", limit.against),
    ]);
    for row in rows {
        for (place, bracket) in &row.brackets {
            let sides = bracket.sides.as_ref().ok();
            table.rows.push(vec![
                Cell::Words(row.label.clone()),
                Cell::Number(*place),
                sides.map(|sides| sides[0]).into(),
                sides.map(|sides| sides[1]).into(),
                bracket.expected.as_ref().ok().map(|(value, _)| *value).into(),
            ]);
        }
    }
    table
}
