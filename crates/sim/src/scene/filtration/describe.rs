//! A filtration scene in words and numbers.

use super::model::{CakeLength, CakePermeability, Deposited, Feed, Filtration, Held, Resistance};
use crate::coupling::permeability::kozeny_carman;
use crate::scene::collision::describe_laws;
use crate::scene::sedimentation::describe::{
    forces_in_words, grains_in_words, numbers, run_in_words, start_in_words, work,
};
use crate::scene::sedimentation::warnings::warnings;
use crate::scene::{Description, Floor, GrainDrag, IntegratorChoice, StillFluid};

pub fn describe(scene: &Filtration) -> Description {
    let bed = &scene.bed;
    let limits = scene.limits();
    let mut description = work(bed, &limits, mean_grains(scene));
    let medium = (scene.medium_grains(), scene.bed.grains());
    description.grains = medium.0 + medium.1;
    grains_in_words(bed, &feed_in_words(scene), &mut description);
    describe_laws(&bed.normal, &bed.tangential, &bed.rolling, &mut description);
    forces_in_words(bed, &fluid_in_words(scene), &mut description);
    filtrate_in_words(scene, &mut description);
    run_in_words(bed, &mut description);
    numbers(bed, &limits, &mut description);
    own_numbers(scene, &mut description);
    warnings(bed, &limits, arrival(scene), &mut description);
    own_warnings(scene, &mut description);
    description
}

/// Grains in the cell, mean over the run.
fn mean_grains(scene: &Filtration) -> f64 {
    let all = scene.bed.grains() as f64;
    let (rate, duration) = (scene.feed_rate(), scene.bed.duration);
    if rate * duration <= all {
        return 0.5 * rate * duration;
    }
    // So many come in the time until all are there.
    all * (1.0 - 0.5 * all / (rate * duration))
}

impl Filtration {
    /// Number of fixed grains of the medium.
    pub fn medium_grains(&self) -> u64 {
        crate::scene::sedimentation::floor::floor_grains(&self.bed).len() as u64
    }

    /// Grains that come in a second at the start [1/s]; infinite where all are there.
    pub fn feed_rate(&self) -> f64 {
        match self.feed {
            Feed::AtStart => f64::INFINITY,
            Feed::Rate { rate, .. } => rate,
            Feed::Suspension {
                solids_fraction,
                settling,
                ..
            } => {
                let own = if settling {
                    self.settling_speed(1.0 - solids_fraction).unwrap_or(0.0)
                } else {
                    0.0
                };
                let flux = self.operation().map_or(0.0, |operation| operation.flux);
                let mean = self.bed.solids() / (self.bed.grains() as f64).max(1.0);
                solids_fraction * (flux + own) * self.area() / mean
            }
        }
    }
}

fn feed_in_words(scene: &Filtration) -> String {
    let zone =
        |layers: f64| format!("the upper {layers} diameters of the cell, with the velocity of the fluid");
    let waits = "those that find no room wait";
    match scene.feed {
        Feed::AtStart => start_in_words(&scene.bed),
        Feed::Rate { rate, layers } => {
            format!("are fed at {rate} in a second into {}; {waits}", zone(layers))
        }
        Feed::Suspension {
            solids_fraction,
            settling,
            layers,
        } => {
            let with = if settling {
                "the filtrate and their own settling"
            } else {
                "the filtrate"
            };
            format!(
                "are fed with {with} from a suspension of {solids_fraction} solids into {}; {waits}",
                zone(layers)
            )
        }
    }
}

fn fluid_in_words(scene: &Filtration) -> String {
    let down = match scene.bed.fluid {
        StillFluid::Column(_) => "filtrate flows down everywhere alike, faster where grains take room",
        StillFluid::Still(_) => {
            "filtrate flows down with its flux between the grains too, as printed: too slow in the cake"
        }
    };
    match scene.crossflow {
        None => down.to_owned(),
        Some(flow) => {
            let lift = if flow.shear_lift {
                ", with Saffman's lift in its shear"
            } else {
                ""
            };
            format!("a parabola along x between medium and lid that does not know the cake{lift}; {down}")
        }
    }
}

