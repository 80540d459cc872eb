//! Scenes in words: what is solved, what was left out, and the numbers that decide.

use std::fmt::Write;

use kynch_sim::scene::{Description, Observable, ObservableKind, describe, observables};

use super::console::Paint;
use super::magnitude::{count, number, size};
use super::selection::show;
use crate::study::model::{Point, Study, Work};

/// One scene of a study with all its points.
struct SceneInWords<'a> {
    name: &'a str,
    points: Vec<&'a Point>,
    descriptions: Vec<Description>,
    observables: Vec<Observable>,
}

/// The scenes of some points, in the order of the study.
fn scenes<'a>(study: &'a Study, points: &[&'a Point]) -> Vec<SceneInWords<'a>> {
    let scene = |name: &'a String| {
        let points: Vec<&Point> = points
            .iter()
            .copied()
            .filter(|point| point.scene == *name)
            .collect();
        let simulated = points.iter().filter_map(|point| match &point.work {
            Work::Simulation(scene) => Some(scene),
            Work::Rehearsal(_) => None,
        });
        SceneInWords {
            name,
            descriptions: simulated.clone().map(describe).collect(),
            observables: simulated.clone().next().map(observables).unwrap_or_default(),
            points,
        }
    };
    study
        .scenes
        .iter()
        .map(scene)
        .filter(|scene| !scene.points.is_empty())
        .collect()
}

/// For `plan`: what each scene compiles in, what it leaves out, how large it is.
pub fn compiled(study: &Study, points: &[&Point], paint: Paint) -> String {
    let mut text = String::new();
    for scene in scenes(study, points) {
        scene.heading(&mut text, paint);
        scene.equations(&mut text, paint);
        scene.extent(&mut text);
        scene.warnings(&mut text, paint);
    }
    text
}

/// For `explain`: the scenes in full.
pub fn explain(study: &Study, paint: Paint) -> String {
    let points: Vec<&Point> = study.plan.points.iter().collect();
    let mut text = format!("{}: {}\n", paint.bold(&study.name), study.question);
    for axis in &study.axes {
        let values: Vec<String> = axis.values.iter().map(show).collect();
        let _ = writeln!(
            text,
            "varies {}{}: {}  (in {})",
            axis.name,
            unit(&axis.unit),
            values.join(", "),
            axis.scenes.join(", ")
        );
    }
    for input in &study.calibrated {
        let path = input.path.get(1..).unwrap_or_default().join(".");
        let _ = writeln!(
            text,
            "calibrated {path} = {}{}: `{}` to `{}`  (in {})",
            show(&input.value),
            unit(&input.unit),
            input.of,
            input.against,
            input.scene
        );
    }
    for scene in scenes(study, &points) {
        scene.heading(&mut text, paint);
        scene.equations(&mut text, paint);
        scene.numbers(&mut text);
        scene.extent(&mut text);
        scene.can_be_asked_for(&mut text);
        scene.warnings(&mut text, paint);
    }
    text
}

/// ` [m]`, or nothing for a number without unit and for words.
pub fn unit(unit: &str) -> String {
    match unit {
        "" | "1" | "-" => String::new(),
        unit => format!(" [{unit}]"),
    }
}

