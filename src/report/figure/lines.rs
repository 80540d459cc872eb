//! Curves of many runs on one pair of axes: shared by time series and profiles.

use super::super::canvas::Stroke;
use super::super::legend::Entry;
use super::super::panel::Panel;
use super::super::theme::{self, Style};
use super::Material;
use crate::report::{format, selection};
use crate::store::model::Run;

/// One curve in SI units.
pub struct Line {
    pub x: Vec<f64>,
    pub y: Vec<f64>,
    pub style: Style,
    pub opacity: f64,
    /// Where markers sit on the line, as its `n`-th of several; `None` for none.
    pub markers: Option<usize>,
    /// Half width of the band around it, where it is a mean; along x for a profile.
    pub band: Option<Band>,
}

/// Scatter around a mean, in SI units.
pub struct Band {
    pub half: Vec<f64>,
    /// Whether it lies along x.
    pub across: bool,
}

impl Line {
    /// Edges of the band, or the line itself.
    fn edges(&self) -> [Vec<(f64, f64)>; 2] {
        [-1.0, 1.0].map(|side| {
            let half = |index: usize| self.band.as_ref().map_or(0.0, |band| side * band.half[index]);
            let across = self.band.as_ref().is_some_and(|band| band.across);
            let points = self.x.iter().zip(&self.y).enumerate();
            let moved = points.map(|(index, (x, y))| match across {
                true => (x + half(index), *y),
                false => (*x, y + half(index)),
            });
            moved.collect()
        })
    }

    /// Abscissae that the line and its band reach.
    pub fn all_x(&self) -> Vec<f64> {
        self.edges().concat().into_iter().map(|(x, _)| x).collect()
    }

    /// Ordinates that the line and its band reach.
    pub fn all_y(&self) -> Vec<f64> {
        self.edges().concat().into_iter().map(|(_, y)| y).collect()
    }
}

/// Markers on one line: enough to tell it, few enough to see the line.
const MARKERS: usize = 6;

/// One run's look: style, opacity and place among the marked lines.
pub type Look = (Style, f64, Option<usize>);

/// How the runs of a figure are told apart.
pub struct Looks {
    pub styles: Vec<Look>,
    pub legend: Vec<Entry>,
    /// The parameter whose values the legend lists.
    pub heading: Option<String>,
    /// Says what fading means, where lines fade.
    pub note: Option<String>,
}

/// Styles for the runs of a figure: one per group and quantity, or one per run where nothing groups
/// them. Within a group lines fade along the axis that varies.
pub fn looks(material: &Material, quantities: &[String], group: Option<&str>) -> Looks {
    let runs = &material.runs;
    let groups = selection::grouped(material.study, runs, group);
    let several = quantities.len() > 1;
    let by = single_parameter(runs, group).filter(|_| !several);
    let mut looks = Looks {
        styles: Vec::new(),
        legend: Vec::new(),
        heading: by.as_deref().and_then(selection::heading),
        note: None,
    };
    let mut styles = vec![None; runs.len() * quantities.len()];
    let mut next = 0;
    for (place, quantity) in quantities.iter().enumerate() {
        let called = if several {
            format::words(quantity)
        } else {
            String::new()
        };
        for members in &groups {
            let varying = varying_names(&members.runs, group);
            if group.is_none() {
                for run in &members.runs {
                    let label = match (&looks.heading, varying.as_slice()) {
                        (Some(_), [name]) => material.value(run, name),
                        _ => material.distinction(run, &varying),
                    };
                    let label = joined(&called, &label, &format::words(quantity));
                    styles[position(runs, run) + place * runs.len()] = Some((solid(next), 1.0, Some(next)));
                    looks.legend.push(marked(label, solid(next)));
                    next += 1;
                }
                continue;
            }
            for (index, run) in members.runs.iter().enumerate() {
                let marked = (index == 0).then_some(next);
                let look = (solid(next), theme::fade(index, members.runs.len()), marked);
                styles[position(runs, run) + place * runs.len()] = Some(look);
            }
            looks.note = looks.note.or_else(|| fading(material, &members.runs, &varying));
            let label = match looks.heading {
                Some(_) => &members.value,
                None => &members.label,
            };
            looks
                .legend
                .push(marked(joined(&called, label, "runs"), solid(next)));
            next += 1;
        }
    }
    looks.styles = styles
        .into_iter()
        .map(|look| look.unwrap_or((solid(0), 1.0, None)))
        .collect();
    looks
}

/// The one parameter by which a figure's lines differ in style.
fn single_parameter(runs: &[&Run], group: Option<&str>) -> Option<String> {
    if let Some(name) = group {
        return Some(name.to_owned());
    }
    match varying_names(runs, None).as_slice() {
        [name] => Some(name.clone()),
        _ => None,
    }
}

