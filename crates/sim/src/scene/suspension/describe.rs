//! A suspension in words and numbers.

use super::model::{Homogeneity, SuspendedClass, SuspendingFluid, Suspension};
use super::particles::Particles;
use crate::fluid::FluidParticles;
use crate::scene::collision::describe_laws;
use crate::scene::describe::{PAIR_COST, law_in_words, scheme_in_words};
use crate::scene::sedimentation::{Limits, limits};
use crate::scene::{Description, Rolling, SharpeningChoice, SphFluid, sedimentation};

/// Cost of a grain's sub-step over the step of a fluid particle.
const GRAIN_COST: f64 = 0.25;
/// Share of the sub-steps that a grain takes: those in the deposit, and the few that meet.
const SUB_STEPPED: f64 = 0.5;
/// Memory of a grain [bytes].
const GRAIN_MEMORY: f64 = 1000.0;

pub fn describe(scene: &Suspension) -> Description {
    let mut description = match &scene.fluid {
        SuspendingFluid::Column(_) => sedimentation::describe(&scene.as_sedimentation()),
        SuspendingFluid::Sph(sph) => in_particles(scene, sph),
    };
    balances(scene, &mut description);
    description
}

/// The balance of forces at the start, class by class.
fn balances(scene: &Suspension, description: &mut Description) {
    let medium = scene.fluid.medium();
    let balance = |(index, class): (usize, &SuspendedClass)| {
        let name = match scene.classes.len() {
            1 => String::new(),
            _ => format!(" of class {}", index + 1),
        };
        let speed = scene.settling_speed(class, scene.porosity);
        let reynolds = medium.density * class.diameter * speed.abs() / medium.viscosity;
        [
            (format!("settling speed{name} amid the suspension"), speed, "m/s"),
            (format!("Reynolds number{name} at that speed"), reynolds, "1"),
        ]
    };
    description
        .numbers
        .extend(scene.classes.iter().enumerate().flat_map(balance));
    description
        .numbers
        .push(("grains".to_owned(), scene.grains() as f64, "1"));
}

fn in_particles(scene: &Suspension, sph: &SphFluid) -> Description {
    let particles = Particles { scene, sph };
    let bed = scene.as_sedimentation();
    let limits = limits(&bed);
    let steps = scene.duration / particles.step();
    let mut description = Description {
        fluid_particles: particles.count(),
        grains: scene.grains(),
        steps: steps.round() as u64,
        ..Description::default()
    };
    grains_in_words(scene, &mut description);
    describe_laws(&bed.normal, &bed.tangential, &Rolling::None, &mut description);
    fluid_in_words(sph, &mut description);
    numbers(&particles, &limits, &mut description);
    cost(&particles, &limits, &mut description);
    description
}

fn grains_in_words(scene: &Suspension, description: &mut Description) {
    let start = match scene.arrangement {
        Homogeneity::Even => "at random but evenly over the whole column, without overlap",
        Homogeneity::Random => "at random over the whole column, without overlap",
    };
    description.active.push(format!(
        "free grains; they start {start}, at their terminal speed"
    ));
    description.active.push(format!(
        "{}, on the superficial slip, integrated exactly over each step",
        law_in_words(scene.drag)
    ));
    description
        .active
        .push("grains that can meet are sub-stepped, the others fly in closed form".to_owned());
    description
        .left_out
        .push("side walls: the column repeats itself sideways".to_owned());
    description
        .left_out
        .push("cohesion, lift, added mass and history force: no scene of this kind has them".to_owned());
}

fn fluid_in_words(sph: &SphFluid, description: &mut Description) {
    description.active.extend([
        "averaged Navier–Stokes equations on particles over a floor of three fixed layers".to_owned(),
        "reaction of the grains on the fluid, with the weights they sample it with".to_owned(),
        "drag implicit for the fluid: no bed is too dense for the step".to_owned(),
    ]);
    scheme_in_words(&sph.scheme, description);
    if sph.scheme.sharpening == SharpeningChoice::Conservative {
        description
            .active
            .push("conservative sharpening of porosity and exchange kernels".to_owned());
        description
            .warnings
            .push("sharpened kernels amplify the noise of random grains: take `sharpening: none`".to_owned());
    } else {
        description
            .left_out
            .push("kernel sharpening: it amplifies the noise of random grains".to_owned());
    }
    description
        .left_out
        .push("correction for self-induced flow: grains among others share one flow".to_owned());
}

fn numbers(particles: &Particles, limits: &Limits, description: &mut Description) {
    let (scene, dt, sound) = (particles.scene, particles.step(), particles.sound_speed());
    let h = 1.5 * particles.spacing();
    let smallest = scene.smallest_diameter();
    let sub_steps = (dt / limits.time_step).ceil();
    let numbers = [
        ("sound speed", sound, "m/s"),
        ("Mach number", scene.greatest_settling_speed() / sound, "1"),
        (
            "weight of the grains on the fluid",
            particles.excess_pressure(),
            "Pa",
        ),
        ("time step of the fluid", dt, "s"),
        ("Courant number c dt/h", sound * dt / h, "1"),
        ("smoothing length", h, "m"),
        (
            "exchange length of the smallest grains",
            particles.exchange_length(smallest),
            "m",
        ),
        ("contact time", limits.contact_time, "s"),
        ("sub-steps of touching grains", sub_steps, "1"),
        ("expected overlap over diameter", limits.overlap, "1"),
    ];
    description
        .numbers
        .extend(numbers.map(|(name, value, unit)| (name.to_owned(), value, unit)));
}

fn cost(particles: &Particles, limits: &Limits, description: &mut Description) {
    let (scene, dt) = (particles.scene, particles.step());
    let neighbours =
        |length: f64| 4.0 / 3.0 * std::f64::consts::PI * (2.0 * length / particles.spacing()).powi(3);
    let pairs: f64 = (scene.classes.iter().zip(scene.numbers()))
        .map(|(class, number)| number as f64 * neighbours(particles.exchange_length(class.diameter)))
        .sum();
    let grains = scene.grains() as f64;
    let sub_steps = (dt / limits.time_step).ceil();
    let step = particles.count() as f64 + PAIR_COST * pairs + GRAIN_COST * SUB_STEPPED * sub_steps * grains;
    description.work = description.steps as f64 * step;
    let kept = grains * (GRAIN_MEMORY + f64::from(scene.snapshots) * sedimentation::ROW_MEMORY);
    description.memory =
        FluidParticles::memory(particles.count() as usize) + (pairs * 1.3 * 16.0 + kept) as u64;
}
