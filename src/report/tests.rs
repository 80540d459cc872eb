//! Reports of hand-built runs: what is on the page, and whether every figure can be read.

mod beds;
mod fits;

use std::path::Path;

use super::canvas::Area;
use super::figure::Plate;
use super::numbers::{Convergence, Curve, Numbers, PointError, Resolved};
use super::{figure, render_with, theme};
use crate::judge::model::{Outcome, PointVerdict, Verdict};
use crate::store::model::{Column, PointId, Provenance, Run, Scalar, Status, Table, Timing};
use crate::study::model::*;
use resvg::{tiny_skia, usvg};

const SPACINGS: [f64; 5] = [1.5, 2.0, 3.0, 4.0, 6.0];
const SCENES: [&str; 3] = ["sphere", "block_dilute", "block_dense"];

/// Terminal velocities [m/s], error at spacing 1, order.
const TRUTH: [(f64, f64, f64); 3] = [
    (0.00886, 0.0006, 1.4),
    (0.00491, 0.003, 1.0),
    (0.0026, 0.007, 1.2),
];

fn run(scene: usize, spacing: f64) -> Run {
    let (limit, error, order) = TRUTH[scene];
    let found = limit * (1.0 + error * spacing.powf(order));
    let time: Vec<f64> = (0..=124).map(|index| f64::from(index) * 0.5e-3).collect();
    let velocity = time
        .iter()
        .map(|time| found * (1.0 - (-time / 1.6e-3).exp()))
        .collect();
    let height: Vec<f64> = (0..60).map(|index| f64::from(index) * 1e-4).collect();
    let smoothing = 1e-4 * spacing;
    let porosity = height
        .iter()
        .map(|z| 1.0 - 0.1 * (-((z - 3e-3) / (5e-4 + smoothing)).powi(4)).exp())
        .collect();
    let column = |name: &str, unit: &str, values| Column {
        name: name.into(),
        unit: unit.into(),
        values,
    };
    Run {
        id: PointId(format!("{scene}{spacing}")),
        study: "sweep".into(),
        scene: SCENES[scene].into(),
        axes: vec![
            ("spacing_over_diameter".into(), AxisValue::Number(spacing)),
            ("width".into(), AxisValue::Number(4e-3 + 1e-4 * spacing)),
        ],
        seed: 1,
        settings: serde_json::json!({"block": {"porosity": 0.9}}),
        status: Status::Completed,
        reason: None,
        scalars: vec![Scalar {
            name: "terminal_velocity".into(),
            unit: "m/s".into(),
            value: found,
        }],
        counters: vec![
            ("steps".into(), (40_000.0 / spacing) as u64),
            ("fluid_pairs".into(), (3e9 / spacing.powi(4)) as u64),
        ],
        tables: vec![
            Table {
                name: "time_series".into(),
                columns: vec![column("time", "s", time), column("velocity", "m/s", velocity)],
            },
            Table {
                name: "porosity_profile".into(),
                columns: vec![column("height", "m", height), column("porosity", "1", porosity)],
            },
        ],
        derived: Vec::new(),
        timing: Timing {
            wall: (30.0 + 7.0 * scene as f64) / spacing.powf(3.2),
            cpu: 29.0 / spacing.powf(3.2),
            peak_memory: (60e6 / spacing) as u64,
            split: vec![("fluid".into(), 3.0), ("exchange".into(), 1.0)],
            provenance: Provenance {
                commit: "0123456789abcdef".into(),
                dirty: scene == 2,
                cpu: "AMD EPYC 7763".into(),
                version: "0.1.0".into(),
                finished: format!("2026-05-0{}T12:30:11Z", scene + 1),
                ..Provenance::default()
            },
        },
    }
}

fn runs() -> Vec<Run> {
    let all = SCENES
        .iter()
        .enumerate()
        .flat_map(|(scene, _)| SPACINGS.map(|spacing| run(scene, spacing)));
    all.collect()
}

