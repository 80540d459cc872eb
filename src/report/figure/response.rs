//! A scalar over an axis: means over seeds with their scatter, references and published data beside.

mod beside;

use super::super::axis::Scale;
use super::super::canvas::{Area, Stroke};
use super::super::legend::Entry;
use super::super::panel::{Axis, Panel};
use super::super::theme::{self, Style};
use super::{Cell, Material, Plate, Table, distinct, lines};
use crate::judge::point_error::{Mean, mean_scalar};
use crate::judge::select::{Chain, Replicates, chains, gathered};
use crate::report::format::Unit;
use crate::report::{ReportError, format, selection};
use crate::study::model::Beside;
use beside::{Other, others};

pub struct Question<'a> {
    pub of: &'a str,
    pub over: &'a str,
    pub against: &'a [Beside],
}

/// An axis that spans more than this is logarithmic.
const DECADES: f64 = 30.0;
/// An abscissa that spans more than this is logarithmic beside a logarithmic ordinate.
const OCTAVES: f64 = 8.0;

/// Means along the axis, everything else fixed.
struct Curve<'a> {
    label: String,
    style: Style,
    points: Vec<(f64, Mean, Replicates<'a>)>,
}

pub fn draw(material: &Material, question: &Question, group: Option<&str>) -> Result<Plate, ReportError> {
    let (curves, heading) = curves(material, question, group)?;
    let others = others(material, question, &curves)?;
    let unit = curves[0].points[0].1.unit.clone();
    let (x_unit, y_unit) = units(material, question, &curves, &others, &unit);
    let mut panel = panel(question, &curves, &others, (&x_unit, &y_unit));
    panel.heading = heading;
    let factors = (x_unit.factor, y_unit.factor);
    let (lines, data): (Vec<&Other>, Vec<&Other>) = others.iter().partition(|other| other.line);
    for other in lines {
        draw_other(&mut panel, other, factors);
    }
    for curve in &curves {
        draw_curve(&mut panel, curve, factors);
    }
    for other in data {
        draw_other(&mut panel, other, factors);
    }
    let legend = legend(question, &curves, &others);
    let suggested = format!(
        "{} over {}",
        format::measure(question.of),
        format::title_words(question.over)
    );
    let title = material.title(&suggested);
    let count: usize = curves.iter().map(|curve| curve.points.len()).sum();
    let description = format!("{count} points on {} lines.", curves.len());
    let drawing = panel.finish(&legend, &material.id(), &title, &description)?;
    let table = table(material, question, &curves, &others, &unit);
    let notes = material.captioned(&suggested, notes(&curves, &others));
    Ok(material.plate(title, drawing, notes, table))
}

/// Means over seeds along the axis, and what the legend lists the values of.
fn curves<'a>(
    material: &Material<'a>,
    question: &Question,
    group: Option<&str>,
) -> Result<(Vec<Curve<'a>>, Option<String>), ReportError> {
    let groups = gathered(material.study, material.runs.clone());
    let chains = chains(material.study, material.all, &groups, question.over);
    if chains.is_empty() {
        return Err(ReportError(format!(
            "no run of this figure has a number `{}`: name a numeric axis",
            question.over
        )));
    }
    let firsts: Vec<_> = chains.iter().map(|chain| chain.steps[0].1.first()).collect();
    let varying = selection::varying(&firsts, &[question.over]);
    let by = match (group, varying.as_slice()) {
        (Some(name), _) => Some(name.to_owned()),
        (None, [name]) => Some(name.clone()),
        _ => None,
    };
    let mut seen: Vec<String> = Vec::new();
    let mut curves = Vec::new();
    for chain in chains {
        let first = chain.steps[0].1.first();
        let label = match &by {
            Some(name) => material.value(first, name),
            None => material.distinction(first, &varying),
        };
        let place = seen.iter().position(|other| *other == label).unwrap_or_else(|| {
            seen.push(label.clone());
            seen.len() - 1
        });
        let style = Style {
            dash: theme::SOLID,
            ..theme::style(place)
        };
        curves.push(curve(chain, question.of, label, style)?);
    }
    Ok((curves, by.as_deref().and_then(selection::heading)))
}

