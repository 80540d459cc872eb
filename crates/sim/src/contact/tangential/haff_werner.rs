//! Viscous friction capped by Coulomb's.
//!
//! ```text
//! F_t = −min(γ_t |v_t|, μ F_n, 2/7 m* |v_t|/Δt) t̂
//! ```
//!
//! The third bound stops the slip within the step and never reverses it: with published coefficients
//! γ_t Δt/m* is in the hundreds, which no explicit step survives. No history, so no sticking at rest:
//! a grain on an incline creeps. Sources: Haff & Werner (1986), Powder Technology 48, 239–245; Alvim
//! (2016), eqs. 37–38.

use super::{Slip, TangentialLaw};
use crate::math::{Number, Vector};

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HaffWerner {
    /// γ_t [N s/m].
    pub damping: f64,
    /// μ [-].
    pub friction: f64,
}

impl TangentialLaw for HaffWerner {
    #[inline(always)]
    fn force<N: Number>(&self, slip: &Slip<N>, history: Vector<N>) -> (Vector<N>, Vector<N>) {
        let speed = slip.velocity.norm();
        let zero = N::splat(0.0);
        // Force per slip velocity: the least of dashpot, friction and what stops the slip.
        let sliding = N::splat(self.friction) * slip.normal_force / speed;
        let stop = slip.resisting_mass() * N::splat(1.0 / slip.time_step);
        let resistance = sliding.min(N::splat(self.damping)).min(stop);
        let resistance = N::select(zero.below(speed), resistance, zero);
        (slip.velocity * (zero - resistance), history)
    }

    /// None: the impulse is limited in every step.
    fn step_limit(&self, _: f64) -> f64 {
        f64::INFINITY
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_may_stop_the_slip_but_never_reverse_it() {
        let law = HaffWerner {
            damping: 10.0,
            friction: 0.5,
        };
        let slip = |time_step| Slip {
            velocity: Vector::new(0.0, 0.02, -0.01),
            normal: Vector::new(1.0, 0.0, 0.0),
            normal_force: 1.0,
            overlap: 1e-8,
            reduced_mass: 1e-8,
            elapsed: time_step,
            time_step,
        };
        for time_step in [1e-9, 1e-6, 1e-3] {
            let slip = slip(time_step);
            let (force, _) = law.force(&slip, Vector::zeros());
            let after = slip.velocity + force * (time_step / slip.resisting_mass());
            assert!(after.dot(&slip.velocity) >= -1e-18, "{time_step}");
            assert!(force.norm() <= 0.5);
        }
    }
}
