//! The exchange of momentum between grains and fluid over one step.

use super::drag::{DragOnAll, DragState};
use super::laps::Part;
use super::{FluidForce, GrainPorosity, GrainSet, POROSITY_FLOOR, Simulation, SlipRule};
use crate::coupling::Field;
use crate::drag::PolydisperseLaw;
use crate::math::Vec3;
use crate::neighbours::in_widest;

/// Flow [m/s] and force density [N/m³] that an isolated grain samples of itself.
type OwnFlow = (Vec3, Vec3);

impl<L: PolydisperseLaw, G: GrainSet> Simulation<L, G> {
    /// Grains feel the fluid over the step, the fluid gets the same impulse back.
    pub(super) fn exchange_momentum(&mut self, dt: f64) {
        self.write_fields(0.5 * dt);
        let own = self.own_flow(dt);
        self.sum_forces(own);
        self.laps.end(Part::Exchange);
        let motion = self.grains.advance(&self.forces, dt, &mut self.impulses);
        self.laps.end(Part::Grains);
        self.grain_steps += motion.grain_steps;
        self.report.outside = motion.outside;
        self.report.overlap = self.report.overlap.max(motion.overlap);
        if self.rules.two_way {
            self.hand_back(dt);
        }
        self.observe_exchange(own, dt);
        if let Some(flow) = self.rules.own_flow.as_mut() {
            let handed = self.impulses[0].z / dt;
            flow.advance(handed, self.grains.position(0).z, dt);
        }
    }

    fn write_fields(&mut self, ahead: f64) {
        let flux = matches!(self.rules.slip, SlipRule::MixtureFlux | SlipRule::FreeMixtureFlux);
        let solids = &self.exchange.solids;
        for a in 0..self.fluid.len() {
            let porosity = self.fluid.porosity[a];
            let velocity = self.velocity_ahead(a, ahead);
            self.answered[a] = velocity;
            let sampled = if flux {
                porosity * velocity + self.fluid.solid_flux[a]
            } else {
                velocity
            };
            let share = if self.rules.intrinsic_stress {
                porosity
            } else {
                1.0
            };
            // The mean size moves with the particle between refreshes.
            let per_size = per(solids.surface[a], solids.fraction[a]);
            let surface = (1.0 - porosity) * per_size;
            self.fields[a] = Field::new(sampled, self.fluid.stress[a] / share, porosity, surface);
        }
    }

    /// Velocity of a fluid particle a time `ahead` [s] from now, by implicit drag.
    fn velocity_ahead(&self, a: usize, ahead: f64) -> Vec3 {
        let fluid = &self.fluid;
        let (velocity, stopping) = (fluid.velocity[a], self.stopping[a]);
        let answer = (velocity - self.answered[a]) * stopping;
        let acceleration = fluid.acceleration[a] + fluid.reaction[a] - answer;
        velocity + acceleration * (ahead / (1.0 + ahead * stopping))
    }

    fn own_flow(&self, dt: f64) -> OwnFlow {
        let Some(flow) = &self.rules.own_flow else {
            return (Vec3::zeros(), Vec3::zeros());
        };
        let velocity = self.grains.velocity(0);
        let z = self.grains.position(0).z + velocity.z * dt;
        let force = self.report.drag + self.report.stress;
        let echo = self.exchange.echo(0, &self.fluid);
        // −∇p + ∇·τ = ρ ∂u/∂t − f in the wake, with f what the grain hands out.
        let stress = self.rules.fluid[0] * flow.acceleration(force, z) - force * echo;
        (
            Vec3::new(0.0, 0.0, -flow.velocity(z, -velocity.z)),
            Vec3::new(0.0, 0.0, -stress),
        )
    }

    /// What the fluid does to each grain.
    fn sum_forces(&mut self, own: OwnFlow) {
        self.report.sampled = 0.0;
        self.exchange.sample_all(&self.fields, &mut self.samples);
        for grain in 0..self.forces.len() {
            let sample = self.samples[grain];
            self.forces[grain] = self.force_but_drag(grain, &sample, own);
            self.states[grain] = self.drag_state(grain, &sample);
            self.report.sampled -= sample.velocity().z / self.forces.len() as f64;
        }
        in_widest(DragOnAll {
            law: self.rules.law,
            fluid: self.rules.fluid,
            states: &self.states,
            coefficients: &mut self.coefficients,
        });
        let scaled = self.asks_interstitial();
        for (grain, force) in self.forces.iter_mut().enumerate() {
            let share = if scaled { self.states[grain].porosity } else { 1.0 };
            force.drag = share * self.coefficients[grain];
        }
    }

