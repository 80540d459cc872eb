//! A suspension in a particle fluid: free grains, coupled both ways.

use super::model::{SuspendedClass, Suspension};
use super::particles::Particles;
use super::run::Settling;
use crate::arrangement::Fault;
use crate::bed::Bed;
use crate::coupling::{Breathing, Exchange, ExchangeRules, GrainSize, PorosityRules, PorositySums};
use crate::drag::PolydisperseLaw;
use crate::fluid::kernel::Sharpening;
use crate::fluid::{Continuity, FluidParticles};
use crate::math::Vec3;
use crate::outcome::{Counters, Scalar};
use crate::scene::divergence::leapt;
use crate::scene::run_sph::{carried_pressure, damp, fastest, not_finite, numerics, slip_rule};
use crate::scene::sedimentation::start;
use crate::scene::{Hydrostatics, PorosityPath, SharpeningChoice, SphFluid, Start, StressDensity};
use crate::simulation::{CouplingRules, FreeGrains, GrainPorosity, GrainSet, Simulation, SlipRule};

/// r/h from which on fluid particles get no weight [-]: outside lie half of the pairs and half a per cent of the
/// kernel.
const CUT: f64 = 1.6;
/// Steps between two audits of momentum.
const AUDIT_INTERVAL: u64 = 16;

pub struct InParticles<L> {
    simulation: Simulation<L, FreeGrains>,
    dt: f64,
    momentum_gap: f64,
}

impl<L: PolydisperseLaw> InParticles<L> {
    /// Fluid, grains and coupling in their starting state.
    ///
    /// # Errors
    /// Grains that do not find room.
    pub fn start(scene: &Suspension, sph: &SphFluid, law: L) -> Result<Self, Fault> {
        let particles = Particles { scene, sph };
        let exact = sph.scheme.start == Start::Exact;
        let grains = FreeGrains::new(falling_bed(&particles, exact)?);
        let position: Vec<Vec3> = (0..grains.len()).map(|grain| grains.position(grain)).collect();
        let velocity: Vec<Vec3> = (0..grains.len()).map(|grain| grains.velocity(grain)).collect();
        let mut fluid = still_fluid(&particles);
        let mut exchange = exchange(&particles, &grains, &fluid, &position);
        if exact {
            exchange.refresh(&fluid, 0.0, &position, &velocity);
            prepare(&particles, &mut fluid, &exchange);
        }
        let rules = rules(&particles, law, &grains, &fluid);
        let mut simulation = Simulation::new(fluid, grains, exchange, rules);
        let dt = particles.step();
        if !exact {
            simulation.grains.held = true;
            damp(&mut simulation, dt);
            simulation.grains.held = false;
        }
        Ok(InParticles {
            simulation,
            dt,
            momentum_gap: 0.0,
        })
    }

    /// Why the state can no longer be trusted, if so.
    fn diverged(&self) -> Option<String> {
        let simulation = &self.simulation;
        if let Some(astray) = simulation.grains.astray() {
            return Some(leapt(astray, simulation.time));
        }
        let when = format!("at t = {:.6e} s (step {})", simulation.time, simulation.steps);
        not_finite(&simulation.fluid, &when).or_else(|| {
            let (energy, bound) = simulation.energy_excess()?;
            Some(format!(
                "kinetic energy {energy:.3e} J exceeds twice what gravity and the start gave, {bound:.3e} J, {when}; {}",
                fastest(&simulation.fluid)
            ))
        })
    }
}

/// Grains where they start, falling at their terminal speed where the fluid is to carry them at once.
fn falling_bed(particles: &Particles, falling: bool) -> Result<Bed, Fault> {
    let scene = particles.scene;
    let mut bed = start(&scene.as_sedimentation())?;
    bed.surroundings.drag = None;
    bed.porosity = None;
    if particles.sph.scheme.hydrostatics == Hydrostatics::Carried {
        // The pressure of the fluid particles holds the buoyancy.
        bed.surroundings.fluid_density = 0.0;
    }
    if falling {
        let speed = |class: &SuspendedClass| scene.settling_speed(class, scene.porosity);
        let speeds: Vec<f64> = scene.classes.iter().map(speed).collect();
        for grain in 0..bed.grains.moving {
            let class = usize::from(bed.grains.class[grain]);
            bed.grains.motion[grain].0[6] = -speeds[class];
        }
    }
    Ok(bed)
}

fn fluid_weight(particles: &Particles) -> f64 {
    match particles.sph.scheme.hydrostatics {
        Hydrostatics::Split => 0.0,
        Hydrostatics::Carried => particles.scene.gravity,
    }
}

fn still_fluid(particles: &Particles) -> FluidParticles {
    let mut numerics = numerics(
        particles.sph,
        particles.spacing(),
        particles.sound_speed(),
        fluid_weight(particles),
    );
    if particles.sph.scheme.porosity == PorosityPath::OnePass {
        // Which slip the drag law is given changes no balance of the fluid.
        numerics.continuity = Continuity::MixtureFlux;
    }
    let column = &particles.scene.column;
    FluidParticles::lattice(numerics, column.width, column.height)
}

