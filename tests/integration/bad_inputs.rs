//! Faulty study files: each says in comments above the faulty line what must be reported there.
//!
//! `# error at `underlined`: message` (without `at …` for the file as a whole), then `# help: advice`.

use std::fs;
use std::path::{Path, PathBuf};

use kynch::study::{self, StudyError};

const FOLDER: &str = "tests/inputs/bad";

/// Line from 1 (0: the whole file), underlined text, message, advice.
type Report = (usize, String, String, String);

fn expected(text: &str) -> Vec<Report> {
    let mut waiting: Vec<(String, String, String)> = Vec::new();
    let mut reports = Vec::new();
    let after = text.lines().count() + 1;
    for (number, line) in text.lines().chain(std::iter::once("")).enumerate() {
        let comment = line.trim_start();
        if let Some(rest) = comment.strip_prefix("# error at `") {
            let (underlined, message) = rest
                .split_once("`: ")
                .expect("a message after the underlined text");
            waiting.push((underlined.to_owned(), message.to_owned(), String::new()));
        } else if let Some(message) = comment.strip_prefix("# error: ") {
            reports.push((0, String::new(), message.to_owned(), String::new()));
        } else if let Some(help) = comment.strip_prefix("# help: ") {
            match (waiting.last_mut(), reports.last_mut()) {
                (Some(last), _) => last.2 = help.to_owned(),
                (None, Some(last)) => last.3 = help.to_owned(),
                _ => panic!("advice without an error: {line}"),
            }
        } else if !comment.starts_with('#') {
            let line = (number + 1).min(after);
            reports.extend(
                waiting
                    .drain(..)
                    .map(|(at, message, help)| (line, at, message, help)),
            );
        }
    }
    reports
}

fn reported(error: &StudyError) -> Vec<Report> {
    let report = |problem: &study::Problem| {
        let line = error.position(problem).map_or(0, |(line, _)| line);
        let at = error.excerpt(problem).to_owned();
        (line, at, problem.message.clone(), problem.help.clone())
    };
    error.problems.iter().map(report).collect()
}

fn fixtures() -> Vec<PathBuf> {
    let entries = fs::read_dir(FOLDER).expect("the folder of faulty studies");
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    paths
}

#[test]
fn every_fault_is_reported_where_it_stands_and_in_these_words() {
    let mut faults = 0;
    let mut wrong = String::new();
    for path in fixtures() {
        let text = fs::read_to_string(&path).expect("a fixture");
        let error = study::load(&path).err();
        let found = error.as_ref().map(reported).unwrap_or_default();
        let mut wanted = expected(&text);
        wanted.sort_by_key(|report| report.0);
        faults += wanted.len();
        if found.is_empty() || found != wanted {
            wrong.push_str(&format!("== {}\n", path.display()));
            for (line, at, message, help) in &found {
                wrong.push_str(&format!("{line}|# error at `{at}`: {message}|# help: {help}\n"));
            }
        }
    }
    assert!(wrong.is_empty(), "not as announced; found:\n{wrong}");
    assert!(faults >= 40, "{faults}");
}

#[test]
fn a_report_shows_place_excerpt_field_and_advice() {
    let text = "question: Does it fall?\nscene:\n  rehearsal: {limit: 1, ordre: 2}\n";
    let error = study::parse(Path::new("studies/x.yaml"), text).expect_err("a fault");
    let expected = "  \
  × unknown key `ordre`
   ╭─[studies/x.yaml:3:25]
 2 │ scene:
 3 │   rehearsal: {limit: 1, ordre: 2}
   ·                         ──┬──
   ·                           ╰── scene.rehearsal.ordre
   ╰────
  help: did you mean `order`?

1 error in studies/x.yaml";
    assert_eq!(error.render(false, 100), expected);
}

#[test]
fn what_is_no_study_file_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        fs::write(&path, bytes).expect("a file");
        path
    };
    let mut bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x]\n".to_owned();
    for level in 1..30 {
        let alias = format!("*a{}", level - 1);
        bomb.push_str(&format!(
            "a{level}: &a{level} [{}]\n",
            [alias.as_str(); 9].join(", ")
        ));
    }
    let cases = [
        (folder.path().to_owned(), "this is a directory, not a study file"),
        (folder.path().join("missing.yaml"), "there is no such file"),
        (
            write("latin1.yaml", b"question: ok\nscene: caf\xe9\n"),
            "the file is not UTF-8 text: line 2 holds a byte that is not",
        ),
        (
            write("large.yaml", &vec![b'#'; 50_000_000]),
            "the file is 50.0 MB large, a study has at most 1 MB",
        ),
        (
            write("bomb.yaml", bomb.as_bytes()),
            "the file holds more than 20000 values",
        ),
        (write("empty.yaml", b""), "the file is empty"),
        (
            write("deep.yaml", "[".repeat(5000).as_bytes()),
            "this is not YAML",
        ),
    ];
    for (path, message) in cases {
        let error = study::load(&path).expect_err(message);
        assert!(error.problems[0].message.starts_with(message), "{error}");
    }
}
