//! Figures of settling suspensions: maps, fitted laws and flux curves.

use super::*;
use crate::report::figure::Cell;

const POROSITIES: [f64; 5] = [0.6, 0.7, 0.8, 0.9, 0.95];

/// A suspension that settles at v = 8 mm/s ε^4.4 times 1 + noise, with its map and heights.
fn suspension(drag: &str, porosity: f64, seed: u64, noise: f64) -> Run {
    let mut run = run(0, 2.0);
    run.id = PointId(format!("{drag}{porosity}{seed}"));
    run.seed = seed;
    run.axes = vec![
        ("drag".into(), AxisValue::Word(drag.into())),
        ("porosity".into(), AxisValue::Number(porosity)),
    ];
    run.settings = serde_json::json!({"constant_porosity_block": {
        "grains": {"diameter": 1e-4, "density": 2500.0}, "drag": drag, "porosity": porosity,
        "fluid": {"column": {"density": 1000.0, "viscosity": 8.9e-4}}, "gravity": 9.81}});
    let wave = noise * (91.0 * porosity + seed as f64).sin();
    let speed = 8e-3 * porosity.powf(4.4) * (1.0 + wave);
    let scalar = |name: &str, unit: &str, value: f64| Scalar {
        name: name.into(),
        unit: unit.into(),
        value,
    };
    run.scalars = vec![
        scalar("interface_velocity", "m/s", speed),
        scalar("deposit_fraction", "1", 0.58),
    ];
    let column = |name: &str, unit: &str, values: Vec<f64>| Column {
        name: name.into(),
        unit: unit.into(),
        values,
    };
    let times: Vec<f64> = (0..=20).map(|index| 0.05 * f64::from(index)).collect();
    let interface = |time: f64| (6e-3 - speed * time).max(2e-3);
    let front = |time: f64| (1e-3 * time).min(2e-3);
    let levels: Vec<f64> = (0..30).map(|index| 1e-4 + 2e-4 * f64::from(index)).collect();
    let cells: Vec<(f64, f64)> = times
        .iter()
        .flat_map(|time| levels.iter().map(move |level| (*time, *level)))
        .collect();
    let seen = |(time, level): &(f64, f64)| match level {
        level if *level < front(*time) => 0.42,
        level if *level < interface(*time) => porosity,
        _ => 1.0,
    };
    run.tables = vec![
        Table {
            name: "time_series".into(),
            columns: vec![
                column("time", "s", times.clone()),
                column(
                    "interface_height",
                    "m",
                    times.iter().map(|time| interface(*time)).collect(),
                ),
                column("bed_front", "m", times.iter().map(|time| front(*time)).collect()),
            ],
        },
        Table {
            name: "porosity_map".into(),
            columns: vec![
                column("time", "s", cells.iter().map(|cell| cell.0).collect()),
                column("height", "m", cells.iter().map(|cell| cell.1).collect()),
                column("porosity", "1", cells.iter().map(seen).collect()),
            ],
        },
    ];
    run
}

fn suspensions(drags: &[&str], seeds: u64) -> Vec<Run> {
    let all = drags.iter().flat_map(|drag| {
        POROSITIES
            .iter()
            .flat_map(move |porosity| (1..=seeds).map(move |seed| suspension(drag, *porosity, seed, 0.02)))
    });
    all.collect()
}

fn settling(seeds: u64, figures: Vec<Figure>) -> Study {
    Study {
        axes: vec![Axis {
            name: "porosity".into(),
            unit: "1".into(),
            values: POROSITIES.map(AxisValue::Number).to_vec(),
            scenes: vec!["sphere".into()],
        }],
        seeds: (1..=seeds).collect(),
        figures,
        ..study()
    }
}

fn law_figure(id: &str, against: Option<&str>) -> Figure {
    let law = FittedLaw {
        of: "interface_velocity".into(),
        over: "porosity".into(),
        linear: false,
    };
    drawn(
        id,
        FigureKind::RichardsonZaki {
            law,
            against: against.map(Into::into),
            group: None,
        },
    )
}

fn flux_figure(id: &str, deposit: bool) -> Figure {
    drawn(
        id,
        FigureKind::Flux {
            of: "interface_velocity".into(),
            over: "porosity".into(),
            against: "force_balance".into(),
            deposit: deposit.then(|| "deposit_fraction".into()),
            group: None,
        },
    )
}

