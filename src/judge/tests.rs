mod derived;
mod fitted;
mod limits;
mod published;

use super::exit::exit_code;
use super::point_error::point_error;
use super::*;
use crate::store::model::{Column, PointId, Scalar, Status, Table, Timing};
use crate::study::model::{
    Axis, AxisValue, Band, Comparison, Norm, Plan, Point, Rehearsal, RehearsalEnding, Relation, Work,
};
use proptest::prelude::*;
use serde_json::json;

const LIMIT: f64 = 2.0;
const TIME_CONSTANT: f64 = 0.1;

/// A rehearsal's run: its limit and series are off by `error` · scale^2.
fn rehearse(scene: &str, scale: f64, error: f64) -> Run {
    let value = LIMIT * (1.0 + error * scale * scale);
    let times: Vec<f64> = (0..50).map(|index| 0.02 * index as f64).collect();
    let series = times
        .iter()
        .map(|time| value * (1.0 - (-time / TIME_CONSTANT).exp()));
    let column = |name: &str, unit: &str, values: Vec<f64>| Column {
        name: name.to_string(),
        unit: unit.to_string(),
        values,
    };
    let scalar = |name: &str, value: f64| Scalar {
        name: name.to_string(),
        unit: "m/s".to_string(),
        value,
    };
    Run {
        id: PointId(format!("{scene}-{scale}-{error}")),
        study: "rehearsal".to_string(),
        scene: scene.to_string(),
        axes: vec![("scale".to_string(), AxisValue::Number(scale))],
        seed: 1,
        settings: json!({"rehearsal": {"limit": LIMIT, "time_constant": TIME_CONSTANT, "scale": scale}}),
        status: Status::Completed,
        reason: None,
        scalars: vec![scalar("limit", value), scalar("scale", scale)],
        counters: vec![("steps".to_string(), 50)],
        tables: vec![Table {
            name: "time_series".to_string(),
            columns: vec![
                column("value", "m/s", series.collect()),
                column("time", "s", times),
            ]
            .into_iter()
            .rev()
            .collect(),
        }],
        derived: Vec::new(),
        timing: Timing::default(),
    }
}

fn seeded(run: &Run, seed: u64, limit: f64) -> Run {
    let mut run = run.clone();
    run.id = PointId(format!("{}-{seed}", run.id.0));
    run.seed = seed;
    run.scalars[0].value = limit;
    run
}

fn expectation(check: Check) -> Expectation {
    Expectation {
        id: "it".to_string(),
        check,
        selection: Selection::default(),
        claims: vec!["claim".to_string()],
        informative: None,
    }
}

fn study(expect: Vec<Expectation>) -> Study {
    Study {
        name: "rehearsal".to_string(),
        path: "rehearsal.yaml".into(),
        question: "?".to_string(),
        scenes: vec!["a".to_string(), "b".to_string()],
        axes: Vec::<Axis>::new(),
        seeds: vec![1],
        calibrated: Vec::new(),
        derive: Vec::new(),
        observe: Vec::new(),
        expect,
        figures: Vec::new(),
        published_time: None,
        plan: Plan::default(),
    }
}

fn planned(run: &Run) -> Point {
    Point {
        index: 0,
        scene: run.scene.clone(),
        axes: run.axes.clone(),
        seed: run.seed,
        settings: run.settings.clone(),
        work: Work::Rehearsal(Rehearsal {
            limit: LIMIT,
            time_constant: TIME_CONSTANT,
            duration: 1.0,
            samples: 50,
            scale: 1.0,
            order: 2.0,
            error: 0.0,
            grains: 0,
            delay: 0.0,
            ending: RehearsalEnding::Completes,
        }),
    }
}

fn one(check: Check, runs: &[Run]) -> Verdict {
    judge(&study(vec![expectation(check)]), runs).remove(0)
}

fn error_below(of: &str, against: &str, below: f64) -> Check {
    Check::Error {
        of: of.to_string(),
        against: against.to_string(),
        below,
        norm: Norm::Maximum,
    }
}

fn limit_below(below: f64) -> Check {
    error_below("limit", "known_limit", below)
}

fn order_two() -> Check {
    Check::Order {
        of: "limit".to_string(),
        against: "known_limit".to_string(),
        over: "scale".to_string(),
        is: 2.0,
        within: 0.1,
    }
}

fn monotone(rising: bool) -> Check {
    Check::Monotone {
        of: "limit".to_string(),
        over: "scale".to_string(),
        rising,
        within_noise: false,
    }
}

