//! Thickness of a cake whose grains are fed at a given rate.
//!
//! ```text
//! φ_s = Ṅ V_p / (A (q + w))                          what falls above the cake
//! L(t) = Ṅ V_p (t − t₁) / (A (1 − ε − φ_s))          from the first deposit t₁ on, while grains arrive
//! L_end = N V_p / (A (1 − ε))                        once all have arrived
//! ```
//!
//! Grains arrive at q + w and the front of the cake meets them on its way up: hence φ_s. w: settling speed of
//! the grains among each other; ε: porosity that the run has measured, the same over the whole cake. Source:
//! balance of the solids over the front of the cake, as in Kynch (1952), Trans. Faraday Soc. 48, 166.

use super::filter::Filter;
use super::settings::Case;
use super::{Entry, Kind, ReferenceError, Solution};

const GROWTH: &str = "cake_growth";
const RATE: &str = "cake_growth_rate";
const THICKNESS: &str = "cake_thickness";
const SOURCE: &str =
    "balance of the solids over the front of the cake: Kynch (1952), Trans. Faraday Soc. 48, 166";

/// Speed of the front [m/s] under a solid flux ṄV_p/A [m/s], ε and φ_s [-].
pub fn front_speed(solid_flux: f64, porosity: f64, suspended: f64) -> f64 {
    solid_flux / (1.0 - porosity - suspended)
}

/// Speed of the run's own front [m/s], and its porosity [-].
fn own_front(name: &str, case: &Case, filter: &Filter) -> Result<(f64, f64), ReferenceError> {
    let flux = filter.solid_flux(name)?;
    let porosity = filter.porosity(case)?;
    Ok((front_speed(flux, porosity, filter.suspended(flux)), porosity))
}

fn rate(case: &Case) -> Result<f64, ReferenceError> {
    let filter = Filter::of(RATE, case)?;
    Ok(own_front(RATE, case, &filter)?.0)
}

fn growth(case: &Case, times: &[f64]) -> Result<Vec<f64>, ReferenceError> {
    let filter = Filter::of(GROWTH, case)?;
    let (speed, porosity) = own_front(GROWTH, case, &filter)?;
    let first = case.measured("first_deposit_time")?;
    let end = filter.solids_per_area() / (1.0 - porosity);
    Ok(times
        .iter()
        .map(|time| (speed * (time - first)).clamp(0.0, end))
        .collect())
}

fn thickness(case: &Case) -> Result<f64, ReferenceError> {
    let filter = Filter::of(THICKNESS, case)?;
    Ok(filter.solids_per_area() / (1.0 - filter.porosity(case)?))
}

pub(super) fn growth_solution() -> Solution {
    Solution {
        entry: Entry {
            name: GROWTH,
            meaning: "thickness over time of a cake fed at a constant rate, with its measured porosity and first deposit",
            source: SOURCE,
        },
        unit: "m",
        kind: Kind::Series(growth),
    }
}

pub(super) fn rate_solution() -> Solution {
    Solution {
        entry: Entry {
            name: RATE,
            meaning: "speed at which a cake fed at a constant rate grows, with its measured porosity",
            source: SOURCE,
        },
        unit: "m/s",
        kind: Kind::Scalar(rate),
    }
}

pub(super) fn thickness_solution() -> Solution {
    Solution {
        entry: Entry {
            name: THICKNESS,
            meaning: "thickness of the cake of all grains, with its measured porosity",
            source: "volume of the solids: N V_p = (1 − ε) A L",
        },
        unit: "m",
        kind: Kind::Scalar(thickness),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use crate::reference::filter::tests::{filter, settings};
    use crate::reference::{Facts, scalar, series};

    #[test]
    fn the_cake_begins_with_its_first_grain_and_ends_with_the_last() {
        let filtrate = json!({"held": "flux", "initial_flux": 0.01, "pressure_drop": 2000.0});
        let settings = settings(filtrate, json!({"rate": {"rate": 1250.0}}));
        let facts = Facts {
            settings: &settings,
            scalars: &|name| match name {
                "porosity" => Some(0.45),
                "first_deposit_time" => Some(0.2),
                _ => None,
            },
        };
        let at = |times: &[f64]| series("cake_growth", &facts, times).unwrap().values;
        let end = scalar("cake_thickness", &facts).unwrap().values[0];
        let thickness = at(&[0.1, 0.2, 0.4, 0.6, 5.0]);
        assert_eq!(thickness[..2], [0.0, 0.0]);
        assert!((thickness[3] / thickness[2] - 2.0).abs() < 1e-12);
        assert_eq!(thickness[4], end);
        let rate = scalar("cake_growth_rate", &facts).unwrap().values[0];
        assert!((rate * 0.2 / thickness[2] - 1.0).abs() < 1e-12);
        // Solids come down with the suspension as the front rises into it.
        let filter = filter(&settings);
        let flux = filter.solid_flux("test").unwrap();
        let speed = (thickness[3] - thickness[2]) / 0.2;
        let met = filter.suspended(flux) * speed;
        assert!(((flux + met) / (0.55 * speed) - 1.0).abs() < 1e-12);
    }
}
