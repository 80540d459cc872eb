//! The program as its users meet it: rehearsal studies in a folder of their own, exit codes, words.

use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use tempfile::TempDir;

/// Two scenes of two points each; the limit of each point is 1 + error.
const STUDY: &str = "
question: How far is the limit from the known one?
scenes:
  near:
    rehearsal: {limit: 1, time_constant: 1 s, duration: 5 s, samples: 20, scale: 1, order: 1, error: 0.001}
  far:
    rehearsal: {limit: 2, time_constant: 1 s, duration: 5 s, samples: 20, scale: 1, order: 1, error: 0.001}
vary:
  error: {path: scene.error, values: [0.001, 0.002]}
observe: [limit, value]
expect:
  - error: {of: limit, against: known_limit, below: 1 %, id: near-limit, where: {scene: near}}
  - error: {of: limit, against: known_limit, below: 1 %, id: far-limit, where: {scene: far}}
figures:
  - time_series: {of: value, against: known_series}
";

/// A folder to work in, with `studies/`.
struct Desk {
    folder: TempDir,
}

/// How a command ended and what it said.
struct Said {
    code: i32,
    out: String,
    err: String,
}

impl Desk {
    fn new() -> Desk {
        let folder = tempfile::tempdir().expect("a temporary folder");
        fs::create_dir(folder.path().join("studies")).expect("a folder");
        Desk { folder }
    }

    /// A desk with [`STUDY`] under the name `limits`.
    fn with_study() -> Desk {
        let desk = Desk::new();
        desk.study("limits", STUDY);
        desk
    }

    fn study(&self, name: &str, text: &str) {
        fs::write(self.path(&format!("studies/{name}.yaml")), text).expect("a study file");
    }

    fn path(&self, below: &str) -> PathBuf {
        self.folder.path().join(below)
    }

    fn command(&self, typed: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_kynch"));
        command
            .args(typed.split_whitespace())
            .current_dir(self.folder.path());
        command.stdin(Stdio::null());
        command
    }

    fn kynch(&self, typed: &str) -> Said {
        Said::from(self.command(typed).output().expect("the program starts"))
    }

    /// As [`Desk::kynch`], and the exit code is this one.
    fn ends(&self, typed: &str, code: i32) -> Said {
        let said = self.kynch(typed);
        assert_eq!(said.code, code, "kynch {typed}\n{}\n{}", said.out, said.err);
        said
    }
}

impl From<Output> for Said {
    fn from(output: Output) -> Said {
        let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).expect("UTF-8");
        let said = Said {
            code: output.status.code().unwrap_or(-1),
            out: text(&output.stdout),
            err: text(&output.stderr),
        };
        assert!(!said.err.contains("panicked at src/cli"), "{}", said.err);
        assert_ne!(said.code, 101, "the program panicked: {}", said.err);
        said
    }
}

/// Every file below a folder with its bytes; timings and the manifest that sums them left out.
fn results(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(next) = folders.pop() {
        for entry in fs::read_dir(&next).expect("a folder") {
            let path = entry.expect("an entry").path();
            let name = path
                .file_name()
                .map(|name| name.to_string_lossy().into_owned())
                .unwrap_or_default();
            if path.is_dir() {
                folders.push(path);
            } else if name.ends_with(".parquet") && !name.starts_with("timings") && !name.starts_with('.') {
                let bytes = fs::read(&path).expect("a file");
                files.push((path.strip_prefix(folder).expect("below").to_path_buf(), bytes));
            }
        }
    }
    files.sort();
    assert!(!files.is_empty(), "no results below {}", folder.display());
    files
}

// Exit codes

#[test]
fn a_study_that_holds_ends_with_0_and_a_report() {
    let desk = Desk::with_study();
    let said = desk.ends("study limits", 0);
    assert!(said.out.contains("✓ holds"), "{}", said.out);
    assert!(
        said.out
            .contains("2 expectations: 2 held, 0 failed, 0 not decidable"),
        "{}",
        said.out
    );
    assert!(
        said.out.contains("4 points: 4 completed, 0 failed, 0 missing"),
        "{}",
        said.out
    );
    assert!(said.out.trim_end().ends_with("index.html"), "{}", said.out);
    for file in ["index.html", "report.md", "verdicts.json"] {
        assert!(desk.path("reports/limits").join(file).is_file(), "{file}");
    }
}

