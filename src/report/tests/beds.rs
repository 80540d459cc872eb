//! Figures of beds of grains: pictures, responses over seeds, published data beside.

use super::{assert_pictured, assert_readable, pictures};
use crate::report::figure::{self, Plate};
use crate::report::numbers::Numbers;
use crate::store::model::{Column, PointId, Run, Scalar, Status, Table, Timing};
use crate::study::model::*;

const DENSITIES: [f64; 4] = [500.0, 1000.0, 1500.0, 2000.0];
const VISCOSITIES: [f64; 3] = [1e-3, 5e-3, 10e-3];
const SEEDS: u64 = 4;

/// A fraction that looks random and is not.
fn scatter(number: u64) -> f64 {
    let mixed = (number + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((mixed ^ (mixed >> 31)) >> 11) as f64 / (1u64 << 53) as f64
}

fn column(name: &str, unit: &str, values: Vec<f64>) -> Column {
    Column {
        name: name.into(),
        unit: unit.into(),
        values,
    }
}

/// Settling of one density, viscosity and seed.
fn run(density: f64, viscosity: f64, seed: u64) -> Run {
    let noise = 0.03 * (scatter(seed * 31 + density as u64 + (viscosity * 1e6) as u64) - 0.5);
    let porosity = 0.40 + 0.04 * density / 2000.0 + 2.0 * viscosity + noise;
    let times: Vec<f64> = (0..=60 + seed).map(|index| index as f64 / 60.0).collect();
    let curve = |time: &f64| 1.0 - (1.0 - porosity) * (1.0 - (-time / (0.1 + 20.0 * viscosity)).exp());
    let height: Vec<f64> = (0..40).map(|index| f64::from(index) * 1e-4).collect();
    let profile = height
        .iter()
        .map(|z| porosity + 0.3 * noise.abs() + 0.2 * (-z / 3e-4).exp());
    Run {
        id: PointId(format!("{density}-{viscosity}-{seed}")),
        study: "beds".into(),
        scene: "bed".into(),
        axes: vec![
            ("fluid_density".into(), AxisValue::Number(density)),
            ("viscosity".into(), AxisValue::Number(viscosity)),
        ],
        seed,
        settings: serde_json::json!({"sedimentation": {
            "container": {"width": 2.5e-3, "height": 10e-3},
            "fluid": {"still": {"density": density, "viscosity": viscosity}}}}),
        status: Status::Completed,
        reason: None,
        scalars: vec![Scalar {
            name: "solids_fraction".into(),
            unit: "1".into(),
            value: 1.0 - porosity,
        }],
        counters: Vec::new(),
        tables: vec![
            Table {
                name: "time_series".into(),
                columns: vec![
                    column("time", "s", times.clone()),
                    column("porosity", "1", times.iter().map(curve).collect()),
                ],
            },
            Table {
                name: "porosity_profile".into(),
                columns: vec![
                    column("height", "m", height.clone()),
                    column("porosity", "1", profile.collect()),
                ],
            },
        ],
        derived: Vec::new(),
        timing: Timing::default(),
    }
}

/// Grains at three instants: suspended, falling, settled.
fn snapshots(grains: u64) -> Table {
    let names = [
        "time",
        "grain",
        "class",
        "x",
        "y",
        "z",
        "radius",
        "speed_x",
        "speed_y",
        "speed_z",
        "coordination",
    ];
    let units = ["s", "1", "1", "m", "m", "m", "m", "m/s", "m/s", "m/s", "1"];
    let mut values = vec![Vec::new(); names.len()];
    for (instant, time) in [0.0, 0.11, 1.0].into_iter().enumerate() {
        for grain in 0..grains {
            let of = |salt: u64| scatter(grain * 8 + salt);
            let radius = 75e-6 + 175e-6 * of(1);
            let inside = |share: f64| radius + share * (2.5e-3 - 2.0 * radius);
            let bed = [1.0, 0.7, 0.4][instant];
            let height = radius + of(2) * (bed * 10e-3 - 2.0 * radius);
            let speed = [0.0, -0.03 * of(3), 0.0][instant];
            let row = [
                time,
                grain as f64,
                (of(1) * 3.0).floor(),
                inside(of(4)),
                inside(of(5)),
                height,
                radius,
            ];
            let row = row.into_iter().chain([0.002 * speed, 0.0, speed, 6.0 * of(6)]);
            for (column, value) in values.iter_mut().zip(row) {
                column.push(value);
            }
        }
    }
    let columns = names.iter().zip(units).zip(values);
    Table {
        name: "snapshots".into(),
        columns: columns
            .map(|((name, unit), values)| column(name, unit, values))
            .collect(),
    }
}

fn runs() -> Vec<Run> {
    let mut runs = Vec::new();
    for density in DENSITIES {
        for viscosity in VISCOSITIES {
            runs.extend((1..=SEEDS).map(|seed| run(density, viscosity, seed)));
        }
    }
    runs
}

fn study(path: &str) -> Study {
    let axis = |name: &str, unit: &str, values: &[f64]| Axis {
        name: name.into(),
        unit: unit.into(),
        values: values.iter().map(|value| AxisValue::Number(*value)).collect(),
        scenes: vec!["bed".into()],
    };
    Study {
        name: "beds".into(),
        path: path.into(),
        question: "How loose does the bed become in a denser fluid?".into(),
        scenes: vec!["bed".into()],
        axes: vec![
            axis("fluid_density", "kg/m3", &DENSITIES),
            axis("viscosity", "Pa s", &VISCOSITIES),
        ],
        seeds: (1..=SEEDS).collect(),
        calibrated: Vec::new(),
        derive: Vec::new(),
        observe: Vec::new(),
        expect: Vec::new(),
        figures: Vec::new(),
        published_time: None,
        plan: Plan::default(),
    }
}

fn at(axis: &str, value: f64) -> Selection {
    Selection {
        scenes: Vec::new(),
        axes: vec![(axis.into(), vec![AxisValue::Number(value)])],
    }
}

fn drawn(id: &str, kind: FigureKind, selection: Selection) -> Figure {
    Figure {
        id: id.into(),
        title: None,
        kind,
        selection,
        thesis: None,
    }
}

fn response(group: Option<&str>, against: Vec<Beside>) -> FigureKind {
    FigureKind::Response {
        of: "solids_fraction".into(),
        over: "fluid_density".into(),
        group: group.map(Into::into),
        against,
    }
}

fn plate(runs: &[Run], figure: &Figure) -> Plate {
    figure::draw(&study("studies/beds.yaml"), runs, figure, &Numbers::JUDGED).unwrap()
}

fn picture(times: &[f64]) -> FigureKind {
    FigureKind::Snapshots {
        times: times.to_vec(),
    }
}

/// One point with its snapshots.
fn bed(grains: u64) -> Vec<Run> {
    let mut run = run(1000.0, 1e-3, 1);
    run.tables.push(snapshots(grains));
    vec![run]
}

fn published(folder: &std::path::Path) -> Beside {
    let references = folder.join("references");
    std::fs::create_dir_all(&references).unwrap();
    let index = "citations: {someone_2006: 'Someone (2006), Powder Technology 1, 1'}\n\
                 datasets:\n- {file: beds.csv, title: Beds, citation_keys: [someone_2006], provenance: quoted, \
                 confidence: high}\n";
    std::fs::write(references.join("references.yaml"), index).unwrap();
    let table = "case,rho,fraction\na,0.5,0.585\na,1.2,0.575\na,2.1,0.545\nb,1,0.1\n";
    std::fs::write(references.join("beds.csv"), table).unwrap();
    Beside::Data(DataSeries {
        file: "beds.csv".into(),
        x: "rho".into(),
        y: "fraction".into(),
        factors: (1000.0, 1.0),
        rows: vec![("case".into(), "a".into())],
        label: Some("Someone (2006)".into()),
    })
}

#[test]
fn figures_of_beds_can_be_read() {
    let folder = tempfile::tempdir().unwrap();
    let beside = vec![published(folder.path())];
    let study = study(&folder.path().join("studies/beds.yaml").display().to_string());
    let series = FigureKind::TimeSeries {
        of: vec!["porosity".into()],
        over: None,
        against: None,
        group: Some("viscosity".into()),
    };
    let profile = FigureKind::Profile {
        of: "porosity_profile".into(),
        group: None,
    };
    let runs = runs();
    let figures = [
        drawn("response", response(None, beside.clone()), at("viscosity", 1e-3)),
        drawn(
            "responses",
            response(Some("viscosity"), beside),
            Selection::default(),
        ),
        drawn("porosity-over-time", series, at("fluid_density", 1000.0)),
        drawn("profiles", profile, at("viscosity", 1e-3)),
    ];
    let mut plates: Vec<Plate> = figures
        .iter()
        .map(|figure| figure::draw(&study, &runs, figure, &Numbers::JUDGED).unwrap())
        .collect();
    for (id, times) in [
        ("three-panels", &[0.0, 0.1, 1.0][..]),
        ("two-panels", &[0.1, 1.0]),
        ("one-panel", &[1.0]),
    ] {
        plates.push(plate(
            &bed(if pictures().is_some() { 2000 } else { 200 }),
            &drawn(id, picture(times), Selection::default()),
        ));
    }
    for plate in &plates {
        assert_readable(plate);
        assert_pictured(plate);
    }
}

#[test]
fn panels_show_the_nearest_instants_back_to_front_within_a_megabyte() {
    let plate = plate(
        &bed(2000),
        &drawn("bed", picture(&[0.0, 0.1, 0.12, 5.0]), Selection::default()),
    );
    assert!(plate.svg.len() < 1_000_000, "{}", plate.svg.len());
    assert_eq!(plate.svg.matches("<circle").count(), 3 * 2000);
    assert_eq!(plate.svg.matches("<g stroke").count(), 3);
    let texts: Vec<&str> = plate
        .drawing
        .texts
        .iter()
        .map(|(text, _)| text.as_str())
        .collect();
    for expected in [
        "t = 0 s",
        "t = 0.11 s",
        "t = 1 s",
        "x (mm)",
        "z (mm)",
        "speed (mm/s)",
    ] {
        assert!(texts.contains(&expected), "{expected} in {texts:?}");
    }
    assert_eq!(plate.table.rows.len(), 3 * 2000);
}

#[test]
fn the_front_covers_the_back_and_speed_gives_the_colour() {
    let mut run = bed(2).remove(0);
    let table = run.tables.last_mut().unwrap();
    for column in &mut table.columns {
        column.values.truncate(2);
    }
    let mut set = |name: &str, values: [f64; 2]| {
        let column = table
            .columns
            .iter_mut()
            .find(|column| column.name == name)
            .unwrap();
        column.values = values.to_vec();
    };
    set("y", [1e-3, 2e-3]);
    set("speed_z", [-0.02, 0.0]);
    set("speed_x", [0.0, 0.0]);
    let plate = plate(&[run], &drawn("two", picture(&[0.0]), Selection::default()));
    let circles: Vec<&str> = plate
        .svg
        .lines()
        .filter(|line| line.starts_with("<circle"))
        .collect();
    // The grain at larger y is farther away: drawn first, at rest and dark; then the fast one.
    assert!(
        circles[0].contains("#440154") && circles[1].contains("#FDE725"),
        "{circles:?}"
    );
}

#[test]
fn pictures_that_cannot_be_made_say_why() {
    let problem = |runs: &[Run]| {
        let figure = drawn("bed", picture(&[0.0]), Selection::default());
        figure::draw(&study("studies/beds.yaml"), runs, &figure, &Numbers::JUDGED)
            .unwrap_err()
            .to_string()
    };
    assert!(problem(&[run(500.0, 1e-3, 1)]).contains("keeps no snapshots"));
    let two = [bed(3), runs()].concat();
    assert!(problem(&two).contains("one point"), "{}", problem(&two));
    let mut torn = bed(3);
    torn[0].tables.last_mut().unwrap().columns.remove(6);
    assert!(problem(&torn).contains("`radius`"));
}

#[test]
fn grains_at_rest_and_without_a_container_are_drawn() {
    let mut still = bed(5);
    still[0].settings = serde_json::Value::Null;
    for column in &mut still[0].tables.last_mut().unwrap().columns {
        if column.name.starts_with("speed") {
            column.values.fill(0.0);
        }
    }
    let plate = plate(
        &still,
        &drawn("still", picture(&[0.0, 1.0]), Selection::default()),
    );
    assert_readable(&plate);
    assert!(!plate.svg.contains("NaN"));
}

#[test]
fn a_response_is_the_mean_over_seeds_with_its_scatter() {
    let runs = runs();
    let plate = plate(
        &runs,
        &drawn("r", response(Some("viscosity"), Vec::new()), Selection::default()),
    );
    assert_eq!(plate.table.rows.len(), 12);
    let values = runs[..4].iter().map(|run| run.scalars[0].value);
    let mean = values.sum::<f64>() / 4.0;
    let line = plate.table.csv().lines().nth(1).unwrap().to_owned();
    let found: f64 = line.split(',').nth(2).unwrap().parse().unwrap();
    assert!((found - mean).abs() < 1e-12, "{line}");
    assert!(line.ends_with(",4"));
    assert!(
        plate.notes.iter().any(|note| note.contains("4 seeds")),
        "{:?}",
        plate.notes
    );
    let single: Vec<Run> = runs.into_iter().filter(|run| run.seed == 1).collect();
    let figure = drawn("r", response(None, Vec::new()), at("viscosity", 1e-3));
    let plate = super::beds::plate(&single, &figure);
    assert!(plate.notes.iter().all(|note| !note.contains("seeds")));
}

#[test]
fn published_data_stand_beside_in_si_units_with_their_citation() {
    let folder = tempfile::tempdir().unwrap();
    let beside = published(folder.path());
    let study = study(&folder.path().join("studies/beds.yaml").display().to_string());
    let draw = |beside: &Beside| {
        let figure = drawn("r", response(None, vec![beside.clone()]), at("viscosity", 1e-3));
        figure::draw(&study, &runs(), &figure, &Numbers::JUDGED)
    };
    let plate = draw(&beside).unwrap();
    let csv = plate.table.csv();
    assert!(csv.contains("Someone (2006),1200,0.575,,,"), "{csv}");
    assert!(!csv.contains("0.1,,"));
    assert!(plate.notes.iter().any(|note| note.contains("Powder Technology")));
    let Beside::Data(mut series) = beside else {
        unreachable!()
    };
    series.y = "porosity".into();
    let why = draw(&Beside::Data(series.clone())).unwrap_err().to_string();
    assert!(why.contains("case, rho, fraction"), "{why}");
    series.file = "beads.csv".into();
    let why = draw(&Beside::Data(series)).unwrap_err().to_string();
    assert!(why.contains("beads.csv"), "{why}");
}

#[test]
fn published_references_stand_where_they_have_a_value() {
    let draw = |runs: &[Run], name: &str| {
        let beside = vec![Beside::Reference(name.into())];
        let figure = drawn("r", response(Some("viscosity"), beside), Selection::default());
        figure::draw(&study("studies/beds.yaml"), runs, &figure, &Numbers::JUDGED)
    };
    let plate = draw(&runs(), "dong_2006").unwrap();
    let csv = plate.table.csv();
    let beside: Vec<&str> = csv.lines().filter(|line| line.starts_with("dong")).collect();
    // The data have 500 kg/m³; the other densities of these runs lie between theirs.
    assert_eq!(beside, ["dong 2006,500,0.6071,,,"]);
    assert!(
        plate.notes.iter().any(|note| note.contains("Dong, K. J.")),
        "{:?}",
        plate.notes
    );
    assert_readable(&plate);
    let elsewhere: Vec<Run> = DENSITIES[1..]
        .iter()
        .map(|density| run(*density, 1e-3, 1))
        .collect();
    let why = draw(&elsewhere, "dong_2006").unwrap_err().to_string();
    assert!(why.contains("no row with `fluid.density`"), "{why}");
}

#[test]
fn curves_over_seeds_are_means_with_bands() {
    let series = FigureKind::TimeSeries {
        of: vec!["porosity".into()],
        over: None,
        against: None,
        group: Some("viscosity".into()),
    };
    let plate = plate(&runs(), &drawn("t", series, at("fluid_density", 1000.0)));
    assert_eq!(plate.svg.matches("<polygon opacity=\"0.2\"").count(), 3);
    assert!(
        plate.table.head.contains(&"porosity deviation [1]".to_owned()),
        "{:?}",
        plate.table.head
    );
    assert!(
        plate.notes.iter().any(|note| note.contains("means over 4 seeds")),
        "{:?}",
        plate.notes
    );
    assert!(!plate.table.csv().contains("seed 1"));
}
