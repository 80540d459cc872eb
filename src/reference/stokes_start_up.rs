//! A sphere released from rest under Stokes drag.
//!
//! ```text
//! v(t) = (ρ_p − ρ_f) V g / b · (1 − exp(−t/t_d)),     b = 3πμ d,     t_d = (m + m_a)/b
//! ```
//!
//! Fluid at rest and unbounded, no history force. m_a: ½ρ_f V where the scene asks for added mass, else zero.
//! Source: Raso (2014), eq. 4.1.

use super::drag_law::DragLaw;
use super::grain::Grain;
use super::{Entry, Kind, ReferenceError, Solution};

pub struct StokesStartUp {
    pub grain: Grain,
    /// m_a [kg].
    pub added_mass: f64,
}

impl StokesStartUp {
    /// [m/s], positive downwards.
    pub fn terminal_velocity(&self) -> f64 {
        self.grain.buoyant_weight() / self.grain.stokes_drag(1.0)
    }

    /// t_d [s].
    pub fn relaxation_time(&self) -> f64 {
        (self.grain.mass() + self.added_mass) / self.grain.stokes_drag(1.0)
    }

    /// Settling velocity at time t ≥ 0 [m/s].
    pub fn velocity(&self, time: f64) -> f64 {
        // exp_m1 keeps the digits of the first instants.
        -self.terminal_velocity() * (-time / self.relaxation_time()).exp_m1()
    }
}

pub(super) fn solution() -> Solution {
    Solution {
        entry: Entry {
            name: "stokes_start_up",
            meaning: "velocity over time of a grain released from rest under Stokes drag",
            source: "Raso (2014), eq. 4.1",
        },
        unit: "m/s",
        kind: Kind::Series(|case, times| {
            let alone = case.kind == "sedimentation" && case.number("grains.number").is_ok_and(|n| n == 1.0);
            if !alone {
                case.only("stokes_start_up", "single_sphere")?;
            }
            if case.law()? != DragLaw::Stokes {
                let law = case.word("drag").unwrap_or_default();
                return Err(ReferenceError(format!(
                    "`stokes_start_up` holds for `drag: stokes`, not for `drag: {law}`; compare with `terminal_velocity`"
                )));
            }
            let grain = case.grain()?;
            let added_mass = match case.word("added_mass") {
                Some("on") => 0.5 * grain.fluid_density * grain.volume(),
                _ => 0.0,
            };
            let start_up = StokesStartUp { grain, added_mass };
            Ok(times.iter().map(|&time| start_up.velocity(time)).collect())
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::grain::tests::GLASS;
    use crate::reference::library::tests::{assert_printed, dataset};

    const ALONE: StokesStartUp = StokesStartUp {
        grain: GLASS,
        added_mass: 0.0,
    };

    #[test]
    fn relaxation_times_are_the_published_table() {
        let table = dataset("terminal_velocity_analytic.csv");
        for row in 0..table.rows() {
            let grain = Grain {
                diameter: 1e-6 * table.number("d_um", row),
                density: table.number("rho_p_kg_m3", row),
                fluid_density: table.number("rho_f_kg_m3", row),
                viscosity: table.number("mu_Pa_s", row),
                gravity: 9.81,
            };
            let start_up = StokesStartUp {
                grain,
                added_mass: 0.0,
            };
            assert_printed(
                start_up.relaxation_time(),
                table.text("stokes_relaxation_time_s", row),
            );
            assert_printed(
                1e3 * start_up.terminal_velocity(),
                table.text("v_stokes_mm_s", row),
            );
        }
    }

    #[test]
    fn obeys_the_equation_of_motion() {
        let start_up = ALONE;
        let step = 1e-7;
        for time in [1e-4, 1e-3, 5e-3] {
            let acceleration =
                (start_up.velocity(time + step) - start_up.velocity(time - step)) / (2.0 * step);
            let force = GLASS.buoyant_weight() - GLASS.stokes_drag(start_up.velocity(time));
            assert!((GLASS.mass() * acceleration - force).abs() < 1e-7 * GLASS.buoyant_weight());
        }
    }

    #[test]
    fn starts_with_the_reduced_gravity() {
        let start_up = ALONE;
        let time = 1e-9;
        let gravity = GLASS.gravity * (1.0 - GLASS.fluid_density / GLASS.density);
        assert!((start_up.velocity(time) / time / gravity - 1.0).abs() < 1e-6);
    }

    #[test]
    fn added_mass_slows_the_start_and_leaves_the_end() {
        let carrying = StokesStartUp {
            grain: GLASS,
            added_mass: 0.5 * GLASS.fluid_density * GLASS.volume(),
        };
        assert_eq!(carrying.terminal_velocity(), ALONE.terminal_velocity());
        let time = 1e-9;
        // A sphere in a fluid of its own density times s starts with (1 − s)/(1 + s/2) g.
        let ratio = GLASS.fluid_density / GLASS.density;
        let gravity = GLASS.gravity * (1.0 - ratio) / (1.0 + 0.5 * ratio);
        assert!((carrying.velocity(time) / time / gravity - 1.0).abs() < 1e-6);
    }
}