fn filtrate_in_words(scene: &Filtration, description: &mut Description) {
    let filtrate = &scene.filtrate;
    let held = match filtrate.held {
        Held::Pressure => "constant pressure drop: the flux falls as the cake grows",
        Held::Flux => "constant flux: the pressure drop rises as the cake grows",
    };
    let resistance = match filtrate.resistance {
        Resistance::Series => "medium and cake resist in series",
        Resistance::DarcyCapped => {
            "the cake alone resists, the flux is capped at that of the start (as printed)"
        }
    };
    let length = match filtrate.length {
        CakeLength::Thickness => "over the cake's thickness",
        CakeLength::CellHeight => "over the height of the cell (what a flux in print follows from)",
    };
    let permeability = match filtrate.permeability {
        CakePermeability::Mean => "the porosity of its central slice",
        CakePermeability::Layered => "the porosities of its layers in series",
    };
    description.active.push(format!(
        "{held}; {resistance}, {length}, with Kozeny and Carman's permeability from {permeability}"
    ));
    let deposited = match scene.deposited {
        Deposited::Slow => "slower than a tenth of the terminal speed and carried by their like",
        Deposited::Settled => {
            "slower than a hundredth of the terminal speed, hardly moved and carried by their like"
        }
        Deposited::Carried => "carried by a chain of contacts",
    };
    description
        .active
        .push(format!("the cake is made of grains {deposited}"));
    if scene.crossflow.is_none() {
        description
            .left_out
            .push("flow along the medium: dead-end filtration".to_owned());
    }
    if scene.feed != Feed::AtStart && scene.bed.integrator != IntegratorChoice::VelocityVerlet {
        description
            .active
            .push("the scheme begins anew whenever grains come in".to_owned());
    }
}

fn own_numbers(scene: &Filtration, description: &mut Description) {
    let Some(operation) = scene.operation() else {
        return;
    };
    let mut add = |name: &str, value: f64, unit| description.numbers.push((name.to_owned(), value, unit));
    add("flux at the start", operation.flux, "m/s");
    add("pressure drop at the start", operation.pressure_drop, "Pa");
    add("resistance of the medium", operation.medium_resistance, "1/m");
    let sauter = scene.bed.sauter_diameter();
    if scene.bed.grains() > 0 {
        let (thickness, resistance) = scene.expected_cake();
        let (flux, pressure_drop) = scene
            .filtrate
            .with_cake(&operation, scene.viscosity(), resistance);
        add("Sauter diameter", sauter, "m");
        add(
            "permeability at a porosity of 0.4",
            kozeny_carman(0.4, sauter),
            "m²",
        );
        add("thickness of all grains at a porosity of 0.4", thickness, "m");
        add("flux through them", flux, "m/s");
        add("pressure drop over them and the medium", pressure_drop, "Pa");
    }
    add("time of a grain to the medium", arrival(scene), "s");
    if let Some(stream) = scene.stream() {
        let shear = scene.viscosity() * stream.shear(stream.bottom);
        add("shear stress on the bare medium", shear, "Pa");
    }
    if let Floor::Grains(floor) = scene.bed.container.floor {
        add(
            "widest hole of a layer of the medium",
            floor.hole(&scene.bed).max(0.0),
            "m",
        );
    }
}

/// Time in which a grain comes down from the top to the medium [s].
fn arrival(scene: &Filtration) -> f64 {
    let flux = scene.operation().map_or(0.0, |operation| operation.flux);
    let own = scene.settling_speed(1.0).unwrap_or(0.0);
    scene.bed.container.height / (flux + own)
}

fn own_warnings(scene: &Filtration, description: &mut Description) {
    let bed = &scene.bed;
    let mut warn = |holds: bool, words: &str| {
        if holds {
            description.warnings.push(words.to_owned());
        }
    };
    let falls_through = match bed.container.floor {
        Floor::Flat => false,
        Floor::Grains(floor) => floor.hole(bed) > bed.smallest_diameter(),
    };
    warn(
        falls_through,
        "the medium has holes wider than the smallest grains: some may pass, they are counted",
    );
    warn(
        bed.drag == GrainDrag::None,
        "without drag the filtrate carries no grain: they fall as in empty space",
    );
    warn(
        scene.feed_rate() * bed.duration < bed.grains() as f64,
        "the run ends before all grains have been fed",
    );
}
