//! Rolling resistance.
//!
//! ```text
//! T = −min(μ_r R F_n, ¼ I* |ω|/Δt) ω/|ω|,   ω = ω_i − ω_j without its part along n
//! ```
//!
//! One radius R for the pair, that of the smaller body: with the two radii of the published form the
//! two torques do not cancel and angular momentum is lost. The second bound, I* = I_i I_j/(I_i + I_j),
//! lets the torque vanish with ω, so that a resting grain is not shaken; a quarter of what stops the
//! rolling, since several contacts that each stop it all would turn it about together. Source: Alvim (2016), eq. 25;
//! Zhou et al. (1999), Physica A 269, 536–553.

use crate::math::{Number, Vector};

/// What a rolling law sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rolling<N = f64> {
    /// Angular velocity of the first body over the second [rad/s], perpendicular to the normal.
    pub velocity: Vector<N>,
    /// Normal force [N], never below zero.
    pub normal_force: N,
    /// Radius of the smaller body [m].
    pub radius: N,
    /// I* [kg m²].
    pub reduced_inertia: N,
    /// Step over which the torque will act [s].
    pub time_step: f64,
}

pub trait RollingLaw: Copy {
    /// Torque on the first body [N m]; the second gets the opposite.
    fn torque<N: Number>(&self, rolling: &Rolling<N>) -> Vector<N>;
}

/// No resistance.
impl RollingLaw for () {
    #[inline(always)]
    fn torque<N: Number>(&self, _: &Rolling<N>) -> Vector<N> {
        Vector::zeros()
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RollingResistance {
    /// μ_r [-].
    pub friction: f64,
}

/// Part of the rolling that one contact may stop in a step [-].
const PART: f64 = 0.25;

impl RollingLaw for RollingResistance {
    #[inline(always)]
    fn torque<N: Number>(&self, rolling: &Rolling<N>) -> Vector<N> {
        let speed = rolling.velocity.norm();
        let zero = N::splat(0.0);
        // Torque per angular velocity: the least of resistance and what stops its part of the rolling.
        let resistance = N::splat(self.friction) * rolling.radius * rolling.normal_force / speed;
        let stop = rolling.reduced_inertia * N::splat(PART / rolling.time_step);
        let resistance = N::select(zero.below(speed), resistance.min(stop), zero);
        rolling.velocity * (zero - resistance)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_torque_opposes_rolling_and_four_contacts_stop_it_at_most() {
        for speed in [1e-9, 1e-3, 1.0, 1e3] {
            let rolling = Rolling {
                velocity: Vector::new(0.0, 0.6, -0.8) * speed,
                normal_force: 1e-3,
                radius: 1e-4,
                reduced_inertia: 1e-16,
                time_step: 1e-6,
            };
            let torque = RollingResistance { friction: 0.1 }.torque(&rolling);
            let after = rolling.velocity + torque * 4.0 * (rolling.time_step / rolling.reduced_inertia);
            assert!(torque.dot(&rolling.velocity) < 0.0);
            assert!(after.dot(&rolling.velocity) >= -1e-12 * speed * speed);
            assert!(torque.norm() <= 0.1 * 1e-4 * 1e-3 * (1.0 + 1e-12));
        }
    }
}
