//! A rigid set of grains settles through a column of particle fluid.
//!
//! One grain is the smallest rigid set; a block is a lattice whose grains share the mean force. Each
//! fluid step: kick and drift, refresh the coupling, sum the rates, exchange momentum, kick. The
//! exchange sees velocities at the full step, extrapolated with the last reaction, so a steady state is
//! free of the step's length.

use crate::contact::{Contact, LinearSpringDashpot, NormalLaw};
use crate::coupling::{Breathing, Exchange, Field, SelfInducedFlow};
use crate::drag::{DragLaw, DragScale};
use crate::fluid::FluidParticles;
use crate::integrator::ExactDrag;
use crate::math::Vec3;

/// Grains that move as one.
#[derive(Clone, Debug)]
pub struct RigidGrains {
    pub position: Vec<Vec3>,
    /// Common velocity [m/s].
    pub velocity: Vec3,
    pub diameter: f64,
    /// Volume of one grain [m³].
    pub volume: f64,
    /// Mass of one grain [kg].
    pub mass: f64,
    /// Weight less buoyancy of one grain, or full weight where the fluid carries its whole pressure [N].
    pub weight: f64,
    /// Held in place: feels the fluid and pushes it, but does not move.
    pub held: bool,
}

/// Which velocity and porosity enter the drag law.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SlipRule {
    /// Mixture flux less the grain's velocity: the superficial slip of a grain among others. The
    /// mixture flux ε u + (1 − ε) v_s is smooth where ε is not, so sampling it costs no accuracy.
    MixtureFlux,
    /// Fluid velocity less the grain's own velocity, for an isolated grain.
    Isolated,
    /// Local porosity times the interstitial slip.
    PorosityTimesInterstitial,
    /// Interstitial slip in place of the superficial one: a published defect.
    Interstitial,
}

/// Where a grain's porosity comes from.
#[derive(Clone, Debug)]
pub enum GrainPorosity {
    /// Constant values: one per grain.
    Known(Vec<f64>),
    /// Sampled from the fluid.
    Sampled,
}

/// How the coupling is done.
pub struct CouplingRules<L> {
    pub law: L,
    pub scale: DragScale,
    pub slip: SlipRule,
    pub porosity: GrainPorosity,
    /// ϱ in place of ρ = ε ϱ in the stress on a grain: a published defect.
    pub intrinsic_stress: bool,
    /// Whether the fluid feels the grains.
    pub two_way: bool,
    pub own_flow: Option<SelfInducedFlow>,
    /// Damper of compression waves through the whole column.
    pub breathing: Option<Breathing>,
    pub floor: LinearSpringDashpot,
    /// Grain steps per contact time [-].
    pub contact_steps: f64,
    /// Fluid steps between refreshes of the weights.
    pub refresh_interval: u64,
}

/// What the last step did, for observation.
#[derive(Clone, Debug, Default)]
pub struct StepReport {
    /// Mean drag per grain [N], upward positive.
    pub drag: f64,
    /// Mean force of the fluid stress per grain [N], upward positive.
    pub stress: f64,
    /// Mean superficial slip speed [m/s].
    pub slip: f64,
    /// Fluid velocity sampled by the grains, mean, downward positive [m/s].
    pub sampled: f64,
    /// Own flow taken out of it, downward positive [m/s].
    pub own_flow: f64,
    /// Largest overlap with the floor over the diameter [-].
    pub overlap: f64,
    /// Impulse handed to the fluid in this step [N s].
    pub impulse: f64,
    /// Slip speed and drag of each grain, for tracked grains.
    pub grain_slip: Vec<f64>,
    pub grain_drag: Vec<f64>,
}

pub struct Simulation<L> {
    pub fluid: FluidParticles,
    pub grains: RigidGrains,
    pub exchange: Exchange,
    pub rules: CouplingRules<L>,
    pub time: f64,
    pub steps: u64,
    pub grain_steps: u64,
    pub report: StepReport,
    pub porosity_clips: u64,
    /// Elastic energy of the fluid at the start [J] and where the first grain started [m].
    start_energy: f64,
    start_height: f64,
    since_refresh: f64,
    steps_since_refresh: u64,
    fields: Vec<Field>,
    impulses: Vec<[f64; 4]>,
}

/// Porosity below which the drag law is not asked.
const POROSITY_FLOOR: f64 = 0.3;

