//! Kynch's flux curve φ v(φ): the curve of a reference, measured points, and the chords of the shocks between
//! each operating point and the deposit, whose slope is the speed of the deposit's front.
//!
//! Source: Kynch (1952), Trans. Faraday Soc. 48, 166.

use serde_json::Value;

use super::super::axis::Scale;
use super::super::canvas::{Area, Stroke};
use super::super::legend::Entry;
use super::super::panel::{Axis, Panel};
use super::super::theme::{self, Style};
use super::settling::{Suspension, suspensions};
use super::{Cell, Material, Plate, Table, cited, lines};
use crate::judge::point_error::mean_scalar;
use crate::reference::{self, Facts};
use crate::report::format::Unit;
use crate::report::{ReportError, format};

pub struct Question<'a> {
    pub of: &'a str,
    pub over: &'a str,
    pub against: &'a str,
    pub deposit: Option<&'a str>,
}

/// Points of the curve.
const POINTS: usize = 120;
/// Setting of a scene that holds its porosity.
const POROSITY: &str = "porosity";
/// Where the curve ends without a deposit: loose packing.
const LOOSE: f64 = 0.6;

/// A suspension with its curve and its deposits.
struct Settling<'a> {
    suspension: Suspension<'a>,
    /// Fraction and flux.
    curve: Vec<(f64, f64)>,
    /// One per point; none without a deposit.
    deposits: Vec<f64>,
}

pub fn draw(material: &Material, question: &Question, group: Option<&str>) -> Result<Plate, ReportError> {
    let (found, heading) = suspensions(material, question.of, question.over, group)?;
    let unit = found[0].unit().to_owned();
    let mut sources = Vec::new();
    let mut all = Vec::new();
    for suspension in found {
        all.push(settling(question, suspension, &mut sources)?);
    }
    let fluxes: Vec<f64> = all
        .iter()
        .flat_map(|one| one.curve.iter().map(|point| point.1))
        .collect();
    let flux = format::readable(&unit, lines::largest(&fluxes));
    let mut panel = panel(&all, &flux);
    panel.heading = heading;
    for one in &all {
        draw_one(&mut panel, one, flux.factor, all.len());
    }
    let legend = legend(&all, question);
    let suggested = format!("flux of solids by {}", format::measure(question.of));
    let title = material.title(&suggested);
    let description = format!("{} flux curves with measured points.", all.len());
    let drawing = panel.finish(&legend, &material.id(), &title, &description)?;
    let mut notes = vec![format!(
        "Curve: fraction times velocity of {}.",
        cited(question.against, &[], &unit, sources)
    )];
    if question.deposit.is_some() {
        notes.push(
            "Chords run from each operating point to the deposit it leaves; their slope is the speed at which \
             the deposit's front rises."
                .to_owned(),
        );
    }
    let table = table(&all, question, &unit);
    Ok(material.plate(title, drawing, material.captioned(&suggested, notes), table))
}

fn settling<'a>(
    question: &Question,
    suspension: Suspension<'a>,
    sources: &mut Vec<String>,
) -> Result<Settling<'a>, ReportError> {
    let mut deposits = Vec::new();
    if let Some(name) = question.deposit {
        for (_, _, replicates) in &suspension.points {
            let mean = mean_scalar(replicates, name);
            let mean = mean.map_err(|why| ReportError(format!("{}: {why}", replicates.label())))?;
            deposits.push(mean.value);
        }
    }
    let densest = suspension.porosities().into_iter().fold(1.0, f64::min);
    let end = deposits
        .iter()
        .copied()
        .fold(LOOSE.max(1.0 - densest), f64::max)
        .min(0.74);
    let run = suspension.points[0].2.first();
    let scalars = |name: &str| run.scalar(name).map(|scalar| scalar.value);
    let mut curve = vec![(0.0, 0.0)];
    for index in 1..=POINTS {
        let fraction = end * index as f64 / POINTS as f64;
        let mut settings = run.settings.clone();
        if !set(&mut settings, POROSITY, 1.0 - fraction) {
            let message = format!("the scene of run {} has no `{POROSITY}` to vary", run.id.0);
            return Err(ReportError(message));
        }
        let facts = Facts {
            settings: &settings,
            scalars: &scalars,
        };
        let expected = reference::scalar(question.against, &facts).map_err(|why| ReportError(why.0))?;
        curve.push((fraction, fraction * expected.values[0]));
        sources.push(expected.source);
    }
    Ok(Settling {
        suspension,
        curve,
        deposits,
    })
}

/// Replaces the first number of that name in a tree of settings; whether there is one.
fn set(tree: &mut Value, name: &str, value: f64) -> bool {
    let Some(fields) = tree.as_object_mut() else {
        return false;
    };
    if let Some(number) = fields.get_mut(name).filter(|found| found.is_number()) {
        *number = value.into();
        return true;
    }
    fields.values_mut().any(|branch| set(branch, name, value))
}

