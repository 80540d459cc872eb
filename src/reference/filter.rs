//! A filtration as its settings have it: grains, cell, feed, and what drives the filtrate.
//!
//! ```text
//! V_p = π d₁ d₂ (d₁ + d₂)/12,   d₃₂ = (d₁ + d₂)/2      diameters from d₁ to d₂ with p ~ 1/d²
//! ΔP = μ q₀ R_m                                        at the start
//! φ_s = j/(q₀ + w(φ_s))                                in the suspension above the cake, j its solids per area and time
//! ```
//!
//! w: superficial slip of equal grains at the porosity 1 − φ_s ([`superficial_slip`]); the laboratory sees them fall
//! at q₀ + w, as no volume is lost, at q₀ + w/ε where the fluid moves at q₀ between the grains. Spread of diameters:
//! Alvim (2016), eq. 91.

use std::f64::consts::PI;

use super::ReferenceError;
use super::drag_law::DragLaw;
use super::first_settling_speed::{Crowding, superficial_slip};
use super::grain::Grain;
use super::settings::Case;

/// What stays constant, with its value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Drive {
    /// ΔP [Pa]
    Pressure(f64),
    /// q₀ [m/s]
    Flux(f64),
}

/// A filtration in SI units.
#[derive(Clone, Debug)]
pub struct Filter {
    /// The smallest grain, the fluid and gravity.
    pub grain: Grain,
    /// d₂ [m].
    pub largest: f64,
    /// Grains fed in the whole run [-].
    number: f64,
    /// Of the medium [m²].
    pub area: f64,
    plane: bool,
    pub drive: Drive,
    /// q₀ [m/s].
    pub first_flux: f64,
    /// R_m [1/m].
    pub medium_resistance: f64,
    /// Grains per second [1/s], where that is given.
    rate: Option<f64>,
    /// Solids fraction φ₀ of the suspension that is drawn in [-], where that is what feeds.
    drawn: Option<f64>,
    law: DragLaw,
    crowding: Crowding,
    /// Whether volume is kept between the grains.
    consistent: bool,
}

impl Filter {
    /// # Errors
    /// Another scene than a filtration, several classes of grains, or settings that lack something.
    pub fn of(name: &str, case: &Case) -> Result<Filter, ReferenceError> {
        case.only(name, "filtration")?;
        let grain = case.grain()?;
        let largest = case.number("grains.largest_diameter").unwrap_or(grain.diameter);
        let plane = case.number("dimensions")? == 2.0;
        let depth = if plane {
            largest
        } else {
            case.number("container.depth")?
        };
        let (drop, first_flux, medium_resistance) = resistance(case, grain.viscosity)?;
        let fluid = case.word("fluid").unwrap_or_default();
        Ok(Filter {
            grain,
            largest,
            number: case.number("grains.number")?,
            area: case.number("container.width")? * depth,
            plane,
            drive: match case.word("filtrate.held") {
                Some("flux") => Drive::Flux(first_flux),
                _ => Drive::Pressure(drop),
            },
            first_flux,
            medium_resistance,
            rate: case.number("feed.rate.rate").ok(),
            drawn: case
                .number("feed.suspension.solids_fraction")
                .ok()
                .filter(|_| case.word("feed.suspension.settling") != Some("on")),
            law: case.law()?,
            crowding: Crowding::of(case)?,
            consistent: case.word(&format!("fluid.{fluid}.flow")) != Some("literal"),
        })
    }

    /// V_p [m³], mean over the grains.
    pub fn grain_volume(&self) -> f64 {
        PI / 12.0 * self.grain.diameter * self.largest * (self.grain.diameter + self.largest)
    }

    /// d₃₂ [m].
    pub fn sauter_diameter(&self) -> f64 {
        0.5 * (self.grain.diameter + self.largest)
    }

    /// N V_p/A [m]: all grains that are fed, molten.
    pub fn solids_per_area(&self) -> f64 {
        self.number * self.grain_volume() / self.area
    }

    /// Ṅ V_p/A [m/s].
    ///
    /// # Errors
    /// Grains that are not fed at a rate.
    pub fn solid_flux(&self, name: &str) -> Result<f64, ReferenceError> {
        let rate = self
            .rate
            .ok_or_else(|| ReferenceError(format!("`{name}` holds for grains fed at a constant rate")))?;
        Ok(rate * self.grain_volume() / self.area)
    }

    /// φ₀ [-].
    ///
    /// # Errors
    /// Grains that do not come with the suspension alone.
    pub fn drawn(&self, name: &str) -> Result<f64, ReferenceError> {
        self.drawn.ok_or_else(|| {
            ReferenceError(format!(
                "`{name}` holds for a suspension drawn in by the filtrate, without settling into the cell"
            ))
        })
    }

    /// φ_s [-] of grains that come at a solid flux [m/s].
    pub fn suspended(&self, solid_flux: f64) -> f64 {
        let mut suspended = 0.0;
        // Falls towards its root by a factor of ten and more each time.
        for _ in 0..50 {
            suspended = solid_flux / self.falling_speed(1.0 - suspended);
        }
        suspended
    }

