//! Numbers made of series, and what becomes of them.

use super::*;
use crate::judge::derive::derive;
use crate::study::model::{Coordinate, Derivation, Derived, Segment};

/// A run whose heights fall from 6 at 5 per second to 1.5, and rise from 0 at 1.
fn settling(seed: u64, noise: f64) -> Run {
    let mut run = seeded(&rehearse("a", 1.0, 0.0), seed, 2.0);
    let times: Vec<f64> = (0..200).map(|index| 0.01 * f64::from(index)).collect();
    let wave = |index: usize| noise * (1.7 * index as f64 + seed as f64).sin();
    let column = |name: &str, unit: &str, value: &dyn Fn(f64) -> f64| Column {
        name: name.to_string(),
        unit: unit.to_string(),
        values: times
            .iter()
            .enumerate()
            .map(|(index, time)| value(*time) + wave(index))
            .collect(),
    };
    let falling = |time: f64| (6.0 - 5.0 * time).max(1.5);
    run.tables[0].columns = vec![
        Column {
            name: "time".to_string(),
            unit: "s".to_string(),
            values: times.clone(),
        },
        column("interface", "m", &falling),
        column("front", "m", &|time| time),
        column("late", "m", &|time| if time < 0.5 { f64::NAN } else { time }),
    ];
    run
}

fn segment(window: [Option<f64>; 2], segments: usize, which: usize) -> Segment {
    Segment {
        window,
        segments,
        which,
    }
}

fn made(how: Derivation, unit: &str) -> Derived {
    Derived {
        name: "made".to_string(),
        unit: unit.to_string(),
        how,
    }
}

fn slope(of: &str, line: Segment) -> Derived {
    let of = of.to_string();
    made(
        Derivation::Slope {
            of,
            over: None,
            line,
            falling: true,
        },
        "m/s",
    )
}

fn derived(what: Derived, runs: &mut [Run], check: Check) -> Verdict {
    let mut study = study(vec![expectation(check)]);
    study.derive = vec![what];
    derive(&study, runs);
    judge(&study, runs).remove(0)
}

fn within(low: f64, high: f64) -> Check {
    Check::Value {
        of: "made".to_string(),
        band: Band {
            above: Some(low),
            below: Some(high),
        },
    }
}

#[test]
fn a_slope_a_breakpoint_and_a_crossing_are_found() {
    let whole = [None, None];
    let pair = || ["interface".to_string(), "front".to_string()];
    let crossing = |take| Derivation::Crossing {
        of: pair(),
        line: segment([None, Some(0.8)], 1, 1),
        take,
    };
    let breakpoint = Derivation::Breakpoint {
        of: "interface".to_string(),
        line: segment(whole, 2, 1),
    };
    let cases: [(Derived, &str, f64); 6] = [
        (
            slope("interface", segment([Some(0.1), Some(0.8)], 1, 1)),
            "m/s",
            5.0,
        ),
        (slope("interface", segment(whole, 2, 1)), "m/s", 5.0),
        (slope("late", segment(whole, 1, 1)), "m/s", -1.0),
        (made(breakpoint, "s"), "s", 0.9),
        (made(crossing(Coordinate::Time), "s"), "s", 1.0),
        (made(crossing(Coordinate::Value), "m"), "m", 1.0),
    ];
    for (what, unit, truth) in cases {
        let size = 0.01 * truth.abs();
        let verdict = derived(what, &mut [settling(1, 1e-3)], within(truth - size, truth + size));
        assert_eq!(verdict.verdict, Outcome::Holds, "{verdict:?}");
        assert_eq!(verdict.unit, unit);
        assert!(verdict.half_width.unwrap() > 0.0);
        assert!(
            reason(&verdict).contains("half width of the fit"),
            "{}",
            reason(&verdict)
        );
    }
}

#[test]
fn the_interval_of_one_fit_decides_until_seeds_tell_more() {
    let what = || slope("interface", segment([None, Some(0.8)], 1, 1));
    // Within its own interval of the limit.
    let open = derived(what(), &mut [settling(1, 0.3)], within(4.9, 5.003));
    assert_eq!(open.verdict, Outcome::NotDecidable, "{open:?}");
    assert!(
        reason(&open).contains("95 % confidence of the fit"),
        "{}",
        reason(&open)
    );
    let mut several: Vec<Run> = (1..=4).map(|seed| settling(seed, 1e-3)).collect();
    let verdict = derived(what(), &mut several, within(4.99, 5.01));
    assert_eq!(verdict.verdict, Outcome::Holds);
    assert!(reason(&verdict).contains("over seeds"), "{}", reason(&verdict));
}

#[test]
fn what_cannot_be_derived_says_why() {
    let verdict = derived(
        slope("interface", segment([Some(5.0), None], 1, 1)),
        &mut [settling(1, 0.0)],
        within(0.0, 1.0),
    );
    assert_eq!(verdict.verdict, Outcome::NotDecidable);
    assert!(
        reason(&verdict)
            .contains("`made` cannot be derived: `interface`: 0 samples for 1 segments, 5 are needed"),
        "{}",
        reason(&verdict)
    );
    let missing = derived(
        slope("surface", segment([None, None], 1, 1)),
        &mut [settling(1, 0.0)],
        within(0.0, 1.0),
    );
    assert!(reason(&missing).contains("no `surface`"), "{}", reason(&missing));
    let mut failed = settling(1, 0.0);
    failed.status = Status::Diverged;
    let mut runs = [failed];
    let mut study = study(Vec::new());
    study.derive = vec![slope("interface", segment([None, None], 1, 1))];
    derive(&study, &mut runs);
    assert!(runs[0].derived.is_empty());
}

#[test]
fn a_derived_number_is_a_scalar_of_the_run() {
    let mut runs = [settling(1, 0.0)];
    let mut study = study(Vec::new());
    study.derive = vec![slope("interface", segment([None, Some(0.8)], 1, 1))];
    derive(&study, &mut runs);
    let (value, unit) = runs[0].measure("made").unwrap();
    assert!((value - 5.0).abs() < 1e-9);
    assert_eq!(unit, "m/s");
}
