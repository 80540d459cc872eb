//! The exchange of momentum between grains and fluid over one step.

use super::{GrainPorosity, POROSITY_FLOOR, Simulation, SlipRule};
use crate::contact::{Contact, NormalLaw};
use crate::coupling::Field;
use crate::drag::DragLaw;
use crate::integrator::ExactDrag;
use crate::math::Vec3;

/// What the fluid does to one grain over a step: drag β (U − v) and a force that does not depend on v.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct GrainForce {
    /// β [kg/s].
    beta: f64,
    /// Flow velocity U [m/s].
    flow: Vec3,
    /// Force of pressure and viscous stress [N].
    stress: Vec3,
    /// Fluid velocity as sampled, own flow included [m/s].
    sampled: Vec3,
}

impl GrainForce {
    /// What the fluid gets back at grain velocity v is −(β U + σ) + β v: the first three numbers and,
    /// last, β. The velocity is known only when all grains have been asked, their rows are at hand now.
    fn reaction(&self) -> [f64; 4] {
        let given = -(self.beta * self.flow + self.stress);
        [given.x, given.y, given.z, self.beta]
    }
}

impl<L: DragLaw> Simulation<L> {
    /// Grains feel the fluid over the step, the fluid gets the same impulse back.
    pub(super) fn exchange_momentum(&mut self, dt: f64) {
        self.write_fields(0.5 * dt);
        let own = self.own_flow();
        let mut forces = std::mem::take(&mut self.forces);
        forces.resize(self.grains.position.len(), GrainForce::default());
        self.impulses.fill([0.0; 4]);
        for row in 0..forces.len() {
            let grain = self.exchange.order()[row] as usize;
            let force = self.force_on(grain, own);
            if self.rules.two_way {
                self.exchange.spread(grain, force.reaction(), &mut self.impulses);
            }
            forces[grain] = force;
        }
        let mean_velocity = self.advance_grains(&forces, dt);
        let handed = self.hand_back(&forces, mean_velocity, dt);
        self.forces = forces;
        self.observe_exchange(own, mean_velocity, handed);
        let z = self.grains.position[0].z;
        if let Some(flow) = self.rules.own_flow.as_mut() {
            flow.advance(handed.z / dt, z, dt);
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
            let share = if self.rules.intrinsic_stress {
                porosity
            } else {
                1.0
            };
            self.fields[a] = Field::new(sampled, self.fluid.stress[a] / share, porosity);
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
        // −∇p + ∇·τ = ρ ∂u/∂t − f in the wake, with f what the grain hands out.
        let stress = self.rules.scale.density * flow.acceleration(force, z) - force * echo;
        (
            Vec3::new(0.0, 0.0, -flow.velocity(z, speed)),
            Vec3::new(0.0, 0.0, -stress),
        )
    }

    fn force_on(&mut self, grain: usize, own: (Vec3, Vec3)) -> GrainForce {
        let sample = self.exchange.sample(grain, &self.fields);
        let raw = match &self.rules.porosity {
            GrainPorosity::Known(values) => values[grain],
            GrainPorosity::Sampled => sample.porosity(),
        };
        self.porosity_clips += (raw < POROSITY_FLOOR) as u64;
        let porosity = raw.clamp(POROSITY_FLOOR, 1.0);
        let scaled = self.rules.slip == SlipRule::PorosityTimesInterstitial;
        let share = if scaled { porosity } else { 1.0 };
        // The published defect overrates the whole stress by 1/ε, the part carried analytically too.
        let excess = match self.rules.intrinsic_stress {
            true => self.rules.buoyancy * (1.0 / sample.porosity() - 1.0),
            false => 0.0,
        };
        let flow = sample.velocity() - own.0;
        let slip = share * (flow - self.grains.velocity).norm();
        GrainForce {
            beta: share * self.rules.scale.coefficient(&self.rules.law, slip, porosity),
            flow,
            stress: (sample.stress() - own.1) * self.grains.volume + Vec3::new(0.0, 0.0, excess),
            sampled: sample.velocity(),
        }
    }

    /// Moves the common velocity over the step; gives back its mean.
    fn advance_grains(&mut self, forces: &[GrainForce], dt: f64) -> Vec3 {
        self.report.floor_impulse = 0.0;
        if self.grains.held {
            return Vec3::zeros();
        }
        let count = forces.len() as f64;
        let weight = Vec3::new(0.0, 0.0, -self.grains.weight * count);
        let body = ExactDrag {
            mass: count * self.grains.mass,
            drag: forces.iter().map(|force| force.beta).sum(),
            pull: forces.iter().map(|force| force.flow * force.beta).sum(),
            force: forces.iter().map(|force| force.stress).sum::<Vec3>() + weight,
        };
        let lowest = self
            .grains
            .position
            .iter()
            .map(|x| x.z)
            .fold(f64::INFINITY, f64::min);
        let (end, mean) = body.advance(self.grains.velocity, dt);
        let fall = end.norm().max(self.grains.velocity.norm()) * dt;
        if lowest > 0.5 * self.grains.diameter + 2.0 * fall {
            self.grain_steps += 1;
            // The drift took the velocity at its start for the mean.
            let missed = (mean - self.grains.velocity) * dt;
            self.grains.position.iter_mut().for_each(|x| *x += missed);
            self.grains.velocity = end;
            return mean;
        }
        self.land(&body, lowest, dt)
    }

    /// The same near the floor, in equal sub-steps short against a contact.
    fn land(&mut self, body: &ExactDrag, lowest: f64, dt: f64) -> Vec3 {
        let radius = 0.5 * self.grains.diameter;
        let touch = |overlap: f64, rate: f64| Contact {
            overlap,
            rate,
            reduced_mass: self.grains.mass,
            mean_mass: self.grains.mass,
            reduced_radius: radius,
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
        let (mut velocity, mut mean) = (self.grains.velocity, Vec3::zeros());
        // The drift has moved the grains already: the sub-steps begin where it began.
        let mut z = lowest - velocity.z * dt;
        for _ in 0..parts as u64 {
            // Asked at the middle of the drift, the spring gives back exactly what it took.
            let overlap = radius - (z + 0.5 * part * velocity.z);
            let push = if overlap > 0.0 {
                bottom * self.rules.floor.force(&touch(overlap, -velocity.z))
            } else {
                0.0
            };
            let force = body.force + Vec3::new(0.0, 0.0, push);
            let (end, middle) = ExactDrag { force, ..*body }.advance(velocity, part);
            velocity = end;
            z += middle.z * part;
            mean += middle / parts;
            self.report.floor_impulse += push * part;
            self.report.overlap = self.report.overlap.max(overlap / self.grains.diameter);
            self.grain_steps += 1;
        }
        let correction = z - lowest;
        self.grains.position.iter_mut().for_each(|x| x.z += correction);
        self.grains.velocity = velocity;
        mean
    }

    /// Gives the fluid what the grains got, as a reaction to act over the next kicks; returns the sum.
    fn hand_back(&mut self, forces: &[GrainForce], mean_velocity: Vec3, dt: f64) -> Vec3 {
        if self.rules.two_way {
            for (a, sums) in self.impulses.iter().enumerate() {
                let force = Vec3::new(sums[0], sums[1], sums[2]) + sums[3] * mean_velocity;
                self.fluid.reaction[a] = force / self.fluid.mass[a];
            }
        }
        let given = |force: &GrainForce| force.beta * (force.flow - mean_velocity) + force.stress;
        forces.iter().map(given).sum::<Vec3>() * dt
    }

    fn observe_exchange(&mut self, own: (Vec3, Vec3), mean_velocity: Vec3, handed: Vec3) {
        let count = self.forces.len() as f64;
        let mean = |value: &dyn Fn(usize) -> f64| (0..self.forces.len()).map(value).sum::<f64>() / count;
        self.report.mean_velocity = mean_velocity;
        self.report.drag = mean(&|i| self.forces[i].beta * (self.forces[i].flow - mean_velocity).z);
        self.report.slip = mean(&|i| (self.forces[i].flow - mean_velocity).z);
        self.report.stress = mean(&|i| self.forces[i].stress.z);
        self.report.sampled = mean(&|i| -self.forces[i].sampled.z);
        self.report.own_flow = -own.0.z;
        self.report.impulse = handed.norm();
    }

    /// Slip [m/s] and drag [N] of one grain in the last step, upward positive; zero before the first.
    pub fn slip_and_drag(&self, grain: usize) -> (f64, f64) {
        self.forces.get(grain).map_or((0.0, 0.0), |force| {
            let slip = (force.flow - self.report.mean_velocity).z;
            (slip, force.beta * slip)
        })
    }
}
