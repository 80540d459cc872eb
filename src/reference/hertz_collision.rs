//! Head-on collision under a Hertz contact with damping.
//!
//! ```text
//! m* d²δ/dt² = −K δ^{3/2} − (B δ^{1/2} + C δ^{1/4}) dδ/dt,   K = 4/3 E* √R*
//! elastic: t_c = 2.868 (m*²/(R* E*² v))^{1/5},   δ_max = (15/16 · m* v²/(E* √R*))^{2/5}
//! ```
//!
//! With damping the equation is integrated in y = δ^{1/4} over a time τ with dt = 4 y³ dτ: there every
//! term is a polynomial, so that the classical Runge–Kutta scheme keeps its order through first touch and
//! separation. Followed until δ = 0; the force is not clipped at zero.
//!
//! Sources: Brilliantov et al. (1996), Phys. Rev. E 53, 5382–5392 (B); Tsuji et al. (1992), Powder
//! Technology 71, 239–250 (C).

/// Steps of τ per unit of y over v.
const STEP: f64 = 1.0 / 2000.0;
/// Steps after which there is no end.
const MOST: usize = 10_000_000;

#[derive(Clone, Copy, Debug)]
pub struct Hertz {
    /// Reduced mass m* [kg].
    pub mass: f64,
    /// Reduced radius R* [m].
    pub radius: f64,
    /// Effective modulus E* [Pa].
    pub modulus: f64,
    pub damping: Damping,
}

#[derive(Clone, Copy, Debug)]
pub enum Damping {
    /// Material time γ_n [s]: B = 2 γ_n E* √R*.
    Viscoelastic(f64),
    /// Ratio γ [-] to a mass m [kg]: C = 2 γ √(2 E* √R* m).
    Tsuji { ratio: f64, mass: f64 },
}

/// How a collision went.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rebound {
    /// e [-]
    pub restitution: f64,
    /// [s]
    pub contact_time: f64,
    /// [m]
    pub overlap: f64,
}

/// y, v and t in the units of the elastic impact.
type State = [f64; 3];

impl Hertz {
    fn stiffness(&self) -> f64 {
        4.0 / 3.0 * self.modulus * self.radius.sqrt()
    }

    /// Contact time [s] without damping.
    pub fn elastic_contact_time(&self, speed: f64) -> f64 {
        let impact = self.mass.powi(2) / (self.radius * self.modulus.powi(2) * speed);
        2.868_265_699_195 * impact.powf(0.2)
    }

    /// Greatest overlap [m] without damping.
    pub fn elastic_overlap(&self, speed: f64) -> f64 {
        let energy = self.mass * speed * speed / (self.modulus * self.radius.sqrt());
        (15.0 / 16.0 * energy).powf(0.4)
    }

    /// The collision at `speed` [m/s]; `None` where the bodies do not part.
    pub fn rebound(&self, speed: f64) -> Option<Rebound> {
        let length = (self.mass * speed * speed / self.stiffness()).powf(0.4);
        let time = length / speed;
        let unit = time / self.mass;
        let (b, c) = match self.damping {
            Damping::Viscoelastic(seconds) => {
                let coefficient = 2.0 * seconds * self.modulus * (self.radius * length).sqrt();
                (coefficient * unit, 0.0)
            }
            Damping::Tsuji { ratio, mass } => {
                let stiffness = 2.0 * self.modulus * (self.radius * length).sqrt();
                (0.0, 2.0 * ratio * (stiffness * mass).sqrt() * unit)
            }
        };
        let slope = |[y, v, _]: State| -> State {
            let force = y.powi(6) + (b * y + c) * y * v;
            let pace = 4.0 * y.powi(3);
            [v, -pace * force, pace]
        };
        let (peak, end) = followed(slope)?;
        Some(Rebound {
            restitution: -end[1],
            contact_time: end[2] * time,
            overlap: peak.powi(4) * length,
        })
    }
}

/// Greatest y, and the state at which y is zero again.
fn followed(slope: impl Fn(State) -> State) -> Option<(f64, State)> {
    let (mut state, mut peak) = ([0.0, 1.0, 0.0], 0.0);
    for _ in 0..MOST {
        let next = advanced(&slope, state, STEP);
        if state[1] > 0.0 && next[1] <= 0.0 {
            peak = crossing(&slope, state, |state| state[1])[0];
        }
        if next[0] <= 0.0 {
            return Some((peak, crossing(&slope, state, |state| state[0])));
        }
        state = next;
    }
    None
}

