//! Pictures of the grains: side views of one point at chosen times, coloured by speed.

mod frame;

use super::super::canvas::{Canvas, Disc};
use super::super::colour_map;
use super::super::panel::Drawing;
use super::super::theme;
use super::{Cell, Material, Plate, Table};
use crate::report::{ReportError, format, selection};
use crate::store::model::Run;
use frame::{Bounds, Frame, Layout};

const TABLE: &str = "snapshots";

/// A grain at one instant, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Grain {
    number: f64,
    class: f64,
    place: [f64; 3],
    radius: f64,
    speed: f64,
    coordination: f64,
}

/// All grains at one kept instant.
struct Snapshot {
    time: f64,
    grains: Vec<Grain>,
}

pub fn draw(material: &Material, times: &[f64]) -> Result<Plate, ReportError> {
    let run = one_run(material)?;
    let shown = shown(run, times)?;
    let fastest = shown.iter().flat_map(|snapshot| &snapshot.grains);
    let fastest = fastest.map(|grain| grain.speed).fold(0.0, f64::max);
    let bounds = bounds(run, &shown);
    let layout = Layout::of(&bounds, shown.len());
    let mut canvas = Canvas::default();
    let moment = format::readable(
        "s",
        shown.iter().map(|snapshot| snapshot.time).fold(0.0, f64::max),
    );
    for (index, snapshot) in shown.iter().enumerate() {
        let time = format!(
            "{} {}",
            format::number(snapshot.time * moment.factor),
            moment.label
        );
        let frame = layout.frame(index);
        frame.draw(&mut canvas, &time);
        canvas.discs(discs(snapshot, &frame, fastest));
        frame.outline(&mut canvas);
    }
    layout.colour_bar(&mut canvas, fastest);
    let suggested = "grains from the side, coloured by speed";
    let title = material.title(suggested);
    let description = format!("{} panels of {} grains.", shown.len(), shown[0].grains.len());
    let drawing = Drawing::of(&canvas, layout.height(), &material.id(), &title, &description)?;
    let notes = material.captioned(suggested, notes(material, run, &shown));
    Ok(material.plate(title, drawing, notes, table(&shown)))
}

/// The run with the lowest seed of the one point there is.
pub(super) fn one_run<'a>(material: &Material<'a>) -> Result<&'a Run, ReportError> {
    let mut runs = material.runs.clone();
    runs.sort_by_key(|run| run.seed);
    let first = *runs.first().ok_or_else(|| ReportError("no run".to_owned()))?;
    match runs
        .iter()
        .find(|run| run.scene != first.scene || run.axes != first.axes)
    {
        None => Ok(first),
        Some(other) => Err(ReportError(format!(
            "these pictures show one point, but both {} and {} are selected: narrow `where`",
            selection::label(material.study, first),
            selection::label(material.study, other)
        ))),
    }
}

/// The kept instants nearest to those asked for, each once.
fn shown(run: &Run, times: &[f64]) -> Result<Vec<Snapshot>, ReportError> {
    let table = run.table(TABLE).filter(|table| !table.columns.is_empty());
    let missing = || {
        ReportError(format!(
            "run {} keeps no snapshots: ask the scene for some",
            run.id.0
        ))
    };
    let table = table.ok_or_else(missing)?;
    let column = |name: &str| {
        let column = table.column(name).map(|column| column.values.as_slice());
        column.ok_or_else(|| {
            ReportError(format!(
                "the snapshots of run {} have no column `{name}`",
                run.id.0
            ))
        })
    };
    let at = column("time")?;
    let names = [
        "grain",
        "class",
        "x",
        "y",
        "z",
        "radius",
        "speed_x",
        "speed_y",
        "speed_z",
        "coordination",
    ];
    let columns = names.map(column).into_iter().collect::<Result<Vec<_>, _>>()?;
    let mut kept = at.to_vec();
    kept.dedup();
    let nearest = |time: &f64| {
        let mut kept = kept.iter().copied();
        let first = kept.next()?;
        Some(kept.fold(first, |best, next| {
            match (next - time).abs() < (best - time).abs() {
                true => next,
                false => best,
            }
        }))
    };
    let mut chosen: Vec<f64> = times.iter().filter_map(nearest).collect();
    chosen.sort_by(f64::total_cmp);
    chosen.dedup();
    if chosen.is_empty() {
        return Err(missing());
    }
    let grain = |row: usize| {
        let value = |index: usize| columns[index][row];
        Grain {
            number: value(0),
            class: value(1),
            place: [value(2), value(3), value(4)],
            radius: value(5),
            speed: value(6).hypot(value(7)).hypot(value(8)),
            coordination: value(9),
        }
    };
    let snapshot = |time: f64| Snapshot {
        time,
        grains: (0..at.len()).filter(|row| at[*row] == time).map(grain).collect(),
    };
    Ok(chosen.into_iter().map(snapshot).collect())
}

