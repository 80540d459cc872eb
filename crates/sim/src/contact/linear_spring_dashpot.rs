//! Linear spring–dashpot normal contact.
//!
//! ```text
//! F = k δ + γ dδ/dt,     γ = −2 ln e √(m* k / (π² + ln² e))
//! ```
//!
//! A free pair followed until δ = 0 rebounds with restitution e at every speed. F can turn
//! attractive just before that instant; it is not clipped at zero: clipping ends the contact
//! early and raises the restitution above e.
//!
//! Source: Cundall & Strack (1979), Géotechnique 29, 47–65; clipping: Schwager & Pöschel (2007),
//! Granular Matter 9, 465–469.

use std::f64::consts::PI;

#[derive(Clone, Copy, Debug)]
pub struct LinearSpringDashpot {
    /// Stiffness k [N/m].
    pub stiffness: f64,
    /// Dashpot coefficient γ [N s/m].
    pub damping: f64,
}

impl LinearSpringDashpot {
    /// The law of stiffness k [N/m] that returns restitution e, 0 < e ≤ 1, for reduced mass m* [kg].
    pub fn with_restitution(stiffness: f64, restitution: f64, reduced_mass: f64) -> Self {
        let ln_e = restitution.ln();
        let damping = -2.0 * ln_e * (reduced_mass * stiffness / (PI * PI + ln_e * ln_e)).sqrt();
        LinearSpringDashpot { stiffness, damping }
    }

    /// Stiffness [N/m] at which an impact of `speed` [m/s] overlaps by `overlap` [m] at most.
    pub fn stiffness_for_overlap(reduced_mass: f64, speed: f64, overlap: f64) -> f64 {
        reduced_mass * (speed / overlap).powi(2)
    }

    /// Repulsive force [N] at overlap δ [m] and its rate dδ/dt [m/s].
    #[inline]
    pub fn force(&self, overlap: f64, rate: f64) -> f64 {
        self.stiffness * overlap + self.damping * rate
    }

    /// Duration of a contact [s] of reduced mass m* [kg]: π/√(k/m* − (γ/2m*)²).
    pub fn duration(&self, reduced_mass: f64) -> f64 {
        let decay = self.damping / (2.0 * reduced_mass);
        PI / (self.stiffness / reduced_mass - decay * decay).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Follows a head-on impact with velocity Verlet until the overlap ends; gives back e.
    fn collide(law: LinearSpringDashpot, mass: f64, speed: f64, steps: f64) -> (f64, f64) {
        let dt = law.duration(mass) / steps;
        let (mut overlap, mut rate, mut deepest) = (0.0_f64, speed, 0.0_f64);
        let mut acceleration = -law.force(overlap, rate) / mass;
        loop {
            let before = (overlap, rate);
            rate += 0.5 * dt * acceleration;
            overlap += dt * rate;
            deepest = deepest.max(overlap);
            acceleration = -law.force(overlap, rate) / mass;
            rate += 0.5 * dt * acceleration;
            if overlap <= 0.0 {
                // The contact ends inside the step.
                let share = before.0 / (before.0 - overlap);
                return (-(before.1 + share * (rate - before.1)) / speed, deepest);
            }
        }
    }

    #[test]
    fn restitution_converges_at_first_order_because_the_dashpot_sees_half_step_velocities() {
        // Nearer to 1 the dashpot is too weak for its first-order error to lead at these steps.
        for e in [0.3, 0.7] {
            let law = LinearSpringDashpot::with_restitution(10.0, e, 1e-9);
            let error = |steps| (collide(law, 1e-9, 0.01, steps).0 / e - 1.0).abs();
            let order = (error(100.0) / error(400.0)).log2() / 2.0;
            assert!(
                error(50.0) < 0.05 && (order - 1.0).abs() < 0.15,
                "e {e}: error {}, order {order}",
                error(50.0)
            );
        }
    }

    #[test]
    fn overlap_target_is_met_without_damping() {
        let stiffness = LinearSpringDashpot::stiffness_for_overlap(1e-9, 0.01, 3e-7);
        let law = LinearSpringDashpot {
            stiffness,
            damping: 0.0,
        };
        let (e, deepest) = collide(law, 1e-9, 0.01, 1000.0);
        assert!((deepest / 3e-7 - 1.0).abs() < 1e-4 && (e - 1.0).abs() < 1e-4);
    }
}