fn ladder(error: f64) -> Vec<Run> {
    [1.0, 2.0, 4.0].map(|scale| rehearse("a", scale, error)).to_vec()
}

fn reason(verdict: &Verdict) -> &str {
    verdict.reason.as_deref().unwrap_or("")
}

#[test]
fn the_worst_point_decides_an_error() {
    let runs = ladder(0.001);
    let holding = one(limit_below(0.017), &runs);
    assert_eq!(holding.verdict, Outcome::Holds);
    assert!((holding.error.unwrap() - 0.016).abs() < 1e-12);
    assert_eq!(holding.expected, Some(LIMIT));
    assert_eq!(
        holding.statement,
        "relative error of `limit` against the reference `known_limit` < 1.7 %"
    );
    assert_eq!((holding.band.as_str(), holding.unit.as_str()), ("< 0.017", "m/s"));
    let failing = one(limit_below(0.01), &runs);
    assert_eq!(failing.verdict, Outcome::Fails);
    assert!(reason(&failing).contains("scene=a scale=4"), "{failing:?}");
    let holds: Vec<_> = failing.points.iter().map(|point| point.holds).collect();
    assert_eq!(holds, [Some(true), Some(true), Some(false)]);
    assert_eq!(failing.claims, ["claim"]);
}

#[test]
fn a_name_of_a_series_and_its_last_value_is_compared_as_the_reference_is() {
    let mut run = rehearse("scene", 1.0, 0.01);
    let series = point_error(&run, "value", "known_series", Norm::Maximum).unwrap();
    run.scalars.push(Scalar {
        name: "value".to_string(),
        unit: "m/s".to_string(),
        value: 0.5 * LIMIT,
    });
    let beside_a_curve = point_error(&run, "value", "known_series", Norm::Maximum).unwrap();
    assert_eq!(beside_a_curve, series);
    let beside_a_value = point_error(&run, "value", "known_limit", Norm::Maximum).unwrap();
    assert_eq!(beside_a_value.error, 0.5);
}

#[test]
fn a_series_is_judged_by_its_largest_deviation() {
    let run = rehearse("a", 1.0, 0.01);
    let error = point_error(&run, "value", "known_series", Norm::Maximum).unwrap();
    assert!((error.error - 0.01).abs() < 1e-12, "{error:?}");
    let series = error_below("value", "known_series", 0.02);
    assert_eq!(one(series, &[run]).verdict, Outcome::Holds);
}

#[test]
fn values_lie_in_bands() {
    let runs = ladder(0.0);
    let outcome = |above, below| {
        let band = Band { above, below };
        one(
            Check::Value {
                of: "limit".to_string(),
                band,
            },
            &runs,
        )
        .verdict
    };
    assert_eq!(outcome(Some(1.9), Some(2.1)), Outcome::Holds);
    assert_eq!(outcome(Some(2.0), Some(2.0)), Outcome::Holds);
    assert_eq!(outcome(None, Some(2.0)), Outcome::Fails);
    assert_eq!(outcome(Some(2.0), None), Outcome::Fails);
    assert_eq!(outcome(Some(1.9), None), Outcome::Holds);
    let steps = Check::Value {
        of: "steps".to_string(),
        band: Band {
            above: None,
            below: Some(51.0),
        },
    };
    assert_eq!(one(steps, &runs).verdict, Outcome::Holds);
}

#[test]
fn orders_are_observed_or_refused() {
    let verdict = one(order_two(), &ladder(0.001));
    assert_eq!(verdict.verdict, Outcome::Holds);
    assert!((verdict.computed.unwrap() - 2.0).abs() < 1e-9);
    assert_eq!(verdict.band, "1.9 to 2.1");

    let few = one(order_two(), &ladder(0.001)[..2]);
    assert_eq!(few.verdict, Outcome::NotDecidable);
    assert!(reason(&few).contains("needs three"));

    let mut oscillating = ladder(0.001);
    oscillating[1].scalars[0].value = LIMIT * 0.996;
    let verdict = one(order_two(), &oscillating);
    assert_eq!(verdict.verdict, Outcome::NotDecidable);
    assert!(reason(&verdict).contains("sign"));

    let mut first_order = ladder(0.001);
    for run in &mut first_order {
        let AxisValue::Number(scale) = run.axes[0].1 else {
            unreachable!()
        };
        run.scalars[0].value = LIMIT * (1.0 + 0.001 * scale);
    }
    let verdict = one(order_two(), &first_order);
    assert_eq!(verdict.verdict, Outcome::Fails);
    assert!((verdict.computed.unwrap() - 1.0).abs() < 1e-9);
}

