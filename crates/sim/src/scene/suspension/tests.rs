use super::*;
use crate::outcome::{Control, Outcome};
use crate::scene::{
    Column, Drag, Medium, ObservableKind, Scene, Scheme, SphFluid, check, describe, observables, run,
};

const WATER: Medium = Medium {
    density: 1000.0,
    viscosity: 0.89e-3,
};

fn particles() -> SuspendingFluid {
    SuspendingFluid::Sph(SphFluid {
        medium: WATER,
        spacing_over_diameter: 2.0,
        scheme: Scheme::for_random_grains(),
    })
}

/// The suspension of Raso (2014), section 5.5, in a column a thirtieth as large.
fn small(fluid: SuspendingFluid) -> Suspension {
    Suspension {
        classes: vec![SuspendedClass {
            diameter: 100e-6,
            density: 2500.0,
            share: 1.0,
        }],
        porosity: 0.9,
        column: Column {
            width: 1.2e-3,
            height: 2.4e-3,
        },
        arrangement: Homogeneity::Even,
        drag: Drag::DiFelice,
        fluid,
        contact: SoftContact {
            stiffness: None,
            restitution: 0.9,
            friction: None,
        },
        top_grains: None,
        duration: 0.04,
        gravity: 9.81,
        steps_per_contact: 20.0,
        time_step: None,
        unsafe_time_step: false,
        threads: 1,
        seed: 1,
        snapshots: 2,
    }
}

fn two_densities(fluid: SuspendingFluid) -> Suspension {
    let class = |density: f64| SuspendedClass {
        diameter: 100e-6,
        density,
        share: 0.5,
    };
    Suspension {
        classes: vec![class(2450.0), class(1500.0)],
        ..small(fluid)
    }
}

fn outcome(scene: Suspension) -> Outcome {
    let scene = Scene::Suspension(scene);
    assert_eq!(check(&scene), []);
    run(&scene, &Control::SILENT).unwrap()
}

fn scalar(outcome: &Outcome, name: &str) -> f64 {
    let found = outcome.scalars.iter().find(|scalar| scalar.name == name);
    found.unwrap_or_else(|| panic!("no {name}")).value
}

fn series<'a>(outcome: &'a Outcome, name: &str) -> &'a [f64] {
    let columns = &outcome.tables[0].columns;
    let found = columns.iter().find(|column| column.name == name);
    &found.unwrap_or_else(|| panic!("no {name}")).values
}

/// Mean of the later half of a series.
fn late(outcome: &Outcome, name: &str) -> f64 {
    let values = series(outcome, name);
    let half = &values[values.len() / 2..];
    half.iter().sum::<f64>() / half.len() as f64
}

#[test]
fn the_balance_of_forces_is_the_published_one() {
    let mono = small(SuspendingFluid::Column(WATER));
    let speed = mono.settling_speed(&mono.classes[0], 0.9);
    assert!((speed - 4.91237e-3).abs() < 2e-8, "{speed}");
    let two = two_densities(SuspendingFluid::Column(WATER));
    let [heavy, light] = [0, 1].map(|class| two.settling_speed(&two.classes[class], 0.9));
    assert!((heavy - 5.11e-3).abs() < 0.005e-3, "{heavy}");
    assert!((light - 1.38e-3).abs() < 0.005e-3, "{light}");
}

#[test]
fn a_column_settles_at_the_balance_of_forces() {
    let outcome = outcome(small(SuspendingFluid::Column(WATER)));
    let speed = late(&outcome, "settling_speed_1");
    assert!((speed / 4.912e-3 - 1.0).abs() < 0.01, "{speed}");
    assert!((late(&outcome, "slip_1") / speed - 1.0).abs() < 1e-3);
    assert!(scalar(&outcome, "momentum_error") < 1e-12);
}

#[test]
fn a_particle_fluid_carries_grains_at_the_balance_of_forces_and_keeps_momentum() {
    let outcome = outcome(small(particles()));
    let slip = late(&outcome, "slip_1");
    assert!((slip / 4.912e-3 - 1.0).abs() < 0.015, "{slip}");
    let speed = late(&outcome, "settling_speed_1");
    assert!((speed / 4.912e-3 - 1.0).abs() < 0.04, "{speed}");
    let error = scalar(&outcome, "momentum_error");
    assert!(error > 0.0 && error < 1e-10, "{error:e}");
    assert_eq!(scalar(&outcome, "porosity_clips"), 0.0);
}

#[test]
fn two_densities_part_at_the_two_species_balance_until_they_collide() {
    let outcome = outcome(Suspension {
        duration: 0.002,
        ..two_densities(particles())
    });
    let speeds = ["settling_speed_1", "settling_speed_2"].map(|name| late(&outcome, name));
    // Later on heavy grains run into light ones and share their momentum with them.
    assert!((speeds[0] / 5.107e-3 - 1.0).abs() < 0.02, "{speeds:?}");
    assert!((speeds[1] / 1.384e-3 - 1.0).abs() < 0.08, "{speeds:?}");
}

