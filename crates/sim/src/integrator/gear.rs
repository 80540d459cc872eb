//! Gear's predictor–corrector in Nordsieck form, one force evaluation and one correction per step.
//!
//! ```text
//! q_k = Δt^k/k! d^k r/dt^k;   predict with Pascal's triangle;   Δ = Δt²/2 a − q_2;   q_k += c_k Δ
//! ```
//!
//! `Gear<5>` and `Gear<6>` keep position and 4 or 5 derivatives. The first coefficient is the one for
//! forces that depend on velocity: 19/90 with 5 values, 3/16 with 6. Alvim (2016), table 1, prints 2/16
//! for the latter; 19/120 and 3/20 are for forces of position only. Angular velocities follow a first
//! order equation with the same number of derivatives of the torque. Orders 4 and 5, damped or not. The first steps are Runge–Kutta
//! steps, from whose accelerations the higher derivatives are differenced.
//!
//! Stable for ω Δt < 0.42 (5 values) and 0.25 (6) at a damping ratio of 0.3; without damping the scheme
//! gains energy at any step. Sources: Gear (1971), Numerical Initial Value Problems; Allen & Tildesley
//! (1987), Computer Simulation of Liquids, app. E.

use super::{Accelerations, Bodies, Forces, Integrator, RungeKutta4};
use crate::math::Vec3;

/// Second-order equations, by number of values.
const FIVE: [f64; 5] = [19.0 / 90.0, 3.0 / 4.0, 1.0, 1.0 / 2.0, 1.0 / 12.0];
const SIX: [f64; 6] = [3.0 / 16.0, 251.0 / 360.0, 1.0, 11.0 / 18.0, 1.0 / 6.0, 1.0 / 60.0];
/// First-order equations, by number of values.
const FOUR_FIRST: [f64; 4] = [3.0 / 8.0, 1.0, 3.0 / 4.0, 1.0 / 6.0];
const FIVE_FIRST: [f64; 5] = [251.0 / 720.0, 1.0, 11.0 / 12.0, 1.0 / 3.0, 1.0 / 24.0];

/// A Gear scheme of `VALUES` values, 5 or 6.
#[derive(Clone, Debug)]
pub struct Gear<const VALUES: usize> {
    starter: RungeKutta4,
    /// Accelerations of the first steps, oldest first.
    past: Vec<Accelerations>,
    /// Nordsieck vectors of position and of angular velocity, once started; the latter has one less.
    moving: Vec<[Vec3; VALUES]>,
    turning: Vec<[Vec3; VALUES]>,
    accelerations: Accelerations,
}

impl<const VALUES: usize> Gear<VALUES> {
    /// Derivatives of the acceleration that are kept.
    const DERIVATIVES: usize = VALUES - 3;

    fn coefficients() -> (&'static [f64], &'static [f64]) {
        const { assert!(VALUES == 5 || VALUES == 6, "Gear schemes have 5 or 6 values here") };
        match VALUES {
            5 => (&FIVE, &FOUR_FIRST),
            _ => (&SIX, &FIVE_FIRST),
        }
    }

    /// Fills the Nordsieck vectors from the state and the accelerations so far.
    fn begin(&mut self, bodies: &Bodies, time_step: f64) {
        let count = bodies.position.len();
        let column = |of: fn(&Accelerations) -> &Vec<Vec3>, body: usize| -> Vec<Vec3> {
            let values: Vec<Vec3> = self.past.iter().map(|past| of(past)[body]).collect();
            derivatives(&values)
        };
        self.moving = (0..count)
            .map(|body| {
                let slopes = column(|past| &past.linear, body);
                let mut values = [Vec3::zeros(); VALUES];
                values[0] = bodies.position[body];
                values[1] = bodies.velocity[body] * time_step;
                scale(&mut values[2..], &slopes, time_step * time_step, 2);
                values
            })
            .collect();
        self.turning = (0..count)
            .map(|body| {
                let slopes = column(|past| &past.angular, body);
                let mut values = [Vec3::zeros(); VALUES];
                values[0] = bodies.angular_velocity[body];
                scale(&mut values[1..VALUES - 1], &slopes, time_step, 1);
                values
            })
            .collect();
    }

