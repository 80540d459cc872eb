//! Viscous friction capped by Coulomb's.
//!
//! ```text
//! F_t = −min(γ_t |v_t|, μ F_n) t̂
//! ```
//!
//! With published coefficients γ_t Δt/m* is in the hundreds: no explicit step survives the dashpot, and
//! holding it to what stops the slip of one pair within a step leaves grains with several contacts
//! shaking and creeping, as if without friction. So the dashpot is integrated implicitly, in a row with
//! a spring as stiff as the step bears,
//!
//! ```text
//! dξ/dt = v_t + F_t/γ_t,   F_t = −k ξ − c v_t,   |F_t| ≤ μ F_n,   k = κ m*/Δt²
//! ```
//!
//! which is F_t = −γ_t v_t for a slip that lasts longer than γ_t/k, and holds a load below μ F_n up to
//! the slow creep F_t/γ_t. c only damps the spring. The stiffness falls with the step: results agree
//! between steps as far as sticking contacts yield by little. Sources: Haff & Werner (1986), Powder
//! Technology 48, 239–245; Alvim (2016), eqs. 37–38.

use super::{Slip, TangentialLaw};
use crate::math::{Number, Vector};

/// κ = k Δt²/m* of the spring [-]: at twenty steps in a contact about 2/7 of the normal stiffness,
/// and (ω Δt)² is below 0.2 for a grain held by six others.
const STIFFNESS: f64 = 0.01;
/// c Δt/m* of its damping [-], 0.3 of critical for a pair.
const DAMPING: f64 = 0.032;

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
        let (zero, one) = (N::splat(0.0), N::splat(1.0));
        let per_step = N::splat(1.0 / slip.time_step);
        let stiffness = slip.reduced_mass * N::splat(STIFFNESS) * per_step * per_step;
        let viscosity = N::splat(self.damping);
        let damping = viscosity.min(slip.reduced_mass * N::splat(DAMPING) * per_step);
        let dashpot = slip.velocity * damping;
        // Backward Euler: the dashpot in the row may be as strong as it likes.
        let elapsed = N::splat(slip.elapsed);
        let moved = slip.displaced(history) * viscosity - dashpot * elapsed;
        let held = zero.below(viscosity);
        let displacement = moved * N::select(held, one / (viscosity + stiffness * elapsed), zero);
        let trial = displacement * (zero - stiffness) - dashpot;
        let (size, most) = (trial.norm(), N::splat(self.friction) * slip.normal_force);
        let slides = most.below(size);
        let force = Vector::select(slides, trial * (most / size), trial);
        let left = (force + dashpot) * (zero - one / stiffness);
        (force, Vector::select(slides, left, displacement))
    }

    /// None: spring and dashpot are made for the step.
    fn step_limit(&self, _: f64) -> f64 {
        f64::INFINITY
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEP: f64 = 1e-6;
    const MASS: f64 = 1e-8;

    fn slip(speed: f64) -> Slip {
        Slip {
            velocity: Vector::new(0.0, speed, 0.0),
            normal: Vector::new(1.0, 0.0, 0.0),
            normal_force: 1e-6,
            overlap: 1e-8,
            reduced_mass: MASS,
            elapsed: STEP,
            time_step: STEP,
        }
    }

    /// Friction [N] after slipping at a speed [m/s] for long.
    fn steady(damping: f64, speed: f64) -> f64 {
        let law = HaffWerner {
            damping,
            friction: 0.5,
        };
        let mut history = Vector::zeros();
        let mut force = Vector::zeros();
        for _ in 0..200_000 {
            (force, history) = law.force(&slip(speed), history);
        }
        -force.y
    }

    #[test]
    fn steady_slip_is_held_back_by_the_dashpot_up_to_sliding() {
        for damping in [1e-9, 1e-5, 1e-4, 1e-2] {
            let found = steady(damping, 1e-7 / damping);
            assert!((found / 1e-7 - 1.0).abs() < 1e-9, "{damping}: {found}");
        }
        assert!((steady(1e-2, 1.0) / 0.5e-6 - 1.0).abs() < 1e-12);
        assert_eq!(steady(0.0, 1.0), 0.0);
    }

    /// Slip velocity [m/s] of `contacts` in parallel on one mass that resists slip, pulled by a share of
    /// what they bear together, after many steps.
    fn pulled(share: f64, contacts: usize) -> f64 {
        let law = HaffWerner {
            damping: 10.0,
            friction: 0.5,
        };
        let pull = share * 0.5e-6 * contacts as f64;
        let resisting = 2.0 / 7.0 * MASS;
        let mut histories = vec![Vector::zeros(); contacts];
        let mut speed = 0.0;
        for _ in 0..100_000 {
            let mut force = pull;
            for history in &mut histories {
                let (friction, new) = law.force(&slip(speed), *history);
                *history = new;
                force += friction.y;
            }
            speed += force * STEP / resisting;
        }
        speed
    }

    #[test]
    fn a_strong_dashpot_holds_a_load_below_sliding_however_many_share_it() {
        for contacts in [1, 6, 12] {
            let creep = 0.8 * 0.5e-6 / 10.0;
            assert!((pulled(0.8, contacts) / creep - 1.0).abs() < 1e-3, "{contacts}");
            let sliding = pulled(1.1, contacts);
            assert!(sliding > 1e4 * creep, "{contacts}: {sliding}");
        }
    }

    #[test]
    fn a_step_may_stop_the_slip_but_never_reverse_it() {
        let law = HaffWerner {
            damping: 10.0,
            friction: 0.5,
        };
        let slip = Slip {
            normal_force: 1.0,
            ..slip(0.02)
        };
        let (force, _) = law.force(&slip, Vector::zeros());
        let after = slip.velocity + force * (STEP / slip.resisting_mass());
        assert!(after.dot(&slip.velocity) >= 0.0 && force.dot(&slip.velocity) < 0.0);
    }
}
