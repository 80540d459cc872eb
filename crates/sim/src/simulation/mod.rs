//! A rigid set of grains settles through a column of particle fluid.
//!
//! One grain is the smallest rigid set; a block is a lattice whose grains share the mean force. Each
//! fluid step: kick and drift, refresh the coupling, sum the rates, exchange momentum, kick. The
//! exchange sees velocities at the full step, extrapolated with the last reaction, so a steady state is
//! free of the step's length.

mod audit;
mod momentum;
mod rules;

use momentum::GrainForce;
pub use rules::{CouplingRules, GrainPorosity, RigidGrains, SlipRule, StepReport};

use crate::coupling::{Exchange, Field};
use crate::drag::DragLaw;
use crate::fluid::FluidParticles;

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
    forces: Vec<GrainForce>,
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
            forces: Vec::new(),
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

    /// Counts time and steps from here.
    pub fn restart_clock(&mut self) {
        self.time = 0.0;
        self.steps = 0;
    }
}