impl<L: DragLaw> Simulation<L> {
    /// Couples grains and fluid; the fluid keeps its state, its porosity is set from the grains.
    pub fn new(
        fluid: FluidParticles,
        grains: RigidGrains,
        exchange: Exchange,
        rules: CouplingRules<L>,
    ) -> Self {
        let count = fluid.len();
        let mut simulation = Simulation {
            fluid,
            grains,
            exchange,
            rules,
            time: 0.0,
            steps: 0,
            grain_steps: 0,
            report: StepReport::default(),
            porosity_clips: 0,
            start_energy: 0.0,
            start_height: 0.0,
            since_refresh: 0.0,
            steps_since_refresh: 0,
            fields: vec![Field::default(); count],
            impulses: vec![[0.0; 4]; count],
        };
        simulation.refresh_weights();
        simulation.carry_porosity();
        simulation.fluid.sum_rates(0.0);
        simulation.start_energy = simulation.fluid.elastic_energy();
        simulation.start_height = simulation.grains.position[0].z;
        simulation
    }

    /// One fluid step of `dt` [s].
    pub fn step(&mut self, dt: f64) {
        if self.fluid_rests() {
            self.drift_grains(dt);
            self.exchange_momentum(dt);
        } else {
            self.fluid.kick_and_drift(dt);
            self.drift_grains(dt);
            self.refresh_coupling(dt);
            self.fluid.sum_rates(0.5 * dt);
            self.exchange_momentum(dt);
            self.fluid.kick(dt);
            self.damp_breathing(dt);
        }
        self.time += dt;
        self.steps += 1;
    }

    /// A fluid that neither feels the grains nor carries its own weight never moves.
    fn fluid_rests(&self) -> bool {
        !self.rules.two_way && self.fluid.numerics.gravity == 0.0
    }

    fn drift_grains(&mut self, dt: f64) {
        let (width, shift) = (self.fluid.width, self.grains.velocity * dt);
        for x in &mut self.grains.position {
            *x += shift;
            x.x = x.x.rem_euclid(width);
            x.y = x.y.rem_euclid(width);
        }
    }

    fn refresh_coupling(&mut self, dt: f64) {
        self.since_refresh += dt;
        self.steps_since_refresh += 1;
        if self.steps_since_refresh >= self.rules.refresh_interval {
            self.refresh_weights();
        }
        self.carry_porosity();
    }

    fn refresh_weights(&mut self) {
        self.exchange.refresh(
            &self.fluid,
            &self.grains.position,
            self.grains.volume,
            self.grains.velocity,
        );
        self.since_refresh = 0.0;
        self.steps_since_refresh = 0;
    }

    /// Porosity of the fluid now: the last refreshed one moved on by its rate.
    fn carry_porosity(&mut self) {
        if !self.rules.two_way {
            return;
        }
        for a in 0..self.fluid.len() {
            let solids = self.exchange.solids[a] + self.since_refresh * self.exchange.solids_rate[a];
            let porosity = 1.0 - solids;
            self.porosity_clips += (porosity < POROSITY_FLOOR) as u64;
            let porosity = porosity.clamp(POROSITY_FLOOR, 1.0);
            self.fluid.set_porosity(a, porosity);
            self.fluid.solid_flux[a] = (1.0 - porosity) * self.grains.velocity;
        }
    }

    fn damp_breathing(&mut self, dt: f64) {
        if let Some(breathing) = self.rules.breathing.as_mut() {
            breathing.damp(&mut self.fluid, dt);
        }
    }

    fn write_fields(&mut self, ahead: f64) {
        let flux = self.rules.slip == SlipRule::MixtureFlux;
        for a in 0..self.fluid.len() {
            let porosity = self.fluid.porosity[a];
            let velocity = self.fluid.velocity_ahead(a, ahead);
            let sampled = if flux {
                porosity * velocity + self.fluid.solid_flux[a]
            } else {
                velocity
            };
            let stress = if self.rules.intrinsic_stress {
                self.fluid.stress[a] / porosity
            } else {
                self.fluid.stress[a]
            };
            self.fields[a] = Field::new(sampled, stress, porosity);
        }
    }

