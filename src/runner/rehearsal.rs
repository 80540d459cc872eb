//! The scene without physics: a known series, a wait, and an end of one's choice.

use std::time::{Duration, Instant};

use kynch_sim::outcome::{Column, Control, Counters, Failure, FailureKind, Outcome, Scalar, Table};

use crate::study::model::{Rehearsal, RehearsalEnding};

/// How long it sleeps before it asks again whether to stop.
const SLICE: Duration = Duration::from_millis(2);

pub(super) fn run(scene: &Rehearsal, control: &Control) -> Result<Outcome, Box<Failure>> {
    if !wait(scene.delay, control) {
        return Err(Box::new(Failure {
            kind: FailureKind::Stopped,
            reason: "stopped from outside".into(),
            partial: Outcome::default(),
        }));
    }
    match scene.ending {
        RehearsalEnding::Completes => Ok(outcome(scene, scene.samples)),
        RehearsalEnding::Diverges => {
            let reached = scene.samples / 2;
            Err(Box::new(Failure {
                kind: FailureKind::Diverged,
                reason: format!("value is not finite at sample {reached} of {}", scene.samples),
                partial: outcome(scene, reached),
            }))
        }
        RehearsalEnding::Panics => panic!("a rehearsed panic"),
    }
}

/// Spends real time; false when told to stop.
fn wait(seconds: f64, control: &Control) -> bool {
    let whole = Duration::try_from_secs_f64(seconds.max(0.0)).unwrap_or(Duration::MAX);
    let start = Instant::now();
    loop {
        if (control.stop)() {
            return false;
        }
        let left = whole.saturating_sub(start.elapsed());
        if left.is_zero() {
            return true;
        }
        (control.progress)(start.elapsed().as_secs_f64() / whole.as_secs_f64());
        std::thread::sleep(left.min(SLICE));
    }
}

/// The first `reached` samples and what follows from them.
fn outcome(scene: &Rehearsal, reached: u32) -> Outcome {
    let limit = scene.limit * (1.0 + scene.error * scene.scale.powf(scene.order));
    let last = f64::from(scene.samples.saturating_sub(1).max(1));
    let times: Vec<f64> = (0..reached)
        .map(|sample| scene.duration * f64::from(sample) / last)
        .collect();
    let values = times
        .iter()
        .map(|time| limit * -(-time / scene.time_constant).exp_m1())
        .collect();
    let column = |name, unit, values| Column { name, unit, values };
    let scalar = |name, unit, value| Scalar { name, unit, value };
    Outcome {
        scalars: vec![scalar("limit", "m/s", limit), scalar("scale", "1", scene.scale)],
        tables: std::iter::once(Table {
            name: "time_series",
            columns: vec![column("time", "s", times), column("value", "m/s", values)],
        })
        .chain((scene.grains > 0).then(|| snapshots(scene, limit, reached)))
        .collect(),
        counters: Counters {
            steps: u64::from(reached),
            ..Counters::default()
        },
    }
}

/// Instants at which the grains are kept.
const KEPT: u32 = 11;
/// Radii of the grains, in turn [m].
const RADII: [f64; 3] = [100e-6, 125e-6, 150e-6];
/// Distance between the places of grains on the floor [m].
const PITCH: f64 = 310e-6;

/// Grains in layers above the floor, each falling at the series' speed onto its place in the lattice.
fn snapshots(scene: &Rehearsal, limit: f64, reached: u32) -> Table {
    let columns = [
        ("time", "s"),
        ("grain", "1"),
        ("class", "1"),
        ("x", "m"),
        ("y", "m"),
        ("z", "m"),
        ("radius", "m"),
        ("speed_x", "m/s"),
        ("speed_y", "m/s"),
        ("speed_z", "m/s"),
        ("coordination", "1"),
    ];
    let mut values: Vec<Vec<f64>> = vec![Vec::new(); columns.len()];
    let share = f64::from(reached) / f64::from(scene.samples.max(1));
    let side = f64::from(scene.grains).cbrt().ceil() as u32;
    for kept in 0..KEPT {
        let time = scene.duration * f64::from(kept) / f64::from(KEPT - 1);
        if time > share * scene.duration {
            break;
        }
        for grain in 0..scene.grains {
            let (column, row, layer) = (grain % side, grain / side % side, grain / (side * side));
            let place = |index: u32| (f64::from(index) + 0.5) * PITCH;
            // Higher layers begin higher and arrive later.
            let arrival = scene.duration * (0.5 + 0.4 * f64::from(layer) / f64::from(side));
            let left = (1.0 - time / arrival).max(0.0);
            let speed = match left > 0.0 {
                true => -limit * -(-time / scene.time_constant).exp_m1(),
                false => 0.0,
            };
            let height = place(layer) * (1.0 + 2.0 * left);
            let kind = grain as usize % RADII.len();
            let touching = if left > 0.0 { 0.0 } else { 6.0 };
            let row = [
                time,
                f64::from(grain),
                kind as f64,
                place(column),
                place(row),
                height,
                RADII[kind],
                0.0,
                0.0,
                speed,
                touching,
            ];
            for (column, value) in values.iter_mut().zip(row) {
                column.push(value);
            }
        }
    }
    let columns = columns.into_iter().zip(values);
    Table {
        name: "snapshots",
        columns: columns
            .map(|((name, unit), values)| Column { name, unit, values })
            .collect(),
    }
}
