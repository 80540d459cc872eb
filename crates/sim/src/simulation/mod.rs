//! Grains settle through a column of particle fluid.
//!
//! What the grains are is their own matter ([`GrainSet`]): a rigid set, whose smallest is a single grain,
//! or free ones. Each fluid step: kick and drift, refresh the coupling, sum the rates, exchange momentum,
//! kick. The exchange sees velocities at the full step, extrapolated with the last reaction and with how it
//! answers the fluid:
//!
//! ```text
//! u′ = u + ½Δt (a + r − B (u − u_r))/(1 + ½Δt B),   B = Σ_i w β_i/m
//! ```
//!
//! r is the reaction to the velocity u_r in the last step, a all other acceleration. A steady state is free
//! of the step's length, and no bed is so dense that it limits the step: the true rates at which grains stop
//! the fluid lie between zero and B, and for those the scheme is stable at any step.

mod audit;
mod drag;
mod free;
mod grains;
mod laps;
mod momentum;
mod rigid;
mod rules;

pub use free::FreeGrains;
pub use grains::{FluidForce, GrainSet, Motion};
pub use rigid::{RigidGrain, RigidGrains};
pub use rules::{CouplingRules, GrainPorosity, SlipRule, StepReport};

use crate::coupling::{Exchange, Field};
use crate::drag::PolydisperseLaw;
use crate::fluid::FluidParticles;
use crate::math::Vec3;

use drag::DragState;
use laps::{Laps, Part};

pub struct Simulation<L, G = RigidGrains> {
    pub fluid: FluidParticles,
    pub grains: G,
    pub exchange: Exchange,
    pub rules: CouplingRules<L>,
    pub time: f64,
    pub steps: u64,
    pub grain_steps: u64,
    pub report: StepReport,
    pub porosity_clips: u64,
    /// Elastic energy of the fluid and potential energy of the grains at the start [J].
    start_energy: f64,
    start_potential: f64,
    since_refresh: f64,
    steps_since_refresh: u64,
    /// Mean velocity of the grains at the last refresh [m/s].
    refreshed_velocity: Vec3,
    /// Places and velocities of the grains for a refresh [m, m/s].
    position: Vec<Vec3>,
    velocity: Vec<Vec3>,
    fields: Vec<Field>,
    /// What each grain samples of them.
    samples: Vec<Field>,
    states: Vec<DragState>,
    coefficients: Vec<f64>,
    forces: Vec<FluidForce>,
    /// What each grain got of the fluid in the last step [N s], and how long that was [s].
    impulses: Vec<Vec3>,
    exchanged_over: f64,
    /// Impulses over time [N] and drag coefficients [kg/s] that the grains hand back, and their sums by
    /// fluid particle.
    given: Vec<[f64; 4]>,
    reactions: Vec<[f64; 4]>,
    /// Rate B at which the drag of all grains around stops each particle [1/s], and the velocity of the
    /// particle that the last reaction answers [m/s].
    stopping: Vec<f64>,
    answered: Vec<Vec3>,
    /// Mean velocity of the solids around each grain at the last refresh [m/s].
    companions: Vec<Vec3>,
    laps: Laps,
}

/// Porosity below which the drag law is not asked.
const POROSITY_FLOOR: f64 = 0.3;

