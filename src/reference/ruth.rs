//! Filtration of a suspension: time over volume against volume is a straight line.
//!
//! ```text
//! t/V = (μ α c / (2 ΔP)) V + μ R_m / ΔP                  at constant pressure
//! ΔP = μ q₀ (R_m + α c q₀ t)                             at constant flux
//! c = ρ_s (1 − ε) φ₀ / (1 − ε − φ_s)      φ_s = φ₀ q₀ / (q₀ + w)      α = 1 / (ρ_s (1 − ε) k)
//! ```
//!
//! V: filtrate volume per area; t and V count from the first deposit on. φ₀: solids fraction of the suspension
//! that is drawn in; φ_s: that above the cake, less as the grains settle at w besides. With w = 0 this is Ruth's c
//! of an incompressible cake. ε: porosity that the run has measured. φ_s is that of the first flux: it changes
//! little as long as w is small beside q or φ₀ is small. Source: Ruth (1935), Ind. Eng. Chem. 27, 708; Alvim (2016),
//! eq. 6.

use super::filter::{Drive, Filter};
use super::kozeny_carman::specific_resistance;
use super::settings::Case;
use super::{Entry, Kind, ReferenceError, Solution};

const THICKNESS: &str = "ruth_thickness";
const GROWTH: &str = "ruth_growth";
const LINE: &str = "ruth_line";
const SLOPE: &str = "ruth_slope";
const INTERCEPT: &str = "ruth_intercept";
const SOURCE: &str = "Ruth (1935), Ind. Eng. Chem. 27, 708, with settling; Alvim (2016), eq. 6";

/// c [kg/m³]: dry solids of the cake per volume of filtrate, from ρ_s [kg/m³], ε, φ₀ and φ_s [-].
pub fn solids_per_filtrate(density: f64, porosity: f64, drawn: f64, suspended: f64) -> f64 {
    density * (1.0 - porosity) * drawn / (1.0 - porosity - suspended)
}

/// V [m] at a time [s] under ΔP/μ [1/s], with R_m [1/m] and αc [1/m²].
pub fn volume(time: f64, drive: f64, medium: f64, cake: f64) -> f64 {
    // αc/2 V² + R_m V = t ΔP/μ, in the form that keeps its digits without a cake.
    2.0 * drive * time / (medium + (medium * medium + 2.0 * cake * drive * time).sqrt())
}

/// A filtration with the porosity of its own cake.
struct Cake {
    /// αc [1/m²]
    resistance: f64,
    /// R_m [1/m]
    medium: f64,
    /// ΔP/μ [1/s]
    drive: f64,
    /// Thickness per filtrate, c/(ρ_s (1 − ε)) [-].
    thickness: f64,
}

impl Cake {
    fn of(name: &str, case: &Case) -> Result<Cake, ReferenceError> {
        let filter = Filter::of(name, case)?;
        let drawn = filter.drawn(name)?;
        let Drive::Pressure(drop) = filter.drive else {
            return Err(ReferenceError(format!("`{name}` holds for a constant pressure")));
        };
        let (porosity, density) = (filter.porosity(case)?, filter.grain.density);
        let suspended = filter.suspended(drawn * filter.first_flux);
        let solids = solids_per_filtrate(density, porosity, drawn, suspended);
        Ok(Cake {
            resistance: specific_resistance(porosity, filter.sauter_diameter(), density) * solids,
            medium: filter.medium_resistance,
            drive: drop / filter.grain.viscosity,
            thickness: solids / density / (1.0 - porosity),
        })
    }

    /// [s/m²]
    fn slope(&self) -> f64 {
        self.resistance / (2.0 * self.drive)
    }

    /// [s/m]
    fn intercept(&self) -> f64 {
        self.medium / self.drive
    }
}

fn slope(case: &Case) -> Result<f64, ReferenceError> {
    Ok(Cake::of(SLOPE, case)?.slope())
}

fn intercept(case: &Case) -> Result<f64, ReferenceError> {
    Ok(Cake::of(INTERCEPT, case)?.intercept())
}

fn growth(case: &Case) -> Result<f64, ReferenceError> {
    Ok(Cake::of(GROWTH, case)?.thickness)
}