fn curve<'a>(chain: Chain<'a>, of: &str, label: String, style: Style) -> Result<Curve<'a>, ReportError> {
    let mut points = Vec::new();
    for (at, replicates) in chain.steps {
        let mean = mean_scalar(&replicates, of)
            .map_err(|why| ReportError(format!("{}: {why}", replicates.label())))?;
        points.push((at, mean, replicates));
    }
    Ok(Curve { label, style, points })
}

fn units(
    material: &Material,
    question: &Question,
    curves: &[Curve],
    others: &[Other],
    unit: &str,
) -> (Unit, Unit) {
    let drawn = || curves.iter().flat_map(|curve| &curve.points);
    let beside = || others.iter().flat_map(|other| &other.points);
    let across: Vec<f64> = drawn()
        .map(|point| point.0)
        .chain(beside().map(|point| point.0))
        .collect();
    let up: Vec<f64> = drawn()
        .map(|point| point.1.value)
        .chain(beside().map(|point| point.1))
        .collect();
    let axis = selection::axis_unit(material.study, question.over);
    (
        format::readable(axis, lines::largest(&across)),
        format::readable(unit, lines::largest(&up)),
    )
}

fn panel(question: &Question, curves: &[Curve], others: &[Other], (x_unit, y_unit): (&Unit, &Unit)) -> Panel {
    let mut across: Vec<f64> = Vec::new();
    let mut up: Vec<f64> = Vec::new();
    for (at, mean, _) in curves.iter().flat_map(|curve| &curve.points) {
        across.push(at * x_unit.factor);
        let scatter = mean.sample.deviation;
        up.extend([mean.value - scatter, mean.value + scatter].map(|end| end * y_unit.factor));
    }
    for (x, y) in others.iter().flat_map(|other| &other.points) {
        across.push(x * x_unit.factor);
        up.push(y * y_unit.factor);
    }
    let least = across.iter().copied().fold(f64::INFINITY, f64::min);
    let most = across.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let ordinate = ordinate(up);
    // Where the ordinate is logarithmic a power is a straight line only if the abscissa is so too.
    let enough = if ordinate.is_logarithmic() {
        OCTAVES
    } else {
        DECADES
    };
    let wide = least > 0.0 && most >= enough * least;
    let x = match wide {
        true => Scale::logarithmic(across.iter().copied()),
        false => Scale::linear(across.iter().copied()),
    };
    let own: Vec<f64> = curves
        .iter()
        .flat_map(|curve| curve.points.iter().map(|point| point.0 * x_unit.factor))
        .collect();
    let x = match others.iter().any(|other| !other.line) {
        true => x,
        false => x.with_ticks_at(&own),
    };
    Panel::new(
        Axis {
            title: format!("{}{}", format::title_words(question.over), x_unit.in_brackets()),
            scale: x,
        },
        Axis {
            title: format!("{}{}", format::measure(question.of), y_unit.in_brackets()),
            scale: ordinate,
        },
    )
}

/// Logarithmic where the values are positive and spread over more than [`DECADES`].
fn ordinate(values: Vec<f64>) -> Scale {
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    match least > 0.0 && most >= DECADES * least {
        true => Scale::logarithmic(values),
        false => Scale::linear(values),
    }
}

fn draw_curve(panel: &mut Panel, curve: &Curve, factors: (f64, f64)) {
    let Style { colour, marker, dash } = curve.style;
    let places: Vec<_> = curve
        .points
        .iter()
        .map(|(at, mean, _)| panel.at(at * factors.0, mean.value * factors.1))
        .collect();
    let stroke = Stroke {
        dash,
        ..Stroke::solid(colour, theme::LINE_STROKE)
    };
    panel.canvas.path(&places, stroke);
    for ((_, mean, _), at) in curve.points.iter().zip(&places) {
        if mean.sample.count > 1 {
            let ends =
                [-1.0, 1.0].map(|side| panel.up((mean.value + side * mean.sample.deviation) * factors.1));
            let thin = Stroke::solid(colour, theme::THIN_STROKE);
            panel.canvas.line((at.0, ends[0]), (at.0, ends[1]), thin);
            for end in ends {
                panel
                    .canvas
                    .line((at.0 - theme::CAP, end), (at.0 + theme::CAP, end), thin);
            }
        }
        panel.canvas.marker(marker, *at, colour, 1.0);
        panel.canvas.take(Area::around(*at, theme::MARKER));
    }
}