impl<L: PolydisperseLaw, G: GrainSet> Simulation<L, G> {
    /// Couples grains and fluid; the fluid keeps its state, its porosity is set from the grains.
    pub fn new(fluid: FluidParticles, grains: G, exchange: Exchange, rules: CouplingRules<L>) -> Self {
        let (count, particles) = (grains.len(), fluid.len());
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
            start_potential: 0.0,
            since_refresh: 0.0,
            steps_since_refresh: 0,
            refreshed_velocity: Vec3::zeros(),
            position: Vec::new(),
            velocity: Vec::new(),
            fields: vec![Field::default(); particles],
            samples: vec![Field::default(); count],
            states: vec![DragState::default(); count],
            coefficients: vec![0.0; count],
            forces: vec![FluidForce::default(); count],
            impulses: vec![Vec3::zeros(); count],
            exchanged_over: 0.0,
            given: vec![[0.0; 4]; count],
            reactions: vec![[0.0; 4]; particles],
            stopping: vec![0.0; particles],
            answered: vec![Vec3::zeros(); particles],
            companions: vec![Vec3::zeros(); count],
            laps: Laps::new(),
        };
        simulation.refresh_weights([0.0; 2]);
        simulation.carry_porosity();
        simulation.fluid.sum_rates(0.0);
        simulation.start_energy = simulation.fluid.elastic_energy();
        simulation.start_potential = simulation.grains.potential_energy();
        simulation
    }

    /// One fluid step of `dt` [s].
    pub fn step(&mut self, dt: f64) {
        self.laps.start();
        if self.fluid_rests() {
            self.exchange_momentum(dt);
        } else {
            self.fluid.kick_and_drift(dt);
            self.laps.end(Part::Fluid);
            self.refresh_coupling(dt);
            self.laps.end(Part::Weights);
            self.fluid.sum_rates(0.5 * dt);
            self.laps.end(Part::Fluid);
            self.exchange_momentum(dt);
            self.laps.end(Part::Exchange);
            self.fluid.kick(dt);
            self.damp_breathing(dt);
            self.laps.end(Part::Fluid);
        }
        self.time += dt;
        self.steps += 1;
    }

    /// What the steps so far spent their time on [s], by name.
    pub fn split_of_time(&self) -> Vec<(&'static str, f64)> {
        self.laps.split()
    }

    /// A fluid that neither feels the grains nor carries its own weight never moves.
    fn fluid_rests(&self) -> bool {
        !self.rules.two_way && self.fluid.numerics.gravity == 0.0
    }

    fn refresh_coupling(&mut self, dt: f64) {
        self.since_refresh += dt;
        self.steps_since_refresh += 1;
        if self.steps_since_refresh >= self.rules.refresh_interval {
            // In the middle of the steps they serve, weights are right to second order. The fluid has moved
            // already, the grains are a step behind.
            let middle = 0.5 * (self.rules.refresh_interval - 1) as f64 * dt;
            self.refresh_weights([dt + middle, middle]);
            self.since_refresh = -middle;
        }
        self.carry_porosity();
    }

    /// Weights and solids for the grains and the fluid `ahead` [s] from now, if nothing pushes them meanwhile.
    fn refresh_weights(&mut self, [ahead, fluid_ahead]: [f64; 2]) {
        let (grains, width) = (&self.grains, self.fluid.width);
        let wrapped = |x: Vec3| Vec3::new(x.x.rem_euclid(width), x.y.rem_euclid(width), x.z);
        let places = (0..grains.len()).map(|i| wrapped(grains.position(i) + grains.velocity(i) * ahead));
        self.position.clear();
        self.position.extend(places);
        self.velocity.clear();
        self.velocity
            .extend((0..grains.len()).map(|i| grains.velocity(i)));
        self.exchange
            .refresh(&self.fluid, fluid_ahead, &self.position, &self.velocity);
        if let GrainPorosity::OnePass(sums) = &mut self.rules.porosity {
            sums.refresh(&self.position);
        }
        if self.rules.slip == SlipRule::FreeMixtureFlux {
            self.meet_companions();
        }
        self.refreshed_velocity = self.mean_velocity();
        self.since_refresh = 0.0;
        self.steps_since_refresh = 0;
    }

    /// Samples the mean velocity of the solids at each grain.
    fn meet_companions(&mut self) {
        let solids = &self.exchange.solids;
        for ((field, flux), fraction) in self.fields.iter_mut().zip(&solids.flux).zip(&solids.fraction) {
            *field = Field::new(*flux, Vec3::zeros(), *fraction, 0.0);
        }
        self.exchange.sample_all(&self.fields, &mut self.samples);
        for (companions, sample) in self.companions.iter_mut().zip(&self.samples) {
            *companions = sample.velocity() / sample.porosity().max(f64::MIN_POSITIVE);
        }
    }

    /// Mean velocity of the grains [m/s].
    fn mean_velocity(&self) -> Vec3 {
        let count = self.grains.len();
        (0..count).map(|i| self.grains.velocity(i)).sum::<Vec3>() / count as f64
    }

    /// Porosity of the fluid now: the last refreshed one moved on by its rate. The solids keep their
    /// velocities but for what all of them have gained since.
    fn carry_porosity(&mut self) {
        if !self.rules.two_way {
            return;
        }
        let gained = self.mean_velocity() - self.refreshed_velocity;
        let solids = &self.exchange.solids;
        for a in 0..self.fluid.len() {
            let fraction = solids.fraction[a];
            let porosity = 1.0 - (fraction + self.since_refresh * solids.rate[a]);
            self.porosity_clips += (porosity < POROSITY_FLOOR) as u64;
            let porosity = porosity.clamp(POROSITY_FLOOR, 1.0);
            self.fluid.set_porosity(a, porosity);
            self.fluid.solid_flux[a] = if fraction > 0.0 {
                (1.0 - porosity) * (solids.flux[a] / fraction + gained)
            } else {
                Vec3::zeros()
            };
        }
    }

    fn damp_breathing(&mut self, dt: f64) {
        if let Some(breathing) = self.rules.breathing.as_mut() {
            breathing.damp(&mut self.fluid, dt);
        }
    }

    /// Counts time and steps from here.
    pub fn restart_clock(&mut self) {
        self.time = 0.0;
        self.steps = 0;
    }
}