fn drawn(id: &str, kind: FigureKind) -> Figure {
    Figure {
        id: id.into(),
        title: None,
        kind,
        selection: Selection::default(),
        thesis: Some("raso-fig5.18".into()),
    }
}

fn only(scene: &str, figure: Figure) -> Figure {
    let selection = Selection {
        scenes: vec![scene.into()],
        axes: Vec::new(),
    };
    Figure { selection, ..figure }
}

fn figures() -> Vec<Figure> {
    let series = |against: bool, group: Option<&str>| FigureKind::TimeSeries {
        of: vec!["velocity".into()],
        over: None,
        against: against.then(|| "stokes_start_up".into()),
        group: group.map(Into::into),
    };
    let error = |group: Option<&str>| FigureKind::ErrorAgainstResolution {
        of: "terminal_velocity".into(),
        against: "force_balance".into(),
        over: "spacing_over_diameter".into(),
        group: group.map(Into::into),
    };
    let cost = |group: Option<&str>| FigureKind::RunTimeAgainstError {
        work: None,
        of: "terminal_velocity".into(),
        against: "force_balance".into(),
        group: group.map(Into::into),
    };
    let profile = |group: Option<&str>| FigureKind::Profile {
        of: "porosity_profile".into(),
        group: group.map(Into::into),
    };
    vec![
        drawn("velocities", series(true, Some("scene"))),
        only("sphere", drawn("start-up", series(true, None))),
        drawn("all-runs", series(false, None)),
        drawn("convergence", error(Some("scene"))),
        only("block_dilute", drawn("convergence-of-one", error(None))),
        drawn("cost", cost(Some("scene"))),
        only("sphere", drawn("cost-of-one", cost(None))),
        drawn("porosity", profile(Some("scene"))),
        only("block_dilute", drawn("porosity-of-one", profile(None))),
    ]
}

fn study() -> Study {
    let axis = |name: &str, unit: &str, values: &[f64]| Axis {
        name: name.into(),
        unit: unit.into(),
        values: values.iter().map(|value| AxisValue::Number(*value)).collect(),
        scenes: SCENES.map(String::from).to_vec(),
    };
    Study {
        name: "sweep".into(),
        path: "studies/sweep.yaml".into(),
        question: "How far is the block's velocity from the force balance, as the fluid gets coarser?".into(),
        scenes: SCENES.map(String::from).to_vec(),
        axes: vec![
            axis("spacing_over_diameter", "1", &SPACINGS),
            axis("width", "m", &SPACINGS),
        ],
        seeds: vec![1],
        calibrated: Vec::new(),
        derive: Vec::new(),
        observe: vec!["terminal_velocity".into()],
        expect: vec![Expectation {
            id: "error-1".into(),
            check: Check::Error {
                of: "terminal_velocity".into(),
                against: "force_balance".into(),
                below: 0.02,
                norm: Norm::Maximum,
            },
            selection: Selection::default(),
            claims: vec!["raso-fig5.18-c1".into()],
            informative: None,
        }],
        figures: figures(),
        published_time: None,
        plan: Plan::default(),
    }
}

fn limit(run: &Run) -> f64 {
    SCENES
        .iter()
        .position(|scene| *scene == run.scene)
        .map_or(1.0, |scene| TRUTH[scene].0)
}

fn error(run: &Run, of: &str, _: &str) -> Result<PointError, String> {
    let computed = run.scalar(of).ok_or("no such scalar")?.value;
    let expected = limit(run);
    Ok(PointError {
        computed: Some(computed),
        expected: Some(expected),
        error: (computed / expected - 1.0).abs(),
        signed: computed / expected - 1.0,
        source: "Raso (2014), equation 4.4".into(),
    })
}

fn convergence(sweep: &[Resolved]) -> Convergence {
    let (Some(first), Some(last)) = (sweep.first(), sweep.last()) else {
        return Convergence::default();
    };
    let order = (last.error / first.error).ln() / (last.resolution / first.resolution).ln();
    Convergence {
        order: Some(order),
        index: Some(0.4 * first.error),
        no_order: None,
        no_index: None,
    }
}

