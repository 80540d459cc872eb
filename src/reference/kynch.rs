//! Settling of a suspension of equal grains by the flux curve of its own drag law.
//!
//! The flux is that of the force balance, f(φ) = φ w(1 − φ); the deposit's fraction φ_m is the one that the
//! run measured. See [`FluxCurve`] for the construction.
//! Source: Kynch (1952), Trans. Faraday Soc. 48, 166–176.

use super::flux_curve::{FluxCurve, Kind as Type};
use super::force_balance::ForceBalance;
use super::settings::Case;
use super::{Entry, Kind, ReferenceError, Solution};

/// Scalar of a run that holds φ_m.
const DEPOSIT: &str = "deposit_fraction";
const SOURCE: &str = "Kynch (1952), Trans. Faraday Soc. 48, 166, on the flux curve of the force balance with the measured deposit";

pub(super) fn solutions() -> Vec<Solution> {
    let solution = |name, meaning, unit, kind| Solution {
        entry: Entry {
            name,
            meaning,
            source: SOURCE,
        },
        unit,
        kind,
    };
    vec![
        solution(
            "kynch_bed_front",
            "speed at which the deposit's front rises",
            "m/s",
            Kind::Scalar(|case| Ok(of(case)?.bed_front())),
        ),
        solution(
            "kynch_meeting_time",
            "when the interface meets the first wave from the floor, the deposit's front where settling is of type 1",
            "s",
            Kind::Scalar(|case| Ok(of(case)?.meeting(case.number("column.height")?).0)),
        ),
        solution(
            "kynch_meeting_height",
            "where the interface meets the first wave from the floor",
            "m",
            Kind::Scalar(|case| Ok(of(case)?.meeting(case.number("column.height")?).1)),
        ),
        solution(
            "kynch_type",
            "1: one front rises; 2: a fan of concentrations before it; 3: a front, a fan, a front",
            "1",
            Kind::Scalar(|case| {
                Ok(match of(case)?.waves.kind {
                    Type::One => 1.0,
                    Type::Two => 2.0,
                    Type::Three => 3.0,
                })
            }),
        ),
        solution(
            "kynch_interface",
            "height of the interface over time",
            "m",
            Kind::Series(|case, times| {
                let (curve, height) = (of(case)?, case.number("column.height")?);
                Ok(times.iter().map(|time| curve.interface(height, *time)).collect())
            }),
        ),
        solution(
            "kynch_bed_height",
            "height of the deposit over time",
            "m",
            Kind::Series(|case, times| {
                let (curve, height) = (of(case)?, case.number("column.height")?);
                let (rise, last) = (curve.bed_front(), height * curve.start / curve.deposit);
                Ok(times.iter().map(|time| (rise * time).min(last)).collect())
            }),
        ),
    ]
}

/// The flux curve of a run's suspension.
fn of(case: &Case) -> Result<FluxCurve<impl Fn(f64) -> f64>, ReferenceError> {
    case.only("kynch", "suspension")?;
    let (grain, law) = (case.grain()?, case.law()?);
    let (start, deposit) = (1.0 - case.number("porosity")?, case.measured(DEPOSIT)?);
    let ordered = start < deposit && deposit < 1.0;
    if !ordered {
        return Err(ReferenceError(format!(
            "the run's `{DEPOSIT}` is {deposit}, which is no deposit of a suspension that starts at {start}"
        )));
    }
    let velocity = move |fraction: f64| {
        ForceBalance {
            grain,
            law,
            porosity: 1.0 - fraction,
        }
        .settling_velocity()
    };
    Ok(FluxCurve::new(velocity, start, deposit))
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use crate::reference::library::tests::dataset;
    use crate::reference::{Facts, scalar, series};

    fn suspension(porosity: f64) -> serde_json::Value {
        json!({"suspension": {
            "grains": {"diameter": 1e-4, "density": 2500.0}, "drag": "di_felice", "porosity": porosity,
            "fluid": {"column": {"density": 1000.0, "viscosity": 8.9e-4}},
            "column": {"width": 4e-3, "height": 6e-3}, "gravity": 9.81}})
    }

    fn value(name: &str, porosity: f64, deposit: Option<f64>) -> Result<f64, ReferenceError> {
        let facts = Facts {
            settings: &suspension(porosity),
            scalars: &|name| deposit.filter(|_| name == DEPOSIT),
        };
        scalar(name, &facts).map(|expected| expected.values[0])
    }

    #[test]
    fn bed_fronts_and_ends_of_settling_are_the_tabulated_ones() {
        let table = dataset("raso2014_settling_reference_analytic.csv");
        for row in 0..table.rows() {
            if table.number("rho_p_kg_m3", row) != 2500.0 {
                continue;
            }
            let found = |name| value(name, table.number("porosity", row), Some(0.5)).unwrap();
            let rise = table.number("bed_front_rise_mm_s_phi_bed_0.5", row);
            let end = table.number("end_of_settling_s_H6mm_phi_bed_0.5", row);
            assert!((1e3 * found("kynch_bed_front") / rise - 1.0).abs() < 1e-5);
            assert!((found("kynch_meeting_time") / end - 1.0).abs() < 1e-5);
            assert_eq!(found("kynch_type"), 1.0);
        }
    }

    #[test]
    fn dense_deposits_settle_as_type_2_where_di_felice_allows_it() {
        // n is 4.41 between porosities 0.6 and 0.95: type 2 or 3 above 4n/(n+1)² = 0.6026.
        let types = |deposit: f64| {
            [0.95, 0.9, 0.85, 0.8, 0.75, 0.7, 0.65, 0.6]
                .map(|porosity| value("kynch_type", porosity, Some(deposit)).unwrap())
        };
        assert_eq!(types(0.58), [1.0; 8]);
        assert_eq!(types(0.62)[..3], [1.0; 3]);
        assert_eq!(types(0.62)[7], 2.0);
    }

    #[test]
    fn the_interface_ends_where_the_bed_does() {
        let settings = suspension(0.65);
        let facts = Facts {
            settings: &settings,
            scalars: &|_| Some(0.62),
        };
        let last = |name| series(name, &facts, &[0.0, 100.0]).unwrap().values[1];
        let expected = 6e-3 * 0.35 / 0.62;
        assert!((last("kynch_interface") / expected - 1.0).abs() < 1e-12);
        assert!((last("kynch_bed_height") / expected - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_run_without_its_deposit_says_what_to_observe() {
        let message = |deposit| value("kynch_bed_front", 0.9, deposit).unwrap_err().0;
        assert!(message(None).contains("`deposit_fraction`") && message(None).contains("observe"));
        assert!(message(Some(0.05)).contains("no deposit"));
    }
}
