//! Resume, limits, failures, and results that do not depend on how they were computed.

use std::time::{Duration, Instant};

use kynch::runner::{Options, Planned, RunError, State, identify, run, survey};
use kynch::store::Store;
use kynch::store::model::Status;
use kynch::study::model::{AxisValue, Rehearsal, RehearsalEnding, Study};

use crate::rehearsals::{rehearsal, results, scales, study};

fn only(name: &str, value: f64) -> Options {
    Options {
        only: vec![(name.into(), AxisValue::Number(value))],
        ..Options::default()
    }
}

fn due(planned: &[Planned]) -> Vec<&str> {
    let reason = |planned: &'_ Planned| match &planned.state {
        State::Due(reason) => Some(reason.clone().leak() as &str),
        _ => None,
    };
    planned.iter().filter_map(reason).collect()
}

#[test]
fn results_are_the_same_bytes_for_any_number_of_jobs_and_any_order() {
    let reference = tempfile::tempdir().unwrap();
    run(
        &study(scales(9)),
        &Store::open(reference.path()).unwrap(),
        &Options {
            jobs: Some(1),
            ..Options::default()
        },
    )
    .unwrap();
    assert_eq!(results(reference.path()).len(), 9 + 2);
    for jobs in [1, 2, 5] {
        let dir = tempfile::tempdir().unwrap();
        let mut backwards = scales(9);
        backwards.reverse();
        let options = Options {
            jobs: Some(jobs),
            ..Options::default()
        };
        run(&study(backwards), &Store::open(dir.path()).unwrap(), &options).unwrap();
        assert!(results(reference.path()) == results(dir.path()), "{jobs} jobs");
    }
}

#[test]
fn finished_points_rest_until_there_is_a_reason() {
    let dir = tempfile::tempdir().unwrap();
    let store = Store::open(dir.path()).unwrap();
    let small = study(scales(3));
    assert_eq!(
        due(&survey(&small, &store, &Options::default()).unwrap()),
        ["no result yet"; 3]
    );
    assert_eq!(run(&small, &store, &Options::default()).unwrap().completed, 3);
    let again = run(&study(scales(5)), &store, &Options::default()).unwrap();
    assert_eq!((again.cached, again.completed, again.not_run), (3, 2, 0));
    let fresh = Options {
        fresh: true,
        ..only("scale", 1.5)
    };
    let planned = survey(&small, &store, &fresh).unwrap();
    assert_eq!(due(&planned), ["--fresh"]);
    assert!(
        matches!(&planned[0].state, State::LeftOut(why) if why.contains("scale is 1")),
        "{planned:?}"
    );
    assert_eq!(run(&small, &store, &fresh).unwrap().completed, 1);
}

#[test]
fn a_changed_simulator_is_given_as_the_reason() {
    let dir = tempfile::tempdir().unwrap();
    let store = Store::open(dir.path()).unwrap();
    let small = study(scales(1));
    run(&small, &store, &Options::default()).unwrap();
    let mut old = store.load(&[identify(&small.plan.points[0])]).unwrap().remove(0);
    drop(store);
    let dir = tempfile::tempdir().unwrap();
    let store = Store::open(dir.path()).unwrap();
    old.id.0 = "0".repeat(64);
    old.timing.provenance.simulator_hash = "of an older one".into();
    store.append(&old).unwrap();
    assert_eq!(
        due(&survey(&small, &store, &Options::default()).unwrap()),
        ["simulator changed since"]
    );
}

#[test]
fn failures_are_rows_with_reasons_and_the_rest_goes_on() {
    let dir = tempfile::tempdir().unwrap();
    let store = Store::open(dir.path()).unwrap();
    let mixed = study(vec![
        Rehearsal {
            ending: RehearsalEnding::Panics,
            ..rehearsal(1.0)
        },
        Rehearsal {
            ending: RehearsalEnding::Diverges,
            ..rehearsal(2.0)
        },
        Rehearsal {
            delay: 60.0,
            ..rehearsal(3.0)
        },
        rehearsal(4.0),
    ]);
    let options = Options {
        jobs: Some(2),
        timeout: Some(Duration::from_millis(200)),
        ..Options::default()
    };
    let start = Instant::now();
    let summary = run(&mixed, &store, &options).unwrap();
    assert!(start.elapsed() < Duration::from_secs(10));
    assert_eq!(
        (summary.completed, summary.failed.len(), summary.not_run),
        (1, 3, 0)
    );
    let ids: Vec<_> = mixed.plan.points.iter().map(identify).collect();
    let runs = store.load(&ids).unwrap();
    let statuses: Vec<Status> = runs.iter().map(|run| run.status).collect();
    assert_eq!(
        statuses,
        [
            Status::Panicked,
            Status::Diverged,
            Status::TimedOut,
            Status::Completed
        ]
    );
    assert!(runs[0].reason.as_ref().unwrap().contains("a rehearsed panic"));
    assert_eq!(
        runs[1].tables[0].columns[0].values.len(),
        20,
        "what it computed before is kept"
    );
    assert!(runs[2].reason.as_ref().unwrap().contains("0.2 s"));
    assert_eq!(runs[3].reason, None);
    let reasons = survey(&mixed, &store, &options).unwrap();
    let reasons = due(&reasons);
    assert!(
        reasons.len() == 3 && reasons[1].starts_with("last run diverged: value is not finite"),
        "{reasons:?}"
    );
}

