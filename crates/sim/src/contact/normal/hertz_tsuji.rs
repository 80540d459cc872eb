//! Hertz contact with one restitution at every speed.
//!
//! ```text
//! F = 4/3 E* √R* δ^1.5 + 2 √(5/6) ζ √(S m*) dδ/dt,   S = 2 E* √(R* δ),   ζ = −ln e/√(π² + ln² e)
//! ```
//!
//! A free pair followed until δ = 0 rebounds with e exactly: in δ^{5/4} the motion is that of a linear
//! spring and dashpot. Sources: Tsuji et al. (1992), Powder Technology 71, 239–250; Antypov & Elliott
//! (2011), EPL 94, 50004.

use super::hertz::{contact_time, elastic_force, stiffness};
use super::{Contact, NormalLaw, damping_ratio};
use crate::math::Number;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HertzTsuji {
    /// E* [Pa].
    pub effective_modulus: f64,
    /// ζ [-].
    pub damping_ratio: f64,
}

impl HertzTsuji {
    /// The law that returns restitution e, 0 < e ≤ 1.
    pub fn with_restitution(effective_modulus: f64, restitution: f64) -> Self {
        HertzTsuji {
            effective_modulus,
            damping_ratio: damping_ratio(restitution),
        }
    }
}

impl NormalLaw for HertzTsuji {
    #[inline(always)]
    fn force<N: Number>(&self, contact: &Contact<N>) -> N {
        let root = (stiffness(self.effective_modulus, contact) * contact.reduced_mass).sqrt();
        let share = 2.0 * f64::sqrt(5.0 / 6.0) * self.damping_ratio;
        elastic_force(self.effective_modulus, contact) + N::splat(share) * root * contact.rate
    }

    fn contact_time(&self, contact: &Contact) -> f64 {
        contact_time(self.effective_modulus, contact)
    }
}

#[cfg(test)]
mod tests {
    use super::super::rebound;
    use super::*;

    #[test]
    fn restitution_is_the_same_at_every_speed() {
        for restitution in [0.3, 0.7, 0.95] {
            let law = HertzTsuji::with_restitution(5e5, restitution);
            for rate in [1e-3, 1e-1] {
                let start = Contact {
                    overlap: 0.0,
                    rate,
                    reduced_mass: 1e-8,
                    mean_mass: 2e-8,
                    reduced_radius: 6e-5,
                };
                let found = rebound(law, &start).0;
                assert!(
                    (found / restitution - 1.0).abs() < 2e-3,
                    "{found} for {restitution}"
                );
            }
        }
    }
}