    /// Whether the flow that a grain sees is the interstitial one, of whose slip ε is the superficial part.
    fn asks_interstitial(&self) -> bool {
        matches!(
            self.rules.slip,
            SlipRule::PorosityTimesInterstitial | SlipRule::FreeMixtureFlux
        )
    }

    fn force_but_drag(&self, grain: usize, sample: &Field, own: OwnFlow) -> FluidForce {
        let volume = self.exchange.size(grain).volume();
        // The published defect overrates the whole stress by 1/ε, the part carried analytically too.
        let excess = match self.rules.intrinsic_stress {
            true => self.rules.buoyancy * volume * (1.0 / sample.porosity() - 1.0),
            false => 0.0,
        };
        FluidForce {
            drag: 0.0,
            flow: sample.velocity() - own.0,
            stress: (sample.stress() - own.1) * volume + Vec3::new(0.0, 0.0, excess),
        }
    }

    fn drag_state(&mut self, grain: usize, sample: &Field) -> DragState {
        let raw = match &self.rules.porosity {
            GrainPorosity::Known(values) => values[grain],
            GrainPorosity::Sampled => sample.porosity(),
            GrainPorosity::OnePass(sums) => sums.porosity[grain],
        };
        self.porosity_clips += (raw < POROSITY_FLOOR) as u64;
        let porosity = raw.clamp(POROSITY_FLOOR, 1.0);
        if self.rules.slip == SlipRule::FreeMixtureFlux {
            let flow = &mut self.forces[grain].flow;
            *flow = (*flow - self.companions[grain] * (1.0 - porosity)) / porosity;
        }
        let scaled = self.asks_interstitial();
        let share = if scaled { porosity } else { 1.0 };
        let diameter = self.exchange.size(grain).diameter;
        DragState {
            diameter,
            relative_diameter: diameter / self.sauter_mean(sample, diameter),
            slip: share * (self.forces[grain].flow - self.grains.velocity(grain)).norm(),
            porosity,
        }
    }

    /// ⟨d⟩ = φ/Σ(φ_k/d_k) [m] between the smallest and the largest grain; `alone` where there is no solid.
    fn sauter_mean(&self, sample: &Field, alone: f64) -> f64 {
        let (smallest, largest) = self.exchange.diameters();
        let solids = 1.0 - sample.porosity();
        if sample.surface() > 0.0 && solids > 0.0 {
            (solids / sample.surface()).clamp(smallest, largest)
        } else {
            alone
        }
    }

    /// Gives the fluid what the grains got, as a reaction to act over the next kicks.
    fn hand_back(&mut self, dt: f64) {
        for ((given, impulse), drag) in self.given.iter_mut().zip(&self.impulses).zip(&self.coefficients) {
            let force = -impulse / dt;
            *given = [force.x, force.y, force.z, *drag];
        }
        self.reactions.fill([0.0; 4]);
        self.exchange.spread(&self.given, &mut self.reactions);
        for (a, sums) in self.reactions.iter().enumerate() {
            let mass = self.fluid.mass[a];
            self.fluid.reaction[a] = Vec3::new(sums[0], sums[1], sums[2]) / mass;
            self.stopping[a] = sums[3] / mass;
        }
    }

    fn observe_exchange(&mut self, own: OwnFlow, dt: f64) {
        let count = self.forces.len() as f64;
        let report = &mut self.report;
        (report.drag, report.slip, report.stress) = (0.0, 0.0, 0.0);
        let mut handed = Vec3::zeros();
        for ((force, impulse), coefficient) in self.forces.iter().zip(&self.impulses).zip(&self.coefficients)
        {
            let drag = impulse.z / dt - force.stress.z;
            report.drag += drag / count;
            report.slip += per(drag, *coefficient) / count;
            report.stress += force.stress.z / count;
            handed += impulse;
        }
        report.own_flow = -own.0.z;
        report.impulse = handed.norm();
        self.exchanged_over = dt;
    }

    /// Slip [m/s] and drag [N] of one grain in the last step, upward positive; zero before the first.
    pub fn slip_and_drag(&self, grain: usize) -> (f64, f64) {
        if self.exchanged_over == 0.0 {
            return (0.0, 0.0);
        }
        let force = &self.forces[grain];
        let drag = self.impulses[grain].z / self.exchanged_over - force.stress.z;
        (per(drag, self.coefficients[grain]), drag)
    }

    /// Porosity [-] each grain's drag was asked at in the last step.
    pub fn porosity_at(&self, grain: usize) -> f64 {
        self.states[grain].porosity
    }
}

/// A quotient, zero where there is nothing to divide by.
fn per(value: f64, divisor: f64) -> f64 {
    if divisor > 0.0 { value / divisor } else { 0.0 }
}