fn front(pairs: &[(f64, f64)]) -> Vec<usize> {
    let beaten = |one: &(f64, f64)| pairs.iter().any(|other| other.0 < one.0 && other.1 < one.1);
    (0..pairs.len()).filter(|index| !beaten(&pairs[*index])).collect()
}

fn curve(run: &Run, _: &str, times: &[f64]) -> Result<Curve, String> {
    let limit = limit(run);
    let values = times
        .iter()
        .map(|time| limit * (1.0 - (-time / 1.6e-3).exp()))
        .collect();
    Ok(Curve {
        values,
        source: "Raso (2014), equation 4.1".into(),
    })
}

const NUMBERS: Numbers = Numbers {
    error: &error,
    convergence: &convergence,
    front: &front,
    curve: &curve,
    points: &|_, _| Ok(None),
};

fn verdicts() -> Vec<Verdict> {
    let point = |label: &str, error: f64| PointVerdict {
        id: label.into(),
        label: label.into(),
        expected: Some(0.00491),
        computed: Some(0.00491 * (1.0 + error)),
        half_width: None,
        error: Some(error),
        holds: Some(error < 0.02),
    };
    let verdict = |id: &str, outcome| Verdict {
        id: id.into(),
        statement: "relative error of terminal_velocity against force_balance < 2 %".into(),
        quantity: "terminal_velocity".into(),
        unit: "m/s".into(),
        expected: Some(0.00491),
        computed: Some(0.0051),
        half_width: None,
        error: Some(0.0387),
        band: "< 0.02".into(),
        verdict: outcome,
        reason: (outcome == Outcome::Fails).then(|| "spacing 6 is beyond the smoothing limit".into()),
        source: "Raso (2014), equation 4.4".into(),
        claims: vec!["raso-fig5.18-c1".into()],
        informative: None,
        points: vec![
            point("spacing_over_diameter=2", 0.006),
            point("spacing_over_diameter=6", 0.0387),
        ],
    };
    let mut informative = verdict("error-3", Outcome::Fails);
    informative.informative = Some("the printed value is doubtful".into());
    vec![
        verdict("error-1", Outcome::Holds),
        verdict("error-2", Outcome::Fails),
        informative,
    ]
}

fn with_a_failure() -> Vec<Run> {
    let mut runs = runs();
    runs[4].status = Status::Diverged;
    runs[4].reason = Some("velocity of grain 0 is not finite at t = 3.2 ms <script>".into());
    runs
}

fn written(study: &Study, runs: &[Run], verdicts: &[Verdict], out: &Path) -> String {
    let index = render_with(study, runs, verdicts, out, &NUMBERS).unwrap();
    std::fs::read_to_string(index).unwrap()
}

fn all_files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files.extend(all_files(&path));
        } else {
            files.push((
                path.file_name().unwrap().to_string_lossy().into_owned(),
                std::fs::read(&path).unwrap(),
            ));
        }
    }
    files.sort();
    files
}

fn plates() -> Vec<Plate> {
    let (study, runs) = (study(), runs());
    study
        .figures
        .iter()
        .map(|one| figure::draw(&study, &runs, one, &NUMBERS).unwrap())
        .collect()
}

#[test]
fn the_same_runs_give_the_same_bytes() {
    let folders = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
    for folder in &folders {
        written(&study(), &with_a_failure(), &verdicts(), folder.path());
    }
    let files = all_files(folders[0].path());
    assert_eq!(files.len(), 5 + 2 * figures().len());
    assert_eq!(files, all_files(folders[1].path()));
}

