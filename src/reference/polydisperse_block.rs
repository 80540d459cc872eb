//! Settling velocity of a rigid block of grains of several kinds, evenly mixed.
//!
//! ```text
//! Σ_i n_i 3πμ d_i F_i(u) u = ε Σ_i n_i V_i (ρ_i − ρ_f) g
//! ```
//!
//! u: superficial slip, in a closed column the block's velocity. Under Beetstra and Cello's law two sizes of
//! one density give
//!
//! ```text
//! u = (ρ_p − ρ_f) g ⟨d⟩² / (18 μ [f/ε + (Σ − 1)/ε²]),     Σ = x_1/y_1² + x_2/y_2²
//! ```
//!
//! Source: Raso (2014), eq. 4.5, with the buoyant density where ρ_p is printed.

use super::mixture::Mixture;
use super::root::rising_root;

/// Settling velocity in a closed column [m/s]; positive downwards.
pub fn block_velocity(mixture: &Mixture) -> f64 {
    let grains = || mixture.grains.iter().zip(&mixture.fractions);
    let pull: f64 = grains()
        .map(|(grain, fraction)| fraction * (grain.density - grain.fluid_density) * grain.gravity)
        .sum();
    let carried = mixture.porosity() * pull;
    let drag = |slip: f64| -> f64 {
        grains()
            .map(|(grain, fraction)| fraction / grain.volume() * mixture.drag(grain, slip))
            .sum()
    };
    let speed = rising_root(|slip| drag(slip) - carried.abs(), 1e-3).unwrap_or(0.0);
    speed.copysign(carried)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::drag_law::{DragLaw, beetstra};
    use crate::reference::grain::Grain;
    use crate::reference::grain::tests::GLASS;
    use crate::reference::library::tests::dataset;

    fn blocks() -> Vec<(Mixture, f64)> {
        let table = dataset("raso2014_bidisperse_block_analytic.csv");
        let block = |row: usize| {
            let grain = |column| Grain {
                diameter: 1e-6 * table.number(column, row),
                ..GLASS
            };
            let (large, small) = (grain("d1_um"), grain("d2_um"));
            let share = match table.text("composition", row) {
                "equal number" => 0.5,
                _ => small.volume() / (large.volume() + small.volume()),
            };
            let classes = [(large, share), (small, 1.0 - share)];
            let mixture = Mixture::by_number(DragLaw::BeetstraCello, &classes, table.number("porosity", row));
            (mixture, 1e-3 * table.number("v_block_superficial_mm_s", row))
        };
        (0..table.rows()).map(block).collect()
    }

    #[test]
    fn blocks_of_two_sizes_fall_as_tabulated() {
        for (mixture, tabulated) in blocks() {
            let velocity = block_velocity(&mixture);
            assert!(
                (velocity / tabulated - 1.0).abs() < 1e-5,
                "{velocity} and {tabulated}"
            );
        }
    }

    #[test]
    fn blocks_of_two_sizes_meet_the_closed_form() {
        for (mixture, _) in blocks() {
            let (velocity, sauter, porosity) = (
                block_velocity(&mixture),
                mixture.sauter_diameter(),
                mixture.porosity(),
            );
            let mean = Grain {
                diameter: sauter,
                ..GLASS
            };
            let f = beetstra(mean.reynolds(velocity), porosity);
            let sum: f64 = mixture
                .grains
                .iter()
                .zip(&mixture.fractions)
                .map(|(grain, fraction)| fraction / (1.0 - porosity) * (sauter / grain.diameter).powi(2))
                .sum();
            let resistance = f / porosity + (sum - 1.0) / porosity.powi(2);
            let closed = 1500.0 * 9.81 * sauter * sauter / (18.0 * 8.9e-4 * resistance);
            assert!((velocity / closed - 1.0).abs() < 1e-12, "{velocity} and {closed}");
        }
    }
}