/// The state within the next step at which a falling quantity is zero.
fn crossing(slope: &impl Fn(State) -> State, state: State, of: impl Fn(State) -> f64) -> State {
    let (mut low, mut high) = (0.0, STEP);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if of(advanced(slope, state, middle)) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    advanced(slope, state, 0.5 * (low + high))
}

/// A step of the classical Runge–Kutta scheme.
fn advanced(slope: &impl Fn(State) -> State, state: State, step: f64) -> State {
    let along = |slopes: State, step: f64| -> State { std::array::from_fn(|i| state[i] + step * slopes[i]) };
    let first = slope(state);
    let second = slope(along(first, 0.5 * step));
    let third = slope(along(second, 0.5 * step));
    let fourth = slope(along(third, step));
    let mean = std::array::from_fn(|i| (first[i] + 2.0 * (second[i] + third[i]) + fourth[i]) / 6.0);
    along(mean, step)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::library::tests::{assert_printed, dataset};

    /// A pair of equal grains of the published three-dimensional cases.
    fn pair(diameter: f64, damping: Damping) -> Hertz {
        Hertz {
            mass: 0.5 * grain_mass(diameter),
            radius: 0.25 * diameter,
            modulus: 1e6 / (2.0 * (1.0 - 0.29 * 0.29)),
            damping,
        }
    }

    fn grain_mass(diameter: f64) -> f64 {
        2460.0 * std::f64::consts::PI / 6.0 * diameter.powi(3)
    }

    #[test]
    fn elastic_impacts_are_the_published_table() {
        let table = dataset("hertz_impact_analytic.csv");
        for row in 0..table.rows() {
            let diameter = 1e-6 * table.number("d_um", row);
            let speed = table.number("v_rel_m_s", row);
            let pair = pair(diameter, Damping::Viscoelastic(0.0));
            let overlap = pair.elastic_overlap(speed);
            assert_printed(
                pair.elastic_contact_time(speed),
                table.text("contact_time_s", row),
            );
            assert_printed(1e6 * overlap, table.text("max_overlap_um", row));
            assert_printed(overlap / diameter, table.text("max_overlap_over_d", row));
            let force = pair.stiffness() * overlap.powf(1.5);
            assert_printed(force, table.text("max_force_N", row));
            let rebound = pair.rebound(speed).unwrap();
            assert!((rebound.restitution - 1.0).abs() < 1e-11, "{rebound:?}");
            assert!((rebound.contact_time / pair.elastic_contact_time(speed) - 1.0).abs() < 1e-10);
            assert!((rebound.overlap / overlap - 1.0).abs() < 1e-10);
        }
    }

    #[test]
    fn damped_restitutions_are_the_published_table() {
        let table = dataset("hertz_damping_variants_analytic.csv");
        let mass = 0.5 * grain_mass(250e-6);
        for row in 0..table.rows() {
            let speed = table.number("v_rel_m_s", row);
            for (damping, column) in [
                (
                    Damping::Viscoelastic(2e-5),
                    "e_viscoelastic_gamma_n_2e-5_s_full_overlap",
                ),
                (
                    Damping::Tsuji { ratio: 2e-5, mass },
                    "e_tsuji_form_reduced_mass_gamma_n_2e-5_full_overlap",
                ),
                (
                    Damping::Tsuji { ratio: 0.3, mass },
                    "e_tsuji_form_reduced_mass_gamma_n_0.3_full_overlap",
                ),
            ] {
                let rebound = pair(250e-6, damping).rebound(speed).unwrap();
                // The table's own integration is good to five digits, as the closed form below shows.
                let printed = table.number(column, row);
                let gap = (rebound.restitution - printed).abs();
                assert!(gap < 6e-6, "{rebound:?} for {printed}");
            }
        }
    }

    #[test]
    fn the_form_of_tsuji_has_the_restitution_of_a_linear_dashpot() {
        let mass = 0.5 * grain_mass(250e-6);
        for ratio in [2e-5, 0.3, 0.8] {
            let share: f64 = ratio / (5.0f64 / 6.0).sqrt();
            let exact = (-std::f64::consts::PI * share / (1.0 - share * share).sqrt()).exp();
            let rebound = pair(250e-6, Damping::Tsuji { ratio, mass })
                .rebound(0.01)
                .unwrap();
            assert!(
                (rebound.restitution / exact - 1.0).abs() < 1e-9,
                "{rebound:?} for {exact}"
            );
        }
    }
}