/// Axes that tell runs apart. An axis that moves along with an earlier one tells nothing more.
fn varying_names(runs: &[&Run], group: Option<&str>) -> Vec<String> {
    let names = selection::varying(runs, group.as_slice());
    let mut kept: Vec<String> = Vec::new();
    for name in names {
        let told_apart = |names: &[String]| {
            let mut seen: Vec<Vec<_>> = Vec::new();
            for run in runs {
                let values: Vec<_> = names.iter().map(|name| run.parameter(name)).collect();
                if !seen.contains(&values) {
                    seen.push(values);
                }
            }
            seen.len()
        };
        let mut longer = kept.clone();
        longer.push(name);
        if told_apart(&longer) > told_apart(&kept) {
            kept = longer;
        }
    }
    kept
}

fn fading(material: &Material, runs: &[&Run], varying: &[String]) -> Option<String> {
    let (first, last) = (runs.first()?, runs.last()?);
    (runs.len() > 1 && !varying.is_empty()).then(|| {
        let (first, last) = (
            material.distinction(first, varying),
            material.distinction(last, varying),
        );
        format!("Lines of one colour fade from {first} to {last}.")
    })
}

fn position(runs: &[&Run], run: &Run) -> usize {
    runs.iter()
        .position(|other| std::ptr::eq(*other, run))
        .unwrap_or(0)
}

fn joined(first: &str, second: &str, otherwise: &str) -> String {
    match (first, second) {
        ("", "") => otherwise.to_owned(),
        (first, "") => first.to_owned(),
        ("", second) => second.to_owned(),
        (first, second) => format!("{first}, {second}"),
    }
}

/// Curves are solid and carry markers: dashes on close curves run into each other, and mean the
/// reference.
fn solid(index: usize) -> Style {
    Style {
        dash: theme::SOLID,
        ..theme::style(index)
    }
}

fn marked(label: String, style: Style) -> Entry {
    Entry {
        label,
        style,
        markers: true,
        line: true,
        open: false,
    }
}

/// The reference's line in a legend.
pub fn reference_entry(label: String) -> Entry {
    Entry {
        label,
        style: reference_style(),
        markers: false,
        line: true,
        open: false,
    }
}

pub fn reference_style() -> Style {
    Style {
        colour: theme::INK,
        dash: theme::REFERENCE_DASH,
        marker: theme::Marker::Circle,
    }
}

/// Shades the band of a mean.
pub fn shade(panel: &mut Panel, line: &Line, factors: (f64, f64)) {
    if line.band.is_none() {
        return;
    }
    let [mut outline, back] = line.edges();
    outline.extend(back.into_iter().rev());
    let inside = |panel: &Panel, (x, y): (f64, f64)| {
        let finite = x.is_finite() && y.is_finite();
        finite && panel.x.scale.fraction(x * factors.0) < 1.0 + 1e-9
    };
    let corners = outline
        .into_iter()
        .filter(|place| inside(panel, *place))
        .map(|(x, y)| panel.at(x * factors.0, y * factors.1))
        .collect();
    panel.canvas.area(corners, line.style.colour, theme::BAND_OPACITY);
}

/// Draws one curve as far as the horizontal axis goes; values in SI, `factors` turn them into
/// displayed units.
pub fn draw(panel: &mut Panel, line: &Line, factors: (f64, f64)) {
    let points: Vec<_> = line
        .x
        .iter()
        .zip(&line.y)
        .filter(|(x, y)| x.is_finite() && y.is_finite())
        .filter(|(x, _)| panel.x.scale.fraction(**x * factors.0) < 1.0 + 1e-9)
        .map(|(x, y)| panel.at(x * factors.0, y * factors.1))
        .collect();
    let stroke = Stroke {
        colour: line.style.colour,
        width: theme::LINE_STROKE,
        dash: line.style.dash,
        opacity: line.opacity,
    };
    panel.canvas.path(&points, stroke);
    let Some(place) = line.markers else { return };
    // Staggered, so that the markers of curves that coincide stand side by side.
    let shift = (place * 2) % 5;
    for index in 0..MARKERS {
        let share = (index * 5 + shift + 1) as f64 / (5 * MARKERS) as f64;
        if let Some(at) = points.get((share * points.len() as f64) as usize) {
            panel
                .canvas
                .marker(line.style.marker, *at, line.style.colour, line.opacity);
        }
    }
}

/// Largest size among finite values.
pub fn largest<'a>(values: impl IntoIterator<Item = &'a f64>) -> f64 {
    values
        .into_iter()
        .filter(|value| value.is_finite())
        .fold(0.0, |most, value| value.abs().max(most))
}
