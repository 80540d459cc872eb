//! Permeability of a bed of spheres from its porosity.
//!
//! ```text
//! k = ε³ d² / (180 (1 − ε)²)      α = 1 / (ρ_s (1 − ε) k)
//! ```
//!
//! d: Sauter diameter. Creeping flow through random beds, ε from 0.3 to 0.6. The porosity is the one that the
//! run has measured. Alvim (2016) prints 2.03e-15 m² and 1.175e-13 m² where this says 2.03e-11 and 1.175e-9:
//! 1e-4 of it, as from cm² to m² once too often. Source: Carman (1937), Trans. Inst. Chem. Eng. 15, 150;
//! Alvim (2016), eqs. 5 and 93.

use super::filter::Filter;
use super::settings::Case;
use super::{Entry, Kind, ReferenceError, Solution};

/// What two permeabilities in print are too small by [-].
const SLIP: f64 = 1e-4;

/// k [m²] at a porosity [-] and a Sauter diameter [m].
pub fn kozeny_carman(porosity: f64, diameter: f64) -> f64 {
    porosity.powi(3) * diameter.powi(2) / (180.0 * (1.0 - porosity).powi(2))
}

/// α [m/kg] of a cake of density ρ_s [kg/m³] of its solids.
pub fn specific_resistance(porosity: f64, diameter: f64, density: f64) -> f64 {
    1.0 / (density * (1.0 - porosity) * kozeny_carman(porosity, diameter))
}

fn of_the_run(case: &Case) -> Result<f64, ReferenceError> {
    let filter = Filter::of("kozeny_carman", case)?;
    Ok(kozeny_carman(filter.porosity(case)?, filter.sauter_diameter()))
}

pub(super) fn solution() -> Solution {
    Solution {
        entry: Entry {
            name: "kozeny_carman",
            meaning: "permeability of the cake from its measured porosity",
            source: "Carman (1937), Trans. Inst. Chem. Eng. 15, 150; Alvim (2016), eq. 93",
        },
        unit: "m²",
        kind: Kind::Scalar(of_the_run),
    }
}

pub(super) fn with_unit_slip() -> Solution {
    Solution {
        entry: Entry {
            name: "kozeny_carman_unit_slip",
            meaning: "1e-4 of that permeability, the slip of a unit in two printed values",
            source: "Alvim (2016), sections 4.2.2 and 4.2.3, against its eq. 93",
        },
        unit: "m²",
        kind: Kind::Scalar(|case| Ok(SLIP * of_the_run(case)?)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::library::Library;

    #[test]
    fn the_table_of_permeabilities_comes_back() {
        let table = Library::carried()
            .unwrap()
            .dataset("carman_kozeny_analytic.csv")
            .unwrap();
        let column = |name: &str| table.numbers(name).unwrap();
        let (diameters, porosities) = (column("d_um"), column("porosity"));
        let (known, resistances) = (column("k_constant180_m2"), column("alpha_rho_s_2460_m_kg"));
        assert!(known.len() >= 27);
        for row in 0..known.len() {
            let (porosity, diameter) = (porosities[row], 1e-6 * diameters[row]);
            let k = kozeny_carman(porosity, diameter);
            let alpha = specific_resistance(porosity, diameter, 2460.0);
            assert!((k / known[row] - 1.0).abs() < 1e-5, "{porosity}, {diameter}: {k}");
            assert!((alpha / resistances[row] - 1.0).abs() < 1e-5, "{alpha}");
        }
    }

    #[test]
    fn the_two_printed_values_are_a_ten_thousandth() {
        for (porosity, diameter, printed) in [(0.392, 150e-6, 2.03e-15), (0.553, 500e-6, 1.175e-13)] {
            let share = printed / kozeny_carman(porosity, diameter) / SLIP;
            // Half a unit of the porosity's last digit is 0.6 % of the permeability.
            assert!((share - 1.0).abs() < 6e-3, "{porosity}: {share}");
        }
    }
}