#[test]
fn trends_rise_or_fall() {
    let runs = ladder(0.001);
    assert_eq!(one(monotone(true), &runs).verdict, Outcome::Holds);
    let falling = one(monotone(false), &runs);
    assert_eq!(falling.verdict, Outcome::Fails);
    assert!(reason(&falling).contains("goes from"));
    assert_eq!(one(monotone(true), &ladder(0.0)).verdict, Outcome::Fails);
    assert_eq!(one(monotone(true), &runs[..1]).verdict, Outcome::NotDecidable);
}

#[test]
fn axes_that_move_along_are_not_held_fixed() {
    let mut runs = ladder(0.001);
    for (run, width) in runs.iter_mut().zip([4.5, 4.0, 4.2]) {
        run.axes.push(("width".to_string(), AxisValue::Number(width)));
    }
    assert_eq!(one(order_two(), &runs).verdict, Outcome::Holds);
    // A free axis starts a chain of its own for each of its values.
    let mut free = Vec::new();
    for (width, error) in [(1.0, 0.001), (2.0, -0.001)] {
        for mut run in ladder(error) {
            run.axes.push(("width".to_string(), AxisValue::Number(width)));
            free.push(run);
        }
    }
    let verdict = one(monotone(true), &free);
    assert_eq!(verdict.verdict, Outcome::Fails);
    assert_eq!(one(order_two(), &free).verdict, Outcome::Holds);
}

#[test]
fn selections_go_by_scene_axis_and_setting() {
    let mut runs = ladder(0.001);
    runs.push(rehearse("b", 1.0, 0.5));
    let verdict = |selection: Selection| {
        let expectation = Expectation {
            selection,
            ..expectation(limit_below(0.01))
        };
        judge(&study(vec![expectation]), &runs).remove(0)
    };
    let number = |name: &str, value: f64| (name.to_string(), vec![AxisValue::Number(value)]);
    let in_a = Selection {
        scenes: vec!["a".to_string()],
        axes: vec![(
            "scale".to_string(),
            vec![AxisValue::Number(1.0), AxisValue::Number(2.0 + 1e-12)],
        )],
    };
    assert_eq!(verdict(in_a).points.len(), 2);
    let by_setting = Selection {
        scenes: Vec::new(),
        axes: vec![number("time_constant", TIME_CONSTANT)],
    };
    assert_eq!(verdict(by_setting).points.len(), 4);
    let nowhere = verdict(Selection {
        scenes: Vec::new(),
        axes: vec![number("scale", 9.0)],
    });
    assert_eq!(nowhere.verdict, Outcome::NotDecidable);
    assert!(
        reason(&nowhere).contains("`scale` under `where`"),
        "{}",
        reason(&nowhere)
    );
}

#[test]
fn failed_runs_never_enter_and_keep_a_statement_open() {
    let mut runs = ladder(0.001);
    runs[2].status = Status::Diverged;
    runs[2].scalars[0].value = 99.0;
    let verdict = one(limit_below(0.01), &runs);
    assert_eq!(verdict.verdict, Outcome::NotDecidable);
    assert!(reason(&verdict).contains("scale=4"));
    assert_eq!(verdict.points.len(), 2);
    assert_eq!(one(limit_below(0.002), &runs).verdict, Outcome::Fails);
    for run in &mut runs {
        run.status = Status::Panicked;
    }
    assert!(reason(&one(limit_below(0.01), &runs)).contains("none of the 3"));
    assert!(reason(&one(limit_below(0.01), &[])).contains("run the study"));
}

#[test]
fn planned_points_without_a_run_keep_a_statement_open() {
    let runs = ladder(0.001);
    let mut study = study(vec![expectation(limit_below(0.1))]);
    study.plan.points = runs.iter().map(planned).collect();
    assert_eq!(judge(&study, &runs)[0].verdict, Outcome::Holds);
    let verdict = judge(&study, &runs[..2]).remove(0);
    assert_eq!(verdict.verdict, Outcome::NotDecidable);
    assert!(reason(&verdict).contains("scale=4"));
}