#[test]
fn a_failed_expectation_ends_with_1() {
    let desk = Desk::new();
    desk.study(
        "limits",
        &STUDY.replace("below: 1 %, id: far-limit", "below: 0.15 %, id: far-limit"),
    );
    let said = desk.ends("study limits", 1);
    assert!(
        said.out.contains("✗ fails") && said.out.contains("1 failed"),
        "{}",
        said.out
    );
}

#[test]
fn an_informative_expectation_never_gates() {
    let desk = Desk::new();
    let relaxed = "below: 0.15 %, informative: shown beside, id: far-limit";
    desk.study("limits", &STUDY.replace("below: 1 %, id: far-limit", relaxed));
    desk.ends("study limits", 0);
}

#[test]
fn what_cannot_be_decided_counts_only_when_strict() {
    let desk = Desk::with_study();
    let said = desk.ends("study limits --only scene=near", 0);
    assert!(said.out.contains("? not decidable"), "{}", said.out);
    desk.ends("study limits --only scene=near --strict", 1);
}

#[test]
fn points_that_fail_are_rows_and_end_with_3() {
    let desk = Desk::new();
    let study = "
question: What happens when points fail?
scene:
  rehearsal: {limit: 1, time_constant: 1 s, duration: 5 s, samples: 20}
vary:
  ending: {path: scene.ending, values: [completes, diverges, panics]}
observe: [limit]
";
    desk.study("failing", study);
    let said = desk.ends("run failing", 3);
    assert!(said.out.contains("1 completed, 2 failed"), "{}", said.out);
    let said = desk.ends("report failing", 3);
    assert!(
        said.out.contains("3 points: 1 completed, 2 failed, 0 missing"),
        "{}",
        said.out
    );
}

#[test]
fn a_report_without_a_run_ends_with_3() {
    let desk = Desk::with_study();
    let said = desk.ends("report limits", 3);
    assert!(said.out.contains("4 missing"), "{}", said.out);
}

#[test]
fn missing_points_go_before_failed_expectations() {
    let desk = Desk::new();
    desk.study(
        "limits",
        &STUDY.replace("below: 1 %, id: near-limit", "below: 0.05 %, id: near-limit"),
    );
    desk.ends("study limits --limit 3", 3);
    desk.ends("study limits", 1);
}

#[test]
fn bad_input_stops_everything_before_it_starts() {
    let desk = Desk::with_study();
    desk.study("wrong", "question: What?\nscene:\n  rehearsal: {limt: 1}\n");
    let said = desk.ends("study limits wrong", 2);
    assert!(
        said.err.contains("limt") && said.err.contains("limit"),
        "{}",
        said.err
    );
    assert!(!desk.path("store").exists(), "something ran");
    desk.ends("study", 2);
    desk.ends("study limits --jobs none", 2);
    desk.ends("study limits --timeout soon", 2);
    desk.ends("wash limits", 2);
}

#[test]
fn an_empty_selection_ends_with_2_and_says_what_there_is() {
    let desk = Desk::with_study();
    let said = desk.ends("run limits --only error=0.5", 2);
    assert!(
        said.err.contains("selects no point") && said.err.contains("0.001, 0.002"),
        "{}",
        said.err
    );
    let said = desk.ends("run limits --only colour=red", 2);
    assert!(
        said.err.contains("colour") && said.err.contains("error"),
        "{}",
        said.err
    );
    // Each value exists, no point has both.
    desk.study(
        "lone",
        &format!("{STUDY}exclude: [{{scene: far, error: 0.002}}]\n"),
    );
    desk.ends("run lone --only scene=far --only error=0.002", 2);
}