#[test]
fn time_and_memory_of_a_point_are_measured() {
    let dir = tempfile::tempdir().unwrap();
    let store = Store::open(dir.path()).unwrap();
    let small = study(vec![Rehearsal {
        delay: 0.05,
        samples: 10_000,
        ..rehearsal(1.0)
    }]);
    run(
        &small,
        &store,
        &Options {
            memory: Some(1 << 30),
            ..Options::default()
        },
    )
    .unwrap();
    let timing = &store.load(&[identify(&small.plan.points[0])]).unwrap()[0].timing;
    // Two columns of 10 000 doubles at least; asleep most of the time.
    assert!(
        (160_000..1 << 20).contains(&timing.peak_memory),
        "{}",
        timing.peak_memory
    );
    assert!(
        timing.wall >= 0.05 && timing.cpu < 0.5 * timing.wall,
        "{timing:?}"
    );
}

#[test]
fn limits_on_the_number_of_points_and_failures() {
    let dir = tempfile::tempdir().unwrap();
    let store = Store::open(dir.path()).unwrap();
    let summary = run(
        &study(scales(5)),
        &store,
        &Options {
            limit: Some(2),
            ..Options::default()
        },
    )
    .unwrap();
    assert_eq!((summary.completed, summary.not_run), (2, 3));
    let failing = |step: u32| Rehearsal {
        ending: RehearsalEnding::Diverges,
        ..rehearsal(100.0 + f64::from(step))
    };
    let all_fail: Study = study((0..6).map(failing).collect());
    let options = Options {
        jobs: Some(1),
        max_failures: Some(2),
        ..Options::default()
    };
    let summary = run(&all_fail, &store, &options).unwrap();
    assert_eq!((summary.failed.len(), summary.not_run), (2, 4));
}

#[test]
fn seeds_of_the_options_replace_those_of_the_study() {
    let dir = tempfile::tempdir().unwrap();
    let store = Store::open(dir.path()).unwrap();
    let options = Options {
        seeds: Some(3),
        ..Options::default()
    };
    let planned = survey(&study(scales(2)), &store, &options).unwrap();
    let seeds: Vec<u64> = planned.iter().map(|planned| planned.point.seed).collect();
    assert_eq!(seeds, [1, 2, 3, 1, 2, 3]);
    let ids: std::collections::HashSet<_> = planned.iter().map(|planned| &planned.id).collect();
    assert_eq!(ids.len(), 6);
}

#[test]
fn selections_that_are_empty_say_what_there_is() {
    let dir = tempfile::tempdir().unwrap();
    let store = Store::open(dir.path()).unwrap();
    let small = study(scales(3));
    for (options, hint) in [
        (only("scale", 9.0), "scale: 1, 1.5, 2"),
        (only("sclae", 1.0), "the axes are scale"),
        (
            Options {
                jobs: Some(0),
                ..Options::default()
            },
            "--jobs 0",
        ),
        (
            Options {
                seeds: Some(0),
                ..Options::default()
            },
            "--seeds 0",
        ),
    ] {
        let error = run(&small, &store, &options).unwrap_err();
        assert!(
            matches!(error, RunError::Input(_)) && error.to_string().contains(hint),
            "{error}"
        );
    }
}

#[test]
fn one_point_in_two_places_runs_once() {
    let dir = tempfile::tempdir().unwrap();
    let store = Store::open(dir.path()).unwrap();
    let summary = run(
        &study(vec![rehearsal(2.0), rehearsal(2.0)]),
        &store,
        &Options::default(),
    )
    .unwrap();
    assert_eq!((summary.completed, summary.not_run), (1, 0));
}
