//! Time integration of grains.
//!
//! A scheme advances a [`Bodies`] under [`Forces`]; both are generic, so that a step compiles into one
//! piece. Schemes: [`VelocityVerlet`], [`Gear`] with 5 or 6 values, [`RungeKutta4`]; for linear drag
//! alone the exact solution [`ExactDrag`].

mod exact_drag;
mod gear;
mod runge_kutta_4;
mod velocity_verlet;

pub use exact_drag::ExactDrag;
pub use gear::Gear;
pub use runge_kutta_4::RungeKutta4;
pub use velocity_verlet::VelocityVerlet;

use crate::math::Vec3;

/// Positions and velocities of all bodies.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bodies {
    /// [m]
    pub position: Vec<Vec3>,
    /// [m/s]
    pub velocity: Vec<Vec3>,
    /// [rad/s]
    pub angular_velocity: Vec<Vec3>,
}

/// Accelerations of all bodies.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Accelerations {
    /// [m/s²]
    pub linear: Vec<Vec3>,
    /// [rad/s²]
    pub angular: Vec<Vec3>,
}

impl Accelerations {
    pub fn zero(count: usize) -> Self {
        Accelerations {
            linear: vec![Vec3::zeros(); count],
            angular: vec![Vec3::zeros(); count],
        }
    }
}

/// What drives the bodies.
pub trait Forces {
    /// Writes the accelerations at a state that lies `elapsed` [s] after the last accepted one.
    fn evaluate(&mut self, bodies: &Bodies, elapsed: f64, accelerations: &mut Accelerations);

    /// Takes the last evaluated state for where the motion has come: contact histories move on.
    fn accept(&mut self);
}

/// A scheme of time integration.
pub trait Integrator: Sized {
    /// Evaluates the forces at the start.
    fn start<F: Forces>(bodies: &Bodies, forces: &mut F) -> Self;

    /// Advances by `time_step` [s], the same in every call.
    fn step<F: Forces>(&mut self, bodies: &mut Bodies, forces: &mut F, time_step: f64);

    /// Accelerations at the present state.
    fn accelerations(&self) -> &Accelerations;
}

fn starting_accelerations<F: Forces>(bodies: &Bodies, forces: &mut F) -> Accelerations {
    let mut accelerations = Accelerations::zero(bodies.position.len());
    forces.evaluate(bodies, 0.0, &mut accelerations);
    forces.accept();
    accelerations
}

/// `values += slopes · factor`
fn add(values: &mut [Vec3], slopes: &[Vec3], factor: f64) {
    for (value, slope) in values.iter_mut().zip(slopes) {
        *value += slope * factor;
    }
}

#[cfg(test)]
mod tests;
