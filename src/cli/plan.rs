//! The plan as a table: each point, whether it will run and why, what it will cost.

use std::fmt::Write;
use std::time::Duration;

use kynch_sim::scene::describe;

use super::console::Paint;
use super::estimate::{Rate, together};
use super::magnitude::{count, number, time};
use super::physics::{compiled, unit};
use super::selection::show;
use super::table::Table;
use crate::runner::{Planned, State};
use crate::study::model::{Point, Study, Work};

/// The whole plan of a study in words.
pub fn plan(study: &Study, planned: &[Planned], rate: Rate, workers: usize, paint: Paint) -> String {
    let mut text = format!("{}: {}\n\n", paint.bold(&study.name), study.question);
    text.push_str(&table(study, planned, rate).render());
    let points: Vec<&Point> = planned.iter().map(|planned| &planned.point).collect();
    text.push_str(&compiled(study, &points, paint));
    text.push('\n');
    text.push_str(&totals(planned, rate, workers));
    text
}

fn table(study: &Study, planned: &[Planned], rate: Rate) -> Table {
    let several_seeds = planned
        .iter()
        .any(|other| other.point.seed != planned[0].point.seed);
    let mut header = vec!["point".to_string(), "scene".to_string()];
    header.extend(
        study
            .axes
            .iter()
            .map(|axis| format!("{}{}", axis.name, unit(&axis.unit))),
    );
    header.extend(several_seeds.then(|| "seed".to_string()));
    header.extend(["time".to_string(), "state".to_string()]);
    let mut table = Table::new(header);
    for Planned { point, state, .. } in planned {
        let mut cells = vec![point.index.to_string(), point.scene.clone()];
        for axis in &study.axes {
            let value = point.axes.iter().find(|(name, _)| *name == axis.name);
            cells.push(value.map_or("–".into(), |(_, value)| show(value)));
        }
        cells.extend(several_seeds.then(|| point.seed.to_string()));
        let due = matches!(state, State::Due(_));
        cells.push(if due {
            time(rate.time(&point.work))
        } else {
            "–".into()
        });
        cells.push(words(state));
        table.row(cells);
    }
    table
}

fn words(state: &State) -> String {
    match state {
        State::Cached => "cached".into(),
        State::Due(reason) => format!("due: {reason}"),
        State::LeftOut(reason) => format!("left out: {reason}"),
    }
}

fn totals(planned: &[Planned], rate: Rate, workers: usize) -> String {
    let due: Vec<&Work> = planned
        .iter()
        .filter(|planned| matches!(planned.state, State::Due(_)))
        .map(|planned| &planned.point.work)
        .collect();
    let cached = planned
        .iter()
        .filter(|planned| planned.state == State::Cached)
        .count();
    let left_out = planned.len() - due.len() - cached;
    let mut text = format!(
        "{}: {cached} cached, {} due, {left_out} left out\n",
        count(planned.len(), "point"),
        due.len()
    );
    if due.is_empty() {
        return text;
    }
    let times: Vec<(Duration, usize)> = due.iter().map(|work| (rate.time(work), work.threads())).collect();
    let work: f64 = due.iter().map(|work| particle_steps(work)).sum();
    let together = time(together(&times, workers));
    let _ = writeln!(
        text,
        "about {together} with {} at a time",
        count(workers, "point")
    );
    if work > 0.0 {
        let _ = writeln!(text, "work: {} particle-steps{}", number(work), origin(rate));
    }
    text
}

/// Where the times come from.
fn origin(rate: Rate) -> String {
    let speed = number(rate.speed);
    match rate.measured_on {
        0 => format!(", at an assumed {speed} per second and core: nothing was measured here yet"),
        runs => format!(
            ", at {speed} per second and core as measured on {}",
            count(runs, "earlier run")
        ),
    }
}

fn particle_steps(work: &Work) -> f64 {
    match work {
        Work::Simulation(scene) => describe(scene).work,
        Work::Rehearsal(_) => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::example;
    use crate::store::model::PointId;

    #[test]
    fn the_plan_says_what_runs_and_why() {
        let study = example::study();
        let states = [
            State::Cached,
            State::Due("new".into()),
            State::LeftOut("not in --only".into()),
            State::Due("settings changed".into()),
        ];
        let points = study.plan.points.iter().zip(states);
        let planned: Vec<Planned> = points
            .map(|(point, state)| Planned {
                point: point.clone(),
                id: PointId("0".into()),
                state,
            })
            .collect();
        let text = plan(&study, &planned, Rate::DEFAULT, 2, Paint { on: false });
        let expected = "example: Does it work?\n\n\
                        point  scene  error   time  state\n\
                        \x20   0  fast     0.1      –  cached\n\
                        \x20   1  fast     0.2  0.0 s  due: new\n\
                        \x20   2  slow     0.1      –  left out: not in --only\n\
                        \x20   3  slow     0.2  2.0 s  due: settings changed\n";
        assert!(text.starts_with(expected), "{text}");
        assert!(text.contains("4 points: 1 cached, 2 due, 1 left out\n"), "{text}");
        assert!(text.contains("about 2.0 s with 2 points at a time"), "{text}");
    }

    #[test]
    fn a_plan_without_points_is_still_a_plan() {
        let mut study = example::study();
        study.plan.points.clear();
        let text = plan(&study, &[], Rate::DEFAULT, 1, Paint { on: false });
        assert!(
            text.ends_with("0 points: 0 cached, 0 due, 0 left out\n"),
            "{text}"
        );
    }
}