#[test]
fn a_store_that_cannot_be_written_ends_with_5() {
    let desk = Desk::with_study();
    fs::write(desk.path("occupied"), "no folder").expect("a file");
    for store in ["occupied", "occupied/below"] {
        let said = desk.ends(&format!("study limits --store {store}"), 5);
        assert!(said.err.contains("occupied"), "{}", said.err);
    }
    assert_eq!(
        fs::read_to_string(desk.path("occupied")).expect("still there"),
        "no folder"
    );
}

#[test]
fn a_report_that_cannot_be_written_ends_with_5_and_keeps_the_results() {
    let desk = Desk::with_study();
    fs::write(desk.path("occupied"), "no folder").expect("a file");
    desk.ends("study limits --out occupied", 5);
    let said = desk.ends("study limits", 0);
    assert!(said.out.contains("4 cached, 0 completed"), "{}", said.out);
}

#[test]
fn a_flipped_bit_is_found_and_named() {
    let desk = Desk::with_study();
    desk.ends("run limits", 0);
    desk.ends("verify", 0);
    let (file, mut bytes) = results(&desk.path("store")).swap_remove(0);
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    fs::write(desk.path("store").join(&file), bytes).expect("a file");
    let said = desk.ends("verify", 5);
    let name = file.file_name().expect("a name").to_string_lossy().into_owned();
    assert!(
        format!("{}{}", said.out, said.err).contains(&name),
        "{}\n{}",
        said.out,
        said.err
    );
}

#[test]
fn verify_without_a_store_is_bad_input() {
    let said = Desk::new().ends("verify --store nowhere", 2);
    assert!(said.err.contains("nowhere"), "{}", said.err);
}

// Running

#[test]
fn a_second_run_finds_everything_finished() {
    let desk = Desk::with_study();
    let first = desk.ends("run limits", 0);
    assert!(first.out.contains("0 cached, 4 completed"), "{}", first.out);
    let kept = results(&desk.path("store"));
    let second = desk.ends("run limits", 0);
    assert!(second.out.contains("4 cached, 0 completed"), "{}", second.out);
    assert_eq!(results(&desk.path("store")), kept);
    let fresh = desk.ends("run limits --fresh", 0);
    assert!(fresh.out.contains("0 cached, 4 completed"), "{}", fresh.out);
    assert_eq!(
        results(&desk.path("store")),
        kept,
        "running again changed a result"
    );
}

#[test]
fn only_and_limit_leave_the_rest_for_later() {
    let desk = Desk::with_study();
    let said = desk.ends("run limits --only error=0.002 --only scene=near,far", 0);
    assert!(said.out.contains("2 completed"), "{}", said.out);
    desk.ends("run limits --only error=0.2% --only scene=near", 0);
    let said = desk.ends("run limits --limit 1", 3);
    assert!(
        said.out.contains("2 cached, 1 completed") && said.out.contains("1 not run"),
        "{}",
        said.out
    );
    let said = desk.ends("run limits", 0);
    assert!(said.out.contains("3 cached, 1 completed"), "{}", said.out);
}

#[test]
fn jobs_do_not_change_a_byte() {
    let desk = Desk::with_study();
    for jobs in [1, 2, 4] {
        desk.ends(&format!("run limits --jobs {jobs} --store store{jobs}"), 0);
    }
    let one = results(&desk.path("store1"));
    assert_eq!(results(&desk.path("store2")), one);
    assert_eq!(results(&desk.path("store4")), one);
}

#[test]
fn the_same_store_gives_the_same_report() {
    let desk = Desk::with_study();
    desk.ends("study limits --out first", 0);
    desk.ends("report limits --out second", 0);
    let verdicts = |out: &str| fs::read(desk.path(out).join("limits/verdicts.json")).expect("verdicts");
    assert_eq!(verdicts("first"), verdicts("second"));
}