pub(super) fn growth_solution() -> Solution {
    Solution {
        entry: Entry {
            name: GROWTH,
            meaning: "thickness of the cake per filtrate volume and area, from its measured porosity",
            source: SOURCE,
        },
        unit: "1",
        kind: Kind::Scalar(growth),
    }
}

/// t/V [s/m] at volumes V [m].
fn line(case: &Case, volumes: &[f64]) -> Result<Vec<f64>, ReferenceError> {
    let cake = Cake::of(LINE, case)?;
    Ok(volumes
        .iter()
        .map(|volume| cake.intercept() + cake.slope() * volume)
        .collect())
}

/// L [m] at times [s], nothing before the first deposit.
fn thickness(case: &Case, times: &[f64]) -> Result<Vec<f64>, ReferenceError> {
    let cake = Cake::of(THICKNESS, case)?;
    let first = case.measured("first_deposit_time")?;
    let at = |time: &f64| {
        let since = (time - first).max(0.0);
        cake.thickness * volume(since, cake.drive, cake.medium, cake.resistance)
    };
    Ok(times.iter().map(at).collect())
}

pub(super) fn thickness_solution() -> Solution {
    Solution {
        entry: Entry {
            name: THICKNESS,
            meaning: "thickness over time of the cake of a suspension at constant pressure, from its measured porosity",
            source: SOURCE,
        },
        unit: "m",
        kind: Kind::Series(thickness),
    }
}

pub(super) fn line_solution() -> Solution {
    Solution {
        entry: Entry {
            name: LINE,
            meaning: "t/V over V at constant pressure, from the measured porosity of the cake",
            source: SOURCE,
        },
        unit: "s/m",
        kind: Kind::Series(line),
    }
}

pub(super) fn slope_solution() -> Solution {
    Solution {
        entry: Entry {
            name: SLOPE,
            meaning: "slope of t/V over V at constant pressure, from the measured porosity of the cake",
            source: SOURCE,
        },
        unit: "s/m²",
        kind: Kind::Scalar(slope),
    }
}