    /// Grains feel the fluid over the step, the fluid gets the same impulse back.
    fn exchange_momentum(&mut self, dt: f64) {
        self.write_fields(0.5 * dt);
        let count = self.grains.position.len();
        let samples: Vec<Field> = (0..count)
            .map(|i| self.exchange.sample(i, &self.fields))
            .collect();
        let own = self.own_flow();
        let drags: Vec<(f64, Vec3)> = (0..count).map(|i| self.drag_on(i, &samples[i], own)).collect();
        let stresses: Vec<Vec3> = samples
            .iter()
            .map(|sample| (sample.stress() - own.1) * self.grains.volume)
            .collect();
        let mean_velocity = self.advance_grains(&drags, &stresses, dt);
        self.impulses.fill([0.0; 4]);
        let mut handed = Vec3::zeros();
        for i in 0..count {
            let (beta, flow) = drags[i];
            let impulse = (beta * (flow - mean_velocity) + stresses[i]) * dt;
            handed += impulse;
            if self.rules.two_way {
                self.exchange.spread(i, -impulse, &mut self.impulses);
            }
        }
        if self.rules.two_way {
            for (a, impulse) in self.impulses.iter().enumerate() {
                let impulse = Vec3::new(impulse[0], impulse[1], impulse[2]);
                self.fluid.reaction[a] = impulse / (self.fluid.mass[a] * dt);
            }
        }
        self.observe_exchange(&samples, &drags, &stresses, own, mean_velocity, handed);
        let z = self.grains.position[0].z;
        if let Some(flow) = self.rules.own_flow.as_mut() {
            flow.advance(handed.z / dt, z, dt);
        }
    }

    /// Velocity [m/s] and force density [N/m³] that an isolated grain would sample of itself.
    fn own_flow(&self) -> (Vec3, Vec3) {
        let Some(flow) = &self.rules.own_flow else {
            return (Vec3::zeros(), Vec3::zeros());
        };
        let z = self.grains.position[0].z;
        let force = self.report.drag + self.report.stress;
        let speed = -self.grains.velocity.z;
        let echo = self.exchange.echo(0, &self.fluid);
        let density = self.rules.scale.density;
        // −∇p + ∇·τ = ρ ∂u/∂t − f in the wake, with f what the grain hands out.
        let stress = density * flow.acceleration(force, z) - force * echo;
        (
            Vec3::new(0.0, 0.0, -flow.velocity(z, speed)),
            Vec3::new(0.0, 0.0, -stress),
        )
    }

    /// β [kg/s] and the flow velocity U [m/s] that make the drag β (U − v).
    fn drag_on(&mut self, grain: usize, sample: &Field, own: (Vec3, Vec3)) -> (f64, Vec3) {
        let raw = match &self.rules.porosity {
            GrainPorosity::Known(values) => values[grain],
            GrainPorosity::Sampled => sample.porosity(),
        };
        self.porosity_clips += (raw < POROSITY_FLOOR) as u64;
        let porosity = raw.clamp(POROSITY_FLOOR, 1.0);
        let share = if self.rules.slip == SlipRule::PorosityTimesInterstitial {
            porosity
        } else {
            1.0
        };
        let flow = sample.velocity() - own.0;
        let slip = share * (flow - self.grains.velocity).norm();
        (
            share * self.rules.scale.coefficient(&self.rules.law, slip, porosity),
            flow,
        )
    }

    /// Moves the common velocity over the step; gives back its mean.
    fn advance_grains(&mut self, drags: &[(f64, Vec3)], stresses: &[Vec3], dt: f64) -> Vec3 {
        let count = drags.len() as f64;
        let body = ExactDrag {
            mass: count * self.grains.mass,
            drag: drags.iter().map(|(beta, _)| beta).sum(),
            pull: drags.iter().map(|(beta, flow)| *flow * *beta).sum(),
            force: stresses.iter().sum::<Vec3>() + Vec3::new(0.0, 0.0, -self.grains.weight * count),
        };
        if self.grains.held {
            return Vec3::zeros();
        }
        let lowest = self
            .grains
            .position
            .iter()
            .map(|x| x.z)
            .fold(f64::INFINITY, f64::min);
        let fall = self.grains.velocity.norm() * dt;
        if lowest > 0.5 * self.grains.diameter + 2.0 * fall {
            self.grain_steps += 1;
            let (end, mean) = body.advance(self.grains.velocity, dt);
            self.grains.velocity = end;
            return mean;
        }
        self.land(&body, lowest, dt)
    }