impl Settling<'_> {
    /// Measured fraction, flux and scatter of the flux.
    fn measured(&self) -> Vec<(f64, f64, f64)> {
        let points = self.suspension.points.iter();
        points
            .map(|(porosity, mean, _)| {
                let fraction = 1.0 - porosity;
                (fraction, fraction * mean.value, fraction * mean.sample.deviation)
            })
            .collect()
    }
}

fn panel(all: &[Settling], flux: &Unit) -> Panel {
    let across = all.iter().flat_map(|one| {
        let measured = one.measured().into_iter().map(|point| point.0);
        one.curve
            .iter()
            .map(|point| point.0)
            .chain(measured)
            .chain(one.deposits.clone())
            .collect::<Vec<_>>()
    });
    let up = all.iter().flat_map(|one| {
        let measured = one.measured().into_iter().map(|point| point.1 + point.2);
        one.curve
            .iter()
            .map(|point| point.1)
            .chain(measured)
            .collect::<Vec<_>>()
    });
    Panel::new(
        Axis {
            title: "solids fraction".to_owned(),
            scale: Scale::linear(across),
        },
        Axis {
            title: format!("flux of solids{}", flux.in_brackets()),
            scale: Scale::linear(up.map(|value| value * flux.factor)),
        },
    )
}

fn draw_one(panel: &mut Panel, one: &Settling, factor: f64, count: usize) {
    let Style { colour, marker, .. } = one.suspension.style;
    let curve: Vec<_> = one.curve.iter().map(|(x, y)| panel.at(*x, y * factor)).collect();
    let of_curve = if count > 1 { colour } else { theme::INK };
    panel
        .canvas
        .path(&curve, Stroke::solid(of_curve, theme::LINE_STROKE));
    let measured = one.measured();
    for ((fraction, flux, _), deposit) in measured.iter().zip(&one.deposits) {
        let stroke = Stroke {
            dash: theme::BOUND_DASH,
            ..Stroke::solid(colour, theme::THIN_STROKE)
        };
        let ends = (panel.at(*fraction, flux * factor), panel.at(*deposit, 0.0));
        panel.canvas.line(ends.0, ends.1, stroke);
        panel.canvas.open_marker(marker, ends.1, colour);
    }
    for (fraction, flux, scatter) in measured {
        let at = panel.at(fraction, flux * factor);
        if scatter > 0.0 {
            let stroke = Stroke::solid(colour, theme::THIN_STROKE);
            let ends = [flux - scatter, flux + scatter].map(|end| panel.up(end * factor));
            panel.canvas.line((at.0, ends[0]), (at.0, ends[1]), stroke);
        }
        panel.canvas.marker(marker, at, colour, 1.0);
        panel.canvas.take(Area::around(at, theme::MARKER));
    }
}

fn legend(all: &[Settling], question: &Question) -> Vec<Entry> {
    let mut entries = Vec::new();
    for one in all {
        let label = match one.suspension.label.is_empty() {
            true => format::words(question.of),
            false => one.suspension.label.clone(),
        };
        entries.push(Entry {
            label,
            style: one.suspension.style,
            markers: true,
            line: all.len() > 1,
            open: false,
        });
    }
    if let [only] = all {
        entries.push(Entry {
            label: format!("reference ({})", format::words(question.against)),
            style: Style {
                colour: theme::INK,
                ..only.suspension.style
            },
            markers: false,
            line: true,
            open: false,
        });
        if question.deposit.is_some() {
            entries.push(Entry {
                label: "shock to the deposit".to_owned(),
                style: Style {
                    dash: theme::BOUND_DASH,
                    ..only.suspension.style
                },
                markers: true,
                line: true,
                open: true,
            });
        }
    }
    entries
}

fn table(all: &[Settling], question: &Question, unit: &str) -> Table {
    let flux = format!("flux [{unit}]");
    let chord = format!("speed of the front [{unit}]");
    let head = ["series", "solids fraction [1]", &flux, "deposit [1]", &chord];
    let mut table = Table::new(&head);
    for one in all {
        for (index, (fraction, flux, _)) in one.measured().into_iter().enumerate() {
            let deposit = one.deposits.get(index).copied();
            let label = match one.suspension.label.is_empty() {
                true => format::words(question.of),
                false => one.suspension.label.clone(),
            };
            table.rows.push(vec![
                Cell::Words(label),
                Cell::Number(fraction),
                Cell::Number(flux),
                deposit.into(),
                deposit.map(|deposit| flux / (deposit - fraction)).into(),
            ]);
        }
        for (fraction, flux) in &one.curve {
            let label = format!("reference ({})", format::words(question.against));
            let cells = [
                Cell::Number(*fraction),
                Cell::Number(*flux),
                Cell::Empty,
                Cell::Empty,
            ];
            table
                .rows
                .push(std::iter::once(Cell::Words(label)).chain(cells).collect());
        }
    }
    table
}
