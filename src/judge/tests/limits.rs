//! Scaling, status and limits.

use super::*;
use crate::study::model::{Ending, Limit};

fn scaling(of: &str, is: f64) -> Check {
    Check::Scaling {
        of: of.to_string(),
        over: "scale".to_string(),
        is,
        within: 0.1,
    }
}

/// `limit` is 2 (1 + 0.02 scale²): it leaves the band below 2.2 at a scale of 2.236.
fn limit(within: f64) -> Check {
    Check::Limit(Limit {
        of: "limit".to_string(),
        band: Band {
            above: None,
            below: Some(2.2),
        },
        over: "scale".to_string(),
        against: "known_limit".to_string(),
        within,
    })
}

fn at(scales: &[f64]) -> Vec<Run> {
    scales.iter().map(|scale| rehearse("a", *scale, 0.02)).collect()
}

fn diverged(run: &Run) -> Run {
    Run {
        status: Status::Diverged,
        reason: Some("grain 7 leaps".to_string()),
        ..run.clone()
    }
}

#[test]
fn a_power_is_told_from_its_neighbours() {
    let mut runs = ladder(0.01);
    for run in &mut runs {
        let scale = run.scalar("scale").unwrap().value;
        run.counters = vec![("pairs".to_string(), (100.0 * scale * scale) as u64)];
    }
    let verdict = one(scaling("counters.pairs", 2.0), &runs);
    assert_eq!(verdict.verdict, Outcome::Holds, "{verdict:?}");
    assert!((verdict.computed.unwrap() - 2.0).abs() < 1e-9);
    assert_eq!(one(scaling("counters.pairs", 1.0), &runs).verdict, Outcome::Fails);
    let verdict = one(scaling("counters.pairs", 2.0), &runs[..1]);
    assert_eq!(verdict.verdict, Outcome::NotDecidable);
    runs[1].counters[0].1 = 0;
    assert!(reason(&one(scaling("counters.pairs", 2.0), &runs)).contains("zero"));
}

#[test]
fn a_divergence_answers_only_who_asks_for_it() {
    let completed = rehearse("a", 1.0, 0.0);
    let runs = [diverged(&rehearse("a", 2.0, 0.0)), completed];
    let status = |is: &[Ending], runs: &[Run]| one(Check::Status { is: is.to_vec() }, runs).verdict;
    assert_eq!(
        status(&[Ending::Completed, Ending::Diverged], &runs),
        Outcome::Holds
    );
    assert_eq!(status(&[Ending::Completed], &runs), Outcome::Fails);
    assert_eq!(status(&[Ending::Diverged], &runs), Outcome::Fails);
    assert_eq!(status(&[Ending::Diverged], &runs[..1]), Outcome::Holds);
    let asked = study(vec![expectation(Check::Status {
        is: vec![Ending::Diverged],
    })]);
    assert!(select::answers_by_diverging(&asked, &runs[0]));
    assert!(!select::answers_by_diverging(&asked, &runs[1]));
    let other = study(vec![expectation(limit_below(0.1))]);
    assert!(!select::answers_by_diverging(&other, &runs[0]));
    let silent = Run {
        reason: None,
        ..runs[0].clone()
    };
    assert_eq!(status(&[Ending::Diverged], &[silent]), Outcome::Fails);
    let panicked = Run {
        status: Status::Panicked,
        ..runs[0].clone()
    };
    assert_ne!(
        status(&[Ending::Completed, Ending::Diverged], &[panicked]),
        Outcome::Holds
    );
}

#[test]
fn a_limit_holds_where_the_reference_lies_between_both_sides() {
    // The reference says 2.
    let verdict = one(limit(0.01), &at(&[1.0, 1.5, 2.5, 4.0]));
    assert_eq!(verdict.verdict, Outcome::Holds, "{verdict:?}");
    assert_eq!(one(limit(0.01), &at(&[1.0, 2.1, 2.5])).verdict, Outcome::Fails);
    assert_eq!(one(limit(0.1), &at(&[1.0, 2.1, 2.5])).verdict, Outcome::Holds);
}

#[test]
fn what_diverges_is_outside() {
    let mut runs = at(&[1.0, 1.5, 2.1]);
    runs[2] = diverged(&runs[2]);
    let verdict = one(limit(0.01), &runs);
    assert_eq!(verdict.verdict, Outcome::Holds, "{verdict:?}");
}

#[test]
fn a_limit_without_two_sides_is_open_and_says_where_to_go() {
    assert!(reason(&one(limit(0.01), &at(&[1.0, 1.5]))).contains("go higher"));
    assert!(reason(&one(limit(0.01), &at(&[3.0, 4.0]))).contains("go lower"));
    let mut runs = at(&[1.0, 1.5, 2.0]);
    runs[1] = diverged(&runs[1]);
    let verdict = one(limit(0.01), &runs);
    assert_eq!(verdict.verdict, Outcome::NotDecidable);
    assert!(reason(&verdict).contains("inside again"), "{verdict:?}");
}
