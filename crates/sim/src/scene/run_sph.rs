//! Runs a settling scene in the particle fluid.

use super::grain_lengths::{exchange, lattice_porosity};
use super::mixture::mass;
use super::record::Recorder;
use super::setup::Settling;
use super::{
    Coupling, CouplingLengths, Hydrostatics, KernelChoice, PorosityPath, SelfDisturbance, SharpeningChoice,
    Slip, SphFluid, Start, StressDensity, SuspendedClass,
};
use crate::contact::LinearSpringDashpot;
use crate::coupling::{Basin, Breathing, Exchange, ExchangeRules, GrainSize, SelfInducedFlow};
use crate::drag::PolydisperseLaw;
use crate::fluid::kernel::Sharpening;
use crate::fluid::{Continuity, EquationOfState, FluidParticles, Numerics};
use crate::math::Vec3;
use crate::outcome::{Control, Failure, FailureKind, Outcome};
use crate::simulation::{
    CouplingRules, GrainPorosity, GrainSet, RigidGrain, RigidGrains, Simulation, SlipRule,
};

/// χ of the bulk viscosity that damps compression; the step's limit counts on it.
const BULK_DAMPING: f64 = 0.1;
/// Overlap over diameter beyond which a run has diverged.
const OVERLAP_LIMIT: f64 = 0.05;
/// Steps of the damped start.
const RELAXATION_STEPS: u64 = 1000;

/// Runs a scene with a particle fluid under one drag law.
pub fn run<L: PolydisperseLaw>(
    settling: &Settling,
    sph: &SphFluid,
    law: L,
    control: &Control,
) -> Result<Outcome, Box<Failure>> {
    let (dt, steps) = settling.steps();
    let mut simulation = assemble(settling, sph, law);
    if sph.scheme.start == Start::Relaxed {
        relax(&mut simulation, dt);
    }
    let mut recorder = Recorder::new(settling, sph, dt, steps, &simulation);
    for step in 0..steps {
        if (control.stop)() {
            return Err(failure(
                FailureKind::Stopped,
                "stopped from outside".into(),
                recorder,
                &simulation,
            ));
        }
        recorder.step(&mut simulation, step, dt);
        if let Some(reason) = divergence(&simulation, settling.column.height) {
            return Err(failure(FailureKind::Diverged, reason, recorder, &simulation));
        }
        if step.is_multiple_of(16) {
            (control.progress)(step as f64 / steps as f64);
        }
    }
    (control.split)(&simulation.split_of_time());
    Ok(recorder.finish(&simulation))
}

fn failure<L: PolydisperseLaw>(
    kind: FailureKind,
    reason: String,
    recorder: Recorder,
    simulation: &Simulation<L>,
) -> Box<Failure> {
    Box::new(Failure {
        kind,
        reason,
        partial: recorder.finish(simulation),
    })
}

/// Why the state can no longer be trusted, if so.
fn divergence<L: PolydisperseLaw>(simulation: &Simulation<L>, height: f64) -> Option<String> {
    let when = format!("at t = {:.6e} s (step {})", simulation.time, simulation.steps);
    let fluid = &simulation.fluid;
    if let Some(reason) = not_finite(fluid, &when) {
        return Some(reason);
    }
    if !simulation.grains.velocity.norm().is_finite() {
        return Some(format!("the grains' velocity is not finite {when}"));
    }
    if simulation.report.overlap > OVERLAP_LIMIT {
        return Some(format!(
            "a grain overlaps the floor by {:.1} % of its diameter {when}; the limit is {:.0} %",
            100.0 * simulation.report.overlap,
            100.0 * OVERLAP_LIMIT
        ));
    }
    if let Some(i) = (simulation.grains.grains.iter()).position(|grain| grain.position.z > height) {
        return Some(format!("grain {i} left the fluid through its surface {when}"));
    }
    simulation.energy_excess().map(|(energy, bound)| {
        format!(
            "kinetic energy {energy:.3e} J exceeds twice what gravity and the start gave, {bound:.3e} J, {when}; {}",
            fastest(fluid)
        )
    })
}

