use resvg::usvg::roxmltree::{Document, Node};

use super::*;
use crate::store::model::{Column, PointId, Status, Timing};

const NAMES: [&str; 11] = [
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

/// Three grains at two times.
fn run() -> Run {
    let mut values = vec![Vec::new(); NAMES.len()];
    for time in [0.0, 0.1] {
        for grain in 0..3 {
            let at = f64::from(grain);
            let row = [
                time,
                at,
                at % 2.0,
                1e-3 * at,
                2e-3,
                3e-3 - 0.01 * time,
                1e-4 + 1e-5 * at,
                3.0,
                0.0,
                4.0 * time,
                at,
            ];
            for (column, value) in values.iter_mut().zip(row) {
                column.push(value);
            }
        }
    }
    let columns = NAMES.iter().zip(values).map(|(name, values)| Column {
        name: (*name).into(),
        unit: "1".into(),
        values,
    });
    let series = Table {
        name: "time_series".into(),
        columns: vec![
            Column {
                name: "time".into(),
                unit: "s".into(),
                values: vec![0.0, 0.05, 0.1],
            },
            Column {
                name: "porosity".into(),
                unit: "1".into(),
                values: vec![0.9, 0.1 + 0.2, 1.25e-7],
            },
        ],
    };
    Run {
        id: PointId("one".into()),
        study: "bed".into(),
        scene: "bed".into(),
        axes: Vec::new(),
        seed: 1,
        settings: serde_json::Value::Null,
        status: Status::Completed,
        reason: None,
        scalars: Vec::new(),
        counters: Vec::new(),
        tables: vec![
            series,
            Table {
                name: "snapshots".into(),
                columns: columns.collect(),
            },
        ],
        derived: Vec::new(),
        timing: Timing::default(),
    }
}

fn wanted(format: Format) -> Wanted {
    Wanted {
        format,
        time: None,
        table: None,
    }
}

fn text(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).unwrap()
}

fn array(document: &Document, name: &str) -> Vec<f64> {
    let named = |node: &Node| node.attribute("Name") == Some(name);
    let node = document.descendants().find(named).unwrap();
    let words = node.text().unwrap().split_whitespace();
    words.map(|word| word.parse().unwrap()).collect()
}

#[test]
fn a_series_of_grains_reads_back_as_it_was_stored() {
    let folder = tempfile::tempdir().unwrap();
    let files = export(&run(), &wanted(Format::Vtk), folder.path()).unwrap();
    assert_eq!(files.len(), 3);
    let collection = text(folder.path(), "grains.pvd");
    let collection = Document::parse(&collection).unwrap();
    let listed: Vec<(f64, String)> = collection
        .descendants()
        .filter(|node| node.has_tag_name("DataSet"))
        .map(|node| {
            let time = node.attribute("timestep").unwrap().parse().unwrap();
            (time, node.attribute("file").unwrap().to_owned())
        })
        .collect();
    assert_eq!(
        listed.iter().map(|(time, _)| *time).collect::<Vec<_>>(),
        [0.0, 0.1]
    );
    let second = text(folder.path(), &listed[1].1);
    let second = Document::parse(&second).unwrap();
    assert_eq!(second.root_element().attribute("type"), Some("PolyData"));
    let piece = second
        .descendants()
        .find(|node| node.has_tag_name("Piece"))
        .unwrap();
    assert_eq!(piece.attribute("NumberOfPoints"), Some("3"));
    let places = array(&second, "points");
    assert_eq!(places.len(), 9);
    assert_eq!(places[3..6], [1e-3, 2e-3, 3e-3 - 0.01 * 0.1]);
    assert_eq!(array(&second, "radius"), [1e-4, 1e-4 + 1e-5, 1e-4 + 2e-5]);
    assert_eq!(array(&second, "grain"), [0.0, 1.0, 2.0]);
    assert_eq!(array(&second, "offsets"), [1.0, 2.0, 3.0]);
    let velocity = array(&second, "velocity");
    for (speed, parts) in array(&second, "speed").iter().zip(velocity.chunks(3)) {
        let squares: f64 = parts.iter().map(|part| part * part).sum();
        assert!((speed * speed - squares).abs() < 1e-12);
    }
}

#[test]
fn one_time_is_the_nearest_kept() {
    let folder = tempfile::tempdir().unwrap();
    let late = Wanted {
        time: Some(7.0),
        ..wanted(Format::Vtk)
    };
    assert_eq!(export(&run(), &late, folder.path()).unwrap().len(), 2);
    assert!(text(folder.path(), "grains.pvd").contains("timestep=\"0.1\""));
    let csv = Wanted {
        time: Some(0.04),
        ..wanted(Format::Csv)
    };
    export(&run(), &csv, folder.path()).unwrap();
    assert_eq!(text(folder.path(), "snapshots.csv").lines().count(), 1 + 3);
    assert_eq!(text(folder.path(), "time_series.csv").lines().count(), 1 + 1);
}

#[test]
fn tables_keep_units_and_digits() {
    let folder = tempfile::tempdir().unwrap();
    let one = Wanted {
        table: Some("time_series".into()),
        ..wanted(Format::Csv)
    };
    assert_eq!(export(&run(), &one, folder.path()).unwrap().len(), 1);
    let table = text(folder.path(), "time_series.csv");
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines[0], "time [s],porosity [1]");
    let last = |line: &str| line.split(',').nth(1).unwrap().parse::<f64>().unwrap();
    assert_eq!(last(lines[2]), 0.1 + 0.2);
    assert_eq!(last(lines[3]), 1.25e-7);
    assert_eq!(
        export(&run(), &wanted(Format::Csv), folder.path()).unwrap().len(),
        2
    );
}

#[test]
fn what_is_not_there_is_said_with_what_is() {
    let folder = tempfile::tempdir().unwrap();
    let why = |run: &Run, wanted: &Wanted| export(run, wanted, folder.path()).unwrap_err().to_string();
    let mut bare = run();
    bare.tables.truncate(1);
    assert!(why(&bare, &wanted(Format::Vtk)).contains("it keeps time_series"));
    let profile = |format| Wanted {
        table: Some("porosity_profile".into()),
        ..wanted(format)
    };
    assert!(why(&run(), &profile(Format::Csv)).contains("time_series, snapshots"));
    assert!(why(&run(), &profile(Format::Vtk)).contains("--format csv"));
    let mut torn = run();
    torn.tables[1].columns.remove(6);
    assert!(why(&torn, &wanted(Format::Vtk)).contains("`radius`"));
    let file = folder.path().join("file");
    std::fs::write(&file, "").unwrap();
    let blocked = export(&run(), &wanted(Format::Csv), &file).unwrap_err();
    assert!(matches!(blocked, ExportError::NotWritable { .. }));
}