#[test]
fn missing_observables_and_wrong_references_are_reported() {
    let runs = ladder(0.001);
    let missing = one(error_below("speed", "known_limit", 0.1), &runs);
    assert_eq!(missing.verdict, Outcome::NotDecidable);
    assert!(reason(&missing).contains("`speed`") && reason(&missing).contains("observe"));
    let wrong = one(error_below("limit", "force_balance", 0.1), &runs);
    assert_eq!(wrong.verdict, Outcome::NotDecidable);
    let mut broken = ladder(0.001);
    broken[0].scalars[0].value = f64::NAN;
    assert_eq!(one(limit_below(0.1), &broken).verdict, Outcome::NotDecidable);
}

/// One point with a run per limit.
fn scattered(scene: &str, scale: f64, limits: &[f64]) -> Vec<Run> {
    let base = rehearse(scene, scale, 0.0);
    limits
        .iter()
        .zip(1..)
        .map(|(&limit, seed)| seeded(&base, seed, limit))
        .collect()
}

#[test]
fn noise_over_seeds_that_straddles_the_limit_decides_nothing() {
    // Mean 2.02, standard error 0.00577: the 95 % interval is ± 0.0248, relative ± 0.0124.
    let runs = scattered("a", 1.0, &[2.01, 2.03, 2.02]);
    let outcome = |below| one(limit_below(below), &runs);
    assert_eq!(outcome(0.011).verdict, Outcome::NotDecidable);
    assert_eq!(outcome(0.02).verdict, Outcome::NotDecidable);
    let certain = scattered("a", 1.0, &[2.0201, 2.0203, 2.0202]);
    assert_eq!(one(limit_below(0.005), &certain).verdict, Outcome::Fails);
    let holds = outcome(0.025);
    assert_eq!(holds.verdict, Outcome::Holds);
    assert_eq!(holds.points.len(), 1);
    assert!((holds.computed.unwrap() - 2.02).abs() < 1e-12);
    assert!((holds.half_width.unwrap() - 0.0248).abs() < 1e-4);
    assert_eq!(holds.points[0].half_width, holds.half_width);
    assert!(holds.points[0].label.ends_with("seeds=1,2,3"));
    assert!(reason(&holds).contains("95 % confidence"));
}

#[test]
fn a_value_is_judged_by_its_mean_and_the_interval_around_it() {
    let runs = scattered("a", 1.0, &[2.01, 2.03, 2.02]);
    let value = |above, below| {
        let of = "limit".to_string();
        let band = Band { above, below };
        one(Check::Value { of, band }, &runs)
    };
    // Each single run beyond the bound, or not: the mean counts.
    assert_eq!(value(None, Some(2.05)).verdict, Outcome::Holds);
    assert_eq!(value(None, Some(2.04)).verdict, Outcome::NotDecidable);
    assert_eq!(value(None, Some(2.0)).verdict, Outcome::NotDecidable);
    assert_eq!(value(None, Some(1.99)).verdict, Outcome::Fails);
    assert_eq!(value(Some(1.9), Some(2.1)).verdict, Outcome::Holds);
    let open = value(Some(2.0), Some(2.1));
    assert_eq!(open.verdict, Outcome::NotDecidable);
    assert!(reason(&open).contains("2.02 ± 0.0248"), "{}", reason(&open));
    assert_eq!(
        (
            exit_code(std::slice::from_ref(&open), false),
            exit_code(&[open], true)
        ),
        (0, 1)
    );
}

#[test]
fn a_trend_may_stand_still_within_the_noise_of_its_seeds() {
    let trend = |limits: &[[f64; 3]], within_noise| {
        let runs: Vec<Run> = limits
            .iter()
            .zip([1.0, 2.0, 4.0, 8.0, 16.0])
            .flat_map(|(limits, scale)| scattered("a", scale, limits))
            .collect();
        let check = Check::Monotone {
            of: "limit".to_string(),
            over: "scale".to_string(),
            rising: true,
            within_noise,
        };
        one(check, &runs)
    };
    // A step down by a standard error of the difference.
    let flat = [[1.0, 1.1, 1.2], [0.95, 1.05, 1.1], [2.0, 2.1, 2.2]];
    assert_eq!(trend(&flat, true).verdict, Outcome::Holds);
    assert_eq!(trend(&flat, false).verdict, Outcome::NotDecidable);
    assert!(reason(&trend(&flat, false)).contains("within_noise"));
    let down = [[1.0, 1.1, 1.2], [0.5, 0.6, 0.7], [2.0, 2.1, 2.2]];
    for within_noise in [true, false] {
        let verdict = trend(&down, within_noise);
        assert_eq!(verdict.verdict, Outcome::Fails);
        assert!(reason(&verdict).contains("scale=2"), "{}", reason(&verdict));
    }
    // Steps that each pass for noise, but lead down all the same.
    let sliding = [1.0, 0.88, 0.76, 0.64, 0.52].map(|mean| [mean - 0.1, mean, mean + 0.1]);
    let verdict = trend(&sliding, true);
    assert_eq!(verdict.verdict, Outcome::Fails);
    assert!(reason(&verdict).contains("end to end"));
    // One seed has no noise to stand still within.
    let alone = Check::Monotone {
        of: "limit".to_string(),
        over: "scale".to_string(),
        rising: false,
        within_noise: true,
    };
    assert_eq!(one(alone, &ladder(0.001)).verdict, Outcome::Fails);
}

