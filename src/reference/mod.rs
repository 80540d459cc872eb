//! Values to judge against: analytic solutions and published data. Shares nothing with the simulator.

mod all_pairs;
pub mod cake_growth;
mod collision;
pub mod darcy_in_series;
pub mod data;
pub mod drag_law;
pub mod filter;
pub mod first_settling_speed;
pub mod flux_curve;
pub mod force_balance;
pub mod grain;
pub mod hertz_collision;
pub mod kernel;
pub mod kozeny_carman;
pub mod kynch;
pub mod library;
pub mod mixture;
pub mod polydisperse_block;
pub mod rehearsal;
pub mod richardson_zaki;
mod root;
pub mod ruth;
mod settings;
pub mod smoothed_balance;
pub mod spring_dashpot_collision;
mod stable_step;
pub mod stokes_start_up;
pub mod terminal_velocity;
pub mod zero_net_flux;

use serde_json::Value;

use settings::Case;

/// What a reference may know of a run.
pub struct Facts<'a> {
    /// Canonical settings of the scene: `{"single_sphere": {…}}`.
    pub settings: &'a Value,
    /// Scalars the run measured, by name (a lattice's true porosity, say).
    pub scalars: &'a dyn Fn(&str) -> Option<f64>,
}

/// A reference value or curve with its origin.
#[derive(Clone, Debug, PartialEq)]
pub struct Expected {
    /// One value, or one per time asked for.
    pub values: Vec<f64>,
    pub unit: &'static str,
    /// Citation with equation.
    pub source: String,
}

/// A measured curve: its own times and values.
#[derive(Clone, Debug, PartialEq)]
pub struct Points {
    /// Rising [s].
    pub times: Vec<f64>,
    pub values: Vec<f64>,
    pub unit: &'static str,
    pub source: String,
}

#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct ReferenceError(pub String);

/// A line of `kynch list`.
pub struct Entry {
    pub name: &'static str,
    pub meaning: &'static str,
    pub source: &'static str,
}

type Solve = fn(&Case) -> Result<f64, ReferenceError>;
type Curve = fn(&Case, &[f64]) -> Result<Vec<f64>, ReferenceError>;

/// A reference is a value or a curve.
enum Kind {
    Scalar(Solve),
    Series(Curve),
}

struct Solution {
    entry: Entry,
    unit: &'static str,
    kind: Kind,
}

/// The register: one line per solution.
fn solutions() -> Vec<Solution> {
    let one = vec![
        stokes_start_up::solution(),
        terminal_velocity::solution(),
        force_balance::solution(),
        first_settling_speed::solution(),
        smoothed_balance::solution(),
        collision::restitution(),
        collision::contact_time(),
        collision::overlap(),
        collision::sliding(),
        all_pairs::solution(),
        stable_step::solution(),
        kozeny_carman::solution(),
        kozeny_carman::with_unit_slip(),
        cake_growth::growth_solution(),
        cake_growth::rate_solution(),
        cake_growth::thickness_solution(),
        darcy_in_series::flux_solution(),
        darcy_in_series::pressure_solution(),
        ruth::line_solution(),
        ruth::thickness_solution(),
        ruth::growth_solution(),
        ruth::slope_solution(),
        ruth::intercept_solution(),
        rehearsal::limit(),
        rehearsal::series(),
    ];
    let several = richardson_zaki::solutions().into_iter();
    let several = several
        .chain(zero_net_flux::solutions())
        .chain(kynch::solutions());
    one.into_iter().chain(several).collect()
}

/// A scalar reference by name.
///
/// # Errors
/// An unknown name, a curve asked for as a value, or settings the solution does not hold for.
pub fn scalar(name: &str, facts: &Facts) -> Result<Expected, ReferenceError> {
    if let Some(named) = data::find(name)? {
        return named.scalar(&Case::of(facts)?);
    }
    let solution = find(name)?;
    let Kind::Scalar(solve) = solution.kind else {
        return Err(ReferenceError(format!(
            "the reference `{name}` is a curve over time: compare a series with it, not a scalar"
        )));
    };
    let value = solve(&Case::of(facts)?)?;
    Ok(expected(vec![value], &solution))
}

/// A reference curve by name, at the given abscissae (times [s], mostly). A scalar reference is the
/// same at every abscissa. A measured curve is known at its own times only: see [`points`].
///
/// # Errors
/// An unknown name, a measured curve, or settings the solution does not hold for.
pub fn series(name: &str, facts: &Facts, at: &[f64]) -> Result<Expected, ReferenceError> {
    if data::find(name)?.is_some() {
        let level = scalar(name, facts)?;
        return Ok(Expected {
            values: vec![level.values[0]; at.len()],
            ..level
        });
    }
    let solution = find(name)?;
    let case = Case::of(facts)?;
    let values = match solution.kind {
        Kind::Scalar(solve) => vec![solve(&case)?; at.len()],
        Kind::Series(curve) => curve(&case, at)?,
    };
    Ok(expected(values, &solution))
}

/// The measured curve of that name; nothing where the name is a solution or a single value.
///
/// # Errors
/// A data set at fault, or one without a curve for these settings.
pub fn points(name: &str, facts: &Facts) -> Result<Option<Points>, ReferenceError> {
    match data::find(name)? {
        Some(named) if named.is_curve() => named.points(&Case::of(facts)?).map(Some),
        _ => Ok(None),
    }
}

/// Whether a name is that of a curve, with which only a series can be compared.
pub fn is_curve(name: &str) -> bool {
    match data::find(name) {
        Ok(Some(named)) => named.is_curve(),
        _ => find(name).is_ok_and(|solution| matches!(solution.kind, Kind::Series(_))),
    }
}

