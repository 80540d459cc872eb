//! Tangential spring and dashpot capped by Coulomb's friction.
//!
//! ```text
//! F_t = −k_t ξ − c_t v_t,   |F_t| ≤ μ F_n
//! ```
//!
//! ξ is the slip added up since the contact began, turned with the contact plane. On sliding it is
//! reset to what the force carries, so that a reversal finds no slack. Sources: Cundall & Strack
//! (1979), Géotechnique 29, 47–65; Luding (2008), Granular Matter 10, 235–246 for the reset.

use std::f64::consts::PI;

use super::{Slip, TangentialLaw};
use crate::math::{Number, Vector};

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CundallStrack {
    /// k_t [N/m].
    pub stiffness: f64,
    /// c_t [N s/m].
    pub damping: f64,
    /// μ [-].
    pub friction: f64,
}

impl TangentialLaw for CundallStrack {
    #[inline(always)]
    fn force<N: Number>(&self, slip: &Slip<N>, history: Vector<N>) -> (Vector<N>, Vector<N>) {
        let displacement = slip.displaced(history);
        let dashpot = slip.velocity * N::splat(self.damping);
        let trial = displacement * N::splat(-self.stiffness) - dashpot;
        let (size, most) = (trial.norm(), N::splat(self.friction) * slip.normal_force);
        let slides = most.below(size);
        let force = Vector::select(slides, trial * (most / size), trial);
        let left = (force + dashpot) * N::splat(-1.0 / self.stiffness);
        (force, Vector::select(slides, left, displacement))
    }

    fn step_limit(&self, resisting_mass: f64) -> f64 {
        let period = PI * (resisting_mass / self.stiffness).sqrt();
        (period / 10.0).min(resisting_mass / self.damping)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAW: CundallStrack = CundallStrack {
        stiffness: 100.0,
        damping: 0.0,
        friction: 0.5,
    };

    fn slip(speed: f64) -> Slip {
        Slip {
            velocity: Vector::new(0.0, speed, 0.0),
            normal: Vector::new(1.0, 0.0, 0.0),
            normal_force: 1.0,
            overlap: 1e-6,
            reduced_mass: 1e-6,
            elapsed: 1e-3,
            time_step: 1e-3,
        }
    }

    #[test]
    fn a_reversal_after_long_sliding_unloads_at_once() {
        let mut history = Vector::zeros();
        for _ in 0..1000 {
            history = LAW.force(&slip(1.0), history).1;
        }
        let (sliding, history) = LAW.force(&slip(1.0), history);
        assert!((sliding.y + 0.5).abs() < 1e-12);
        let (back, _) = LAW.force(&slip(-0.001), history);
        assert!(back.y > sliding.y && back.y < 0.0);
    }

    #[test]
    fn the_spring_turns_with_the_contact_plane_at_its_length() {
        let mut turned = slip(0.0);
        turned.normal = Vector::new(0.6, 0.8, 0.0);
        let (force, history) = LAW.force(&turned, Vector::new(0.0, 1e-4, 0.0));
        assert!(force.dot(&turned.normal).abs() < 1e-18);
        assert!((history.norm() / 1e-4 - 1.0).abs() < 1e-12);
    }
}
