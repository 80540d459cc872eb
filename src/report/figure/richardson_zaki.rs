//! Settling velocity over the porosity on logarithmic axes: measured points with their scatter, the fitted
//! power with its confidence band, correlations and a reference beside.

use super::super::axis::Scale;
use super::super::canvas::{Area, Stroke};
use super::super::legend::Entry;
use super::super::panel::{Axis, Panel};
use super::super::theme::{self, Marker, Style};
use super::settling::{Suspension, fastest, suspensions};
use super::{Cell, Material, Plate, Table, cited, lines};
use crate::judge::check::fit::correlations_of;
use crate::judge::fit::richardson_zaki::{self, RichardsonZaki, Scale as Deviations};
use crate::report::format::Unit;
use crate::report::{ReportError, format};
use crate::study::model::FittedLaw;

/// Points of a drawn curve.
const POINTS: usize = 60;

/// A suspension with its law.
struct Fitted<'a> {
    suspension: Suspension<'a>,
    law: RichardsonZaki,
    /// Reference velocities at its porosities; empty without a reference.
    reference: Vec<f64>,
}

/// A correlation's exponent.
struct Correlation {
    author: String,
    exponent: f64,
}

pub fn draw(
    material: &Material,
    law: &FittedLaw,
    against: Option<&str>,
    group: Option<&str>,
) -> Result<Plate, ReportError> {
    let (found, heading) = suspensions(material, &law.of, &law.over, group)?;
    let unit = found[0].unit().to_owned();
    let velocity = format::readable(&unit, fastest(&found));
    let mut sources = Vec::new();
    let mut fitted = Vec::new();
    for suspension in found {
        fitted.push(fit(material, suspension, law, against, &mut sources)?);
    }
    let correlations = match fitted.as_slice() {
        [only] => correlations(only),
        _ => Vec::new(),
    };
    let mut panel = panel(law, &fitted, &velocity);
    panel.heading = heading;
    let porosities = span(&fitted);
    for (index, correlation) in correlations.iter().enumerate() {
        let speed = |porosity: f64| fitted[0].law.velocity.value * porosity.powf(correlation.exponent);
        let stroke = Stroke {
            dash: thin(index).dash,
            ..Stroke::solid(theme::SOFT, theme::THIN_STROKE)
        };
        let places = curve(&panel, &porosities, velocity.factor, speed);
        panel.canvas.path(&places, stroke);
    }
    for one in &fitted {
        draw_one(&mut panel, one, &porosities, velocity.factor);
    }
    let legend = legend(&fitted, &correlations, law, against);
    let suggested = format!(
        "{} over {}",
        format::measure(&law.of),
        format::title_words(&law.over)
    );
    let title = material.title(&suggested);
    let description = format!("{} fitted powers on logarithmic axes.", fitted.len());
    let drawing = panel.finish(&legend, &material.id(), &title, &description)?;
    let mut notes: Vec<String> = fitted.iter().map(|one| told(one, &unit)).collect();
    notes.push("Bands: 95 % confidence of the fitted line.".to_owned());
    if fitted
        .iter()
        .any(|one| one.suspension.points.iter().any(|point| point.1.sample.count > 1))
    {
        notes.push("Points: means over seeds; bars: ± one sample standard deviation.".to_owned());
    }
    if !correlations.is_empty() {
        notes.push(
            "Thin lines: exponents of correlations, from the fitted velocity at porosity 1.".to_owned(),
        );
    }
    if let Some(name) = against {
        notes.push(format!("Dashed: {}.", cited(name, &[], &unit, sources)));
    }
    let table = table(law, &fitted, &unit);
    Ok(material.plate(title, drawing, material.captioned(&suggested, notes), table))
}

fn fit<'a>(
    material: &Material,
    suspension: Suspension<'a>,
    law: &FittedLaw,
    against: Option<&str>,
    sources: &mut Vec<String>,
) -> Result<Fitted<'a>, ReportError> {
    let scale = match law.linear {
        true => Deviations::Linear,
        false => Deviations::Logarithmic,
    };
    let fitted = richardson_zaki::fit(&suspension.porosities(), &suspension.velocities(), scale);
    let fitted = fitted.map_err(|why| ReportError(format!("no power can be fitted: {why}")))?;
    let mut reference = Vec::new();
    if let Some(name) = against {
        for (_, _, replicates) in &suspension.points {
            let found = (material.numbers.error)(replicates.first(), &law.of, name).map_err(ReportError)?;
            reference.extend(found.expected);
            sources.push(found.source);
        }
    }
    Ok(Fitted {
        suspension,
        law: fitted,
        reference,
    })
}

fn correlations(only: &Fitted) -> Vec<Correlation> {
    let found = correlations_of(only.suspension.points[0].2.first());
    found
        .into_iter()
        .map(|(author, exponent)| Correlation { author, exponent })
        .collect()
}

/// Porosities of drawn curves.
fn span(fitted: &[Fitted]) -> Vec<f64> {
    let all = || fitted.iter().flat_map(|one| one.suspension.porosities());
    let low = all().fold(f64::INFINITY, f64::min);
    let high = all().fold(f64::NEG_INFINITY, f64::max);
    let step = (high / low).ln() / (POINTS - 1) as f64;
    (0..POINTS)
        .map(|index| low * (step * index as f64).exp())
        .collect()
}

