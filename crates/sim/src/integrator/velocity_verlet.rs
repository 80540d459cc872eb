//! Velocity Verlet, one force evaluation per step.
//!
//! Second order for forces of position only; first order once a force depends on velocity (dashpots,
//! friction, drag), because that force sees the half-step velocity. Stable for ω Δt < 2.
//!
//! Source: Swope et al. (1982), J. Chem. Phys. 76, 637–649.

use super::{Accelerations, Bodies, Forces, Integrator, add, starting_accelerations};

#[derive(Clone, Debug)]
pub struct VelocityVerlet {
    accelerations: Accelerations,
}

impl VelocityVerlet {
    fn kick(&self, bodies: &mut Bodies, time: f64) {
        add(&mut bodies.velocity, &self.accelerations.linear, time);
        add(&mut bodies.angular_velocity, &self.accelerations.angular, time);
    }
}

fn drift(bodies: &mut Bodies, time: f64) {
    add(&mut bodies.position, &bodies.velocity, time);
}

impl Integrator for VelocityVerlet {
    fn start<F: Forces>(bodies: &Bodies, forces: &mut F) -> Self {
        VelocityVerlet {
            accelerations: starting_accelerations(bodies, forces),
        }
    }

    fn step<F: Forces>(&mut self, bodies: &mut Bodies, forces: &mut F, time_step: f64) {
        self.kick(bodies, 0.5 * time_step);
        drift(bodies, time_step);
        forces.evaluate(bodies, time_step, &mut self.accelerations);
        forces.accept();
        self.kick(bodies, 0.5 * time_step);
    }

    fn accelerations(&self) -> &Accelerations {
        &self.accelerations
    }
}
