//! Full-slip form of the Mindlin contact.
//!
//! ```text
//! F_t = −μ F_n {1 − [1 − min(|ξ|, ξ_max)/ξ_max]^{3/2}} ξ/|ξ|,   ξ_max = μ δ (2 − ν)/(2(1 − ν))
//! ```
//!
//! ξ is the slip added up since the contact began, turned with the contact plane and cut to ξ_max on
//! sliding. Unloading follows the loading curve: no hysteresis below sliding, no dashpot. With the 2
//! in ξ_max the initial stiffness is 8 G* a. Sources: Mindlin & Deresiewicz (1953), J. Appl. Mech. 20,
//! 327–344; Alvim (2016), eqs. 41–42, where the 2 is missing.

use super::{Slip, TangentialLaw};
use crate::math::{Number, Vector};

/// Which slip counts as full.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SlipLimit {
    /// ξ_max = μ δ (2 − ν)/(2(1 − ν)).
    Correct,
    /// ξ_max = μ δ (2 − ν)/(1 − ν), as printed: half the stiffness.
    Literal,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mindlin {
    /// μ [-].
    pub friction: f64,
    /// ν [-].
    pub poisson_ratio: f64,
    pub slip_limit: SlipLimit,
}

impl Mindlin {
    /// ξ_max [m] at an overlap [m].
    #[inline(always)]
    fn full_slip<N: Number>(&self, overlap: N) -> N {
        let share = match self.slip_limit {
            SlipLimit::Correct => 0.5,
            SlipLimit::Literal => 1.0,
        };
        let share = share * self.friction * (2.0 - self.poisson_ratio) / (1.0 - self.poisson_ratio);
        overlap * N::splat(share)
    }
}

impl TangentialLaw for Mindlin {
    #[inline(always)]
    fn force<N: Number>(&self, slip: &Slip<N>, history: Vector<N>) -> (Vector<N>, Vector<N>) {
        let displacement = slip.displaced(history);
        let (length, most) = (displacement.norm(), self.full_slip(slip.overlap));
        let (zero, one) = (N::splat(0.0), N::splat(1.0));
        let per_length = N::select(zero.below(length), one / length, zero);
        // Without overlap there is neither friction nor slip to remember.
        let kept = N::select(zero.below(most), (length / most).min(one), zero);
        let rest = one - kept;
        let force = N::splat(self.friction) * slip.normal_force * (one - rest * rest.sqrt());
        (
            displacement * (zero - force * per_length),
            displacement * (kept * most * per_length),
        )
    }

    /// The stiffness is below that of the normal contact: its limit holds for both.
    fn step_limit(&self, _: f64) -> f64 {
        f64::INFINITY
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn law(slip_limit: SlipLimit) -> Mindlin {
        Mindlin {
            friction: 0.3,
            poisson_ratio: 0.29,
            slip_limit,
        }
    }

    fn slip(overlap: f64, normal_force: f64) -> Slip {
        Slip {
            velocity: Vector::zeros(),
            normal: Vector::new(1.0, 0.0, 0.0),
            normal_force,
            overlap,
            reduced_mass: 1e-8,
            elapsed: 0.0,
            time_step: 1e-6,
        }
    }

    #[test]
    fn the_initial_stiffness_is_eight_shear_moduli_times_the_contact_radius() {
        let (young, ratio, radius, overlap) = (1e6, 0.29, 6e-5_f64, 1e-8_f64);
        let modulus = young / (2.0 * (1.0 - ratio * ratio));
        let shear = young / (2.0 * (1.0 + ratio)) / (2.0 * (2.0 - ratio));
        let hertz = 4.0 / 3.0 * modulus * (radius * overlap * overlap * overlap).sqrt();
        let shift = 1e-14;
        let stiffness = |limit| {
            let history = Vector::new(0.0, shift, 0.0);
            -law(limit).force(&slip(overlap, hertz), history).0.y / shift
        };
        let expected = 8.0 * shear * (radius * overlap).sqrt();
        assert!((stiffness(SlipLimit::Correct) / expected - 1.0).abs() < 1e-4);
        assert!((stiffness(SlipLimit::Literal) / expected - 0.5).abs() < 1e-4);
    }

    #[test]
    fn full_slip_is_coulomb_friction_and_cuts_the_history() {
        let (force, history) = law(SlipLimit::Correct).force(&slip(1e-8, 2.0), Vector::new(0.0, 1.0, 0.0));
        assert!((force.y + 0.6).abs() < 1e-15);
        assert!(history.y < 1e-8);
    }
}
