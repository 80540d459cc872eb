//! What a point takes beside what it took elsewhere.

use serde::Serialize;

use super::format;
use crate::store::model::{Run, Status};
use crate::study::model::Study;

/// In words.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Cost {
    published: String,
    source: String,
    rows: Vec<CostRow>,
}

/// Completed points of one scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct CostRow {
    scene: String,
    points: usize,
    mean: String,
    longest: String,
    ratio: String,
}

/// Nothing where the study names no published time or no point has completed.
pub fn of(study: &Study, runs: &[Run]) -> Option<Cost> {
    let published = study.published_time.as_ref()?;
    let row = |scene: &String| {
        let times: Vec<f64> = runs
            .iter()
            .filter(|run| run.status == Status::Completed && run.scene == *scene)
            .map(|run| run.timing.cpu)
            .collect();
        let mean = times.iter().sum::<f64>() / times.len() as f64;
        let ratio = match mean {
            mean if mean > 0.0 => format!("{} ×", two_digits(published.seconds / mean)),
            _ => "–".to_owned(),
        };
        (!times.is_empty()).then(|| CostRow {
            scene: format::words(scene),
            points: times.len(),
            mean: format::duration(mean),
            longest: format::duration(times.iter().copied().fold(0.0, f64::max)),
            ratio,
        })
    };
    let rows: Vec<CostRow> = study.scenes.iter().filter_map(row).collect();
    (!rows.is_empty()).then(|| Cost {
        published: format::duration(published.seconds),
        source: published.source.clone(),
        rows,
    })
}

/// More would say something of the machine only.
fn two_digits(ratio: f64) -> String {
    let scale = 10f64.powi(ratio.log10().floor() as i32 - 1);
    format::number((ratio / scale).round() * scale)
}