impl SceneInWords<'_> {
    fn heading(&self, text: &mut String, paint: Paint) {
        let _ = write!(
            text,
            "\n{}: {}",
            paint.bold(self.name),
            count(self.points.len(), "point")
        );
        let rehearsed = self.points.len() - self.descriptions.len();
        text.push_str(if rehearsed > 0 {
            ", a rehearsal: known numbers, no physics\n"
        } else {
            "\n"
        });
    }

    fn equations(&self, text: &mut String, paint: Paint) {
        for line in distinct(
            self.descriptions
                .iter()
                .flat_map(|description| &description.active),
        ) {
            let _ = writeln!(text, "  {} {line}", paint.green("with"));
        }
        for line in distinct(
            self.descriptions
                .iter()
                .flat_map(|description| &description.left_out),
        ) {
            let _ = writeln!(text, "  {} {line}", paint.dim("without"));
        }
    }

    fn numbers(&self, text: &mut String) {
        let all = self
            .descriptions
            .iter()
            .flat_map(|description| &description.numbers);
        for name in distinct(all.clone().map(|(name, _, _)| name)) {
            let values = all.clone().filter(|(other, _, _)| other == name);
            let unit_text = unit(values.clone().next().map_or("", |(_, _, unit)| unit));
            let _ = writeln!(
                text,
                "  {name} = {}{unit_text}",
                range(values.map(|(_, value, _)| *value))
            );
        }
    }

    fn extent(&self, text: &mut String) {
        let range_of = |read: fn(&Description) -> f64| range(self.descriptions.iter().map(read));
        if let Some(memory) = self
            .descriptions
            .iter()
            .map(|description| description.memory)
            .max()
        {
            let _ = writeln!(
                text,
                "  {} fluid particles, {} grains, {} steps; up to {} of memory",
                range_of(|description| description.fluid_particles as f64),
                range_of(|description| description.grains as f64),
                range_of(|description| description.steps as f64),
                size(memory)
            );
        }
    }

    fn can_be_asked_for(&self, text: &mut String) {
        for observable in &self.observables {
            let kind = match observable.kind {
                ObservableKind::Scalar => "number",
                ObservableKind::Series => "series over time",
                ObservableKind::Profile => "profile",
            };
            let unit = unit(observable.unit);
            let _ = writeln!(
                text,
                "  observe {}{unit}: {}, {kind}",
                observable.name, observable.meaning
            );
        }
    }

    fn warnings(&self, text: &mut String, paint: Paint) {
        let warnings = self
            .descriptions
            .iter()
            .flat_map(|description| &description.warnings);
        for warning in distinct(warnings.clone()) {
            let points = warnings.clone().filter(|other| *other == warning).count();
            let _ = writeln!(
                text,
                "  {} {warning} ({})",
                paint.yellow("warning:"),
                count(points, "point")
            );
        }
    }
}

/// `0.0039`, or `0.0039 to 0.0042` where points differ.
fn range(values: impl Iterator<Item = f64>) -> String {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (low.min(value), high.max(value))
    });
    let (low, high) = (number(low), number(high));
    if low == high {
        low
    } else {
        format!("{low} to {high}")
    }
}

fn distinct<'a>(lines: impl Iterator<Item = &'a String>) -> Vec<&'a String> {
    let mut kept: Vec<&String> = Vec::new();
    for line in lines {
        if !kept.contains(&line) {
            kept.push(line);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::example;

    fn described(active: &[&str], reynolds: f64, warning: Option<&str>) -> Description {
        Description {
            active: active.iter().map(|line| line.to_string()).collect(),
            numbers: vec![("Re".into(), reynolds, "1")],
            warnings: warning.into_iter().map(String::from).collect(),
            fluid_particles: 10,
            memory: 3 << 20,
            ..Description::default()
        }
    }

    #[test]
    fn points_of_a_scene_share_lines_and_span_ranges() {
        let study = example::study();
        let scene = SceneInWords {
            name: "fast",
            points: study.plan.points.iter().take(2).collect(),
            descriptions: vec![
                described(&["drag"], 0.5, Some("coarse")),
                described(&["drag"], 0.25, None),
            ],
            observables: Vec::new(),
        };
        let paint = Paint { on: false };
        let mut text = String::new();
        scene.equations(&mut text, paint);
        scene.numbers(&mut text);
        scene.extent(&mut text);
        scene.warnings(&mut text, paint);
        let expected = "  with drag\n  Re = 0.25 to 0.5\n  10 fluid particles, 0 grains, 0 steps; \
                        up to 3 MiB of memory\n  warning: coarse (1 point)\n";
        assert_eq!(text, expected);
    }

    #[test]
    fn a_rehearsal_says_that_it_is_one() {
        let text = explain(&example::study(), Paint { on: false });
        assert!(text.contains("varies error: 0.1, 0.2  (in fast, slow)"), "{text}");
        assert!(text.contains("slow: 2 points, a rehearsal"), "{text}");
    }
}
