//! A scene in words and numbers.

use super::setup::{Settling, isolated_speed};
use super::{
    Coupling, CouplingLengths, Description, Drag, Fluid, Hydrostatics, PorosityPath, Scene, SelfDisturbance,
    SharpeningChoice, Slip, SoundSpeed, SphFluid, Start, StressDensity,
};
use crate::fluid::FluidParticles;

/// Cost of a fluid–grain pair per step over that of a fluid particle's whole row.
const PAIR_COST: f64 = 0.011;

/// The scene in words. Meaningful only for a scene without faults.
pub fn describe(scene: &Scene) -> Description {
    let settling = match scene {
        Scene::SingleSphere(sphere) => Settling::of_sphere(sphere),
        Scene::ConstantPorosityBlock(block) => Settling::of_block(block),
        Scene::BinaryCollision(collision) => return super::collision::describe(collision),
        Scene::Sedimentation(scene) => return super::sedimentation::describe(scene),
        Scene::Suspension(scene) => return super::suspension::describe(scene),
    };
    let (dt, steps) = settling.steps();
    let grains = settling.positions().len() as u64;
    let mut description = Description {
        fluid_particles: settling.fluid_particles(),
        grains,
        steps,
        ..Description::default()
    };
    numbers(&settling, dt, &mut description);
    grains_in_words(&settling, &mut description);
    match settling.sph() {
        Some(sph) => particle_fluid(&settling, sph, dt, &mut description),
        None => prescribed_fluid(&settling, &mut description),
    }
    description
}

fn numbers(settling: &Settling, dt: f64, description: &mut Description) {
    let medium = settling.medium();
    let mixture = &settling.mixture;
    let diameter = mixture.sauter_mean();
    let density = settling.mass() / settling.volume();
    let archimedes = diameter.powi(3) * medium.density * (density - medium.density) * settling.gravity
        / medium.viscosity.powi(2);
    let speed = settling.expected_speed();
    let relaxation = settling.relaxation_time();
    description.numbers.extend([
        ("Archimedes number".to_owned(), archimedes, "1"),
        ("expected settling speed".to_owned(), speed, "m/s"),
        (
            "Reynolds number at that speed".to_owned(),
            settling.scale().reynolds(speed),
            "1",
        ),
        (
            "isolated settling speed".to_owned(),
            isolated_speed(settling),
            "m/s",
        ),
        ("Stokes relaxation time".to_owned(), relaxation, "s"),
        ("time step".to_owned(), dt, "s"),
        ("time step over relaxation time".to_owned(), dt / relaxation, "1"),
    ]);
    let response = match settling.sph() {
        Some(_) => relaxation,
        None => settling.response_time(),
    };
    if settling.sphere.is_some() && settling.duration < 40.0 * response {
        description.warnings.push(format!(
            "the run lasts {:.1} relaxation times; the terminal window wants 20 to 40",
            settling.duration / response
        ));
    }
    let fallen = speed * settling.duration;
    let start = settling.positions().first().map_or(0.0, |x| x.z);
    if fallen > start - diameter {
        description
            .warnings
            .push("the grains may reach the floor before the run ends".to_owned());
    }
}

fn grains_in_words(settling: &Settling, description: &mut Description) {
    let law = match settling.drag {
        Drag::Stokes => "Stokes drag",
        Drag::Dallavalle => "Dallavalle drag",
        Drag::SchillerNaumann => "Schiller–Naumann drag",
        Drag::DiFelice => "Di Felice drag: Dallavalle times a power of the porosity",
        Drag::CoulsonRichardson => "Coulson–Richardson drag",
        Drag::Beetstra => "Beetstra drag",
        Drag::BeetstraCello => "Beetstra drag, shared out among the sizes after Cello",
    };
    description.active.push(format!(
        "{law}, on the superficial slip, integrated exactly over each step"
    ));
    match settling.block {
        Some(block) => {
            let held = if block.held { ", held in place" } else { "" };
            description
                .active
                .push(format!("rigid block of grains that share the mean force{held}"));
            description.numbers.extend([
                (
                    "grains along a side".to_owned(),
                    f64::from(block.grains_per_side),
                    "1",
                ),
                ("layers of grains".to_owned(), f64::from(block.layers), "1"),
                (
                    "thickness of the block".to_owned(),
                    settling.thickness(block),
                    "m",
                ),
            ]);
            if settling.mixture.classes.len() > 1 {
                classes_in_words(settling, description);
            }
        }
        None => description.active.push("one grain released from rest".to_owned()),
    }
    if settling.added_mass() > 0.0 {
        description
            .active
            .push("added mass: half the displaced fluid".to_owned());
        description
            .left_out
            .push("history force: the time to the terminal velocity comes out short".to_owned());
    } else {
        description
            .left_out
            .push("added mass and history force: not asked for".to_owned());
    }
    description.left_out.extend([
        "contacts between grains: the grains of a rigid set never touch".to_owned(),
        "rotation and lift: no scene of this kind asks for them".to_owned(),
        "floor contact and its sub-steps: only within reach of the floor".to_owned(),
    ]);
}

