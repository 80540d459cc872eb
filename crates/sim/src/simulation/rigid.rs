//! Grains that move as one.

use super::grains::{FluidForce, GrainSet, Motion};
use crate::contact::{Contact, LinearSpringDashpot, NormalLaw};
use crate::integrator::ExactDrag;
use crate::math::Vec3;

/// One grain of a rigid set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidGrain {
    pub position: Vec3,
    /// [m]
    pub diameter: f64,
    /// [kg]
    pub mass: f64,
    /// Weight less buoyancy, or full weight where the fluid carries its whole pressure [N].
    pub weight: f64,
}

/// A rigid set of grains: each feels the fluid around it, all share the sum.
#[derive(Clone, Debug)]
pub struct RigidGrains {
    pub grains: Vec<RigidGrain>,
    /// Common velocity [m/s].
    pub velocity: Vec3,
    /// Held in place: feels the fluid and pushes it, but does not move.
    pub held: bool,
    /// Contact with the floor z = 0.
    pub floor: LinearSpringDashpot,
    /// Steps per contact time [-].
    pub contact_steps: f64,
}

/// Grains this near to the lowest touch the floor together with it [m].
const LEVEL: f64 = 1e-9;

impl RigidGrains {
    /// Sum of the weights [N].
    pub fn weight(&self) -> f64 {
        self.grains.iter().map(|grain| grain.weight).sum()
    }

    /// Sum of the masses [kg].
    pub fn mass(&self) -> f64 {
        self.grains.iter().map(|grain| grain.mass).sum()
    }

    /// Gap under the lowest grain [m] and that grain.
    fn clearance(&self) -> (f64, &RigidGrain) {
        let gap = |grain: &RigidGrain| grain.position.z - 0.5 * grain.diameter;
        let first = (gap(&self.grains[0]), &self.grains[0]);
        self.grains.iter().fold(first, |lowest, grain| {
            if gap(grain) < lowest.0 {
                (gap(grain), grain)
            } else {
                lowest
            }
        })
    }

    /// Velocities at the end of and mean over a step near the floor, in equal sub-steps short against a
    /// contact.
    fn land(&self, body: &ExactDrag, dt: f64, motion: &mut Motion) -> (Vec3, Vec3) {
        let (mut gap, lowest) = self.clearance();
        let touch = |overlap: f64, rate: f64| Contact {
            overlap,
            rate,
            reduced_mass: lowest.mass,
            mean_mass: lowest.mass,
            reduced_radius: 0.5 * lowest.diameter,
        };
        let contact_time = self.floor.contact_time(&touch(0.0, 0.0));
        let parts = (dt / (contact_time / self.contact_steps)).ceil().max(1.0);
        let part = dt / parts;
        let bottom = (self.grains.iter())
            .filter(|grain| grain.position.z - 0.5 * grain.diameter < gap + LEVEL)
            .count() as f64;
        let (mut velocity, mut mean) = (self.velocity, Vec3::zeros());
        for _ in 0..parts as u64 {
            // Asked at the middle of the drift, the spring gives back exactly what it took.
            let overlap = -(gap + 0.5 * part * velocity.z);
            let push = if overlap > 0.0 {
                bottom * self.floor.force(&touch(overlap, -velocity.z))
            } else {
                0.0
            };
            let force = body.force + Vec3::new(0.0, 0.0, push);
            let (end, middle) = ExactDrag { force, ..*body }.advance(velocity, part);
            velocity = end;
            gap += middle.z * part;
            mean += middle / parts;
            motion.outside.z += push * part;
            motion.overlap = motion.overlap.max(overlap / lowest.diameter);
            motion.grain_steps += 1;
        }
        (velocity, mean)
    }

    fn fall(&mut self, forces: &[FluidForce], dt: f64) -> (Motion, Vec3) {
        let weight = Vec3::new(0.0, 0.0, -self.weight());
        let body = ExactDrag {
            mass: self.mass(),
            drag: forces.iter().map(|force| force.drag).sum(),
            pull: forces.iter().map(|force| force.flow * force.drag).sum(),
            force: forces.iter().map(|force| force.stress).sum::<Vec3>() + weight,
        };
        let mut motion = Motion {
            outside: weight * dt,
            ..Motion::default()
        };
        let (mut end, mut mean) = body.advance(self.velocity, dt);
        let drifted = self.clearance().0 + self.velocity.z * dt;
        if drifted > 2.0 * end.norm().max(self.velocity.norm()) * dt {
            motion.grain_steps = 1;
        } else {
            (end, mean) = self.land(&body, dt, &mut motion);
        }
        self.velocity = end;
        self.grains
            .iter_mut()
            .for_each(|grain| grain.position += mean * dt);
        (motion, mean)
    }
}

impl GrainSet for RigidGrains {
    fn len(&self) -> usize {
        self.grains.len()
    }

    fn diameter(&self, grain: usize) -> f64 {
        self.grains[grain].diameter
    }

    fn position(&self, grain: usize) -> Vec3 {
        self.grains[grain].position
    }

    fn velocity(&self, _grain: usize) -> Vec3 {
        self.velocity
    }

    fn advance(&mut self, forces: &[FluidForce], dt: f64, impulses: &mut [Vec3]) -> Motion {
        let (mut motion, mean) = if self.held {
            (Motion::default(), Vec3::zeros())
        } else {
            self.fall(forces, dt)
        };
        for (impulse, force) in impulses.iter_mut().zip(forces) {
            *impulse = force.impulse(mean, dt);
        }
        if self.held {
            motion.outside = -impulses.iter().sum::<Vec3>();
        }
        motion
    }

    fn momentum(&self) -> Vec3 {
        let moving = if self.held { 0.0 } else { self.mass() };
        self.velocity * moving
    }

    fn kinetic_energy(&self) -> f64 {
        0.5 * self.mass() * self.velocity.norm_squared()
    }

    fn potential_energy(&self) -> f64 {
        (self.grains.iter())
            .map(|grain| grain.weight * grain.position.z)
            .sum()
    }

    fn energy_of_one_diameter(&self) -> f64 {
        (self.grains.iter())
            .map(|grain| grain.weight.abs() * grain.diameter)
            .sum()
    }
}