#[test]
fn an_outcome_holds_what_was_announced() {
    for fluid in [SuspendingFluid::Column(WATER), particles()] {
        let scene = Suspension {
            duration: 0.002,
            ..two_densities(fluid)
        };
        let announced = observables(&Scene::Suspension(scene.clone()));
        let outcome = outcome(scene);
        for observable in announced {
            match observable.kind {
                ObservableKind::Scalar => {
                    scalar(&outcome, observable.name);
                }
                ObservableKind::Series => assert!(!series(&outcome, observable.name).is_empty()),
                ObservableKind::Profile => {
                    assert!(outcome.tables.iter().any(|table| table.name == observable.name));
                }
            }
        }
    }
}

#[test]
fn threads_change_nothing_and_neither_does_a_second_run() {
    for fluid in [SuspendingFluid::Column(WATER), particles()] {
        let one = Suspension {
            duration: 0.01,
            ..small(fluid)
        };
        let two = Suspension {
            threads: 2,
            ..one.clone()
        };
        assert_eq!(format!("{:?}", outcome(one)), format!("{:?}", outcome(two)));
    }
}

#[test]
fn a_description_tells_the_balance_and_the_work_of_either_fluid() {
    for fluid in [SuspendingFluid::Column(WATER), particles()] {
        let description = describe(&Scene::Suspension(small(fluid)));
        assert!(description.work > 0.0 && description.memory > 0 && description.steps > 0);
        assert_eq!(description.grains, 660);
        let speed = description
            .numbers
            .iter()
            .find(|(name, ..)| name.contains("settling speed amid"));
        assert!((speed.unwrap().1 - 4.912e-3).abs() < 1e-5);
    }
}

fn faults(scene: Suspension) -> Vec<String> {
    let faults = check(&Scene::Suspension(scene));
    faults.into_iter().map(|fault| fault.path).collect()
}

#[test]
fn refuses_what_cannot_be_simulated() {
    let column = || small(SuspendingFluid::Column(WATER));
    let with = |change: &dyn Fn(&mut Suspension)| {
        let mut scene = column();
        change(&mut scene);
        faults(scene)
    };
    assert_eq!(faults(column()), Vec::<String>::new());
    assert_eq!(with(&|scene| scene.classes.clear()), ["classes"]);
    assert_eq!(with(&|scene| scene.classes[0].share = 0.9), ["classes"]);
    assert_eq!(
        with(&|scene| scene.classes[0].density = 900.0),
        ["grains.density"]
    );
    assert_eq!(with(&|scene| scene.porosity = 0.5), ["porosity"]);
    assert_eq!(with(&|scene| scene.porosity = 1.0), ["porosity"]);
    assert_eq!(with(&|scene| scene.column.width = 0.2e-3), ["column.width"]);
    assert_eq!(with(&|scene| scene.porosity = 0.99999), ["column"]);
    assert_eq!(
        with(&|scene| scene.contact.restitution = 0.0),
        ["contact.restitution"]
    );
    assert_eq!(
        with(&|scene| scene.contact.stiffness = Some(-1.0)),
        ["contact.stiffness"]
    );
    assert_eq!(with(&|scene| scene.top_grains = Some(661)), ["top_grains"]);
    assert_eq!(with(&|scene| scene.time_step = Some(1e-3)), ["time_step"]);
    assert_eq!(
        with(&|scene| scene.steps_per_contact = 5.0),
        ["steps_per_contact"]
    );
    assert_eq!(with(&|scene| scene.snapshots = 1), ["snapshots"]);
    assert_eq!(with(&|scene| scene.gravity = 0.0), ["gravity"]);
    let two_sizes = |scene: &mut Suspension| {
        let mut coarse = scene.classes[0];
        coarse.diameter = 150e-6;
        scene.classes.push(coarse);
        scene.classes.iter_mut().for_each(|class| class.share = 0.5);
        scene.drag = Drag::BeetstraCello;
    };
    assert_eq!(with(&two_sizes), ["drag"]);
}

#[test]
fn refuses_a_scheme_that_says_what_the_scene_says() {
    let with = |change: &dyn Fn(&mut SphFluid)| {
        let mut scene = small(particles());
        if let SuspendingFluid::Sph(fluid) = &mut scene.fluid {
            change(fluid);
        }
        faults(scene)
    };
    assert_eq!(with(&|_| ()), Vec::<String>::new());
    let path = |name: &str| [format!("fluid.sph.scheme.{name}")];
    assert_eq!(
        with(&|fluid| fluid.scheme.stiffness = Some(1.0)),
        path("stiffness")
    );
    assert_eq!(
        with(&|fluid| fluid.scheme.steps_per_contact = 30.0),
        path("steps_per_contact")
    );
    assert_eq!(
        with(&|fluid| fluid.scheme.time_step = Some(1e-3)),
        path("time_step")
    );
    assert_eq!(
        with(&|fluid| fluid.spacing_over_diameter = 5.0),
        ["column.width", "column.height"]
    );
}