#[test]
fn seeds_multiply_the_points() {
    let desk = Desk::with_study();
    let said = desk.ends("run limits --seeds 3", 0);
    assert!(said.out.contains("12 completed"), "{}", said.out);
    let said = desk.ends("report limits --seeds 3", 0);
    assert!(said.out.contains("12 points: 12 completed"), "{}", said.out);
}

#[test]
fn too_many_failures_stop_the_rest() {
    let desk = Desk::new();
    let study = "
question: When does it stop?
scene:
  rehearsal: {limit: 1, ending: diverges}
vary:
  limit: {path: scene.limit, values: [1, 2, 3, 4, 5, 6]}
observe: [limit]
";
    desk.study("failing", study);
    let said = desk.ends("run failing --jobs 1 --max-failures 2", 3);
    assert!(
        said.out.contains("2 failed") && said.out.contains("4 not run"),
        "{}",
        said.out
    );
}

#[test]
fn a_point_over_its_time_ends_and_the_others_go_on() {
    let desk = Desk::new();
    let study = "
question: Does a slow point hold up the others?
scene:
  rehearsal: {limit: 1}
vary:
  delay: {path: scene.delay, values: [0 s, 30 s]}
observe: [limit]
";
    desk.study("slow", study);
    let begun = Instant::now();
    let said = desk.ends("run slow --timeout 500ms", 3);
    assert!(
        begun.elapsed() < Duration::from_secs(15),
        "the limit was not kept"
    );
    assert!(said.out.contains("1 completed, 1 failed"), "{}", said.out);
}

#[test]
fn a_plan_runs_nothing_and_tells_why_points_would_run() {
    let desk = Desk::with_study();
    let said = desk.ends("plan limits", 0);
    assert!(
        said.out.contains("4 points: 0 cached, 4 due, 0 left out"),
        "{}",
        said.out
    );
    let dry = desk.ends("run limits --dry-run", 0);
    assert_eq!(dry.out, said.out);
    assert!(!desk.path("store").exists(), "a plan made a store");
    desk.ends("run limits --only scene=near", 0);
    let said = desk.ends("plan limits", 0);
    assert!(
        said.out.contains("4 points: 2 cached, 2 due, 0 left out"),
        "{}",
        said.out
    );
}

// Finding studies

#[test]
fn studies_are_found_from_a_folder_below_and_by_path() {
    let desk = Desk::with_study();
    let below = desk.path("deep/down");
    fs::create_dir_all(&below).expect("a folder");
    let by_name = desk
        .command("run limits")
        .current_dir(&below)
        .output()
        .expect("starts");
    assert_eq!(Said::from(by_name).code, 0);
    assert!(below.join("store").is_dir());
    let elsewhere = Desk::new();
    let path = desk.path("studies/limits.yaml");
    elsewhere.ends(&format!("run {}", path.display()), 0);
}

#[test]
fn listing_and_explaining_need_no_store() {
    let desk = Desk::with_study();
    let said = desk.ends("list", 0);
    for word in [
        "limits",
        "How far is the limit",
        "single_sphere",
        "di_felice",
        "force_balance",
        "dong_2006",
        "compare",
        "response",
        "snapshots",
    ] {
        assert!(said.out.contains(word), "{word}: {}", said.out);
    }
    let said = desk.ends("explain limits", 0);
    assert!(
        said.out.contains("near") && said.out.contains("rehearsal"),
        "{}",
        said.out
    );
    let schema = desk.ends("schema", 0).out;
    let schema: serde_json::Value = serde_json::from_str(&schema).expect("JSON");
    assert!(schema.get("properties").is_some());
    assert!(desk.ends("completions bash", 0).out.contains("kynch"));
    assert!(!desk.path("store").exists());
}

// Faults of files