#[test]
fn the_page_says_what_held_and_where_it_comes_from() {
    let folder = tempfile::tempdir().unwrap();
    let page = written(&study(), &with_a_failure(), &verdicts(), folder.path());
    for expected in [
        "1 of 2 expectations do not hold; 1 of 15 points missing or failed.",
        "AMD EPYC 7763",
        "0123456789ab (modified)",
        "2026-05-03 12:30 UTC",
        "velocity of grain 0 is not finite",
        "Raso (2014), figure 5.18",
        "4.910</td>",
        "3.87 %",
        "&lt; 2 %",
        "cargo study sweep",
        "figures/convergence.csv",
    ] {
        assert!(page.contains(expected), "`{expected}` is not on the page");
    }
    assert!(!page.contains("<script"), "a reason must not become markup");
    assert!(
        !page.contains("http:")
            || page.matches("http:").count() == page.matches("xmlns=\"http://www.w3.org").count()
    );
}

#[test]
fn the_failed_point_enters_no_figure() {
    let (study, runs) = (study(), with_a_failure());
    let plate = figure::draw(&study, &runs, &study.figures[1], &NUMBERS).unwrap();
    assert!(!plate.table.csv().contains("spacing 6 d"));
    assert!(plate.table.csv().contains("spacing 4 d"));
    assert_eq!(plate.notes.last().unwrap(), "Left out: 1 failed.");
}

fn notes_of(id: &str) -> String {
    let plates = plates();
    let plate = plates.iter().find(|plate| plate.id == id).unwrap();
    plate.notes.join(" ")
}

#[test]
fn a_fast_start_is_enlarged_where_there_is_room() {
    assert!(notes_of("start-up").contains("Inset: the first 10 ms."));
    // Slower scenes lie where the inset would be.
    assert!(!notes_of("velocities").contains("Inset"));
}

#[test]
fn each_scene_has_a_front_of_its_own() {
    let plates = plates();
    let cost = plates.iter().find(|plate| plate.id == "cost").unwrap();
    // Within a scene a finer spacing is always dearer and better, so that no point is beaten.
    assert_eq!(cost.table.csv().matches(",yes\n").count(), 15);
}

#[test]
fn what_a_sweep_cannot_show_is_said_with_the_reason() {
    let study = study();
    let mut runs = runs();
    for (run, error) in runs[5..10].iter_mut().zip([-0.01, 0.02, -0.005, 0.01, -0.01]) {
        run.settings = serde_json::json!({"rehearsal": {
            "limit": 2.0, "time_constant": 0.1, "duration": 1.0, "samples": 20, "scale": 1.0,
            "order": 2.0, "error": 0.0, "delay": 0.0, "ending": "completes"
        }});
        run.scalars[0].value = 2.0 * (1.0 + error);
    }
    let kind = FigureKind::ErrorAgainstResolution {
        of: "terminal_velocity".into(),
        against: "known_limit".into(),
        over: "spacing_over_diameter".into(),
        group: None,
    };
    let figure = only("block_dilute", drawn("signs", kind));
    let plate = figure::draw(&study, &runs, &figure, &Numbers::JUDGED).unwrap();
    let notes = plate.notes.join(" ");
    for told in [
        "known limit, 2.000 m/s",
        "open ones: below it",
        "No observed order, because the error changes its sign along the sweep",
        "no grid convergence index, because the values rise and fall along the sweep",
    ] {
        assert!(notes.contains(told), "{told}: {notes}");
    }
    assert!(!plate.svg.contains("order"));
}

#[test]
fn an_identifier_cannot_leave_the_folder() {
    let mut study = study();
    study.figures.truncate(1);
    study.figures[0].id = "../a b/<c>".into();
    let folder = tempfile::tempdir().unwrap();
    let page = written(&study, &runs(), &[], folder.path());
    assert!(folder.path().join("figures/-a-b--c-.svg").exists());
    assert!(page.contains("figures/-a-b--c-.csv"));
}