fn draw_other(panel: &mut Panel, other: &Other, factors: (f64, f64)) {
    let places: Vec<_> = other
        .points
        .iter()
        .map(|(x, y)| panel.at(x * factors.0, y * factors.1))
        .collect();
    let Style { colour, marker, dash } = other.style;
    if other.line {
        let stroke = Stroke {
            dash,
            ..Stroke::solid(colour, theme::LINE_STROKE)
        };
        return panel.canvas.path(&places, stroke);
    }
    for at in places {
        panel.canvas.open_marker(marker, at, colour);
    }
}

fn legend(question: &Question, curves: &[Curve], others: &[Other]) -> Vec<Entry> {
    // One line that the vertical axis names needs no legend.
    if curves.len() == 1 && curves[0].label.is_empty() && others.is_empty() {
        return Vec::new();
    }
    let mut entries: Vec<Entry> = Vec::new();
    for curve in curves {
        let label = match curve.label.is_empty() {
            true => format::words(question.of),
            false => curve.label.clone(),
        };
        if !entries.iter().any(|entry| entry.label == label) {
            entries.push(Entry {
                label,
                style: curve.style,
                markers: true,
                line: true,
                open: false,
            });
        }
    }
    for other in others {
        if !entries.iter().any(|entry| entry.label == other.label) {
            entries.push(Entry {
                label: other.label.clone(),
                style: other.style,
                markers: !other.line,
                line: other.line,
                open: !other.line,
            });
        }
    }
    entries
}

fn notes(curves: &[Curve], others: &[Other]) -> Vec<String> {
    let counts = curves
        .iter()
        .flat_map(|curve| curve.points.iter().map(|point| point.1.sample.count));
    let (least, most) = counts.fold((usize::MAX, 0), |(least, most), count| {
        (least.min(count), most.max(count))
    });
    let mut notes = Vec::new();
    if most > 1 {
        let count = match least == most {
            true => format!("{most}"),
            false => format!("{least} to {most}"),
        };
        notes.push(format!(
            "Means over {count} seeds; bars: ± one sample standard deviation."
        ));
    }
    let cited = |other: &Other| match other.source.is_empty() {
        true => String::new(),
        false => format!("{}: {}.", format::sentence(&other.label), other.source),
    };
    notes.extend(distinct(others.iter().map(cited).collect()));
    notes
}

fn table(material: &Material, question: &Question, curves: &[Curve], others: &[Other], unit: &str) -> Table {
    let over = format!(
        "{} [{}]",
        question.over,
        selection::axis_unit(material.study, question.over)
    );
    let of = format!("{} [{unit}]", question.of);
    let deviation = format!("sample standard deviation [{unit}]");
    let half_width = format!("95 % confidence half width [{unit}]");
    let mut table = Table::new(&["series", &over, &of, &deviation, &half_width, "seeds [1]"]);
    for curve in curves {
        for (at, mean, _) in &curve.points {
            let several = mean.sample.count > 1;
            table.rows.push(vec![
                Cell::Words(curve.label.clone()),
                Cell::Number(*at),
                Cell::Number(mean.value),
                Some(mean.sample.deviation).filter(|_| several).into(),
                Some(mean.sample.half_width()).filter(|_| several).into(),
                Cell::Number(mean.sample.count as f64),
            ]);
        }
    }
    for other in others {
        for (x, y) in &other.points {
            let mut row = vec![
                Cell::Words(other.label.clone()),
                Cell::Number(*x),
                Cell::Number(*y),
            ];
            row.extend([Cell::Empty, Cell::Empty, Cell::Empty]);
            table.rows.push(row);
        }
    }
    table
}