/// Which fluid particle is no number, if one is.
pub fn not_finite(fluid: &FluidParticles, when: &str) -> Option<String> {
    let sound = |a: &usize| (fluid.velocity[*a].norm() + fluid.pressure[*a]).is_finite();
    let a = (0..fluid.len()).find(|a| !sound(a))?;
    let x = fluid.anchored_position(a);
    Some(format!(
        "fluid particle {a} is not finite {when}, last near ({:.3e}, {:.3e}, {:.3e}) m",
        x.x, x.y, x.z
    ))
}

/// Which fluid particle is the fastest.
pub fn fastest(fluid: &FluidParticles) -> String {
    let speed = |a: &usize| fluid.velocity[*a].norm();
    let fastest = (0..fluid.len())
        .max_by(|a, b| speed(a).total_cmp(&speed(b)))
        .unwrap_or(0);
    let x = fluid.anchored_position(fastest);
    format!(
        "fluid particle {fastest} is the fastest, near ({:.3e}, {:.3e}, {:.3e}) m",
        x.x, x.y, x.z
    )
}

/// Builds fluid, grains and coupling in their starting state.
pub fn assemble<L: PolydisperseLaw>(settling: &Settling, sph: &SphFluid, law: L) -> Simulation<L> {
    let scheme = &sph.scheme;
    let fluid_weight = match scheme.hydrostatics {
        Hydrostatics::Split => 0.0,
        Hydrostatics::Carried => settling.gravity,
    };
    let numerics = numerics(
        sph,
        settling.spacing(sph),
        settling.sound_speed(sph),
        fluid_weight,
    );
    let mut fluid = FluidParticles::lattice(numerics, settling.column.width, settling.column.height);
    let position = settling.positions();
    let grains = rigid_grains(settling, sph, &position);
    let mut exchange = exchange(settling, sph, &fluid, &position);
    if scheme.start == Start::Exact {
        exchange.refresh(&fluid, 0.0, &position, &vec![Vec3::zeros(); position.len()]);
        let solids = &exchange.solids.fraction;
        let porosity: Vec<f64> = solids.iter().map(|solids| 1.0 - solids).collect();
        let drive = if grains.held || settling.block.is_none() {
            0.0
        } else {
            settling.excess_weight() / settling.volume()
        };
        let profile = carried_pressure(&fluid, solids, settling.column.height, drive);
        let density = numerics.state.density;
        let height = settling.column.height;
        fluid.prepare(&porosity, |x| {
            profile(x.z) + density * fluid_weight * (height - x.z)
        });
    }
    let rules = rules(settling, sph, law, &position, &fluid);
    Simulation::new(fluid, grains, exchange, rules)
}

fn rigid_grains(settling: &Settling, sph: &SphFluid, position: &[Vec3]) -> RigidGrains {
    let scheme = &sph.scheme;
    let speed = settling.expected_speed();
    // The largest grain is the heaviest to stop; the overlap is told over its diameter.
    let largest = settling.mixture.largest();
    let heaviest = (settling.mixture.classes.iter()).map(mass).fold(0.0, f64::max);
    let stiffness = (scheme.stiffness)
        .unwrap_or_else(|| LinearSpringDashpot::stiffness_for_overlap(heaviest, speed, 0.003 * largest));
    let grain = |(&position, class): (&Vec3, &SuspendedClass)| RigidGrain {
        position,
        diameter: class.diameter,
        mass: mass(class),
        weight: match scheme.hydrostatics {
            Hydrostatics::Split => settling.excess_weight_of(class),
            Hydrostatics::Carried => mass(class) * settling.gravity,
        },
    };
    RigidGrains {
        grains: position.iter().zip(settling.grains()).map(grain).collect(),
        velocity: Vec3::zeros(),
        held: settling.block.is_some_and(|block| block.held),
        floor: LinearSpringDashpot::with_restitution(stiffness, 1.0),
        contact_steps: scheme.steps_per_contact,
    }
}

