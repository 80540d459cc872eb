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
        tables: vec![Table {
            name: "time_series",
            columns: vec![column("time", "s", times), column("value", "m/s", values)],
        }],
        counters: Counters {
            steps: u64::from(reached),
            ..Counters::default()
        },
    }
}
