//! Hertz contact of viscoelastic spheres: restitution falls with speed.
//!
//! ```text
//! F = 4/3 E* √R* δ^1.5 + 2 γ_n E* √(R* δ) dδ/dt
//! ```
//!
//! γ_n is a material time: the elastic force answers to δ + γ_n dδ/dt, to first order. F can turn
//! attractive shortly before δ = 0 and is not clipped.
//!
//! Sources: Brilliantov et al. (1996), Phys. Rev. E 53, 5382–5392; Yang et al. (2000), Phys. Rev. E
//! 62, 3900–3908; Alvim (2016), eq. 34 with γ_n in seconds as its table 6 gives it.

use super::hertz::{contact_time, elastic_force, stiffness};
use super::{Contact, NormalLaw};
use crate::math::Number;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HertzViscoelastic {
    /// E* [Pa].
    pub effective_modulus: f64,
    /// γ_n [s].
    pub damping_time: f64,
}

impl NormalLaw for HertzViscoelastic {
    #[inline(always)]
    fn force<N: Number>(&self, contact: &Contact<N>) -> N {
        let damping = N::splat(self.damping_time) * stiffness(self.effective_modulus, contact);
        elastic_force(self.effective_modulus, contact) + damping * contact.rate
    }

    fn contact_time(&self, contact: &Contact) -> f64 {
        contact_time(self.effective_modulus, contact)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{effective_modulus, rebound};
    use super::*;

    const START: Contact = Contact {
        overlap: 0.0,
        rate: 0.01,
        reduced_mass: 1.006e-8,
        mean_mass: 2.012e-8,
        reduced_radius: 6.25e-5,
    };

    #[test]
    fn restitution_falls_with_speed_and_is_one_without_damping() {
        let law = HertzViscoelastic {
            effective_modulus: effective_modulus(1e6, 0.29),
            damping_time: 2e-5,
        };
        let restitution = |rate: f64| rebound(law, &Contact { rate, ..START }).0;
        let (slow, middle, fast) = (restitution(1e-3), restitution(1e-2), restitution(1e-1));
        assert!(1.0 > slow && slow > middle && middle > fast && fast > 0.0);
        let elastic = HertzViscoelastic {
            damping_time: 0.0,
            ..law
        };
        assert!((rebound(elastic, &START).0 - 1.0).abs() < 1e-6);
    }

    #[test]
    fn the_contact_time_is_that_of_the_elastic_impact() {
        let law = HertzViscoelastic {
            effective_modulus: effective_modulus(1e6, 0.29),
            damping_time: 0.0,
        };
        let time = law.contact_time(&START);
        let (mut contact, mut t, dt) = (START, 0.0, time / 20_000.0);
        while contact.overlap >= 0.0 {
            contact.rate -= dt * law.force(&contact) / contact.reduced_mass;
            contact.overlap += dt * contact.rate;
            t += dt;
        }
        assert!((t / time - 1.0).abs() < 1e-3, "{t} for {time}");
    }
}