    fn warm_up<F: Forces>(&mut self, bodies: &mut Bodies, forces: &mut F, time_step: f64) {
        self.starter.step(bodies, forces, time_step);
        self.accelerations = self.starter.accelerations().clone();
        self.past.push(self.accelerations.clone());
        if self.past.len() > Self::DERIVATIVES {
            self.begin(bodies, time_step);
        }
    }

    fn predict(&mut self, bodies: &mut Bodies, time_step: f64) {
        self.moving.iter_mut().for_each(|values| pascal(values));
        self.turning
            .iter_mut()
            .for_each(|values| pascal(&mut values[..VALUES - 1]));
        self.show(bodies, time_step);
    }

    fn correct(&mut self, bodies: &mut Bodies, time_step: f64) {
        let (second, first) = Self::coefficients();
        for (values, acceleration) in self.moving.iter_mut().zip(&self.accelerations.linear) {
            let gap = acceleration * (0.5 * time_step * time_step) - values[2];
            values
                .iter_mut()
                .zip(second)
                .for_each(|(value, c)| *value += gap * *c);
        }
        for (values, acceleration) in self.turning.iter_mut().zip(&self.accelerations.angular) {
            let gap = acceleration * time_step - values[1];
            values
                .iter_mut()
                .zip(first)
                .for_each(|(value, c)| *value += gap * *c);
        }
        self.show(bodies, time_step);
    }

    /// Writes positions and velocities out.
    fn show(&self, bodies: &mut Bodies, time_step: f64) {
        for (body, (moving, turning)) in self.moving.iter().zip(&self.turning).enumerate() {
            bodies.position[body] = moving[0];
            bodies.velocity[body] = moving[1] / time_step;
            bodies.angular_velocity[body] = turning[0];
        }
    }
}

impl<const VALUES: usize> Integrator for Gear<VALUES> {
    fn start<F: Forces>(bodies: &Bodies, forces: &mut F) -> Self {
        let starter = RungeKutta4::start(bodies, forces);
        let accelerations = starter.accelerations().clone();
        Gear {
            starter,
            past: vec![accelerations.clone()],
            moving: Vec::new(),
            turning: Vec::new(),
            accelerations,
        }
    }

    fn step<F: Forces>(&mut self, bodies: &mut Bodies, forces: &mut F, time_step: f64) {
        if self.past.len() <= Self::DERIVATIVES {
            return self.warm_up(bodies, forces, time_step);
        }
        self.predict(bodies, time_step);
        forces.evaluate(bodies, time_step, &mut self.accelerations);
        forces.accept();
        self.correct(bodies, time_step);
    }

    fn accelerations(&self) -> &Accelerations {
        &self.accelerations
    }
}

/// One step of Taylor's series in Nordsieck form.
fn pascal(values: &mut [Vec3]) {
    for start in 0..values.len() - 1 {
        for k in (start..values.len() - 1).rev() {
            let next = values[k + 1];
            values[k] += next;
        }
    }
}

/// The last of equally spaced values with its derivatives times the spacing's powers, by backward
/// differences: h D = −ln(1 − ∇).
fn derivatives(values: &[Vec3]) -> Vec<Vec3> {
    let mut differences = vec![values.to_vec()];
    while differences[differences.len() - 1].len() > 1 {
        let last = &differences[differences.len() - 1];
        differences.push(last.windows(2).map(|pair| pair[1] - pair[0]).collect());
    }
    let nabla = |order: usize| {
        let difference = differences.get(order).and_then(|row| row.last());
        difference.copied().unwrap_or_else(Vec3::zeros)
    };
    let all = [
        nabla(0),
        nabla(1) + nabla(2) / 2.0 + nabla(3) / 3.0,
        nabla(2) + nabla(3),
        nabla(3),
    ];
    all[..values.len()].to_vec()
}

/// Divides derivatives by the factorials of their order in the Nordsieck vector, which begins at `order`.
fn scale(values: &mut [Vec3], slopes: &[Vec3], factor: f64, order: usize) {
    let mut factorial: f64 = (1..=order).map(|k| k as f64).product();
    for (k, (value, slope)) in values.iter_mut().zip(slopes).enumerate() {
        *value = slope * (factor / factorial);
        factorial *= (order + k + 1) as f64;
    }
}
