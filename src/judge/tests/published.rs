//! Runs against published data: interpolation, norms, look-up and dimensions.

use serde_json::{Value, json};

use super::{error_below, one, reason};
use crate::judge::model::Outcome;
use crate::judge::point_error::point_error;
use crate::store::model::{Column, PointId, Run, Scalar, Status, Table, Timing};
use crate::study::model::Norm;

fn bead(times: Vec<f64>, velocities: Vec<f64>) -> Run {
    let column = |name: &str, unit: &str, values| Column {
        name: name.to_string(),
        unit: unit.to_string(),
        values,
    };
    Run {
        id: PointId("bead".to_string()),
        study: "beads".to_string(),
        scene: "bead".to_string(),
        axes: Vec::new(),
        seed: 1,
        settings: settings(1.5e-3),
        status: Status::Completed,
        reason: None,
        scalars: vec![
            scalar("terminal_velocity", "m/s", 0.2289),
            scalar("time_step", "s", 1e-3),
        ],
        counters: Vec::new(),
        tables: vec![Table {
            name: "time_series".to_string(),
            columns: vec![column("time", "s", times), column("velocity", "m/s", velocities)],
        }],
        derived: Vec::new(),
        timing: Timing::default(),
    }
}

fn scalar(name: &str, unit: &str, value: f64) -> Scalar {
    Scalar {
        name: name.to_string(),
        unit: unit.to_string(),
        value,
    }
}

fn settings(diameter: f64) -> Value {
    json!({"single_sphere": {"grains": {"diameter": diameter, "density": 2560.0},
        "fluid": {"still": {"density": 1000.0, "viscosity": 8.9e-4}}}})
}

const CURVE: &str = "mordant_pinton_2000_velocity";

/// The fit behind the data, sampled where the data are not.
fn fitted(factor: f64) -> Run {
    let times: Vec<f64> = (0..1000).map(|index| 3.1e-4 * f64::from(index)).collect();
    let fit = |time: &f64| factor * 0.218 * (1.0 - (-3.0 * time / 0.142).exp());
    let velocities = times.iter().map(fit).collect();
    bead(times, velocities)
}

fn error(run: &Run, against: &str, norm: Norm) -> Result<f64, String> {
    let of = if against == CURVE {
        "velocity"
    } else {
        "terminal_velocity"
    };
    let found = point_error(run, of, against, norm).map_err(|undecided| undecided.0)?;
    Ok(found.error)
}

#[test]
fn a_run_is_interpolated_at_the_times_of_the_data() {
    for norm in [Norm::Maximum, Norm::RootMeanSquare] {
        assert!(error(&fitted(1.0), CURVE, norm).unwrap() < 1e-4);
    }
    // Off by a tenth everywhere: the largest deviation is where the curve is highest.
    assert!((error(&fitted(1.1), CURVE, Norm::Maximum).unwrap() - 0.1).abs() < 1e-4);
    let mean = error(&fitted(1.1), CURVE, Norm::RootMeanSquare).unwrap();
    assert!(mean > 0.06 && mean < 0.1, "{mean}");
}

#[test]
fn only_what_lies_within_the_run_is_compared() {
    // Right until 50 ms, where the run ends: later data say nothing of it.
    let whole = fitted(1.0);
    let columns = &whole.tables[0].columns;
    let kept = columns[0].values.iter().filter(|time| **time < 0.05).count();
    let cut = |column: &Column| column.values[..kept].to_vec();
    let short = bead(cut(&columns[0]), cut(&columns[1]));
    assert!(error(&short, CURVE, Norm::Maximum).unwrap() < 2e-4);
    let late = bead(vec![1.0, 2.0], vec![0.2, 0.2]);
    assert_eq!(
        error(&late, CURVE, Norm::Maximum).unwrap_err(),
        format!("no point of the reference `{CURVE}` lies within the run, 1 to 2 s")
    );
}

#[test]
fn a_scalar_is_looked_up_and_an_absent_row_is_no_verdict() {
    let run = fitted(1.0);
    let found = error(&run, "mordant_pinton_2000_terminal", Norm::Maximum).unwrap();
    assert!((found - 0.05).abs() < 1e-12, "{found}");
    let other = Run {
        settings: settings(1e-3),
        ..run
    };
    let told = error(&other, "mordant_pinton_2000_terminal", Norm::Maximum).unwrap_err();
    assert!(told.ends_with("there are 0.0005, 0.0008, 0.0015 m"), "{told}");
}

#[test]
fn a_speed_is_not_compared_with_a_time() {
    assert_eq!(
        error(&fitted(1.0), "mordant_pinton_2000_time", Norm::Maximum).unwrap_err(),
        "`terminal_velocity` is a speed (m/s), the reference `mordant_pinton_2000_time` is a time (s)"
    );
    // Solutions have a dimension too.
    let found = point_error(&fitted(1.0), "time_step", "terminal_velocity", Norm::Maximum);
    assert!(found.is_err());
}

/// A bed settled in the fluid of a row of the data, which give 0.6056.
fn bed(seed: u64, solids_fraction: f64) -> Run {
    Run {
        id: PointId(format!("bed-{seed}")),
        seed,
        settings: json!({"sedimentation": {"fluid": {"still": {"density": 1005.1, "viscosity": 1e-3}}}}),
        scalars: vec![scalar("solids_fraction", "1", solids_fraction)],
        ..bead(Vec::new(), Vec::new())
    }
}

#[test]
fn the_mean_over_seeds_is_held_to_a_published_value() {
    let judged = |fractions: &[f64], below| {
        let runs: Vec<Run> = fractions
            .iter()
            .zip(1..)
            .map(|(&fraction, seed)| bed(seed, fraction))
            .collect();
        one(error_below("solids_fraction", "dong_2006", below), &runs)
    };
    // Every seed is off by more than 1 %, their mean is not.
    let around = [0.5956, 0.6156, 0.5976, 0.6146, 0.5966, 0.6136];
    assert!(
        around
            .iter()
            .all(|one| judged(&[*one], 0.01).verdict == Outcome::Fails)
    );
    let verdict = judged(&around, 0.03);
    assert_eq!(verdict.verdict, Outcome::Holds, "{}", reason(&verdict));
    assert_eq!(verdict.points.len(), 1);
    assert_eq!(verdict.expected, Some(0.6056));
    assert!((verdict.computed.unwrap() - 0.6056).abs() < 1e-12);
    assert!(verdict.half_width.unwrap() > 0.0);
    assert!(verdict.source.contains("Dong"), "{}", verdict.source);
    // The interval of the mean reaches past 1 %: more seeds are needed.
    assert_eq!(judged(&around, 0.01).verdict, Outcome::NotDecidable);
    let loose = around.map(|fraction| fraction - 0.06);
    assert_eq!(judged(&loose, 0.03).verdict, Outcome::Fails);
}
