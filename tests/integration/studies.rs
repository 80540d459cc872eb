//! The studies of the repository, read and expanded.

use std::path::Path;

use kynch::study::model::{AxisValue, Point, Study, Work};
use kynch::study::{self};
use kynch_sim::scene::{Fluid, Scene};
use proptest::prelude::*;

use crate::filtration::ACROSS;
use crate::sedimentation::{OTHER, VARIED};

fn load(name: &str) -> Study {
    let path = study::find(name).expect("a study");
    study::load(&path).unwrap_or_else(|error| panic!("{error}"))
}

fn particles_per_side(point: &Point) -> f64 {
    let Work::Simulation(scene) = &point.work else {
        panic!("a simulation")
    };
    let (fluid, column, diameter) = match scene {
        Scene::SingleSphere(sphere) => (&sphere.fluid, sphere.column, sphere.grains.diameter),
        Scene::ConstantPorosityBlock(block) => (&block.fluid, block.column, block.classes[0].diameter),
        Scene::BinaryCollision(_) | Scene::Sedimentation(_) | Scene::Suspension(_) | Scene::Filtration(_) => {
            panic!("a scene with a fluid")
        }
    };
    let Fluid::Sph(fluid) = fluid else {
        panic!("a particle fluid")
    };
    column.width / (fluid.spacing_over_diameter * diameter)
}

#[test]
fn every_study_can_be_read_and_has_points() {
    let entries = study::list();
    assert!(entries.len() >= 5);
    for entry in entries {
        let study = load(&entry.name);
        assert_eq!(study.question, entry.meaning);
        assert!(
            !study.plan.points.is_empty() && !study.expect.is_empty(),
            "{}",
            entry.name
        );
    }
}

#[test]
fn the_resolution_sweep_has_the_columns_of_the_thesis() {
    let study = load("resolution_sweep");
    assert_eq!(study.plan.points.len(), 15);
    let mut sides = Vec::new();
    let mut lattices = Vec::new();
    for point in &study.plan.points {
        sides.push(particles_per_side(point).round() as u32);
        assert!((particles_per_side(point).fract() + 0.5).fract() - 0.5 < 1e-9);
        if let Work::Simulation(Scene::ConstantPorosityBlock(block)) = &point.work {
            lattices.push((block.grains_per_side, block.layers));
        }
    }
    assert_eq!(sides, [30, 20, 14, 10, 9, 30, 20, 14, 10, 9, 30, 20, 14, 10, 10]);
    assert_eq!(lattices[..5], [(26, 13), (23, 13), (24, 13), (23, 13), (31, 13)]);
    assert_eq!(lattices[5..], [(33, 16), (29, 16), (30, 16), (29, 16), (44, 16)]);
}

const SPHERES: &str = "
question: Which model?
scene:
  single_sphere:
    grains: {diameter: 100 um, density: 2.5 g/cm3}
    drag: stokes
    fluid: {sph: {density: 1000, viscosity: 0.89 cP, spacing_over_diameter: 2}}
    column: {width: 4 mm, height: 6 mm}
    duration: 62 ms
vary:
  spacing: {path: scene.fluid.sph.spacing_over_diameter, values: [2, 4]}
  fluid: {path: scene.single_sphere.fluid, values: [still, column, sph]}
  kernel: {path: scene.fluid.sph.scheme.kernel, values: [wendland_c2, lucy]}
seeds: [3, 7]
exclude:
  - {spacing: 4, kernel: lucy}
";

