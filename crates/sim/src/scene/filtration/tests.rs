//! What a filtration must obey, in cells small enough to run in a moment.

mod across;
mod closed_forms;
mod faults;
mod passing;

use super::*;
use crate::contact::{CundallStrack, EffectiveMass};
use crate::outcome::{Control, Outcome};
use crate::scene::{
    Arrangement, Container, Detection, Dimensions, Floor, FloorGrains, GrainClass, GrainDrag,
    IntegratorChoice, Lift, Medium, Normal, ObservableKind, Rolling, Scene, Sedimentation, Sides,
    SlicePorosity, StillFluid, Tangential, Until, Voidage, check, describe, observables, run,
};

const WATER: Medium = Medium {
    density: 1000.0,
    viscosity: 1e-3,
};
const DIAMETER: f64 = 150e-6;

/// A cell of 5 × 5 × 20 diameters, periodic at its sides, over a flat medium.
fn cell() -> Filtration {
    Filtration {
        bed: Sedimentation {
            dimensions: Dimensions::Three,
            classes: vec![GrainClass {
                diameter: DIAMETER,
                largest_diameter: None,
                density: 2460.0,
                number: 200,
            }],
            container: Container {
                width: 5.0 * DIAMETER,
                depth: 5.0 * DIAMETER,
                height: 20.0 * DIAMETER,
                sides: Sides::Periodic,
                floor: Floor::Flat,
            },
            arrangement: Arrangement::Random,
            normal: Normal::LinearSpringDashpot {
                stiffness: 20.0,
                restitution: 0.5,
                effective_mass: EffectiveMass::Reduced,
            },
            tangential: Tangential::CundallStrack(CundallStrack {
                stiffness: 6.0,
                damping: 0.0,
                friction: 0.3,
            }),
            rolling: Rolling::None,
            cohesion: None,
            charge: None,
            drag: GrainDrag::SchillerNaumann,
            voidage: Voidage::DiFelice,
            porosity: SlicePorosity::Exact,
            lift: Lift::None,
            fluid: StillFluid::Column(WATER),
            gravity: 9.81,
            duration: 0.5,
            until: Until::Duration,
            integrator: IntegratorChoice::VelocityVerlet,
            detection: Detection::List { skin: None },
            sleeping: false,
            central_slice: 0.8,
            steps_per_contact: 15.0,
            time_step: None,
            unsafe_time_step: false,
            threads: 1,
            seed: 1,
            snapshots: 0,
        },
        feed: Feed::Rate {
            rate: 800.0,
            layers: 5.0,
        },
        filtrate: Filtrate {
            held: Held::Pressure,
            pressure_drop: Some(2000.0),
            initial_flux: Some(0.01),
            medium_resistance: None,
            resistance: Resistance::Series,
            length: CakeLength::Thickness,
            permeability: CakePermeability::Mean,
        },
        crossflow: None,
        deposited: Deposited::Slow,
    }
}

/// The same over fixed grains of the size of the fed ones.
fn over_grains(gap: f64, layers: u32) -> Filtration {
    let mut scene = cell();
    scene.bed.container.floor = Floor::Grains(FloorGrains {
        diameter: DIAMETER,
        gap,
        layers,
    });
    scene
}

fn outcome(scene: &Filtration) -> Outcome {
    run(&Scene::Filtration(scene.clone()), &Control::SILENT).unwrap()
}

fn scalar(outcome: &Outcome, name: &str) -> f64 {
    let found = outcome.scalars.iter().find(|scalar| scalar.name == name);
    found.unwrap_or_else(|| panic!("no {name}")).value
}

fn series<'a>(outcome: &'a Outcome, name: &str) -> &'a [f64] {
    let found = outcome.tables[0]
        .columns
        .iter()
        .find(|column| column.name == name);
    &found.unwrap_or_else(|| panic!("no {name}")).values
}

#[test]
fn everything_that_can_be_asked_for_is_there() {
    let mut plane = over_grains(0.0, 2);
    plane.bed.dimensions = Dimensions::Two;
    plane.bed.container.width = 20.0 * DIAMETER;
    let mut across = over_grains(0.0, 1);
    across.bed.container.sides = Sides::PeriodicAlongX;
    across.crossflow = Some(Crossflow {
        mean_velocity: 0.01,
        shear_lift: true,
    });
    let mut between_walls = cell();
    between_walls.bed.container.sides = Sides::Walls;
    for mut scene in [cell(), plane, across, between_walls] {
        scene.bed.duration = 0.01;
        scene.bed.snapshots = 3;
        let outcome = outcome(&scene);
        let mut wanted: Vec<&str> = Vec::new();
        for observable in observables(&Scene::Filtration(scene)) {
            let (name, unit) = (observable.name, observable.unit);
            match observable.kind {
                ObservableKind::Scalar => {
                    let found = outcome.scalars.iter().find(|scalar| scalar.name == name);
                    assert_eq!(found.unwrap_or_else(|| panic!("{name}")).unit, unit);
                    wanted.push(name);
                }
                ObservableKind::Series => {
                    let found = outcome.tables[0]
                        .columns
                        .iter()
                        .find(|column| column.name == name);
                    assert_eq!(found.unwrap_or_else(|| panic!("{name}")).unit, unit);
                }
                ObservableKind::Profile => {
                    assert!(outcome.tables.iter().any(|table| table.name == name), "{name}");
                }
            }
        }
        let given: Vec<&str> = outcome.scalars.iter().map(|scalar| scalar.name).collect();
        let unknown: Vec<&&str> = given.iter().filter(|name| !wanted.contains(name)).collect();
        assert!(unknown.is_empty(), "{unknown:?}");
    }
}

#[test]
fn a_scene_is_told_with_what_it_does_and_leaves_out() {
    let mut scene = over_grains(0.0, 1);
    scene.filtrate.length = CakeLength::CellHeight;
    let description = describe(&Scene::Filtration(scene));
    assert_eq!(description.grains, 225);
    let told = description.active.join("\n");
    for words in [
        "fed at 800 in a second",
        "constant pressure drop",
        "in series",
        "height of the cell",
    ] {
        assert!(told.contains(words), "{words}: {told}");
    }
    assert!(description.left_out.join("\n").contains("dead-end"));
    let number = |name: &str| {
        let found = description.numbers.iter().find(|number| number.0 == name);
        found.unwrap_or_else(|| panic!("{name}")).1
    };
    assert!((number("resistance of the medium") / 2e8 - 1.0).abs() < 1e-12);
    assert!(
        description
            .warnings
            .iter()
            .all(|warning| !warning.contains("holes"))
    );
    let wide = describe(&Scene::Filtration(over_grains(1.5 * DIAMETER, 1)));
    assert!(
        wide.warnings.iter().any(|warning| warning.contains("holes")),
        "{:?}",
        wide.warnings
    );
}
