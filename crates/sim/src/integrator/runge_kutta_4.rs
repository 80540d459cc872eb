//! The classical Runge–Kutta scheme, four force evaluations per step.
//!
//! Fourth order for smooth forces, of velocity too. A Hertz force is not smooth where a contact begins
//! and ends: there the order is 5/2, and 3/2 with viscoelastic damping. Stable for ω Δt < 2.8.
//!
//! Source: Hairer, Nørsett & Wanner (1993), Solving Ordinary Differential Equations I, sec. II.1.

use super::{Accelerations, Bodies, Forces, Integrator, add, starting_accelerations};

#[derive(Clone, Debug)]
pub struct RungeKutta4 {
    accelerations: Accelerations,
}

/// Slopes of a stage: velocities and accelerations.
struct Stage {
    bodies: Bodies,
    accelerations: Accelerations,
}

impl Stage {
    /// The state `time` along the slopes of `stage`, from `start`, and the forces there.
    fn after<F: Forces>(start: &Bodies, stage: &Stage, time: f64, forces: &mut F) -> Stage {
        let mut bodies = start.clone();
        advance(&mut bodies, stage, time);
        let mut accelerations = Accelerations::zero(bodies.position.len());
        forces.evaluate(&bodies, time, &mut accelerations);
        Stage {
            bodies,
            accelerations,
        }
    }
}

fn advance(bodies: &mut Bodies, stage: &Stage, time: f64) {
    add(&mut bodies.position, &stage.bodies.velocity, time);
    add(&mut bodies.velocity, &stage.accelerations.linear, time);
    add(&mut bodies.angular_velocity, &stage.accelerations.angular, time);
}

impl Integrator for RungeKutta4 {
    fn start<F: Forces>(bodies: &Bodies, forces: &mut F) -> Self {
        RungeKutta4 {
            accelerations: starting_accelerations(bodies, forces),
        }
    }

    fn step<F: Forces>(&mut self, bodies: &mut Bodies, forces: &mut F, time_step: f64) {
        let first = Stage {
            bodies: bodies.clone(),
            accelerations: self.accelerations.clone(),
        };
        let second = Stage::after(&first.bodies, &first, 0.5 * time_step, forces);
        let third = Stage::after(&first.bodies, &second, 0.5 * time_step, forces);
        let fourth = Stage::after(&first.bodies, &third, time_step, forces);
        for (stage, share) in [(&first, 1.0), (&second, 2.0), (&third, 2.0), (&fourth, 1.0)] {
            advance(bodies, stage, share / 6.0 * time_step);
        }
        forces.evaluate(bodies, time_step, &mut self.accelerations);
        forces.accept();
    }

    fn accelerations(&self) -> &Accelerations {
        &self.accelerations
    }
}