fn side(name: &str, value: f64) -> Selection {
    Selection {
        scenes: Vec::new(),
        axes: vec![(name.to_string(), vec![AxisValue::Number(value)])],
    }
}

fn compare(between: [f64; 2], is: Relation, margin: f64, within_noise: bool) -> Check {
    Check::Compare(Comparison {
        of: "limit".to_string(),
        between: between.map(|scale| side("scale", scale)),
        is,
        margin,
        within_noise,
    })
}

#[test]
fn two_selections_are_compared_pair_by_pair() {
    // Limits 2.002 and 2.032 in one scene; the other way round in the other.
    let mut runs: Vec<Run> = ladder(0.001);
    let verdict = |runs: &[Run], is, margin| one(compare([4.0, 1.0], is, margin, false), runs);
    let holds = verdict(&runs, Relation::Greater, 0.0);
    assert_eq!(holds.verdict, Outcome::Holds);
    assert_eq!(holds.computed, Some(LIMIT * 1.016));
    assert_eq!(holds.expected, Some(LIMIT * 1.001));
    assert_eq!(holds.points[0].label, "scene=a scale=4 beside scene=a scale=1");
    assert_eq!(holds.statement, "`limit` at scale=4 is greater than at scale=1");
    assert_eq!(verdict(&runs, Relation::Greater, 0.01).verdict, Outcome::Holds);
    let short = verdict(&runs, Relation::Greater, 0.02);
    assert_eq!(short.verdict, Outcome::Fails);
    assert!(
        reason(&short).contains("1.5 % more, not greater by 2 %"),
        "{}",
        reason(&short)
    );
    assert_eq!(verdict(&runs, Relation::Less, 0.0).verdict, Outcome::Fails);
    assert_eq!(verdict(&runs, Relation::Equal, 0.02).verdict, Outcome::Holds);
    assert_eq!(verdict(&runs, Relation::Equal, 0.01).verdict, Outcome::Fails);
    runs.extend([1.0, 2.0, 4.0].map(|scale| rehearse("b", scale, -0.001)));
    let mixed = verdict(&runs, Relation::Greater, 0.0);
    assert_eq!((mixed.verdict, mixed.points.len()), (Outcome::Fails, 2));
    assert!(reason(&mixed).contains("scene=b"));
}

#[test]
fn axes_that_move_along_do_not_part_a_pair_and_free_ones_do() {
    let with = |run: &Run, name: &str, value: f64| {
        let mut run = run.clone();
        run.id = PointId(format!("{}-{name}-{value}", run.id.0));
        run.axes.push((name.to_string(), AxisValue::Number(value)));
        run
    };
    let along: Vec<Run> = ladder(0.001)
        .iter()
        .zip([4.5, 4.0, 4.2])
        .map(|(run, width)| with(run, "width", width))
        .collect();
    let check = || compare([4.0, 1.0], Relation::Greater, 0.0, false);
    assert_eq!(one(check(), &along).points.len(), 1);
    let free: Vec<Run> = [1.0, 2.0]
        .iter()
        .flat_map(|depth| {
            ladder(0.001)
                .iter()
                .map(|run| with(run, "depth", *depth))
                .collect::<Vec<_>>()
        })
        .collect();
    assert_eq!(one(check(), &free).points.len(), 2);
}