/// The fluid's numerical choices at a spacing [m], a sound speed [m/s] and a weight per mass [m/s²].
pub fn numerics(sph: &SphFluid, spacing: f64, sound_speed: f64, gravity: f64) -> Numerics {
    let (medium, scheme) = (sph.medium, &sph.scheme);
    let smoothing = 1.5 * spacing;
    // The α form of the real viscosity: α = S ν/(c h).
    let real = scheme.viscosity_constant.map_or(0.0, |s| {
        s * medium.viscosity / medium.density / (sound_speed * smoothing)
    });
    Numerics {
        spacing,
        viscosity: if scheme.viscosity_constant.is_some() {
            0.0
        } else {
            medium.viscosity
        },
        artificial: scheme.artificial_viscosity.unwrap_or(0.0) + real,
        // What the artificial viscosity leaves to damp.
        bulk: (BULK_DAMPING - scheme.artificial_viscosity.unwrap_or(0.0)).max(0.0),
        lucy: scheme.kernel == KernelChoice::Lucy,
        gravity,
        continuity: match (scheme.porosity, scheme.slip) {
            (PorosityPath::OnePass, Slip::Superficial) => Continuity::MixtureFlux,
            _ => Continuity::Superficial,
        },
        state: EquationOfState {
            density: medium.density,
            sound_speed,
        },
    }
}

fn rules<L: PolydisperseLaw>(
    settling: &Settling,
    sph: &SphFluid,
    law: L,
    position: &[Vec3],
    fluid: &FluidParticles,
) -> CouplingRules<L> {
    let scheme = &sph.scheme;
    let isolated = settling.sphere.is_some();
    let twice = matches!(
        scheme.coupling_lengths,
        CouplingLengths::DoubleSmoothing | CouplingLengths::DoubleSmoothingLiteral
    );
    let porosity = match scheme.porosity {
        PorosityPath::TwoPass => GrainPorosity::Sampled,
        // The published double smoothing is a field of the fluid; grains sample it.
        PorosityPath::OnePass if twice => GrainPorosity::Sampled,
        PorosityPath::OnePass if isolated => GrainPorosity::Known(vec![1.0]),
        PorosityPath::OnePass => GrainPorosity::Known(lattice_porosity(settling, sph, position)),
    };
    let corrected = settling.sphere.is_some_and(|sphere| {
        sphere.self_disturbance == SelfDisturbance::Corrected && sphere.coupling == Coupling::TwoWay
    });
    let medium = settling.medium();
    let buoyancy = match scheme.hydrostatics {
        Hydrostatics::Split => medium.density * settling.gravity,
        Hydrostatics::Carried => 0.0,
    };
    CouplingRules {
        law,
        fluid: [medium.density, medium.viscosity],
        slip: slip_rule(sph, isolated),
        porosity,
        buoyancy,
        intrinsic_stress: scheme.stress_density == StressDensity::Intrinsic,
        two_way: settling
            .sphere
            .is_none_or(|sphere| sphere.coupling == Coupling::TwoWay),
        own_flow: corrected.then(|| own_flow(settling, sph, fluid)),
        breathing: (scheme.start == Start::Exact).then(|| {
            Breathing::new(
                fluid.numerics.state.sound_speed,
                settling.column.height,
                fluid.numerics.spacing,
            )
        }),
        refresh_interval: if isolated { 1 } else { 8 },
    }
}

/// What the drag law is asked with.
pub fn slip_rule(sph: &SphFluid, isolated: bool) -> SlipRule {
    match (sph.scheme.slip, sph.scheme.porosity, isolated) {
        (Slip::Interstitial, _, _) => SlipRule::Interstitial,
        (Slip::Superficial, PorosityPath::TwoPass, _) => SlipRule::PorosityTimesInterstitial,
        (Slip::Superficial, PorosityPath::OnePass, true) => SlipRule::Isolated,
        (Slip::Superficial, PorosityPath::OnePass, false) => SlipRule::MixtureFlux,
    }
}