#[test]
fn missing_points_leave_the_study_incomplete() {
    let mut study = study();
    let rehearsal = Rehearsal {
        limit: 1.0,
        time_constant: 1.0,
        duration: 1.0,
        samples: 2,
        scale: 1.0,
        order: 1.0,
        error: 0.0,
        grains: 0,
        delay: 0.0,
        ending: RehearsalEnding::Completes,
    };
    study.plan.points = (0..17)
        .map(|index| Point {
            index,
            scene: "sphere".into(),
            axes: Vec::new(),
            seed: 1,
            settings: serde_json::Value::Null,
            work: Work::Rehearsal(rehearsal.clone()),
        })
        .collect();
    let folder = tempfile::tempdir().unwrap();
    let page = written(&study, &runs(), &verdicts()[..1], folder.path());
    assert!(page.contains("Incomplete") && page.contains("2 of 17 points missing or failed"));
}

#[test]
fn a_study_without_expectations_or_runs_is_shown_as_such() {
    let folder = tempfile::tempdir().unwrap();
    let exploratory = Study {
        expect: Vec::new(),
        ..study()
    };
    let page = written(&exploratory, &[], &[], folder.path());
    assert!(page.contains("Exploratory") && page.contains("no completed run belongs to this figure"));
}

#[test]
fn calibrated_inputs_are_named_with_the_points_they_were_fitted_on() {
    let folder = tempfile::tempdir().unwrap();
    let plain = written(&study(), &runs(), &verdicts(), folder.path());
    assert!(!plain.contains("Calibrated inputs"));
    let fitted = Study {
        calibrated: vec![Calibrated {
            scene: "sphere".into(),
            path: ["single_sphere", "column", "height"].map(String::from).to_vec(),
            value: AxisValue::Number(0.006),
            unit: "m".into(),
            of: "terminal_velocity".into(),
            against: "force_balance".into(),
            on: Selection {
                scenes: vec!["sphere".into()],
                axes: vec![("width".into(), vec![AxisValue::Number(0.004)])],
            },
        }],
        ..study()
    };
    let page = written(&fitted, &runs(), &verdicts(), folder.path());
    let text = std::fs::read_to_string(folder.path().join("report.md")).unwrap();
    for text in [page, text] {
        assert!(text.contains("Calibrated inputs") && text.contains("scenes.sphere.column.height"));
        assert!(text.contains("6 mm") && text.contains("sphere; width 4 mm"));
    }
}

#[test]
fn a_published_time_stands_beside_that_of_a_point() {
    let folder = tempfile::tempdir().unwrap();
    let timed = Study {
        published_time: Some(PublishedTime {
            seconds: 7.0 * 3600.0,
            source: "a thesis".into(),
        }),
        ..study()
    };
    let mut runs = runs();
    for (index, run) in runs.iter_mut().enumerate() {
        run.timing.cpu = [4.0, 6.0][index % 2];
        run.scene = SCENES[0].into();
    }
    runs.truncate(2);
    let page = written(&timed, &runs, &verdicts(), folder.path());
    let text = std::fs::read_to_string(folder.path().join("report.md")).unwrap();
    for page in [&page, &text] {
        for part in ["5.0 s", "6.0 s", "7.0 h", "5000 ×", "a thesis"] {
            assert!(page.contains(part), "{part}");
        }
    }
    let without = written(&study(), &runs, &verdicts(), folder.path());
    assert!(!without.contains("7.0 h"));
}

#[test]
fn figures_of_an_earlier_study_do_not_stay() {
    let folder = tempfile::tempdir().unwrap();
    written(&study(), &runs(), &verdicts(), folder.path());
    let fewer = Study {
        figures: vec![study().figures.remove(0)],
        ..study()
    };
    written(&fewer, &runs(), &verdicts(), folder.path());
    assert!(folder.path().join("figures/velocities.svg").exists());
    assert!(!folder.path().join("figures/cost.svg").exists());
}