#[test]
fn a_comparison_over_seeds_knows_its_noise() {
    let both = |first: &[f64], second: &[f64]| {
        let mut runs = scattered("a", 1.0, first);
        runs.extend(scattered("a", 2.0, second));
        runs
    };
    let verdict = |runs: &[Run], is, margin, noise| one(compare([1.0, 2.0], is, margin, noise), runs);
    let near = both(&[1.0, 1.1, 1.2], &[1.05, 1.15, 1.25]);
    assert_eq!(verdict(&near, Relation::Equal, 0.0, true).verdict, Outcome::Holds);
    assert_eq!(
        verdict(&near, Relation::Less, 0.0, false).verdict,
        Outcome::NotDecidable
    );
    assert_eq!(
        verdict(&near, Relation::Equal, 0.05, false).verdict,
        Outcome::NotDecidable
    );
    assert_eq!(
        verdict(&near, Relation::Equal, 0.5, false).verdict,
        Outcome::Holds
    );
    let far = both(&[1.0, 1.1, 1.2], &[2.0, 2.1, 2.2]);
    assert_eq!(verdict(&far, Relation::Equal, 0.0, true).verdict, Outcome::Fails);
    assert_eq!(verdict(&far, Relation::Less, 0.1, false).verdict, Outcome::Holds);
    assert_eq!(
        verdict(&far, Relation::Equal, 0.05, false).verdict,
        Outcome::Fails
    );
    // A single seed says nothing of noise.
    let alone = verdict(&both(&[1.0], &[1.0]), Relation::Equal, 0.0, true);
    assert_eq!(alone.verdict, Outcome::NotDecidable);
    assert!(reason(&alone).contains("two seeds"));
}

#[test]
fn a_comparison_without_partners_or_with_missing_runs_stays_open() {
    let runs = ladder(0.001);
    let check = || compare([4.0, 9.0], Relation::Greater, 0.0, false);
    let nobody = one(check(), &runs);
    assert_eq!(nobody.verdict, Outcome::NotDecidable);
    assert!(reason(&nobody).contains("partner"));
    let mut study = study(vec![expectation(compare(
        [4.0, 1.0],
        Relation::Greater,
        0.0,
        false,
    ))]);
    study.plan.points = runs.iter().map(planned).collect();
    // A missing run of neither side does not matter, one of a side does.
    let without = |scale: f64| -> Vec<Run> {
        let keep = |run: &&Run| run.axes[0].1 != AxisValue::Number(scale);
        runs.iter().filter(keep).cloned().collect()
    };
    assert_eq!(judge(&study, &without(2.0))[0].verdict, Outcome::Holds);
    assert_eq!(judge(&study, &without(4.0))[0].verdict, Outcome::NotDecidable);
    let zero = [rehearse("a", 4.0, 0.0), seeded(&rehearse("a", 1.0, 0.0), 1, 0.0)];
    let of_zero = one(compare([4.0, 1.0], Relation::Equal, 0.1, false), &zero);
    assert_eq!(of_zero.verdict, Outcome::NotDecidable);
}

#[test]
fn only_gating_failures_reach_the_exit_code() {
    let verdicts = |informative: Option<&str>, below| {
        let expectation = Expectation {
            informative: informative.map(str::to_string),
            ..expectation(limit_below(below))
        };
        judge(&study(vec![expectation]), &ladder(0.001))
    };
    assert_eq!(exit_code(&verdicts(None, 0.1), true), 0);
    assert_eq!(exit_code(&verdicts(None, 0.001), false), 1);
    assert_eq!(exit_code(&verdicts(Some("known defect"), 0.001), true), 0);
    let open = judge(&study(vec![expectation(order_two())]), &ladder(0.001)[..1]);
    assert_eq!((exit_code(&open, false), exit_code(&open, true)), (0, 1));
}

proptest! {
    #[test]
    fn the_order_of_runs_changes_nothing(
        shuffled in Just((0..12usize).collect::<Vec<_>>()).prop_shuffle(),
        errors in prop::collection::vec(-0.01f64..0.01, 4),
    ) {
        let mut runs = Vec::new();
        for (scene, error) in [("a", errors[0]), ("b", errors[1])] {
            for scale in [1.0, 2.0, 4.0] {
                let run = rehearse(scene, scale, error);
                let value = run.scalars[0].value;
                runs.push(seeded(&run, 1, value + errors[2]));
                runs.push(seeded(&run, 2, value + errors[3]));
            }
        }
        let checks = [limit_below(0.005), order_two(), monotone(true), error_below("value", "known_series", 0.01)];
        let study = study(checks.into_iter().map(expectation).collect());
        let permuted: Vec<Run> = shuffled.iter().map(|&index| runs[index].clone()).collect();
        prop_assert_eq!(judge(&study, &runs), judge(&study, &permuted));
    }
}
