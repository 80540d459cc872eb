//! What cannot be run, found before anything runs. Paths are below the kind of the scene.

pub use kynch_sim::scene::Fault;

use super::model::{Rehearsal, Work};

/// All faults of a scene; empty when it can run.
pub fn faults(work: &Work) -> Vec<Fault> {
    match work {
        Work::Simulation(scene) => kynch_sim::scene::check(scene),
        Work::Rehearsal(scene) => rehearsal(scene),
    }
}

fn rehearsal(scene: &Rehearsal) -> Vec<Fault> {
    let mut faults = Vec::new();
    let mut add = |path: &str, message: String, help: &str| {
        faults.push(Fault {
            path: path.to_owned(),
            message,
            help: help.to_owned(),
        });
    };
    for (path, value) in [
        ("time_constant", scene.time_constant),
        ("duration", scene.duration),
        ("scale", scene.scale),
    ] {
        if !(value > 0.0 && value.is_finite()) {
            add(
                path,
                format!("`{path}` is {value}, it must be above 0"),
                "write a positive number",
            );
        }
    }
    if !(2..=1_000_000).contains(&scene.samples) {
        let message = format!(
            "`samples` is {}, it must lie between 2 and 1000000",
            scene.samples
        );
        add("samples", message, "a hundred is plenty");
    }
    if !(0.0..=3600.0).contains(&scene.delay) {
        let message = format!("`delay` is {}, it must lie between 0 and 3600 s", scene.delay);
        add("delay", message, "write a shorter time");
    }
    faults
}
