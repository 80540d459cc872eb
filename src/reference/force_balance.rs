//! Settling velocity of grains at a constant porosity.
//!
//! ```text
//! f(Re) Re ε^−ξ = (Ar/18) ε
//! ```
//!
//! Drag carries what the pressure gradient of the mixture leaves of the buoyant weight: ε of it.
//! With Dallavalle and Di Felice this is
//!
//! ```text
//! 0.3969 Re² + 6.048 Re^1.5 + 23.04 Re − (4/3) Ar ε^(1+ξ) = 0
//! ```
//!
//! The root is the superficial slip, which in a closed column is the settling velocity itself.
//! Uniform suspension of equal spheres; at ε = 1 it is the isolated grain.
//! A rigid block of several classes of grains is in `polydisperse_block.rs`.
//! Source: Raso (2014), eq. 4.4, with 0.63² = 0.3969 where 0.392 is printed.

use super::drag_law::DragLaw;
use super::grain::Grain;
use super::mixture::Mixture;
use super::polydisperse_block::block_velocity;
use super::root::rising_root;
use super::{Entry, Kind, Solution};

pub struct ForceBalance {
    pub grain: Grain,
    pub law: DragLaw,
    /// ε [-]
    pub porosity: f64,
}

impl ForceBalance {
    /// Superficial slip, also the settling velocity in a closed column [m/s], positive downwards.
    pub fn settling_velocity(&self) -> f64 {
        let balance = self.grain.archimedes() / 18.0 * self.porosity;
        let residual = |re| self.law.hindered_force(re, self.porosity) - balance;
        self.grain
            .settling_velocity(rising_root(residual, balance).unwrap_or(0.0))
    }

    /// Velocity of the grains relative to the fluid between them [m/s].
    pub fn interstitial_slip(&self) -> f64 {
        self.settling_velocity() / self.porosity
    }

    /// Drag on one grain, pressure-gradient force apart [N].
    pub fn drag(&self) -> f64 {
        self.porosity * self.grain.buoyant_weight()
    }
}

pub(super) fn solution() -> Solution {
    Solution {
        entry: Entry {
            name: "force_balance",
            meaning: "settling velocity at the scene's porosity (1 for a lone sphere) under its drag law; of a rigid block also for several classes of grains",
            source: "Raso (2014), eq. 4.4, with 0.3969 = 0.63² for the printed 0.392",
        },
        unit: "m/s",
        kind: Kind::Scalar(|case| {
            let porosity = match case.kind {
                "single_sphere" => 1.0,
                _ => case.number("porosity")?,
            };
            if case.kind == "constant_porosity_block" && case.classes()?.len() > 1 {
                let mixture = Mixture::by_number(case.law()?, &case.classes()?, porosity);
                return Ok(block_velocity(&mixture));
            }
            let balance = ForceBalance {
                grain: case.grain()?,
                law: case.law()?,
                porosity,
            };
            Ok(balance.settling_velocity())
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::grain::tests::GLASS;
    use crate::reference::library::tests::{assert_printed, dataset};
    use crate::reference::terminal_velocity::terminal_velocity;

    fn balance(density: f64, porosity: f64) -> ForceBalance {
        ForceBalance {
            grain: Grain { density, ..GLASS },
            law: DragLaw::DiFelice,
            porosity,
        }
    }

    #[test]
    fn velocities_are_the_published_table() {
        let table = dataset("raso2014_settling_reference_analytic.csv");
        for row in 0..table.rows() {
            let balance = balance(table.number("rho_p_kg_m3", row), table.number("porosity", row));
            let printed = |column| table.text(column, row);
            assert_printed(
                1e3 * balance.settling_velocity(),
                printed("v_settling_difelice_dallavalle_mm_s"),
            );
            assert_printed(
                1e3 * balance.interstitial_slip(),
                printed("slip_interstitial_difelice_mm_s"),
            );
            assert_printed(balance.drag(), printed("drag_per_particle_N"));
        }
    }

    #[test]
    fn block_velocities_are_those_of_table_5_4() {
        let table = dataset("raso2014_table5_4_block_porosity.csv");
        for row in 0..table.rows() {
            let balance = balance(2500.0, table.number("actual_porosity", row));
            assert_printed(
                1e3 * balance.settling_velocity(),
                table.text("v_eq4_4_superficial_mm_s", row),
            );
        }
    }

    #[test]
    fn the_printed_block_velocity_is_met() {
        // Raso (2014) §5.2.1: 4.924 mm/s at a porosity of 0.9005.
        assert!((1e3 * balance(2500.0, 0.9005).settling_velocity() - 4.924).abs() < 5e-4);
    }

    #[test]
    fn approaches_the_isolated_grain_and_falls_with_crowding() {
        let alone = terminal_velocity(&GLASS, DragLaw::DiFelice);
        assert!((balance(2500.0, 1.0).settling_velocity() / alone - 1.0).abs() < 1e-12);
        let near = balance(2500.0, 1.0 - 1e-9).settling_velocity();
        assert!((near / alone - 1.0).abs() < 1e-8);
        let speeds = [0.99, 0.9, 0.8, 0.5, 0.3].map(|porosity| balance(2500.0, porosity).settling_velocity());
        assert!(speeds.windows(2).all(|pair| pair[1] < pair[0]));
    }

    #[test]
    fn without_a_voidage_function_stokes_velocity_scales_with_porosity() {
        let stokes = |porosity| {
            ForceBalance {
                grain: GLASS,
                law: DragLaw::Stokes,
                porosity,
            }
            .settling_velocity()
        };
        assert!((stokes(0.8) / stokes(1.0) - 0.8).abs() < 1e-12);
    }
}
