//! Who may import whom: read from the sources, so that an import upwards fails here.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// A room and the rooms of its crate that it may import, itself aside.
type Allowed = (&'static str, &'static [&'static str]);

const HARNESS: [Allowed; 8] = [
    ("study", &[]),
    ("store", &["study"]),
    ("reference", &[]),
    ("runner", &["study", "store"]),
    ("judge", &["study", "store", "reference"]),
    ("export", &["study", "store"]),
    ("report", &["study", "store", "reference", "judge"]),
    (
        "cli",
        &[
            "study",
            "store",
            "reference",
            "runner",
            "judge",
            "report",
            "export",
        ],
    ),
];

/// From the ground up; rooms on one level do not import each other.
const SIMULATOR_LEVELS: [&[&str]; 11] = [
    &["outcome", "math"],
    &["state"],
    &["neighbours"],
    &["contact", "cohesion", "drag", "fluid"],
    &["coupling"],
    &["integrator", "arrangement"],
    &["bed"],
    &["simulation"],
    &["observable"],
    &["scene"],
    &["lib"],
];

/// Crates that belong to certain rooms of the harness alone.
const CRATES: [(&str, &[&str]); 7] = [
    ("kynch_sim", &["study", "runner", "cli"]),
    ("polars", &["report"]),
    ("polars_io", &["report"]),
    ("plotters", &["report"]),
    ("minijinja", &["report"]),
    ("serde_saphyr", &["study", "reference"]),
    ("clap", &["cli", "main"]),
];

/// Outside of tests: what would panic on a user, or was left behind.
const FORBIDDEN: [&str; 4] = [".unwrap()", "todo!(", "unimplemented!(", "dbg!("];

/// Longest file, tests included: a reason to look long before.
const LONGEST: usize = 800;

/// A source file with the comments taken out.
struct Source {
    path: PathBuf,
    /// Folders and file stem below `src`: `["fluid", "kernel"]`; `mod` is left out.
    module: Vec<String>,
    code: String,
    lines: usize,
}

impl Source {
    fn room(&self) -> &str {
        self.module.first().map_or("lib", String::as_str)
    }

    fn fault(&self, what: &str) -> String {
        format!("{}: {what}", self.path.display())
    }
}

fn sources(folder: &Path) -> Vec<Source> {
    let mut found = Vec::new();
    collect(folder, folder, &mut found);
    found.sort_by(|a, b| a.path.cmp(&b.path));
    assert!(!found.is_empty(), "no sources below {}", folder.display());
    found
}

fn collect(root: &Path, folder: &Path, found: &mut Vec<Source>) {
    for entry in fs::read_dir(folder).expect("a folder of sources") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            collect(root, &path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let text = fs::read_to_string(&path).expect("a source file");
            let module = path
                .strip_prefix(root)
                .expect("below the root")
                .with_extension("");
            let mut module: Vec<String> = module
                .iter()
                .map(|part| part.to_string_lossy().into_owned())
                .collect();
            if module.last().is_some_and(|last| last == "mod") {
                module.pop();
            }
            let code = without_comments(&text);
            found.push(Source {
                path,
                module,
                code,
                lines: text.lines().count(),
            });
        }
    }
}

/// Line comments go, docs among them: a link in a doc is no import.
fn without_comments(text: &str) -> String {
    let code = text
        .lines()
        .map(|line| line.find("//").map_or(line, |start| &line[..start]));
    code.collect::<Vec<_>>().join("\n")
}

/// Rooms of its own crate that a source names, through `crate::` or enough `super::`.
fn rooms_named(source: &Source, rooms: &[&str]) -> BTreeSet<String> {
    let mut named = BTreeSet::new();
    for (start, _) in source.code.match_indices("crate::") {
        named.extend(first_segments(&source.code[start + "crate::".len()..]));
    }
    let to_root = "super::".repeat(source.module.len().max(1));
    for (start, _) in source.code.match_indices(&to_root) {
        let rest = source.code[start..].trim_start_matches("super::");
        named.extend(first_segments(rest));
    }
    named.retain(|name| rooms.contains(&name.as_str()) && name != source.room());
    named
}

/// `a` of `a::b`; `a` and `c` of `{a::b, c::{d, e}}`.
fn first_segments(path: &str) -> Vec<String> {
    let Some(group) = path.strip_prefix('{') else {
        return vec![identifier(path)];
    };
    let mut depth = 0;
    let mut segments = vec![String::new()];
    for letter in group.chars() {
        match letter {
            '}' if depth == 0 => break,
            ',' if depth == 0 => segments.push(String::new()),
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            segments.last_mut().expect("never empty").push(letter);
        }
    }
    segments
        .iter()
        .map(|segment| identifier(segment.trim_start_matches([',', ' ', '\n'])))
        .collect()
}

fn identifier(text: &str) -> String {
    text.chars()
        .take_while(|letter| letter.is_alphanumeric() || *letter == '_')
        .collect()
}

/// Upward imports between the rooms of a crate, and rooms that have no place in the order.
fn upward_imports(folder: &Path, order: &[(String, Vec<String>)]) -> Vec<String> {
    let rooms: Vec<&str> = order.iter().map(|(room, _)| room.as_str()).collect();
    let mut faults = Vec::new();
    for source in sources(folder) {
        let room = source.room();
        if matches!(room, "lib" | "main") {
            continue;
        }
        let Some((_, allowed)) = order.iter().find(|(other, _)| other == room) else {
            faults.push(source.fault(&format!("the room `{room}` has no place in the order")));
            continue;
        };
        for named in rooms_named(&source, &rooms) {
            if !allowed.contains(&named) {
                faults.push(source.fault(&format!("`{room}` imports `{named}`")));
            }
        }
    }
    faults
}

fn foreign_crates(folder: &Path) -> Vec<String> {
    let mut faults = Vec::new();
    for source in sources(folder) {
        for (name, rooms) in CRATES {
            let names_it = [format!("{name}::"), format!("use {name}")];
            let named = names_it.iter().any(|text| stands_alone(&source.code, text));
            if named && !rooms.contains(&source.room()) {
                faults.push(source.fault(&format!("`{}` names the crate `{name}`", source.room())));
            }
        }
    }
    faults
}

/// Whether a text occurs with no longer name around it.
fn stands_alone(code: &str, text: &str) -> bool {
    code.match_indices(text).any(|(start, _)| {
        let before = code[..start].chars().next_back();
        let after = code[start + text.len()..].chars().next();
        let part_of_name = |letter: char| letter.is_alphanumeric() || letter == '_';
        let open_end = !text.ends_with(':') && after.is_some_and(part_of_name);
        !before.is_some_and(part_of_name) && !open_end
    })
}

/// Forbidden words in the part of a file before its tests, and files too long to read.
fn habits(folder: &Path) -> Vec<String> {
    let mut faults = Vec::new();
    for source in sources(folder) {
        let only_tests = source.module.iter().any(|part| part == "tests");
        let product = if only_tests {
            ""
        } else {
            before_tests(&source.code)
        };
        let words = FORBIDDEN.iter().filter(|word| product.contains(*word));
        faults.extend(words.map(|word| source.fault(&format!("`{word}` outside of tests"))));
        if source.lines > LONGEST {
            faults.push(source.fault(&format!("{} lines, at most {LONGEST}", source.lines)));
        }
    }
    faults
}

/// The part of a file before its module of tests.
fn before_tests(code: &str) -> &str {
    let marks = code.match_indices("#[cfg(test)]\n");
    let tests = marks
        .map(|(start, mark)| (start, &code[start + mark.len()..]))
        .find(|(_, rest)| {
            rest.lines()
                .next()
                .is_some_and(|line| line.contains("mod ") && line.ends_with('{'))
        });
    tests.map_or(code, |(start, _)| &code[..start])
}

fn harness() -> Vec<(String, Vec<String>)> {
    let owned = |rooms: &[&str]| rooms.iter().map(|room| room.to_string()).collect();
    HARNESS
        .iter()
        .map(|(room, allowed)| (room.to_string(), owned(allowed)))
        .collect()
}

fn simulator() -> Vec<(String, Vec<String>)> {
    let mut order = Vec::new();
    let mut below: Vec<String> = vec!["outcome".into()];
    for level in SIMULATOR_LEVELS {
        order.extend(level.iter().map(|room| {
            let leaf = *room == "outcome";
            (room.to_string(), if leaf { Vec::new() } else { below.clone() })
        }));
        below.extend(level.iter().map(|room| room.to_string()));
    }
    order
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn assert_none(faults: &[String]) {
    assert!(faults.is_empty(), "\n{}\n", faults.join("\n"));
}

#[test]
fn the_harness_imports_downwards() {
    assert_none(&upward_imports(&root().join("src"), &harness()));
}

#[test]
fn the_simulator_imports_downwards() {
    assert_none(&upward_imports(&root().join("crates/sim/src"), &simulator()));
}

#[test]
fn the_simulator_stands_alone() {
    let manifest = fs::read_to_string(root().join("crates/sim/Cargo.toml")).expect("a manifest");
    for name in [
        "kynch = ", "kynch.", "polars", "plotters", "parquet", "serde", "clap",
    ] {
        assert!(!manifest.contains(name), "the simulator depends on {name}");
    }
    for source in sources(&root().join("crates/sim/src")) {
        assert!(
            !stands_alone(&source.code, "kynch::"),
            "{} names the harness",
            source.path.display()
        );
    }
}

#[test]
fn crates_stay_in_their_rooms() {
    assert_none(&foreign_crates(&root().join("src")));
}

#[test]
fn files_are_short_and_finished() {
    assert_none(&habits(&root().join("src")));
    assert_none(&habits(&root().join("crates/sim/src")));
}

#[test]
fn main_is_the_whole_story_in_under_60_lines() {
    let story = fs::read_to_string(root().join("src/main.rs")).expect("main.rs");
    assert!(story.lines().count() < 60);
}

/// A tree with one file, to see that what is planted in it is found.
fn planted(path: &str, text: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join(path);
    fs::create_dir_all(file.parent().expect("a parent")).expect("a folder");
    fs::write(file, text).expect("a file");
    folder
}

#[test]
fn a_planted_upward_import_is_caught_in_every_form() {
    for (path, text) in [
        ("store/mod.rs", "use crate::runner::Options;"),
        ("store/row.rs", "use crate::runner;"),
        (
            "store/row.rs",
            "use crate::{\n    study::model::Point,\n    runner::{self, Options},\n};",
        ),
        ("store/row.rs", "fn f() { crate::runner::run() }"),
        ("store/row.rs", "pub(crate) use super::super::runner::run;"),
        ("store/mod.rs", "use super::runner::run;"),
        ("judge/fit/line.rs", "use super::super::super::runner;"),
        ("report/mod.rs", "use crate::runner::State;"),
        ("reference/mod.rs", "use crate::study::model::Study;"),
        ("attic/mod.rs", "fn f() {}"),
    ] {
        let faults = upward_imports(planted(path, text).path(), &harness());
        assert_eq!(faults.len(), 1, "{path}: {text}: {faults:?}");
    }
    for (path, text) in [
        ("math/mod.rs", "use crate::state::Grains;"),
        ("drag/mod.rs", "use crate::fluid::Fluid;"),
        ("outcome.rs", "use crate::math::Vector;"),
        ("coupling/force.rs", "use crate::{drag::Law, scene::Scene};"),
    ] {
        let faults = upward_imports(planted(path, text).path(), &simulator());
        assert_eq!(faults.len(), 1, "{path}: {text}: {faults:?}");
    }
}

#[test]
fn downward_imports_and_links_in_docs_pass() {
    for (path, text) in [
        ("store/mod.rs", "use crate::study::model::Point;"),
        (
            "store/mod.rs",
            "use crate::store::model::Run; use super::model::Runner;",
        ),
        (
            "store/mod.rs",
            "//! See [`crate::runner`].\n/// [`crate::report::render`]\nfn f() {}",
        ),
        ("cli/plan.rs", "use crate::{runner::{survey, State}, report};"),
        ("report/figure/line.rs", "use super::super::runner_of_lines;"),
    ] {
        assert_none(&upward_imports(planted(path, text).path(), &harness()));
    }
    for (path, text) in [
        ("coupling/mod.rs", "use crate::{drag::Law, fluid::Fluid, math};"),
        ("math/mod.rs", "use crate::outcome::Outcome;"),
        ("scene/mod.rs", "use crate::simulation::Simulation;"),
    ] {
        assert_none(&upward_imports(planted(path, text).path(), &simulator()));
    }
}

#[test]
fn a_planted_crate_in_the_wrong_room_is_caught() {
    for (path, text, faults) in [
        ("judge/mod.rs", "use kynch_sim::scene::Scene;", 1),
        ("judge/mod.rs", "fn f(scene: &kynch_sim::scene::Scene) {}", 1),
        ("store/mod.rs", "use polars::prelude::*;", 1),
        ("store/mod.rs", "use polars_io::prelude::*;", 1),
        (
            "report/mod.rs",
            "use polars::prelude::*; use plotters::prelude::*;",
            0,
        ),
        ("runner/mod.rs", "use kynch_sim::scene::run;", 0),
        ("store/mod.rs", "use eclap::x; fn f() { eclap::g() }", 0),
    ] {
        assert_eq!(foreign_crates(planted(path, text).path()).len(), faults, "{text}");
    }
}

#[test]
fn planted_bad_habits_are_caught_outside_of_tests_only() {
    let bad = "fn f() { g().unwrap(); }\n";
    let tests = "fn f() {}\n#[cfg(test)]\nmod tests {\n    fn f() { g().unwrap(); }\n}\n";
    let long = "fn f() {}\n".repeat(LONGEST + 1);
    for (text, faults) in [(bad, 1), (tests, 0), (long.as_str(), 1)] {
        assert_eq!(habits(planted("study/mod.rs", text).path()).len(), faults);
    }
}
