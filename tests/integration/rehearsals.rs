//! Studies without physics, built by hand.

use std::collections::BTreeMap;
use std::path::Path;

use kynch::study::model::{Axis, AxisValue, Plan, Point, Rehearsal, RehearsalEnding, Study, Work};

/// A rehearsal that takes no time and completes.
pub fn rehearsal(scale: f64) -> Rehearsal {
    Rehearsal {
        limit: 0.25,
        time_constant: 0.01,
        duration: 0.05,
        samples: 40,
        scale,
        order: 2.0,
        error: 0.03,
        grains: 0,
        delay: 0.0,
        ending: RehearsalEnding::Completes,
    }
}

pub fn settings(scene: &Rehearsal) -> serde_json::Value {
    let ending = match scene.ending {
        RehearsalEnding::Completes => "completes",
        RehearsalEnding::Diverges => "diverges",
        RehearsalEnding::Panics => "panics",
    };
    serde_json::json!({ "rehearsal": {
        "limit": scene.limit, "time_constant": scene.time_constant, "duration": scene.duration,
        "samples": scene.samples, "scale": scene.scale, "order": scene.order, "error": scene.error,
        "delay": scene.delay, "ending": ending,
    }})
}

/// One point per rehearsal, on the axis `scale`.
pub fn study(scenes: Vec<Rehearsal>) -> Study {
    let values: Vec<AxisValue> = scenes
        .iter()
        .map(|scene| AxisValue::Number(scene.scale))
        .collect();
    let points = scenes.into_iter().enumerate().map(|(index, scene)| Point {
        index,
        scene: "scene".into(),
        axes: vec![("scale".into(), AxisValue::Number(scene.scale))],
        seed: 1,
        settings: settings(&scene),
        work: Work::Rehearsal(scene),
    });
    Study {
        name: "rehearsed".into(),
        path: "studies/rehearsed.yaml".into(),
        question: "Does the harness work?".into(),
        scenes: vec!["scene".into()],
        axes: vec![Axis {
            name: "scale".into(),
            unit: "1".into(),
            values,
            scenes: vec!["scene".into()],
        }],
        seeds: vec![1],
        calibrated: Vec::new(),
        derive: Vec::new(),
        observe: vec!["limit".into(), "value".into()],
        expect: Vec::new(),
        figures: Vec::new(),
        published_time: None,
        plan: Plan {
            points: points.collect(),
        },
    }
}

/// Scales 1, 1.5, 2, …
pub fn scales(count: u32) -> Vec<Rehearsal> {
    (0..count)
        .map(|step| rehearsal(1.0 + 0.5 * f64::from(step)))
        .collect()
}

/// Every result file of a store with its bytes; timings, the manifest that lists them and the lock
/// are none.
pub fn results(store: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    for folder in ["", "series", "profiles", "pending"] {
        for entry in std::fs::read_dir(store.join(folder)).unwrap() {
            let path = entry.unwrap().path();
            let name = path.strip_prefix(store).unwrap().to_string_lossy().into_owned();
            let apart = ["timings.parquet", "manifest.blake3", ".lock"].contains(&name.as_str());
            if path.is_file() && !apart {
                files.insert(name, std::fs::read(&path).unwrap());
            }
        }
    }
    files
}
