//! Head-on collision under a linear spring and dashpot.
//!
//! ```text
//! m* d²δ/dt² + γ dδ/dt + k δ = 0,   δ(0) = 0,   dδ/dt(0) = v
//! β = γ/(2 m*),   ω = √(k/m* − β²),   t_c = π/ω,   e = exp(−β t_c)
//! δ_max = (v/ω) sin φ exp(−β φ/ω),   φ = atan(ω/β)
//! ```
//!
//! Assumes an underdamped contact that lasts until δ = 0, its force not clipped at zero.
//! Source: Luding (1998), in Physics of Dry Granular Media.

use std::f64::consts::PI;

#[derive(Clone, Copy, Debug)]
pub struct SpringDashpot {
    /// Reduced mass m* [kg].
    pub mass: f64,
    /// Stiffness k [N/m].
    pub stiffness: f64,
    /// Dashpot coefficient γ [N s/m].
    pub damping: f64,
}

impl SpringDashpot {
    /// Dashpot coefficient γ [N s/m] that returns restitution e [-] for a mass m* [kg].
    pub fn damping(mass: f64, stiffness: f64, restitution: f64) -> f64 {
        let ratio = restitution.ln() / PI;
        2.0 * (mass * stiffness).sqrt() * ratio.abs() / (1.0 + ratio * ratio).sqrt()
    }

    fn decay(&self) -> f64 {
        self.damping / (2.0 * self.mass)
    }

    /// Angular frequency ω [rad/s].
    pub fn frequency(&self) -> f64 {
        (self.stiffness / self.mass - self.decay().powi(2)).sqrt()
    }

    /// Contact time t_c [s].
    pub fn contact_time(&self) -> f64 {
        PI / self.frequency()
    }

    /// Coefficient of restitution e [-].
    pub fn restitution(&self) -> f64 {
        (-self.decay() * self.contact_time()).exp()
    }

    /// Greatest overlap [m] after an impact at `speed` [m/s].
    pub fn overlap(&self, speed: f64) -> f64 {
        let phase = self.frequency().atan2(self.decay());
        speed / self.frequency() * phase.sin() * (-self.decay() * phase / self.frequency()).exp()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::library::tests::{assert_printed, dataset};

    #[test]
    fn collisions_are_the_published_table() {
        let table = dataset("lsd_contact_analytic.csv");
        for row in 0..table.rows() {
            let e = table.number("restitution_e", row);
            let (mass, stiffness) = (2e-9_f64, 18.0);
            let natural = (stiffness / mass).sqrt();
            let pair = SpringDashpot {
                mass,
                stiffness,
                damping: SpringDashpot::damping(mass, stiffness, e),
            };
            assert!((pair.restitution() - e).abs() < 1e-14);
            let speed = 0.3;
            let ratio = pair.damping / (2.0 * (mass * stiffness).sqrt());
            for (value, column) in [
                (ratio, "damping_ratio_zeta"),
                (pair.frequency() / natural, "omega_over_omega0"),
                (
                    pair.overlap(speed) * natural / speed,
                    "max_overlap_times_omega0_over_v0",
                ),
                (pair.contact_time() * natural, "contact_time_times_omega0"),
            ] {
                if value.abs() > 1e-12 {
                    assert_printed(value, table.text(column, row));
                }
            }
        }
    }
}
