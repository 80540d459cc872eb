//! Verdicts and points as JUnit XML, for the test views of CI systems. No times and no identifiers
//! of its own: the same store gives the same bytes.

use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};

use super::{ReportError, selection, table, told};
use crate::judge::model::{Outcome, Verdict};
use crate::judge::select::answers_by_diverging;
use crate::store::model::{Run, Status};
use crate::study::model::Study;

pub fn write(study: &Study, runs: &[Run], verdicts: &[Verdict]) -> Result<String, ReportError> {
    let mut expectations = TestSuite::new(format!("{}: expectations", study.name));
    expectations.add_test_cases(verdicts.iter().map(|verdict| {
        let mut case = TestCase::new(
            format!("{}: {}", verdict.id, verdict.statement.replace('`', "")),
            status(verdict),
        );
        case.set_classname(study.name.clone());
        case
    }));
    let mut points = TestSuite::new(format!("{}: points", study.name));
    points.add_test_cases(runs.iter().map(|run| {
        let mut case = TestCase::new(selection::label(study, run), run_status(study, run));
        case.set_classname(study.name.clone());
        case
    }));
    let mut report = Report::new(study.name.clone());
    report.add_test_suites([expectations, points]);
    report
        .to_string()
        .map_err(|error| ReportError(format!("junit.xml cannot be written: {error}")))
}

fn status(verdict: &Verdict) -> TestCaseStatus {
    let message = || {
        let reason = verdict.reason.as_ref().map(|reason| format!(": {reason}"));
        format!("admitted {}{}", told::band(verdict), reason.unwrap_or_default())
    };
    let mut status = match (&verdict.informative, verdict.verdict) {
        (_, Outcome::Holds) => return TestCaseStatus::success(),
        (None, Outcome::Fails) => TestCaseStatus::non_success(NonSuccessKind::Failure),
        (Some(_), _) | (None, Outcome::NotDecidable) => TestCaseStatus::skipped(),
    };
    status.set_message(match &verdict.informative {
        Some(why) => format!("informative ({why}): {}", message()),
        None => message(),
    });
    status.set_type(match verdict.verdict {
        Outcome::Fails => "expectation",
        _ => "not decidable",
    });
    let off: Vec<String> = verdict
        .points
        .iter()
        .filter(|point| point.holds == Some(false))
        .map(|point| match told::found_at(point, &verdict.unit) {
            Some(found) => format!("{}: {found}", point.label),
            None => point.label.clone(),
        })
        .collect();
    if !off.is_empty() {
        status.set_description(format!("points that fail:\n{}", off.join("\n")));
    }
    status
}

fn run_status(study: &Study, run: &Run) -> TestCaseStatus {
    if run.status == Status::Completed || answers_by_diverging(study, run) {
        return TestCaseStatus::success();
    }
    let mut status = TestCaseStatus::non_success(NonSuccessKind::Error);
    let reason = run.reason.as_deref().unwrap_or("no reason is known");
    status.set_type(table::status_word(run.status));
    status.set_message(format!("{}: {reason}", table::status_word(run.status)));
    status
}