/// Length [m] of the continuous kernel that hands out and samples back as much as the exchange kernel does
/// on the particles, averaged over a fall by one spacing.
///
/// At 1.2 spacings the kernel is a few particles wide and its echo Σ w²/V is 5 per cent off ∫W² dV, up or
/// down as the grain falls on a column of particles or between four.
fn resolved_length(settling: &Settling, sph: &SphFluid, fluid: &FluidParticles) -> f64 {
    const PHASES: usize = 8;
    let sharpening = exchange_sharpening(settling, sph);
    let length = settling.exchange_length(sph);
    let start = settling.positions()[0];
    let echo = |phase: usize| {
        let fallen = Vec3::new(0.0, 0.0, phase as f64 / PHASES as f64 * fluid.numerics.spacing);
        let grain = [start - fallen];
        let size = GrainSize {
            diameter: settling.mixture.smallest(),
            length,
        };
        let rules = ExchangeRules {
            sharpening,
            floor_images: false,
            cut: 2.0,
        };
        let mut exchange = Exchange::new(vec![size], rules, fluid, &grain);
        exchange.refresh(fluid, 0.0, &grain, &[Vec3::zeros()]);
        exchange.echo(0, fluid)
    };
    let mean = (0..PHASES).map(echo).sum::<f64>() / PHASES as f64;
    (sharpening.square() / mean).cbrt()
}

/// A block has edges to keep sharp; a single grain has none, and a sharper kernel only strengthens
/// the wake that must be taken out again.
pub fn exchange_sharpening(settling: &Settling, sph: &SphFluid) -> Sharpening {
    match (sph.scheme.sharpening, settling.block) {
        (SharpeningChoice::Conservative, Some(_)) => Sharpening::SECOND_ORDER,
        _ => Sharpening::NONE,
    }
}

/// The wake an isolated grain of the scene leaves in the particle fluid.
fn own_flow(settling: &Settling, sph: &SphFluid, fluid: &FluidParticles) -> SelfInducedFlow {
    let medium = settling.medium();
    let sharpening = exchange_sharpening(settling, sph);
    let basin = Basin {
        width: settling.column.width,
        height: settling.column.height,
        density: medium.density,
        viscosity: medium.viscosity / medium.density,
        smoothing: 1.5 * settling.spacing(sph),
        exchange: resolved_length(settling, sph, fluid),
        sharpening,
    };
    SelfInducedFlow::new(&basin, settling.volume())
}

/// Excess pressure [Pa] at height z [m] of a fluid that carries falling grains at their terminal speed:
/// p′(z) = Δρ g ∫_z φ dz with `drive` Δρ g [N/m³], zero for held grains and single ones.
pub fn carried_pressure(
    fluid: &FluidParticles,
    solids: &[f64],
    height: f64,
    drive: f64,
) -> impl Fn(f64) -> f64 + use<> {
    let spacing = fluid.numerics.spacing;
    let layers = (height / spacing).round() as usize;
    let mut mean = vec![(0.0, 0u32); layers];
    for (x, solids) in fluid.position.iter().zip(solids) {
        let bin = &mut mean[((x.z / spacing) as usize).min(layers - 1)];
        *bin = (bin.0 + solids, bin.1 + 1);
    }
    // Pressure at the layers' middles, from the free surface downward.
    let mut pressure = vec![0.0; layers];
    let mut above = 0.0;
    for layer in (0..layers).rev() {
        let solids = mean[layer].0 / mean[layer].1.max(1) as f64;
        pressure[layer] = above + 0.5 * drive * solids * spacing;
        above += drive * solids * spacing;
    }
    move |z| pressure[((z / spacing) as usize).min(layers - 1)]
}

/// The published start: a lattice without pressure is damped while the grains are held.
fn relax<L: PolydisperseLaw>(simulation: &mut Simulation<L>, dt: f64) {
    let held = std::mem::replace(&mut simulation.grains.held, true);
    damp(simulation, dt);
    simulation.grains.held = held;
}

/// Damps the fluid for the steps of the published start; the grains should be held meanwhile.
pub fn damp<L: PolydisperseLaw, G: GrainSet>(simulation: &mut Simulation<L, G>, dt: f64) {
    for _ in 0..RELAXATION_STEPS {
        simulation.step(dt);
        simulation
            .fluid
            .velocity
            .iter_mut()
            .for_each(|velocity| *velocity *= 0.98);
    }
    simulation.restart_clock();
}
