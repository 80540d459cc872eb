//! What the Hertz laws share: the elastic force and its duration.
//!
//! ```text
//! F = 4/3 E* √R* δ^1.5,   E* = E/(2(1 − ν²)) for two bodies of one material
//! t_c = 2.868 (m*²/(R* E*² v))^{1/5}
//! ```
//!
//! Sources: Alvim (2016), eqs. 30–33; Brilliantov et al. (1996), Phys. Rev. E 53, 5382–5392.

use super::Contact;
use crate::math::Number;

/// 4√π/5 · Γ(2/5)/Γ(9/10) · (15/16)^{2/5}: the duration of an elastic impact in its own units.
const DURATION: f64 = 2.868_265_699_195;

/// Effective modulus E* [Pa] of two bodies of one material: Young's modulus [Pa], Poisson's ratio [-].
pub fn effective_modulus(young_modulus: f64, poisson_ratio: f64) -> f64 {
    young_modulus / (2.0 * (1.0 - poisson_ratio * poisson_ratio))
}

/// Elastic force [N]; none without overlap.
#[inline(always)]
pub(super) fn elastic_force<N: Number>(modulus: f64, contact: &Contact<N>) -> N {
    let overlap = contact.overlap.or_zero();
    N::splat(4.0 / 3.0 * modulus) * (contact.reduced_radius * overlap).sqrt() * overlap
}

/// Stiffness dF/dδ = 2 E* √(R* δ) [N/m] of the elastic force.
#[inline(always)]
pub(super) fn stiffness<N: Number>(modulus: f64, contact: &Contact<N>) -> N {
    N::splat(2.0 * modulus) * (contact.reduced_radius * contact.overlap.or_zero()).sqrt()
}

/// Duration [s] of an elastic impact whose speed is the rate of `contact`.
pub fn contact_time(modulus: f64, contact: &Contact) -> f64 {
    let impact =
        contact.reduced_mass.powi(2) / (contact.reduced_radius * modulus * modulus * contact.rate.abs());
    DURATION * impact.powf(0.2)
}