/// Gives the fluid the grains' porosity, the pressure that carries them and the flow back between them.
fn prepare(particles: &Particles, fluid: &mut FluidParticles, exchange: &Exchange) {
    let solids = &exchange.solids;
    let porosity: Vec<f64> = solids.fraction.iter().map(|solids| 1.0 - solids).collect();
    let height = particles.scene.column.height;
    let profile = carried_pressure(fluid, &solids.fraction, height, particles.drive());
    let weight = particles.sph.medium.density * fluid_weight(particles);
    fluid.prepare(&porosity, |x| profile(x.z) + weight * (height - x.z));
    for ((velocity, flux), porosity) in fluid.velocity.iter_mut().zip(&solids.flux).zip(&porosity) {
        *velocity = -flux / *porosity;
    }
}

fn exchange(
    particles: &Particles,
    grains: &FreeGrains,
    fluid: &FluidParticles,
    position: &[Vec3],
) -> Exchange {
    let scheme = &particles.sph.scheme;
    let length = |diameter: f64| match scheme.porosity {
        PorosityPath::OnePass => particles.exchange_length(diameter),
        PorosityPath::TwoPass => fluid.numerics.smoothing(),
    };
    let sharpening = match (scheme.porosity, scheme.sharpening) {
        (PorosityPath::OnePass, SharpeningChoice::Conservative) => Sharpening::SECOND_ORDER,
        _ => Sharpening::NONE,
    };
    let rules = ExchangeRules {
        sharpening,
        floor_images: true,
        cut: if sharpening == Sharpening::NONE { CUT } else { 2.0 },
    };
    Exchange::new(sizes(grains, length), rules, fluid, position)
}

fn sizes(grains: &FreeGrains, length: impl Fn(f64) -> f64) -> Vec<GrainSize> {
    (0..grains.len())
        .map(|grain| GrainSize {
            diameter: grains.diameter(grain),
            length: length(grains.diameter(grain)),
        })
        .collect()
}

fn rules<L: PolydisperseLaw>(
    particles: &Particles,
    law: L,
    grains: &FreeGrains,
    fluid: &FluidParticles,
) -> CouplingRules<L> {
    let (scene, scheme) = (particles.scene, &particles.sph.scheme);
    let medium = particles.sph.medium;
    CouplingRules {
        law,
        fluid: [medium.density, medium.viscosity],
        slip: match slip_rule(particles.sph, false) {
            SlipRule::MixtureFlux => SlipRule::FreeMixtureFlux,
            published => published,
        },
        porosity: match scheme.porosity {
            PorosityPath::TwoPass => GrainPorosity::Sampled,
            PorosityPath::OnePass => GrainPorosity::OnePass(Box::new(PorositySums::new(
                PorosityRules {
                    sharpening: match scheme.sharpening {
                        SharpeningChoice::Conservative => Sharpening::EDGE_NEUTRAL,
                        SharpeningChoice::None => Sharpening::NONE,
                    },
                    ..PorosityRules::FREE
                },
                sizes(grains, |diameter| particles.porosity_length(diameter)),
                scene.column.width,
            ))),
        },
        buoyancy: match scheme.hydrostatics {
            Hydrostatics::Split => medium.density * scene.gravity,
            Hydrostatics::Carried => 0.0,
        },
        intrinsic_stress: scheme.stress_density == StressDensity::Intrinsic,
        two_way: true,
        own_flow: None,
        breathing: (scheme.start == Start::Exact).then(|| {
            Breathing::new(
                fluid.numerics.state.sound_speed,
                scene.column.height,
                fluid.numerics.spacing,
            )
        }),
        refresh_interval: particles.refresh_interval(),
    }
}

impl<L: PolydisperseLaw> Settling for InParticles<L> {
    fn time_step(&self) -> f64 {
        self.dt
    }

    fn patience(&self) -> u64 {
        AUDIT_INTERVAL
    }

    fn advance(&mut self, steps: u64) -> Result<(), String> {
        for _ in 0..steps {
            if self.simulation.steps.is_multiple_of(AUDIT_INTERVAL) {
                let open = self.simulation.audited_step(self.dt);
                self.momentum_gap = self.momentum_gap.max(open.norm() / self.dt);
            } else {
                self.simulation.step(self.dt);
            }
        }
        self.diverged().map_or(Ok(()), Err)
    }

    fn bed(&self) -> &Bed {
        self.simulation.grains.bed()
    }

    fn forget_deepest(&mut self) {
        self.simulation.grains.forget_deepest();
    }

    fn slip(&self, place: usize) -> f64 {
        let number = self.bed().grains.number[place];
        self.simulation.slip_and_drag(number as usize).0
    }

    fn scalars(&self) -> Vec<Scalar> {
        let scalar = |name, unit, value| Scalar { name, unit, value };
        let fluid = &self.simulation.fluid;
        vec![
            scalar("sound_speed", "m/s", fluid.numerics.state.sound_speed),
            scalar("smoothing_length", "m", fluid.numerics.smoothing()),
            scalar("fluid_particles", "1", fluid.len() as f64),
        ]
    }

    fn counters(&self) -> Counters {
        let (simulation, work) = (&self.simulation, &self.bed().work);
        Counters {
            steps: simulation.steps,
            grain_steps: simulation.grain_steps,
            fluid_pairs: simulation.fluid.pairs,
            coupling_pairs: simulation.exchange.pairs,
            grain_pairs: work.pairs,
            searched_pairs: work.looked_at,
            list_rebuilds: simulation.fluid.rebuilds + work.lists,
            porosity_clips: simulation.porosity_clips,
        }
    }

    fn split_of_time(&self) -> Vec<(&'static str, f64)> {
        self.simulation.split_of_time()
    }

    fn momentum_gap(&self) -> f64 {
        self.momentum_gap
    }
}
