//! Flux, pressure drop and resistances: what holds at the start, and what a cake makes of it.

use super::model::{CakeLength, Filtrate, Filtration, Held, Resistance};
use crate::coupling::permeability::kozeny_carman;

/// Porosity of a cake before it is known [-].
const LIKELY: f64 = 0.4;

/// ΔP = μ q₀ R_m at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Operation {
    /// ΔP₀ [Pa].
    pub pressure_drop: f64,
    /// q₀ [m/s].
    pub flux: f64,
    /// R_m [1/m].
    pub medium_resistance: f64,
}

impl Filtrate {
    /// The third of pressure drop, flux and resistance from the other two; `None` where fewer or more
    /// are given. The viscosity is that of the filtrate [Pa s].
    pub fn operation(&self, viscosity: f64) -> Option<Operation> {
        let (pressure_drop, flux, medium_resistance) =
            match (self.pressure_drop, self.initial_flux, self.medium_resistance) {
                (Some(pressure), Some(flux), None) => (pressure, flux, pressure / (viscosity * flux)),
                (Some(pressure), None, Some(medium)) => (pressure, pressure / (viscosity * medium), medium),
                (None, Some(flux), Some(medium)) => (viscosity * flux * medium, flux, medium),
                _ => return None,
            };
        Some(Operation {
            pressure_drop,
            flux,
            medium_resistance,
        })
    }

    /// Flux [m/s] and pressure drop [Pa] with a cake of a resistance [1/m].
    pub fn with_cake(&self, operation: &Operation, viscosity: f64, cake: f64) -> (f64, f64) {
        let Operation {
            pressure_drop,
            flux,
            medium_resistance,
        } = *operation;
        let share = 1.0 + cake / medium_resistance;
        match (self.resistance, self.held) {
            (Resistance::Series, Held::Pressure) => (flux / share, pressure_drop),
            (Resistance::Series, Held::Flux) => (flux, pressure_drop * share),
            (Resistance::DarcyCapped, Held::Pressure) => {
                (flux.min(pressure_drop / (viscosity * cake)), pressure_drop)
            }
            (Resistance::DarcyCapped, Held::Flux) => (flux, viscosity * flux * cake),
        }
    }
}

impl Filtration {
    /// What holds before there is a cake; `None` unless two of three inputs are given.
    pub fn operation(&self) -> Option<Operation> {
        self.filtrate.operation(self.viscosity())
    }

    /// μ [Pa s].
    pub fn viscosity(&self) -> f64 {
        self.bed.fluid.medium().viscosity
    }

    /// Cross-section that is filtered through [m²].
    pub fn area(&self) -> f64 {
        self.bed.container.width * self.bed.depth()
    }

    /// Height at which the cell ends [m].
    pub fn top(&self) -> f64 {
        self.bed.floor_top() + self.bed.container.height
    }

    /// Thickness [m] and resistance [1/m] of a cake of all grains at a porosity of 0.4.
    pub fn expected_cake(&self) -> (f64, f64) {
        let thickness = self.bed.solids() / (self.area() * (1.0 - LIKELY));
        if thickness == 0.0 {
            return (0.0, 0.0);
        }
        let length = match self.filtrate.length {
            CakeLength::Thickness => thickness,
            CakeLength::CellHeight => self.bed.container.height,
        };
        let permeability = kozeny_carman(LIKELY, self.bed.sauter_diameter());
        (thickness, length / permeability)
    }
}
