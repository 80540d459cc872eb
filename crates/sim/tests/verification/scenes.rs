//! Scenes the tests start from, and how they read an outcome.

use std::f64::consts::PI;

use kynch_sim::outcome::{Control, Outcome};
use kynch_sim::scene::{
    Column, ConstantPorosityBlock, Coupling, Drag, Fluid, Grains, Medium, Scene, Scheme, SelfDisturbance,
    SingleSphere, SphFluid, SuspendedClass,
};

pub const GRAVITY: f64 = 9.81;
pub const WATER: Medium = Medium {
    density: 1000.0,
    viscosity: 0.89e-3,
};
pub const GLASS: Grains = Grains {
    diameter: 1e-4,
    density: 2500.0,
};

/// Water on particles.
pub fn particles(spacing_over_diameter: f64, scheme: Scheme) -> Fluid {
    Fluid::Sph(SphFluid {
        medium: WATER,
        spacing_over_diameter,
        scheme,
    })
}

/// A glass sphere of 0.1 mm in Stokes drag, for 40 relaxation times.
pub fn sphere(fluid: Fluid) -> SingleSphere {
    SingleSphere {
        grains: GLASS,
        drag: Drag::Stokes,
        fluid,
        column: Column {
            width: 4e-3,
            height: 6e-3,
        },
        release_height: 0.8,
        coupling: Coupling::TwoWay,
        self_disturbance: SelfDisturbance::Corrected,
        added_mass: false,
        duration: 63e-3,
        gravity: GRAVITY,
    }
}

/// A block of 2.2 mm whose pitch is as near to cubic as the width allows.
pub fn block(fluid: Fluid, porosity: f64, width: f64) -> ConstantPorosityBlock {
    let pitch = (volume(&GLASS) / (1.0 - porosity)).cbrt();
    ConstantPorosityBlock {
        classes: vec![class(GLASS.diameter, 1.0)],
        drag: Drag::DiFelice,
        fluid,
        column: Column { width, height: 6e-3 },
        porosity,
        grains_per_side: (width / pitch).round() as u32,
        layers: (2.2e-3 / pitch).round() as u32,
        held: false,
        duration: 60e-3,
        gravity: GRAVITY,
    }
}

/// Glass spheres of a diameter [m] that are a share of all.
pub fn class(diameter: f64, share: f64) -> SuspendedClass {
    SuspendedClass {
        diameter,
        density: GLASS.density,
        share,
    }
}

pub fn volume(grains: &Grains) -> f64 {
    PI / 6.0 * grains.diameter.powi(3)
}

/// Terminal speed [m/s] of Stokes drag: the closed form, not the simulator's.
pub fn stokes_speed(grains: &Grains, medium: &Medium) -> f64 {
    (grains.density - medium.density) * GRAVITY * grains.diameter.powi(2) / (18.0 * medium.viscosity)
}

pub fn run_sphere(scene: &SingleSphere) -> Outcome {
    run(&Scene::SingleSphere(scene.clone()))
}

pub fn run_block(scene: &ConstantPorosityBlock) -> Outcome {
    run(&Scene::ConstantPorosityBlock(scene.clone()))
}

pub fn run(scene: &Scene) -> Outcome {
    kynch_sim::scene::run(scene, &Control::SILENT).unwrap_or_else(|failure| panic!("{}", failure.reason))
}

pub fn scalar(outcome: &Outcome, name: &str) -> f64 {
    let found = outcome.scalars.iter().find(|scalar| scalar.name == name);
    found.unwrap_or_else(|| panic!("no scalar {name}")).value
}

pub fn series<'a>(outcome: &'a Outcome, name: &str) -> &'a [f64] {
    profile(outcome, "time_series", name)
}

pub fn profile<'a>(outcome: &'a Outcome, table: &str, name: &str) -> &'a [f64] {
    let table = outcome
        .tables
        .iter()
        .find(|t| t.name == table)
        .expect("the table");
    let column = table.columns.iter().find(|column| column.name == name);
    &column.unwrap_or_else(|| panic!("no column {name}")).values
}

/// Order of an error that falls from `coarse` to `fine` while the step falls by `ratio`.
pub fn order(coarse: f64, fine: f64, ratio: f64) -> f64 {
    (coarse / fine).ln() / ratio.ln()
}