    /// Speed [m/s] of grains in the laboratory at a porosity [-].
    fn falling_speed(&self, porosity: f64) -> f64 {
        let slip = superficial_slip(&self.grain, self.law, self.crowding, porosity);
        let slip = if self.consistent { slip } else { slip / porosity };
        self.first_flux + slip
    }

    /// ε [-] that the cake's permeability follows from: of areas in two dimensions.
    ///
    /// # Errors
    /// A run without it.
    pub fn porosity(&self, case: &Case) -> Result<f64, ReferenceError> {
        case.measured(if self.plane { "area_porosity" } else { "porosity" })
    }
}

/// ΔP, q₀ and R_m from the two of them that are given.
fn resistance(case: &Case, viscosity: f64) -> Result<(f64, f64, f64), ReferenceError> {
    let given = |name: &str| case.number(&format!("filtrate.{name}"));
    let (drop, flux) = (given("pressure_drop"), given("initial_flux"));
    Ok(match (drop, flux) {
        (Ok(drop), Ok(flux)) => (drop, flux, drop / (viscosity * flux)),
        (Ok(drop), Err(_)) => {
            let medium = given("medium_resistance")?;
            (drop, drop / (viscosity * medium), medium)
        }
        (Err(_), flux) => {
            let (flux, medium) = (flux?, given("medium_resistance")?);
            (viscosity * flux * medium, flux, medium)
        }
    })
}

#[cfg(test)]
pub(super) mod tests {
    use serde_json::{Value, json};

    use super::*;
    use crate::reference::Facts;

    /// 150 µm glass in 10 by 10 diameters, 1250 grains a second.
    pub fn settings(filtrate: Value, feed: Value) -> Value {
        json!({"filtration": {
            "dimensions": 3,
            "grains": {"diameter": 150e-6, "density": 2460.0, "number": 1000},
            "container": {"width": 1.5e-3, "depth": 1.5e-3, "height": 6e-3},
            "drag": "schiller_naumann", "voidage": "di_felice", "gravity": 9.81,
            "fluid": {"uniform": {"density": 1000.0, "viscosity": 1e-3, "flow": "consistent"}},
            "feed": feed, "filtrate": filtrate}})
    }

    pub fn filter(settings: &Value) -> Filter {
        let facts = Facts {
            settings,
            scalars: &|_| None,
        };
        Filter::of("test", &Case::of(&facts).unwrap()).unwrap()
    }

    #[test]
    fn two_of_three_give_the_third() {
        let of = |filtrate: Value| {
            let filter = filter(&settings(filtrate, json!("at_start")));
            (filter.drive, filter.first_flux, filter.medium_resistance)
        };
        let whole = of(json!({"held": "pressure", "pressure_drop": 2000.0, "initial_flux": 0.01}));
        assert_eq!(whole.0, Drive::Pressure(2000.0));
        let medium = 2e8;
        assert!((whole.2 / medium - 1.0).abs() < 1e-12);
        let same = |other: (Drive, f64, f64)| {
            (other.1 / whole.1 - 1.0).abs() < 1e-12 && (other.2 / whole.2 - 1.0).abs() < 1e-12
        };
        let pressure = of(json!({"held": "pressure", "pressure_drop": 2000.0, "medium_resistance": medium}));
        assert!(same(pressure) && pressure.0 == Drive::Pressure(2000.0));
        let flux = of(json!({"held": "flux", "initial_flux": 0.01, "medium_resistance": medium}));
        assert!(same(flux) && flux.0 == Drive::Flux(0.01));
    }

    #[test]
    fn grains_that_fall_faster_lie_farther_apart() {
        let filtrate = json!({"held": "flux", "initial_flux": 0.01, "pressure_drop": 2000.0});
        let mut written = settings(filtrate, json!({"rate": {"rate": 1250.0}}));
        let filter_of = |written: &Value| filter(written);
        let filter = filter_of(&written);
        let flux = filter.solid_flux("test").unwrap();
        let suspended = filter.suspended(flux);
        // The balance holds, and buoyant grains are only drawn.
        assert!((suspended * filter.falling_speed(1.0 - suspended) / flux - 1.0).abs() < 1e-12);
        written["filtration"]["grains"]["density"] = json!(1000.0 + 1e-9);
        let drawn = filter_of(&written).suspended(flux);
        assert!((drawn * 0.01 / flux - 1.0).abs() < 1e-6 && suspended < 0.6 * drawn);
    }

    #[test]
    fn a_spread_of_diameters_has_the_moments_of_its_density() {
        let filtrate = json!({"held": "flux", "initial_flux": 0.01, "pressure_drop": 2000.0});
        let mut written = settings(filtrate, json!("at_start"));
        written["filtration"]["grains"]["largest_diameter"] = json!(300e-6);
        let filter = filter(&written);
        // Midpoint sums over p(d) ~ 1/d².
        let places = (0..10_000).map(|i| 150e-6 + 150e-6 * (f64::from(i) + 0.5) / 1e4);
        let moment = |power: i32| places.clone().map(|d| d.powi(power)).sum::<f64>();
        let volume = PI / 6.0 * moment(1) / moment(-2);
        assert!((filter.grain_volume() / volume - 1.0).abs() < 1e-6);
        assert!((filter.sauter_diameter() * moment(0) / moment(1) - 1.0).abs() < 1e-6);
    }
}