fn panel(law: &FittedLaw, fitted: &[Fitted], velocity: &Unit) -> Panel {
    let porosities: Vec<f64> = fitted
        .iter()
        .flat_map(|one| one.suspension.porosities())
        .collect();
    let mut up = Vec::new();
    for one in fitted {
        for (porosity, mean, _) in &one.suspension.points {
            let low = mean.value - mean.sample.deviation;
            up.extend(
                [low, mean.value + mean.sample.deviation]
                    .into_iter()
                    .chain(one.law.band(*porosity)),
            );
        }
        up.extend(&one.reference);
    }
    let up = up.into_iter().map(|value| value * velocity.factor);
    Panel::new(
        Axis {
            title: format::title_words(&law.over),
            scale: Scale::logarithmic_tight(porosities),
        },
        Axis {
            title: format!("{}{}", format::measure(&law.of), velocity.in_brackets()),
            scale: Scale::logarithmic(up),
        },
    )
}

fn curve(panel: &Panel, porosities: &[f64], factor: f64, speed: impl Fn(f64) -> f64) -> Vec<(i32, i32)> {
    let inside = |value: f64| (0.0..=1.0).contains(&panel.y.scale.fraction(value));
    let points = porosities
        .iter()
        .map(|porosity| (*porosity, speed(*porosity) * factor));
    points
        .filter(|point| inside(point.1))
        .map(|(x, y)| panel.at(x, y))
        .collect()
}

fn draw_one(panel: &mut Panel, one: &Fitted, porosities: &[f64], factor: f64) {
    let Style { colour, marker, .. } = one.suspension.style;
    let side = |panel: &Panel, side: usize| {
        curve(panel, porosities, factor, |porosity| one.law.band(porosity)[side])
    };
    let mut outline = side(panel, 0);
    outline.extend(side(panel, 1).into_iter().rev());
    panel.canvas.area(outline, colour, theme::BAND_OPACITY);
    let line = curve(panel, porosities, factor, |porosity| one.law.at(porosity));
    panel
        .canvas
        .path(&line, Stroke::solid(colour, theme::LINE_STROKE));
    let reference: Vec<_> = one
        .suspension
        .points
        .iter()
        .zip(&one.reference)
        .map(|((porosity, ..), value)| panel.at(*porosity, value * factor))
        .collect();
    let dashed = Stroke {
        dash: theme::REFERENCE_DASH,
        ..Stroke::solid(theme::INK, theme::LINE_STROKE)
    };
    panel.canvas.path(&reference, dashed);
    for (porosity, mean, _) in &one.suspension.points {
        let at = panel.at(*porosity, mean.value * factor);
        let low = mean.value - mean.sample.deviation;
        if mean.sample.count > 1 && low > 0.0 {
            let ends = [low, mean.value + mean.sample.deviation].map(|end| panel.up(end * factor));
            let stroke = Stroke::solid(colour, theme::THIN_STROKE);
            panel.canvas.line((at.0, ends[0]), (at.0, ends[1]), stroke);
            for end in ends {
                panel
                    .canvas
                    .line((at.0 - theme::CAP, end), (at.0 + theme::CAP, end), stroke);
            }
        }
        panel.canvas.marker(marker, at, colour, 1.0);
        panel.canvas.take(Area::around(at, theme::MARKER));
    }
}

/// Of the correlation named at this place.
fn thin(index: usize) -> Style {
    Style {
        colour: theme::SOFT,
        marker: Marker::Circle,
        dash: theme::style(index + 1).dash,
    }
}

fn legend(
    fitted: &[Fitted],
    correlations: &[Correlation],
    law: &FittedLaw,
    against: Option<&str>,
) -> Vec<Entry> {
    let mut entries: Vec<Entry> = fitted
        .iter()
        .map(|one| {
            let called = match one.suspension.label.is_empty() {
                true => format::words(&law.of),
                false => one.suspension.label.clone(),
            };
            Entry {
                label: format!("{called}: n = {}", exponent(&one.law)),
                style: one.suspension.style,
                markers: true,
                line: true,
                open: false,
            }
        })
        .collect();
    if let Some(name) = against {
        entries.push(lines::reference_entry(format!(
            "reference ({})",
            format::words(name)
        )));
    }
    let beside = correlations.iter().enumerate().map(|(index, correlation)| Entry {
        label: format!(
            "{}: n = {}",
            correlation.author,
            format::number(correlation.exponent)
        ),
        style: thin(index),
        markers: false,
        line: true,
        open: false,
    });
    entries.extend(beside);
    entries
}

fn exponent(law: &RichardsonZaki) -> String {
    format::plus_minus(law.exponent.value, law.exponent.half_width())
}

fn told(one: &Fitted, unit: &str) -> String {
    let velocity = format::measured(one.law.velocity.value, Some(one.law.velocity.half_width()), unit);
    let called = match one.suspension.label.is_empty() {
        true => String::new(),
        false => format!("{}: ", format::sentence(&one.suspension.label)),
    };
    format!(
        "{called}n = {}, {velocity} at porosity 1 (95 % confidence).",
        exponent(&one.law)
    )
}

fn table(law: &FittedLaw, fitted: &[Fitted], unit: &str) -> Table {
    let named = |name: &str| format!("{name} [{unit}]");
    let mut table = Table::new(&[
        "series",
        &format!("{} [1]", law.over),
        &named(&law.of),
        &named("sample standard deviation"),
        &named("fitted"),
        &named("band from"),
        &named("band to"),
        &named("reference"),
    ]);
    for one in fitted {
        for (index, (porosity, mean, _)) in one.suspension.points.iter().enumerate() {
            let [low, high] = one.law.band(*porosity);
            table.rows.push(vec![
                Cell::Words(one.suspension.label.clone()),
                Cell::Number(*porosity),
                Cell::Number(mean.value),
                Some(mean.sample.deviation)
                    .filter(|_| mean.sample.count > 1)
                    .into(),
                Cell::Number(one.law.at(*porosity)),
                Cell::Number(low),
                Cell::Number(high),
                one.reference.get(index).copied().into(),
            ]);
        }
    }
    table
}
