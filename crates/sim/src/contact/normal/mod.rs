//! Normal contact laws: from overlap and approach to a repulsive force.

mod hertz;
mod hertz_literal;
mod hertz_tsuji;
mod hertz_viscoelastic;
mod linear_spring_dashpot;

pub use hertz::{contact_time, effective_modulus};
pub use hertz_literal::HertzLiteral;
pub use hertz_tsuji::HertzTsuji;
pub use hertz_viscoelastic::HertzViscoelastic;
pub use linear_spring_dashpot::{EffectiveMass, LinearSpringDashpot};

use crate::math::Number;

/// What a normal law sees of two touching bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact<N = f64> {
    /// Overlap δ [m]; below zero only within the step in which a contact ends.
    pub overlap: N,
    /// dδ/dt [m/s], positive while the bodies approach.
    pub rate: N,
    /// m* = m_i m_j/(m_i + m_j) [kg]; the grain's own mass at a wall.
    pub reduced_mass: N,
    /// (m_i + m_j)/2 [kg]; the grain's own mass at a wall. A published form takes it for m*.
    pub mean_mass: N,
    /// R* = R_i R_j/(R_i + R_j) [m]; the grain's own radius at a wall.
    pub reduced_radius: N,
}

/// A normal contact law. No force is clipped at zero: the end of a contact is the end of its overlap.
pub trait NormalLaw: Copy {
    /// Repulsive force [N].
    fn force<N: Number>(&self, contact: &Contact<N>) -> N;

    /// Duration [s] of a contact that begins as `contact` says (its rate the impact speed), damping
    /// left out where it has no closed form. Not finite where the contact never ends.
    fn contact_time(&self, contact: &Contact) -> f64;
}

/// ζ = −ln e/√(π² + ln² e) [-]: the share of critical damping that returns restitution e, 0 < e ≤ 1.
pub fn damping_ratio(restitution: f64) -> f64 {
    let ln_e = restitution.ln();
    -ln_e / (std::f64::consts::PI.powi(2) + ln_e * ln_e).sqrt()
}

/// Follows a head-on contact with tiny steps; gives back e and the greatest overlap.
#[cfg(test)]
fn rebound<N: NormalLaw>(law: N, start: &Contact) -> (f64, f64) {
    let dt = law.contact_time(start) / 20_000.0;
    let (mut contact, mut deepest) = (*start, 0.0_f64);
    loop {
        let middle = contact.rate - 0.5 * dt * law.force(&contact) / contact.reduced_mass;
        let overlap = contact.overlap + dt * middle;
        let halfway = Contact {
            overlap: 0.5 * (contact.overlap + overlap),
            rate: middle,
            ..contact
        };
        contact.rate -= dt * law.force(&halfway) / contact.reduced_mass;
        contact.overlap = overlap;
        deepest = deepest.max(overlap);
        if overlap <= 0.0 {
            return (-contact.rate / start.rate, deepest);
        }
    }
}
