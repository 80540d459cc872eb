//! The end of a report on the terminal: one line per expectation, the counts, where to read on.

use std::fmt::Write;
use std::path::Path;

use super::actions::Tally;
use super::console::Paint;
use super::magnitude::count;
use super::status::Status;
use crate::judge::model::{Outcome, Verdict};
use crate::report::told;

/// One line per verdict (as told by the report), its reason below, then the counts and the path of the report.
pub fn verdicts(verdicts: &[Verdict], tally: &Tally, index: &Path, paint: Paint) -> String {
    let mut text = String::new();
    for verdict in verdicts {
        text.push_str(&line(verdict, paint));
    }
    let how_many = |outcome| {
        verdicts
            .iter()
            .filter(|verdict| verdict.verdict == outcome)
            .count()
    };
    let _ = writeln!(
        text,
        "{}: {} held, {} failed, {} not decidable · {tally}",
        count(verdicts.len(), "expectation"),
        how_many(Outcome::Holds),
        how_many(Outcome::Fails),
        how_many(Outcome::NotDecidable)
    );
    let _ = writeln!(text, "{}", index.display());
    text
}

/// What the verdicts amount to; informative ones amount to nothing.
pub fn amount_to(verdicts: &[Verdict], strict: bool) -> Status {
    let gates = verdicts.iter().filter(|verdict| verdict.informative.is_none());
    let failed = gates.into_iter().any(|verdict| match verdict.verdict {
        Outcome::Holds => false,
        Outcome::Fails => true,
        Outcome::NotDecidable => strict,
    });
    if failed { Status::Failed } else { Status::Held }
}

fn line(verdict: &Verdict, paint: Paint) -> String {
    let mark = match verdict.verdict {
        Outcome::Holds => paint.green("✓ holds"),
        Outcome::Fails => paint.red("✗ fails"),
        Outcome::NotDecidable => paint.yellow("? not decidable"),
    };
    let mut text = format!("{mark}  {}: {}", verdict.id, verdict.statement);
    if let Some(found) = found(verdict) {
        let _ = write!(text, "; {found}");
    }
    if !verdict.source.is_empty() {
        let _ = write!(text, "  {}", paint.dim(&format!("[{}]", verdict.source)));
    }
    text.push('\n');
    for note in verdict.reason.iter().chain(&verdict.informative) {
        let _ = writeln!(text, "    {note}");
    }
    text
}

/// What was found, where it holds: `0.201 %, 9.167 mm/s instead of 9.185 mm/s at sphere, spacing 3 d`.
/// The reason of a failure says it already.
fn found(verdict: &Verdict) -> Option<String> {
    let found = told::found(verdict)?;
    if verdict.verdict == Outcome::Fails && verdict.reason.as_ref().is_some_and(|why| why.contains(&found)) {
        return None;
    }
    let several = verdict.points.len() > 1;
    let at = told::deciding(verdict).filter(|_| several);
    Some(match at {
        Some(point) => format!("at most {found} at {}", point.label),
        None => format!("found {found}"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn verdict(outcome: Outcome) -> Verdict {
        Verdict {
            id: "error-1".into(),
            statement: "relative error of limit against known_limit < 2 %".into(),
            quantity: "limit".into(),
            unit: "m/s".into(),
            expected: Some(1.0),
            computed: Some(1.01),
            half_width: None,
            error: Some(0.01),
            band: "< 0.02".into(),
            verdict: outcome,
            reason: None,
            source: "by construction".into(),
            claims: Vec::new(),
            informative: None,
            points: Vec::new(),
        }
    }

    #[test]
    fn only_what_gates_decides() {
        let informative = Verdict {
            informative: Some("shown beside".into()),
            ..verdict(Outcome::Fails)
        };
        assert_eq!(amount_to(&[], true), Status::Held);
        assert_eq!(
            amount_to(&[verdict(Outcome::Holds), informative], true),
            Status::Held
        );
        assert_eq!(
            amount_to(&[verdict(Outcome::Holds), verdict(Outcome::Fails)], false),
            Status::Failed
        );
        assert_eq!(amount_to(&[verdict(Outcome::NotDecidable)], false), Status::Held);
        assert_eq!(amount_to(&[verdict(Outcome::NotDecidable)], true), Status::Failed);
    }

    #[test]
    fn a_verdict_is_one_line_with_its_reason_below() {
        let failed = Verdict {
            reason: Some("too coarse".into()),
            ..verdict(Outcome::Fails)
        };
        let tally = Tally {
            completed: 2,
            failed: 1,
            missing: 0,
            ..Tally::default()
        };
        let text = verdicts(
            &[verdict(Outcome::Holds), failed],
            &tally,
            Path::new("reports/x/index.html"),
            Paint { on: false },
        );
        let expected = "✓ holds  error-1: relative error of limit against known_limit < 2 %; found 1.00 %, 1.010 m/s \
                        instead of 1.000 m/s  [by construction]\n\
                        ✗ fails  error-1: relative error of limit against known_limit < 2 %; found 1.00 %, 1.010 m/s \
                        instead of 1.000 m/s  [by construction]\n    too coarse\n\
                        2 expectations: 1 held, 1 failed, 0 not decidable · 3 points: 2 completed, 1 failed, \
                        0 missing\nreports/x/index.html\n";
        assert_eq!(text, expected);
    }
}