/// The container where the settings tell it, else the box around the grains; grown to hold every grain.
fn bounds(run: &Run, shown: &[Snapshot]) -> Bounds {
    let scene = run.settings.as_object().and_then(|scenes| scenes.values().next());
    let side = |name: &str| scene?.get("container")?.get(name)?.as_f64();
    let mut bounds = match (side("width"), side("height")) {
        (Some(width), Some(height)) => Bounds {
            left: 0.0,
            right: width,
            low: 0.0,
            high: height,
        },
        _ => Bounds {
            left: f64::INFINITY,
            right: f64::NEG_INFINITY,
            low: 0.0,
            high: f64::NEG_INFINITY,
        },
    };
    for grain in shown.iter().flat_map(|snapshot| &snapshot.grains) {
        // Across a periodic side centres count, as a grain may stand on both.
        let margin = if side("width").is_some() {
            0.0
        } else {
            grain.radius
        };
        bounds.left = bounds.left.min(grain.place[0] - margin);
        bounds.right = bounds.right.max(grain.place[0] + margin);
        bounds.low = bounds.low.min(grain.place[2] - margin);
        bounds.high = bounds.high.max(grain.place[2] + margin);
    }
    bounds.sound()
}

/// Discs from the back to the front: the view is along the second axis.
fn discs(snapshot: &Snapshot, frame: &Frame, fastest: f64) -> Vec<Disc> {
    let mut grains: Vec<&Grain> = snapshot.grains.iter().collect();
    grains.sort_by(|one, other| other.place[1].total_cmp(&one.place[1]));
    grains
        .into_iter()
        .filter(|grain| grain.place.iter().all(|place| place.is_finite()))
        .map(|grain| Disc {
            at: frame.at(grain.place[0], grain.place[2]),
            radius: frame.length(grain.radius).max(theme::GRAIN_RADIUS),
            colour: colour_map::colour(if fastest > 0.0 { grain.speed / fastest } else { 0.0 }),
        })
        .collect()
}

fn notes(material: &Material, run: &Run, shown: &[Snapshot]) -> Vec<String> {
    let seeds = material.runs.len();
    let mut notes = vec![format!("Point: {}.", selection::label(material.study, run))];
    if seeds > 1 {
        notes.push(format!("One of {seeds} seeds."));
    }
    let grains = shown[0].grains.len();
    notes.push(format!(
        "{grains} grains, seen along y, nearer ones in front; kept instants nearest to those asked for."
    ));
    notes
}

fn table(shown: &[Snapshot]) -> Table {
    let mut table = Table::new(&[
        "time [s]",
        "grain [1]",
        "class [1]",
        "x [m]",
        "y [m]",
        "z [m]",
        "radius [m]",
        "speed [m/s]",
        "coordination [1]",
    ]);
    for snapshot in shown {
        for grain in &snapshot.grains {
            let [x, y, z] = grain.place;
            let row = [
                snapshot.time,
                grain.number,
                grain.class,
                x,
                y,
                z,
                grain.radius,
                grain.speed,
                grain.coordination,
            ];
            table.rows.push(row.map(Cell::Number).to_vec());
        }
    }
    table
}