#[test]
fn files_that_are_no_studies_end_with_2_and_their_name() {
    let desk = Desk::new();
    fs::create_dir(desk.path("studies/folder.yaml")).expect("a folder");
    fs::write(desk.path("studies/binary.yaml"), [0x71, 0xff, 0xfe, 0x00, 0xc3]).expect("a file");
    fs::write(desk.path("studies/empty.yaml"), "").expect("a file");
    let huge = fs::File::create(desk.path("studies/huge.yaml")).expect("a file");
    huge.set_len(50 << 20).expect("a long file");
    let mut long = String::from("question: What?\nobserve:\n");
    while long.len() < 50 << 20 {
        long.push_str("  - limit\n");
    }
    desk.study("long", &long);
    let mut bomb = String::from("a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n");
    for level in 1..12 {
        let list = vec![format!("*a{}", level - 1); 10].join(", ");
        bomb.push_str(&format!("a{level}: &a{level} [{list}]\n"));
    }
    desk.study("bomb", &format!("{bomb}question: *a11\n"));
    for name in ["missing", "folder", "binary", "empty", "huge", "long", "bomb"] {
        let begun = Instant::now();
        let said = desk.ends(&format!("study {name}"), 2);
        assert!(said.err.contains(name), "{name}: {}", said.err);
        assert!(
            said.err.len() < 20_000,
            "{name}: an error of {} bytes",
            said.err.len()
        );
        assert!(
            begun.elapsed() < Duration::from_secs(10),
            "{name} took {:?}",
            begun.elapsed()
        );
    }
    desk.ends(
        &format!("study {}", desk.path("studies/folder.yaml").display()),
        2,
    );
    desk.ends("study no/such/path.yaml", 2);
}

// Manners

#[test]
fn no_colours_where_nobody_sees_them() {
    let desk = Desk::with_study();
    desk.ends("run limits", 0);
    for typed in [
        "list",
        "plan limits",
        "explain limits",
        "report limits",
        "study missing",
    ] {
        for value in ["", "1"] {
            let output = desk
                .command(typed)
                .env("NO_COLOR", value)
                .output()
                .expect("starts");
            let said = Said::from(output);
            assert!(
                !said.out.contains('\x1b') && !said.err.contains('\x1b'),
                "{typed}"
            );
        }
    }
}