    /// The same near the floor, in equal sub-steps short against a contact.
    fn land(&mut self, body: &ExactDrag, lowest: f64, dt: f64) -> Vec3 {
        let touch = |overlap: f64, rate: f64| Contact {
            overlap,
            rate,
            reduced_mass: self.grains.mass,
            mean_mass: self.grains.mass,
            reduced_radius: 0.5 * self.grains.diameter,
        };
        let contact_time = self.rules.floor.contact_time(&touch(0.0, 0.0));
        let parts = (dt / (contact_time / self.rules.contact_steps)).ceil().max(1.0);
        let part = dt / parts;
        let bottom = self
            .grains
            .position
            .iter()
            .filter(|x| x.z < lowest + 1e-9)
            .count() as f64;
        let (mut z, mut velocity, mut mean) = (
            lowest - self.grains.velocity.z * dt,
            self.grains.velocity,
            Vec3::zeros(),
        );
        for _ in 0..parts as u64 {
            let overlap = 0.5 * self.grains.diameter - z;
            let push = if overlap > 0.0 {
                self.rules.floor.force(&touch(overlap, -velocity.z))
            } else {
                0.0
            };
            let force = body.force + Vec3::new(0.0, 0.0, push * bottom);
            let (end, middle) = ExactDrag { force, ..*body }.advance(velocity, part);
            velocity = end;
            z += middle.z * part;
            mean += middle / parts;
            self.report.overlap = self.report.overlap.max(overlap / self.grains.diameter);
            self.grain_steps += 1;
        }
        let correction = z - lowest;
        self.grains.position.iter_mut().for_each(|x| x.z += correction);
        self.grains.velocity = velocity;
        mean
    }

    /// Momentum of fluid and grains [N s] in the middle of the next step of `dt` [s], where the kicks of
    /// the fluid meet: from one middle to the next it changes by whole impulses.
    pub fn momentum(&self, dt: f64) -> Vec3 {
        let moving = if self.grains.held {
            0.0
        } else {
            self.grains.mass * self.grains.position.len() as f64
        };
        self.fluid.momentum_ahead(0.5 * dt) + self.grains.velocity * moving
    }

    /// Force on fluid and grains from outside, the floor left out [N].
    pub fn external_force(&self) -> Vec3 {
        let count = self.grains.position.len() as f64;
        let fluid: f64 = self.fluid.mass.iter().sum::<f64>() * self.fluid.numerics.gravity;
        let held = Vec3::new(0.0, 0.0, self.report.drag + self.report.stress) * count;
        let grains = if self.grains.held {
            -held
        } else {
            Vec3::new(0.0, 0.0, -self.grains.weight * count)
        };
        grains - Vec3::new(0.0, 0.0, fluid)
    }

    /// Impulse of the breathing damper in the last step [N s].
    pub fn damper_impulse(&self) -> Vec3 {
        Vec3::new(
            0.0,
            0.0,
            self.rules
                .breathing
                .as_ref()
                .map_or(0.0, |breathing| breathing.impulse),
        )
    }

    /// Kinetic energy and its bound [J], when it is more than twice what gravity and the compression
    /// at the start can have given.
    pub fn energy_excess(&self) -> Option<(f64, f64)> {
        let count = self.grains.position.len() as f64;
        let kinetic = |mass: f64, velocity: &Vec3| 0.5 * mass * velocity.norm_squared();
        let fluid = &self.fluid;
        let energy: f64 = (fluid.mass.iter().zip(&fluid.velocity))
            .map(|(m, u)| kinetic(*m, u))
            .sum::<f64>()
            + kinetic(self.grains.mass * count, &self.grains.velocity);
        let fallen = (self.start_height - self.grains.position[0].z).max(0.0);
        let bound =
            2.0 * (self.start_energy + self.grains.weight.abs() * count * fallen.max(self.grains.diameter));
        (energy > bound).then_some((energy, bound))
    }

    /// Counts time and steps from here.
    pub fn restart_clock(&mut self) {
        self.time = 0.0;
        self.steps = 0;
    }

    fn observe_exchange(
        &mut self,
        samples: &[Field],
        drags: &[(f64, Vec3)],
        stresses: &[Vec3],
        own: (Vec3, Vec3),
        mean_velocity: Vec3,
        handed: Vec3,
    ) {
        let count = samples.len() as f64;
        let slip = |flow: &Vec3| (flow - mean_velocity).z;
        self.report.grain_slip = drags.iter().map(|(_, flow)| slip(flow)).collect();
        self.report.grain_drag = drags.iter().map(|(beta, flow)| beta * slip(flow)).collect();
        self.report.drag = self.report.grain_drag.iter().sum::<f64>() / count;
        self.report.slip = self.report.grain_slip.iter().sum::<f64>() / count;
        self.report.stress = stresses.iter().map(|force| force.z).sum::<f64>() / count;
        self.report.sampled = -samples.iter().map(|sample| sample.velocity().z).sum::<f64>() / count;
        self.report.own_flow = -own.0.z;
        self.report.impulse = handed.norm();
    }
}
