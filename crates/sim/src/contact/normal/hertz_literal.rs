//! Hertz contact with the damping of Alvim (2016), eq. 34, as printed.
//!
//! ```text
//! F = 4/3 E* √R* δ^1.5 + 2 γ_n √(S m) dδ/dt,   S = 2 E* √(R* δ),   m = (m_i + m_j)/2
//! ```
//!
//! As printed, γ_n is a pure number and m the arithmetic mean of the masses. With the published value
//! 2·10⁻⁵ the contact is practically undamped; kept to show that. The root covers R* and δ together,
//! without which the units do not work out.

use super::hertz::{contact_time, elastic_force, stiffness};
use super::{Contact, NormalLaw};
use crate::math::Number;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HertzLiteral {
    /// E* [Pa].
    pub effective_modulus: f64,
    /// γ_n [-].
    pub damping: f64,
}

impl NormalLaw for HertzLiteral {
    #[inline(always)]
    fn force<N: Number>(&self, contact: &Contact<N>) -> N {
        let root = (stiffness(self.effective_modulus, contact) * contact.mean_mass).sqrt();
        elastic_force(self.effective_modulus, contact) + N::splat(2.0 * self.damping) * root * contact.rate
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
    fn the_printed_damping_hardly_damps() {
        let start = Contact {
            overlap: 0.0,
            rate: 0.01,
            reduced_mass: 1e-8,
            mean_mass: 2e-8,
            reduced_radius: 6e-5,
        };
        let restitution = |damping| {
            let law = HertzLiteral {
                effective_modulus: 5e5,
                damping,
            };
            rebound(law, &start).0
        };
        assert!((restitution(2e-5) - 0.9999).abs() < 5e-5);
        assert!((restitution(0.3) - 0.192).abs() < 1e-3);
    }
}