pub(super) fn intercept_solution() -> Solution {
    Solution {
        entry: Entry {
            name: INTERCEPT,
            meaning: "t/V at V = 0 at constant pressure: that of the medium alone",
            source: SOURCE,
        },
        unit: "s/m",
        kind: Kind::Scalar(intercept),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use crate::reference::filter::tests::settings;
    use crate::reference::kozeny_carman::kozeny_carman;
    use crate::reference::library::Library;
    use crate::reference::{Facts, cake_growth, darcy_in_series, scalar, series};

    const POROSITY: f64 = 0.39;
    const DIAMETER: f64 = 150e-6;
    const VISCOSITY: f64 = 1e-3;
    const DENSITY: f64 = 2460.0;
    const FIRST_FLUX: f64 = 0.01;
    const DRAWN: f64 = 0.0654;

    #[test]
    fn the_table_of_closed_forms_comes_back() {
        let library = Library::carried().unwrap();
        let table = library
            .dataset("cake_filtration_closed_forms_analytic.csv")
            .unwrap();
        let column = |name: &str| table.numbers(name).unwrap();
        let (drops, times) = (column("dP_Pa"), column("time_s"));
        let k = kozeny_carman(POROSITY, DIAMETER);
        let cake = solids_per_filtrate(DENSITY, POROSITY, DRAWN, DRAWN)
            * specific_resistance(POROSITY, DIAMETER, DENSITY);
        let fed = 1250.0 * std::f64::consts::PI / 6.0 * DIAMETER.powi(3) / 1.5e-3f64.powi(2);
        let near = |name: &str, row: usize, found: f64| {
            let known = column(name)[row];
            let same = (found - known).abs() <= 2e-5 * known.abs().max(1e-3);
            assert!(same, "{name}, row {row}: {found}, not {known}");
        };
        for row in 0..table.len() {
            let (drop, time) = (drops[row], times[row]);
            let medium = drop / (VISCOSITY * FIRST_FLUX);
            let grown = time * cake_growth::front_speed(fed, POROSITY, 0.0);
            near("L_prescribed_feed_1250_per_s_mm", row, 1e3 * grown);
            let flux = darcy_in_series::flux(drop, VISCOSITY, medium, grown / k);
            near("q_prescribed_feed_mm_s", row, 1e3 * flux);
            let held = darcy_in_series::pressure_drop(FIRST_FLUX, VISCOSITY, medium, grown / k);
            near("dP_constant_rate_q0_0.01_prescribed_feed_Pa", row, held);
            let volume = volume(time, drop / VISCOSITY, medium, cake);
            near("V_per_area_ruth_mm", row, 1e3 * volume);
            near(
                "q_ruth_mm_s_phi0_0.0654",
                row,
                1e3 * drop / VISCOSITY / (medium + cake * volume),
            );
            let solids = solids_per_filtrate(DENSITY, POROSITY, DRAWN, DRAWN) / DENSITY;
            near("L_ruth_mm", row, 1e3 * volume * solids / (1.0 - POROSITY));
        }
    }

    #[test]
    fn slope_and_intercept_are_those_of_the_volume_over_time() {
        let filtrate = json!({"held": "pressure", "pressure_drop": 2000.0, "initial_flux": FIRST_FLUX});
        let mut written = settings(filtrate, json!({"suspension": {"solids_fraction": DRAWN}}));
        // Without settling.
        written["filtration"]["gravity"] = json!(1e-9);
        let facts = Facts {
            settings: &written,
            scalars: &|name| (name == "porosity").then_some(POROSITY),
        };
        let value = |name: &str| scalar(name, &facts).unwrap().values[0];
        let (medium, drive) = (2e8, 2000.0 / VISCOSITY);
        let cake = solids_per_filtrate(DENSITY, POROSITY, DRAWN, DRAWN)
            * specific_resistance(POROSITY, DIAMETER, DENSITY);
        for time in [0.1, 1.0, 10.0] {
            let volume = volume(time, drive, medium, cake);
            let line = value("ruth_slope") * volume + value("ruth_intercept");
            assert!((line * volume / time - 1.0).abs() < 1e-6, "{time}");
        }
        let facts = Facts {
            scalars: &|name| match name {
                "porosity" => Some(POROSITY),
                "first_deposit_time" => Some(0.2),
                _ => None,
            },
            ..facts
        };
        let grown = series("ruth_thickness", &facts, &[0.1, 0.2, 1.2]).unwrap().values;
        assert_eq!(grown[..2], [0.0, 0.0]);
        assert!((grown[2] / volume(1.0, drive, medium, cake) / value("ruth_growth") - 1.0).abs() < 1e-6);
        let solids = grown[2] * (1.0 - POROSITY);
        let filtrate = volume(1.0, drive, medium, cake);
        // What has come with the filtrate, and what the front has met on its way.
        assert!((solids / (DRAWN * (filtrate + grown[2])) - 1.0).abs() < 1e-6);
        // Grains that settle besides are fewer in the suspension, and the cake grows less per filtrate.
        let without = value("ruth_slope");
        let settling = settings(
            written["filtration"]["filtrate"].clone(),
            written["filtration"]["feed"].clone(),
        );
        let facts = Facts {
            settings: &settling,
            ..facts
        };
        let share = scalar("ruth_slope", &facts).unwrap().values[0] / without;
        assert!((0.93..0.95).contains(&share), "{share}");
    }

    #[test]
    fn it_says_what_it_does_not_hold_for() {
        let filtrate = json!({"held": "pressure", "pressure_drop": 2000.0, "initial_flux": FIRST_FLUX});
        let message = |feed, scalars: &dyn Fn(&str) -> Option<f64>| {
            let settings = settings(filtrate.clone(), feed);
            let facts = Facts {
                settings: &settings,
                scalars,
            };
            scalar("ruth_slope", &facts).unwrap_err().0
        };
        assert!(message(json!("at_start"), &|_| Some(0.4)).contains("drawn in by the filtrate"));
        let drawn = json!({"suspension": {"solids_fraction": 0.05}});
        assert!(message(drawn, &|_| None).contains("add it to `observe`"));
    }
}