fn map_figure(id: &str) -> Figure {
    let curves = ["interface_height", "bed_front"].map(String::from).to_vec();
    let kind = FigureKind::Map {
        of: "porosity_map".into(),
        curves,
        against: Vec::new(),
    };
    let selection = Selection {
        scenes: Vec::new(),
        axes: vec![("porosity".into(), vec![AxisValue::Number(0.9)])],
    };
    Figure {
        selection,
        ..drawn(id, kind)
    }
}

fn plate(figure: Figure, runs: &[Run], seeds: u64) -> Plate {
    let study = settling(seeds, vec![figure.clone()]);
    figure::draw(&study, runs, &figure, &Numbers::JUDGED).unwrap()
}

#[test]
fn figures_of_suspensions_can_be_read_and_are_the_same_bytes_again() {
    let (one, two) = (
        suspensions(&["di_felice"], 1),
        suspensions(&["di_felice", "dallavalle"], 3),
    );
    let draw_all = || {
        [
            plate(law_figure("law", Some("force_balance")), &one, 1),
            plate(law_figure("laws-of-two", None), &two, 3),
            plate(flux_figure("flux", true), &one, 1),
            plate(flux_figure("fluxes-of-two", false), &two, 3),
            plate(map_figure("map"), &one, 1),
        ]
    };
    for (plate, again) in draw_all().iter().zip(&draw_all()) {
        assert_readable(plate);
        assert_pictured(plate);
        assert_eq!(plate.svg, again.svg);
        assert!(!plate.svg.contains("NaN"), "{}", plate.id);
    }
}

#[test]
fn the_fitted_exponent_and_the_correlations_stand_in_the_legend() {
    let plate = plate(law_figure("law", None), &suspensions(&["di_felice"], 4), 4);
    for words in ["n = 4.4", "Wallis (1969): n = 4.3", "Garside", "Rowe", "Khan"] {
        assert!(plate.svg.contains(words), "{words}");
    }
    let notes = plate.notes.join(" ");
    assert!(
        notes.contains("at porosity 1 (95 % confidence)") && notes.contains("means over seeds"),
        "{notes}"
    );
    // The band holds the fitted line.
    for row in &plate.table.rows {
        let number = |index: usize| match row[index] {
            Cell::Number(number) => number,
            _ => f64::NAN,
        };
        assert!(number(5) < number(4) && number(4) < number(6), "{row:?}");
    }
}

#[test]
fn the_chord_to_the_deposit_rises_at_the_speed_of_the_front() {
    let plate = plate(flux_figure("flux", true), &suspensions(&["di_felice"], 1), 1);
    let csv = plate.table.csv();
    let line = csv
        .lines()
        .find(|line| line.contains(",0.0999") || line.contains(",0.1,"))
        .unwrap()
        .to_owned();
    let cells: Vec<f64> = line
        .split(',')
        .skip(1)
        .map(|cell| cell.parse().unwrap())
        .collect();
    // v φ_0/(φ_m − φ_0).
    assert!(
        (cells[3] / (cells[1] / (0.58 - 0.1)) - 1.0).abs() < 1e-9,
        "{line}"
    );
    assert!(plate.notes.join(" ").contains("slope"));
}

#[test]
fn a_map_keeps_every_cell_and_a_hole_stays_a_hole() {
    let mut runs = suspensions(&["di_felice"], 1);
    let whole = plate(map_figure("map"), &runs, 1);
    assert_eq!(whole.table.rows.len(), 21 * 30);
    assert!(whole.svg.contains("porosity") && whole.svg.contains("interface height"));
    runs[3].tables[1].columns[2].values[5] = f64::NAN;
    let holed = plate(map_figure("map"), &runs, 1);
    assert_eq!(holed.table.rows[5][2], Cell::Empty);
    assert_readable(&holed);
}

#[test]
fn what_cannot_be_drawn_says_why() {
    let study = settling(1, Vec::new());
    let refused = |figure: Figure, runs: &[Run]| {
        figure::draw(&study, runs, &figure, &Numbers::JUDGED)
            .map(|_| ())
            .unwrap_err()
            .to_string()
    };
    let two: Vec<Run> = suspensions(&["di_felice"], 1).into_iter().take(2).collect();
    assert!(refused(law_figure("law", None), &two).contains("no power can be fitted: 2 points"));
    let mut bare = suspensions(&["di_felice"], 1);
    bare.iter_mut().for_each(|run| run.tables.truncate(1));
    assert!(refused(map_figure("map"), &bare).contains("`porosity_map`"));
    bare.iter_mut()
        .for_each(|run| run.settings = serde_json::json!({"rehearsal": {"limit": 1.0}}));
    assert!(refused(flux_figure("flux", false), &bare).contains("no `porosity`"));
}