/// Whether a name is that of published data, not of a solution.
pub fn is_published(name: &str) -> bool {
    matches!(data::find(name), Ok(Some(_)))
}

/// Every reference there is, solutions first.
pub fn list() -> Vec<Entry> {
    let solutions = solutions().into_iter().map(|solution| solution.entry);
    solutions.chain(data::list()).collect()
}

fn find(name: &str) -> Result<Solution, ReferenceError> {
    solutions()
        .into_iter()
        .find(|solution| solution.entry.name == name)
        .ok_or_else(|| {
            let names: Vec<_> = list().iter().map(|entry| entry.name).collect();
            ReferenceError(format!(
                "there is no reference `{name}`; there are {}",
                names.join(", ")
            ))
        })
}

fn expected(values: Vec<f64>, solution: &Solution) -> Expected {
    Expected {
        values,
        unit: solution.unit,
        source: solution.entry.source.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn sphere(drag: &str) -> Value {
        json!({"single_sphere": {
            "grains": {"diameter": 1e-4, "density": 2500.0}, "drag": drag,
            "fluid": {"still": {"density": 1000.0, "viscosity": 8.9e-4}},
            "column": {"width": 4e-3, "height": 6e-3}, "gravity": 9.81}})
    }

    fn value(name: &str, settings: &Value) -> Result<f64, ReferenceError> {
        let facts = Facts {
            settings,
            scalars: &|_| None,
        };
        scalar(name, &facts).map(|expected| expected.values[0])
    }

    #[test]
    fn a_sphere_alone_balances_like_an_isolated_grain() {
        for law in [
            "stokes",
            "dallavalle",
            "schiller_naumann",
            "di_felice",
            "coulson_richardson",
            "beetstra",
            "beetstra_cello",
        ] {
            let settings = sphere(law);
            let alone = value("terminal_velocity", &settings).unwrap();
            let balance = value("force_balance", &settings).unwrap();
            assert!(
                (alone / balance - 1.0).abs() < 1e-12,
                "{law}: {alone} and {balance}"
            );
        }
    }

    fn two_classes(scene: &str, sizes: [f64; 2], densities: [f64; 2], drag: &str) -> Value {
        let class = |k: usize| json!({"diameter": sizes[k], "density": densities[k], "share": 0.5});
        json!({scene: {
            "classes": [class(0), class(1)], "drag": drag, "porosity": 0.9,
            "fluid": {"sph": {"density": 1000.0, "viscosity": 8.9e-4}},
            "column": {"width": 4e-3, "height": 6e-3}, "gravity": 9.81}})
    }

    #[test]
    fn classes_of_grains_reach_the_references_of_mixtures() {
        // Raso (2014): the block of 150 and 100 µm, and the suspension of 2450 and 1500 kg/m³.
        let block = two_classes(
            "constant_porosity_block",
            [1.5e-4, 1e-4],
            [2500.0; 2],
            "beetstra_cello",
        );
        assert!((value("force_balance", &block).unwrap() - 5.923e-3).abs() < 1e-6);
        let suspension = two_classes("suspension", [1e-4; 2], [2450.0, 1500.0], "di_felice");
        let found = |name| 1e3 * value(name, &suspension).unwrap();
        assert!((found("zero_net_flux_front_1") - 5.107).abs() < 1e-3);
        assert!((found("zero_net_flux_front_2") - 2.10).abs() < 5e-3);
        assert!((found("zero_net_flux_speed_2") - 1.384).abs() < 1e-3);
        let message = |name, settings: &Value| value(name, settings).unwrap_err().0;
        assert!(message("zero_net_flux_front_3", &suspension).contains("it has 2"));
        assert!(message("zero_net_flux_front_1", &block).contains("suspension"));
        assert!(message("force_balance", &suspension).contains("2 classes"));
        assert!(message("kynch_bed_front", &suspension).contains("2 classes"));
    }

    #[test]
    fn the_start_up_curve_ends_at_the_terminal_velocity() {
        let settings = sphere("stokes");
        let facts = Facts {
            settings: &settings,
            scalars: &|_| None,
        };
        let curve = series("stokes_start_up", &facts, &[0.0, 1.0]).unwrap();
        let terminal = value("terminal_velocity", &settings).unwrap();
        assert_eq!(curve.values[0], 0.0);
        assert!((curve.values[1] / terminal - 1.0).abs() < 1e-12);
    }

    #[test]
    fn wrong_uses_say_what_is_wrong() {
        let settings = sphere("dallavalle");
        let facts = Facts {
            settings: &settings,
            scalars: &|_| None,
        };
        let message = |result: Result<Expected, ReferenceError>| result.unwrap_err().0;
        assert!(message(scalar("stokes", &facts)).contains("stokes_start_up"));
        assert!(message(scalar("stokes_start_up", &facts)).contains("curve"));
        assert!(message(series("stokes_start_up", &facts, &[0.0])).contains("dallavalle"));
        assert!(message(scalar("smoothed_balance", &facts)).contains("constant_porosity_block"));
        assert!(message(scalar("known_limit", &facts)).contains("rehearsal"));
    }

    #[test]
    fn settings_without_a_needed_field_name_it() {
        let settings = json!({"single_sphere": {"grains": {"diameter": 1e-4}, "drag": "stokes"}});
        let message = value("terminal_velocity", &settings).unwrap_err().0;
        assert!(message.contains("grains.density"), "{message}");
        assert!(value("terminal_velocity", &json!(3)).is_err());
    }

    #[test]
    fn every_reference_is_found_under_its_own_name() {
        for entry in list() {
            assert!(find(entry.name).is_ok() != data::find(entry.name).unwrap().is_some());
            assert!(!entry.source.is_empty() && !entry.meaning.is_empty());
        }
    }
}
