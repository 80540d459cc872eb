//! Linear spring–dashpot normal contact.
//!
//! ```text
//! F = k δ + γ dδ/dt,     γ = 2 ζ √(m* k),     ζ = −ln e/√(π² + ln² e)
//! ```
//!
//! A free pair followed until δ = 0 rebounds with restitution e at every speed. F can turn
//! attractive just before that instant; it is not clipped at zero: clipping ends the contact
//! early and raises the restitution above e.
//!
//! Source: Cundall & Strack (1979), Géotechnique 29, 47–65; clipping: Schwager & Pöschel (2007),
//! Granular Matter 9, 465–469.

use std::f64::consts::PI;

use super::{Contact, NormalLaw, damping_ratio};
use crate::math::Number;

/// The mass that the dashpot is computed with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EffectiveMass {
    /// m* = m_i m_j/(m_i + m_j).
    Reduced,
    /// (m_i + m_j)/2, as Alvim (2016) used: damps equal grains √2 times too much.
    Arithmetic,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearSpringDashpot {
    /// Stiffness k [N/m].
    pub stiffness: f64,
    /// Damping ratio ζ [-].
    pub damping_ratio: f64,
    pub effective_mass: EffectiveMass,
}

impl LinearSpringDashpot {
    /// The law of stiffness k [N/m] that returns restitution e, 0 < e ≤ 1.
    pub fn with_restitution(stiffness: f64, restitution: f64) -> Self {
        LinearSpringDashpot {
            stiffness,
            damping_ratio: damping_ratio(restitution),
            effective_mass: EffectiveMass::Reduced,
        }
    }

    /// Stiffness [N/m] at which an impact of `speed` [m/s] overlaps by `overlap` [m] at most.
    pub fn stiffness_for_overlap(reduced_mass: f64, speed: f64, overlap: f64) -> f64 {
        reduced_mass * (speed / overlap).powi(2)
    }

    /// Dashpot coefficient γ [N s/m].
    #[inline(always)]
    pub fn damping<N: Number>(&self, contact: &Contact<N>) -> N {
        let mass = match self.effective_mass {
            EffectiveMass::Reduced => contact.reduced_mass,
            EffectiveMass::Arithmetic => contact.mean_mass,
        };
        N::splat(2.0 * self.damping_ratio) * (mass * N::splat(self.stiffness)).sqrt()
    }

    /// Duration of a contact [s]: π/√(k/m* − (γ/2m*)²); not a number when overdamped.
    pub fn duration(&self, contact: &Contact) -> f64 {
        let decay = self.damping(contact) / (2.0 * contact.reduced_mass);
        PI / (self.stiffness / contact.reduced_mass - decay * decay).sqrt()
    }
}

impl NormalLaw for LinearSpringDashpot {
    #[inline(always)]
    fn force<N: Number>(&self, contact: &Contact<N>) -> N {
        N::splat(self.stiffness) * contact.overlap + self.damping(contact) * contact.rate
    }

    fn contact_time(&self, contact: &Contact) -> f64 {
        self.duration(contact)
    }
}

#[cfg(test)]
mod tests {
    use super::super::rebound;
    use super::*;

    const START: Contact = Contact {
        overlap: 0.0,
        rate: 0.01,
        reduced_mass: 1e-9,
        mean_mass: 2e-9,
        reduced_radius: 5e-5,
    };

    #[test]
    fn restitution_is_the_one_asked_for() {
        for e in [0.3, 0.7, 0.95] {
            let law = LinearSpringDashpot::with_restitution(10.0, e);
            let found = rebound(law, &START).0;
            assert!((found / e - 1.0).abs() < 1e-3, "{found} for {e}");
        }
    }

    #[test]
    fn the_arithmetic_mass_damps_equal_grains_too_much() {
        let law = LinearSpringDashpot {
            effective_mass: EffectiveMass::Arithmetic,
            ..LinearSpringDashpot::with_restitution(10.0, 0.3)
        };
        assert!((rebound(law, &START).0 - 0.158).abs() < 1e-3);
    }

    #[test]
    fn overlap_target_is_met_without_damping() {
        let stiffness = LinearSpringDashpot::stiffness_for_overlap(1e-9, 0.01, 3e-7);
        let law = LinearSpringDashpot::with_restitution(stiffness, 1.0);
        let (e, deepest) = rebound(law, &START);
        assert!((deepest / 3e-7 - 1.0).abs() < 1e-4 && (e - 1.0).abs() < 1e-4);
    }
}
