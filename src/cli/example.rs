//! A small study without physics, for the tests of this room.

use std::path::PathBuf;

use serde_json::json;

use crate::study::model::{Axis, AxisValue, Plan, Point, Rehearsal, RehearsalEnding, Study, Work};

/// Two scenes, `fast` and `slow` (2 s), each with errors of 0.1 and 0.2.
pub fn study() -> Study {
    let errors = [0.1, 0.2];
    let scenes = [("fast", 0.0), ("slow", 2.0)];
    let pairs = scenes
        .iter()
        .flat_map(|scene| errors.map(|error| (*scene, error)));
    let points = pairs.enumerate().map(|(index, ((scene, delay), error))| Point {
        index,
        scene: scene.into(),
        axes: vec![("error".into(), AxisValue::Number(error))],
        seed: 1,
        settings: json!({"rehearsal": {"error": error, "order": 2.0}}),
        work: Work::Rehearsal(rehearsal(error, delay)),
    });
    Study {
        name: "example".into(),
        path: PathBuf::from("studies/example.yaml"),
        question: "Does it work?".into(),
        scenes: vec!["fast".into(), "slow".into()],
        axes: vec![Axis {
            name: "error".into(),
            unit: "1".into(),
            values: errors.map(AxisValue::Number).to_vec(),
            scenes: vec!["fast".into(), "slow".into()],
        }],
        seeds: vec![1],
        calibrated: Vec::new(),
        derive: Vec::new(),
        observe: vec!["limit".into()],
        expect: Vec::new(),
        figures: Vec::new(),
        published_time: None,
        plan: Plan {
            points: points.collect(),
        },
    }
}

fn rehearsal(error: f64, delay: f64) -> Rehearsal {
    Rehearsal {
        limit: 1.0,
        time_constant: 1.0,
        duration: 5.0,
        samples: 10,
        scale: 1.0,
        order: 2.0,
        error,
        grains: 0,
        delay,
        ending: RehearsalEnding::Completes,
    }
}