#[test]
fn junit_and_json_carry_every_verdict() {
    let folder = tempfile::tempdir().unwrap();
    written(&study(), &with_a_failure(), &verdicts(), folder.path());
    let xml = std::fs::read_to_string(folder.path().join("junit.xml")).unwrap();
    assert!(
        xml.contains("tests=\"18\" skipped=\"1\" failures=\"1\" errors=\"1\""),
        "{xml}"
    );
    let json: serde_json::Value =
        serde_json::from_slice(&std::fs::read(folder.path().join("verdicts.json")).unwrap()).unwrap();
    assert_eq!(json[1]["verdict"], "fails");
    assert_eq!(json[0]["points"][1]["error"], 0.0387);
    for key in [
        "id",
        "quantity",
        "unit",
        "expected",
        "computed",
        "error",
        "band",
        "source",
        "statement",
    ] {
        assert!(json[0].get(key).is_some(), "{key}");
    }
}

#[test]
fn the_table_of_a_figure_holds_its_numbers() {
    let plates = plates();
    let plate = plates.iter().find(|plate| plate.id == "convergence").unwrap();
    assert_eq!(plate.table.rows.len(), 15);
    let second = plate.table.csv().lines().nth(2).unwrap().to_owned();
    let error: f64 = second.rsplit(',').nth(2).unwrap().parse().unwrap();
    assert!((error - 0.0006 * 2f64.powf(1.4)).abs() < 1e-12, "{second}");
}

#[test]
fn errors_that_vanish_are_drawn_on_linear_axes() {
    let study = study();
    let exact = |run: &Run, of: &str, against: &str| {
        error(run, of, against).map(|found| PointError { error: 0.0, ..found })
    };
    let numbers = Numbers {
        error: &exact,
        ..NUMBERS
    };
    for one in &study.figures {
        let plate = figure::draw(&study, &runs(), one, &numbers).unwrap();
        assert!(!plate.svg.contains("NaN"), "{}", plate.id);
        assert_texts_inside(&plate);
    }
}

#[test]
fn a_single_run_makes_every_figure() {
    let study = study();
    let single = [run(0, 2.0)];
    for one in study
        .figures
        .iter()
        .filter(|one| one.selection.scenes != ["block_dilute"])
    {
        assert_texts_inside(&figure::draw(&study, &single, one, &NUMBERS).unwrap());
    }
}

fn assert_texts_inside(plate: &Plate) {
    let paper = Area {
        left: 0,
        top: 0,
        right: theme::WIDTH,
        bottom: plate.drawing.height,
    };
    for (text, area) in &plate.drawing.texts {
        assert!(
            paper.contains(area),
            "`{text}` leaves figure {}: {area:?} {paper:?}",
            plate.id
        );
    }
}

#[test]
fn no_text_is_cut_or_covers_another() {
    for plate in plates() {
        assert_readable(&plate);
    }
}

fn assert_readable(plate: &Plate) {
    assert_texts_inside(plate);
    for (index, (text, area)) in plate.drawing.texts.iter().enumerate() {
        for (other, covered) in &plate.drawing.texts[..index] {
            assert!(
                !area.meets(covered),
                "`{text}` covers `{other}` in figure {}",
                plate.id
            );
        }
    }
}

/// Every figure as a picture: something is drawn, and the border stays empty.
#[test]
fn every_figure_becomes_a_picture() {
    for plate in plates() {
        assert_pictured(&plate);
    }
    if let Some(folder) = pictures() {
        written(&study(), &with_a_failure(), &verdicts(), &folder);
    }
}

/// Where pictures are kept for looking at them.
fn pictures() -> Option<std::path::PathBuf> {
    std::env::var_os("KYNCH_PICTURES").map(std::path::PathBuf::from)
}