#[test]
fn a_reader_that_leaves_causes_no_panic() {
    let desk = Desk::with_study();
    for typed in ["list", "schema", "plan limits", "completions zsh", "--help"] {
        let mut child = desk
            .command(typed)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program starts");
        drop(child.stdout.take());
        let mut words = String::new();
        child
            .stderr
            .take()
            .expect("a pipe")
            .read_to_string(&mut words)
            .expect("UTF-8");
        let code = child.wait().expect("it ends").code();
        assert_eq!((code, words.as_str()), (Some(0), ""), "{typed}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn an_output_without_room_is_an_error_in_words() {
    let desk = Desk::with_study();
    let full = fs::OpenOptions::new()
        .write(true)
        .open("/dev/full")
        .expect("a device");
    let output = desk.command("list").stdout(full).output().expect("starts");
    let said = Said::from(output);
    assert_eq!(said.code, 5);
    assert!(said.err.contains("cannot write the output"), "{}", said.err);
}

#[cfg(unix)]
#[test]
fn an_interrupt_ends_with_3_and_keeps_what_is_finished() {
    let desk = Desk::new();
    let study = "
question: What is left after an interrupt?
scene:
  rehearsal: {limit: 1}
vary:
  delay: {path: scene.delay, values: [0 s, 20 s]}
observe: [limit]
";
    desk.study("slow", study);
    let mut command = desk.command("run slow --jobs 2");
    let child = command
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    std::thread::sleep(Duration::from_secs(3));
    let begun = Instant::now();
    let signalled = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status()
        .expect("kill");
    assert!(signalled.success());
    let said = Said::from(child.wait_with_output().expect("it ends"));
    assert_eq!(said.code, 3, "{}\n{}", said.out, said.err);
    assert!(begun.elapsed() < Duration::from_secs(10));
    assert!(said.err.contains("interrupted"), "{}", said.err);
    let said = desk.ends("report slow", 3);
    assert!(
        said.out.contains("1 completed, 0 failed, 1 missing"),
        "{}",
        said.out
    );
}

/// Grains of a rehearsal, three scales.
const BEDS: &str = "
question: What do the grains look like?
scene:
  rehearsal: {limit: 0.02, time_constant: 10 ms, duration: 1 s, samples: 20, grains: 64}
vary:
  scale: {path: scene.rehearsal.scale, values: [1, 2]}
expect:
  - compare: {of: scale, between: [{scale: 2}, {scale: 1}], is: greater, by: 50 %, id: greater}
figures:
  - snapshots: {times: [0 s, 0.4 s, 1 s], where: {scale: 1}, id: grains}
  - response: {of: limit, over: scale, against: [{reference: {name: known_limit}}], id: limits}
";

#[test]
fn grains_are_pictured_and_written_for_other_programs() {
    let desk = Desk::new();
    desk.study("beds", BEDS);
    let before = desk.kynch("export beds --point 0 --format vtk --out out");
    assert_eq!(before.code, 3, "{}", before.err);
    assert!(before.err.contains("kynch run beds"), "{}", before.err);
    let ran = desk.kynch("study beds");
    assert_eq!(ran.code, 0, "{}{}", ran.out, ran.err);
    assert!(ran.out.contains("greater"), "{}", ran.out);
    let picture = fs::read_to_string(desk.path("reports/beds/figures/grains.svg")).expect("a picture");
    assert_eq!(picture.matches("<circle").count(), 3 * 64);
    assert!(desk.path("reports/beds/figures/limits.svg").is_file());

    let vtk = desk.kynch("export beds --point 0 --format vtk --out out");
    assert_eq!(vtk.code, 0, "{}", vtk.err);
    assert!(vtk.out.contains("12 files written"), "{}", vtk.out);
    assert!(desk.path("out/grains.pvd").is_file() && desk.path("out/grains_0010.vtp").is_file());
    let one = desk.kynch("export beds --only scale=2 --time 300ms --format vtk --out one");
    assert_eq!(one.code, 0, "{}", one.err);
    assert_eq!(fs::read_dir(desk.path("one")).expect("a folder").count(), 2);
    let csv = desk.kynch("export beds --point 1 --format csv --out csv");
    assert_eq!(csv.code, 0, "{}", csv.err);
    let series = fs::read_to_string(desk.path("csv/time_series.csv")).expect("a table");
    assert!(series.starts_with("time [s],value [m/s]\n"), "{series}");
}

#[test]
fn an_export_that_cannot_be_made_says_what_to_do() {
    let desk = Desk::with_study();
    desk.study("beds", BEDS);
    desk.kynch("run beds");
    desk.kynch("run limits");
    fs::write(desk.path("file"), "").expect("a file");
    for (typed, code, said) in [
        ("export beds --format vtk --out out", 2, "--point 1"),
        ("export beds --point 9 --format vtk --out out", 2, "0 to 1"),
        (
            "export beds --only scale=3 --format vtk --out out",
            2,
            "scale: 1, 2",
        ),
        (
            "export beds --point 0 --time soon --format vtk --out out",
            2,
            "--time: `soon`",
        ),
        (
            "export beds --point 0 --format csv --table porosity --out out",
            2,
            "time_series, snapshots",
        ),
        (
            "export limits --point 0 --format vtk --out out",
            2,
            "keeps no snapshots",
        ),
        ("export nothing --point 0 --format vtk --out out", 2, "nothing"),
        ("export beds --point 0 --format stl --out out", 2, "vtk"),
        (
            "export beds --point 0 --only scale=1 --format vtk --out out",
            2,
            "cannot be used with",
        ),
        ("export beds --point 0 --format vtk --out file", 5, "--out"),
        (
            "export beds --point 0 --format vtk --out out --store elsewhere",
            3,
            "elsewhere",
        ),
    ] {
        let said_instead = desk.kynch(typed);
        assert_eq!(said_instead.code, code, "{typed}: {}", said_instead.err);
        assert!(said_instead.err.contains(said), "{typed}: {}", said_instead.err);
    }
}
