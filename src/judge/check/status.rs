//! Every run ends in a way that is admitted; one that diverges says why.

use super::{Finding, Part, blank};
use crate::judge::model::PointVerdict;
use crate::judge::select::{Replicates, label};
use crate::store::model::{Run, Status};
use crate::study::model::Ending;

pub fn check(groups: &[Replicates], admitted: &[Ending]) -> Finding {
    let mut finding = Finding {
        source: "stated in the study".to_string(),
        ..Finding::default()
    };
    for group in groups {
        for run in &group.runs {
            let part = part(run, admitted);
            finding.points.push(PointVerdict {
                id: run.id.0.clone(),
                label: label(run),
                holds: part.decided(),
                ..blank(group)
            });
            finding.parts.push(part);
        }
    }
    finding
}

fn part(run: &Run, admitted: &[Ending]) -> Part {
    let ending = match run.status {
        Status::Completed => Ending::Completed,
        _ => Ending::Diverged,
    };
    let reason = run.reason.as_deref().unwrap_or_default();
    if !admitted.contains(&ending) {
        let why = match reason.is_empty() {
            true => String::new(),
            false => format!(": {reason}"),
        };
        return Part::fails(format!("{} {}{why}", label(run), run.status.name()));
    }
    match ending == Ending::Diverged && reason.is_empty() {
        true => Part::fails(format!("{} diverged without a reason", label(run))),
        false => Part::holds(),
    }
}