/// Draws a figure on white; where pictures are kept, on a dark page, too.
fn assert_pictured(plate: &Plate) {
    let light = pixels(&plate.svg, tiny_skia::Color::WHITE);
    let (width, height) = (light.width(), light.height());
    let white = |x: u32, y: u32| {
        light
            .pixel(x, y)
            .is_some_and(|pixel| pixel.red() > 250 && pixel.green() > 250)
    };
    let inked = (0..height)
        .flat_map(|y| (0..width).map(move |x| (x, y)))
        .filter(|(x, y)| !white(*x, *y))
        .count();
    assert!(
        inked as f64 > 0.01 * f64::from(width * height),
        "{} is blank",
        plate.id
    );
    let border = (0..height).all(|y| white(0, y) && white(width - 1, y))
        && (0..width).all(|x| white(x, 0) && white(x, height - 1));
    assert!(border, "{} is cut at its border", plate.id);
    if let Some(folder) = pictures() {
        light.save_png(folder.join(format!("{}.png", plate.id))).unwrap();
        let dark = pixels(
            &theme::dark(&plate.svg),
            tiny_skia::Color::from_rgba8(0x16, 0x16, 0x16, 255),
        );
        dark.save_png(folder.join(format!("{}-dark.png", plate.id)))
            .unwrap();
    }
}

fn pixels(svg: &str, ground: tiny_skia::Color) -> tiny_skia::Pixmap {
    let mut options = usvg::Options::default();
    for name in ["DejaVuSans.ttf", "DejaVuSans-Bold.ttf"] {
        if let Ok(font) = std::fs::read(Path::new("/usr/share/fonts/truetype/dejavu").join(name)) {
            options.fontdb_mut().load_font_data(font);
        }
    }
    options.fontdb_mut().set_sans_serif_family("DejaVu Sans");
    let tree = usvg::Tree::from_str(svg, &options).unwrap();
    let size = tree.size().to_int_size();
    let scale = if pictures().is_some() { 2.5 } else { 0.8 };
    let (width, height) = (
        (size.width() as f32 * scale) as u32,
        (size.height() as f32 * scale) as u32,
    );
    let mut picture = tiny_skia::Pixmap::new(width, height).unwrap();
    picture.fill(ground);
    let transform = tiny_skia::Transform::from_scale(scale, scale);
    resvg::render(&tree, transform, &mut picture.as_mut());
    picture
}

/// The whole way with the judge's own numbers: a sweep whose error is 3 % · scale² exactly.
#[test]
fn a_rehearsed_sweep_shows_the_order_it_was_given() {
    let rehearsed = |scale: f64| {
        let found = 2.0 * (1.0 + 0.03 * scale.powi(2));
        let mut run = run(0, scale);
        run.settings = serde_json::json!({"rehearsal": {
            "limit": 2.0, "time_constant": 0.1, "duration": 1.0, "samples": 20, "scale": scale,
            "order": 2.0, "error": 0.03, "delay": 0.0, "ending": "completes"
        }});
        run.axes = vec![("scale".into(), AxisValue::Number(scale))];
        run.scalars = vec![Scalar {
            name: "limit".into(),
            unit: "m/s".into(),
            value: found,
        }];
        run
    };
    let runs: Vec<Run> = [0.125, 0.25, 0.5, 1.0].map(rehearsed).to_vec();
    let kind = |convergence: bool| {
        let (of, against) = ("limit".into(), "known_limit".into());
        match convergence {
            true => FigureKind::ErrorAgainstResolution {
                of,
                against,
                over: "scale".into(),
                group: None,
            },
            false => FigureKind::RunTimeAgainstError {
                work: None,
                of,
                against,
                group: None,
            },
        }
    };
    let study = Study {
        figures: vec![drawn("order", kind(true)), drawn("price", kind(false))],
        ..study()
    };
    let folder = tempfile::tempdir().unwrap();
    super::render(&study, &runs, &[], folder.path()).unwrap();
    let file = |name: &str| std::fs::read_to_string(folder.path().join("figures").join(name)).unwrap();
    assert!(file("order.svg").contains("order 2.0"));
    assert_eq!(file("price.csv").matches(",yes\n").count(), 4);
    let index: f64 = file("order.csv")
        .lines()
        .nth(1)
        .unwrap()
        .rsplit(',')
        .next()
        .unwrap()
        .parse()
        .unwrap();
    // Three quarters of the difference between the two finest are what is left: 1.25 times the true error.
    assert!((index - 1.25 * 0.03 * 0.125f64.powi(2)).abs() < 1e-5, "{index}");
}