fn classes_in_words(settling: &Settling, description: &mut Description) {
    let mixture = &settling.mixture;
    description
        .numbers
        .push(("Sauter mean diameter".to_owned(), mixture.sauter_mean(), "m"));
    let count = settling.grains().len() as f64;
    for class in &mixture.classes {
        let name = format!("grains of {}", super::check::millimetres(class.diameter));
        description
            .numbers
            .push((name, (class.share * count).round(), "1"));
    }
    let Some(sph) = settling.sph() else { return };
    let lengths = match sph.scheme.coupling_lengths {
        CouplingLengths::PerClass => "coupling lengths: each class of grains its own",
        CouplingLengths::Smallest => "coupling lengths: that of the smallest grains for all",
        CouplingLengths::Largest => "coupling lengths: that of the largest grains for all",
        CouplingLengths::DoubleSmoothing => "double smoothing of the larger grains' porosity",
        CouplingLengths::DoubleSmoothingLiteral => "double smoothing as printed in Raso (2014), eq. 3.10",
    };
    description.active.push(lengths.to_owned());
}

fn prescribed_fluid(settling: &Settling, description: &mut Description) {
    let model = match settling.fluid {
        Fluid::Still(_) => "fluid at rest everywhere",
        _ => "closed column: the fluid flows back through the grains",
    };
    description.active.push(model.to_owned());
    description
        .active
        .push("buoyancy of the pure fluid (model B)".to_owned());
    description
        .left_out
        .push("fluid particles: the fluid model does not need them".to_owned());
    description
        .left_out
        .push("all grains but one: they see the same fluid".to_owned());
    description.work = description.steps as f64 * 0.05;
    description.memory = 1 << 20;
}

fn particle_fluid(settling: &Settling, sph: &SphFluid, dt: f64, description: &mut Description) {
    let scheme = &sph.scheme;
    let sound = settling.sound_speed(sph);
    let h = 1.5 * settling.spacing(sph);
    let length = settling.exchange_length(sph);
    let medium = settling.medium();
    description.numbers.extend([
        ("sound speed".to_owned(), sound, "m/s"),
        ("Mach number".to_owned(), settling.expected_speed() / sound, "1"),
        ("Courant number c dt/h".to_owned(), sound * dt / h, "1"),
        (
            "viscous number ν dt/h²".to_owned(),
            medium.viscosity / medium.density * dt / (h * h),
            "1",
        ),
        ("smoothing length".to_owned(), h, "m"),
        ("exchange length".to_owned(), length, "m"),
    ]);
    description
        .active
        .push("averaged Navier–Stokes equations on particles over a floor of three fixed layers".to_owned());
    choices(settling, sph, description);
    if let SoundSpeed::FreeFall = scheme.sound_speed {
        description
            .warnings
            .push("c = 20 √(2 g H) is far above what the flow needs: many steps".to_owned());
    }
    let neighbours = 4.0 / 3.0 * std::f64::consts::PI * (2.0 * length / settling.spacing(sph)).powi(3);
    let pairs = description.grains as f64 * neighbours;
    description.work = description.steps as f64 * (description.fluid_particles as f64 + PAIR_COST * pairs);
    let weights = pairs * 12.0 + pairs * 1.3 * 4.0;
    description.memory = FluidParticles::memory(description.fluid_particles as usize) + weights as u64;
}

fn choices(settling: &Settling, sph: &SphFluid, description: &mut Description) {
    let scheme = &sph.scheme;
    let mut add = |holds: bool, active: &str, left_out: &str| {
        let list = if holds {
            &mut description.active
        } else {
            &mut description.left_out
        };
        let text = if holds { active } else { left_out };
        if !text.is_empty() {
            list.push(text.to_owned());
        }
    };
    add(
        scheme.hydrostatics == Hydrostatics::Split,
        "hydrostatic pressure carried analytically; the equation of state yields the excess",
        "analytic hydrostatic pressure: the equation of state carries all of it",
    );
    add(
        scheme.artificial_viscosity.is_some(),
        "artificial viscosity, always on",
        "artificial viscosity: compression is damped by a bulk viscosity that vanishes in a steady state",
    );
    let two_way = settling
        .sphere
        .is_none_or(|sphere| sphere.coupling == Coupling::TwoWay);
    add(
        two_way,
        "reaction of the grains on the fluid, with the weights they sample it with",
        "reaction on the fluid: one-way coupling, and with its weight split off the fluid is not stepped",
    );
    let corrected = settling
        .sphere
        .is_some_and(|sphere| sphere.self_disturbance == SelfDisturbance::Corrected);
    add(
        corrected && two_way,
        "self-induced flow of the grain taken out of what it samples",
        "correction for self-induced flow",
    );
    add(
        scheme.porosity == PorosityPath::OnePass,
        "",
        "one-pass porosity: sampled from the fluid, twice smoothed",
    );
    add(
        scheme.sharpening == SharpeningChoice::Conservative && settling.block.is_some(),
        "conservative sharpening of porosity and exchange kernels",
        "kernel sharpening: a single grain has no edge to keep sharp",
    );
    add(
        scheme.slip == Slip::Superficial,
        "",
        "superficial slip: the interstitial one in its place (published defect)",
    );
    add(
        scheme.stress_density == StressDensity::Superficial,
        "",
        "superficial density in the stress on grains (published defect)",
    );
    add(
        scheme.start == Start::Exact,
        "exact starting state, no relaxation; breathing of the column damped",
        "exact start: relaxed by damped steps",
    );
}
