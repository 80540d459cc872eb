//! Flux and pressure drop of a cake and its medium, one behind the other.
//!
//! ```text
//! q = ΔP / (μ (R_m + L/k)),   ΔP = μ q₀ (R_m + L/k),   R_m = ΔP₀ / (μ q₀)
//! ```
//!
//! L and k: thickness of the cake that the run has measured, permeability by Kozeny and Carman from its
//! measured porosity. With R_m the flux begins at q₀, which Darcy's law of the cake alone does not give: that is
//! infinite without a cake. Source: Darcy's law; Alvim (2016), eqs. 1, 2 and 93.

use super::filter::{Drive, Filter};
use super::kozeny_carman::kozeny_carman;
use super::settings::Case;
use super::{Entry, Kind, ReferenceError, Solution};

/// q [m/s] under a pressure drop [Pa] through a viscosity [Pa s] and resistances R_m and L/k [1/m].
pub fn flux(pressure_drop: f64, viscosity: f64, medium: f64, cake: f64) -> f64 {
    pressure_drop / (viscosity * (medium + cake))
}

/// ΔP [Pa] at a flux [m/s].
pub fn pressure_drop(flux: f64, viscosity: f64, medium: f64, cake: f64) -> f64 {
    viscosity * flux * (medium + cake)
}

/// L/k [1/m] as the run ended.
fn cake(case: &Case, filter: &Filter) -> Result<f64, ReferenceError> {
    let permeability = kozeny_carman(filter.porosity(case)?, filter.sauter_diameter());
    Ok(case.measured("thickness")? / permeability)
}

fn final_flux(case: &Case) -> Result<f64, ReferenceError> {
    const NAME: &str = "darcy_flux";
    let filter = Filter::of(NAME, case)?;
    match filter.drive {
        Drive::Pressure(drop) => Ok(flux(
            drop,
            filter.grain.viscosity,
            filter.medium_resistance,
            cake(case, &filter)?,
        )),
        Drive::Flux(_) => Err(ReferenceError(format!("`{NAME}` holds for a constant pressure"))),
    }
}

fn final_pressure_drop(case: &Case) -> Result<f64, ReferenceError> {
    const NAME: &str = "darcy_pressure_drop";
    let filter = Filter::of(NAME, case)?;
    match filter.drive {
        Drive::Flux(flux) => Ok(pressure_drop(
            flux,
            filter.grain.viscosity,
            filter.medium_resistance,
            cake(case, &filter)?,
        )),
        Drive::Pressure(_) => Err(ReferenceError(format!("`{NAME}` holds for a constant flux"))),
    }
}

pub(super) fn flux_solution() -> Solution {
    Solution {
        entry: Entry {
            name: "darcy_flux",
            meaning: "flux at the end through medium and cake in series, from the measured thickness and porosity",
            source: "Darcy's law with the resistances of medium and cake in series; Alvim (2016), eqs. 1, 2 and 93",
        },
        unit: "m/s",
        kind: Kind::Scalar(final_flux),
    }
}

pub(super) fn pressure_solution() -> Solution {
    Solution {
        entry: Entry {
            name: "darcy_pressure_drop",
            meaning: "pressure drop at the end over medium and cake in series, from the measured thickness and porosity",
            source: "Darcy's law with the resistances of medium and cake in series; Alvim (2016), eqs. 1, 2 and 93",
        },
        unit: "Pa",
        kind: Kind::Scalar(final_pressure_drop),
    }
}
