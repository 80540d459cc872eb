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
use crate::math::Vec3;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HaffWerner {
    /// γ_t [N s/m].
    pub damping: f64,
    /// μ [-].
    pub friction: f64,
}

impl TangentialLaw for HaffWerner {
    #[inline]
    fn force(&self, slip: &Slip, history: Vec3) -> (Vec3, Vec3) {
        let speed = slip.velocity.norm();
        if speed == 0.0 {
            return (Vec3::zeros(), history);
        }
        let stop = slip.resisting_mass() * speed / slip.time_step;
        let force = (self.damping * speed)
            .min(self.friction * slip.normal_force)
            .min(stop);
        (slip.velocity * (-force / speed), history)
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
            velocity: Vec3::new(0.0, 0.02, -0.01),
            normal: Vec3::new(1.0, 0.0, 0.0),
            normal_force: 1.0,
            overlap: 1e-8,
            reduced_mass: 1e-8,
            elapsed: time_step,
            time_step,
        };
        for time_step in [1e-9, 1e-6, 1e-3] {
            let slip = slip(time_step);
            let (force, _) = law.force(&slip, Vec3::zeros());
            let after = slip.velocity + force * (time_step / slip.resisting_mass());
            assert!(after.dot(&slip.velocity) >= -1e-18, "{time_step}");
            assert!(force.norm() <= 0.5);
        }
    }
}