#[test]
fn axes_bind_where_their_path_exists() {
    let study = study::parse(Path::new("models.yaml"), SPHERES).unwrap_or_else(|error| panic!("{error}"));
    let labels: Vec<String> = study
        .plan
        .points
        .iter()
        .filter(|point| point.seed == 3)
        .map(Point::label)
        .collect();
    let expected = [
        "scene=scene fluid=still",
        "scene=scene fluid=column",
        "scene=scene spacing=2 fluid=sph kernel=wendland_c2",
        "scene=scene spacing=2 fluid=sph kernel=lucy",
        "scene=scene spacing=4 fluid=sph kernel=wendland_c2",
    ];
    assert_eq!(labels, expected);
    assert_eq!(study.plan.points.len(), 2 * expected.len());
    assert!(
        study
            .plan
            .points
            .iter()
            .enumerate()
            .all(|(index, point)| point.index == index)
    );
}

#[test]
fn settings_do_not_depend_on_how_a_scene_is_written() {
    let other = SPHERES
        .replace("100 um", "1e-4")
        .replace("2.5 g/cm3", "2500 kg/m³")
        .replace("0.89 cP", "0.00089")
        .replace("    drag: stokes\n", "    coupling: two_way\n    drag: stokes\n");
    let read = |text: &str| study::parse(Path::new("x.yaml"), text).unwrap_or_else(|error| panic!("{error}"));
    let (left, right) = (read(SPHERES), read(&other));
    for (left, right) in left.plan.points.iter().zip(&right.plan.points) {
        assert_eq!(left.settings.to_string(), right.settings.to_string());
    }
    let settings = &left.plan.points[0].settings["single_sphere"];
    assert_eq!(settings["grains"]["diameter"], 1e-4);
    assert_eq!(settings["release_height"], 0.8);
    assert_eq!(
        left.plan.points[0].parameter("viscosity"),
        Some(AxisValue::Number(0.89e-3))
    );
}

#[test]
fn the_schema_is_closed_and_its_references_resolve() {
    let schema = study::schema();
    let text = schema.to_string();
    for reference in text.split("\"#/$defs/").skip(1) {
        let name = reference.split('"').next().expect("a name");
        assert!(schema["$defs"][name].is_object(), "{name}");
    }
    assert_eq!(schema["additionalProperties"], false);
    let names: Vec<String> = study::scenes().into_iter().map(|entry| entry.name).collect();
    assert_eq!(
        names,
        [
            "single_sphere",
            "constant_porosity_block",
            "binary_collision",
            "sedimentation",
            "suspension",
            "filtration",
            "rehearsal"
        ]
    );
}

/// Bytes that matter to YAML, and numbers at their limits.
fn snippet() -> impl Strategy<Value = String> {
    let words = [
        "",
        " ",
        "\n",
        "\t",
        ":",
        ": ",
        "- ",
        "{",
        "}",
        "[",
        "]",
        "\"",
        "'",
        "&a ",
        "*a",
        "<<: ",
        "!t ",
        "|",
        ">",
        "#",
        "%",
        "---\n",
        "é",
        "\u{feff}",
        "\0",
        "-1",
        "0",
        "1e999",
        ".nan",
        ".inf",
        "1e-320",
        "99999999999999999999",
        "null",
        "true",
        "scene",
        "5 m",
        "-1 mm",
        "1e9 m^127",
    ];
    prop_oneof![
        prop::sample::select(words.to_vec()).prop_map(str::to_owned),
        ".{0,6}"
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_mutation_of_a_study_panics(
        which in 0..5usize,
        edits in prop::collection::vec((any::<prop::sample::Index>(), 0..12usize, snippet()), 1..6),
    ) {
        let good = [SPHERES, include_str!("../../studies/smoke.yaml"), OTHER, VARIED, ACROSS];
        let mut text: Vec<char> = good[which].chars().collect();
        for (place, removed, inserted) in edits {
            let from = place.index(text.len() + 1);
            let to = (from + removed).min(text.len());
            text.splice(from..to, inserted.chars());
        }
        let text: String = text.into_iter().collect();
        if let Err(error) = study::parse(Path::new("mutated.yaml"), &text) {
            prop_assert!(!error.problems.is_empty());
            prop_assert!(!error.render(true, 80).is_empty());
        }
    }
}
