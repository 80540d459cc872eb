//! Filtration of a suspension: time over volume against volume is a straight line.
//!
//! ```text
//! constant pressure   t/V = (μ α c / (2 ΔP)) V + μ R_m / ΔP       V: filtrate per area [m]
//! constant flux       ΔP  = μ q₀ (R_m + α c q₀ t)
//! c = ρ_s (1 − ε) φ₀ / (1 − ε − φ_s)      φ_s = φ₀ q / (q + w)      α = 1 / (ρ_s (1 − ε) k)
//! ```
//!
//! t and V count from the first deposit on. φ₀: solids fed per volume of filtrate and solids; φ_s: solids in the
//! suspension above the cake, less than φ₀ as the grains settle at w besides. With w = 0 this is Ruth's c for an
//! incompressible cake. ε: porosity that the run has measured. Source: Ruth (1935), Ind. Eng. Chem. 27, 708;
//! Alvim (2016), eq. 6.

use super::filter::{Drive, Filter};
use super::kozeny_carman::{kozeny_carman, specific_resistance};
use super::settings::Case;
use super::{Entry, Kind, ReferenceError, Solution};

/// c [kg/m³]: dry solids of the cake per volume of filtrate.
pub fn solids_per_filtrate(density: f64, porosity: f64, fed: f64, suspended: f64) -> f64 {
    density * (1.0 - porosity) * fed / (1.0 - porosity - suspended)
}

/// What the straight line is made of.
struct Line {
    /// [s/m²]
    slope: f64,
    /// [s/m]
    intercept: f64,
}

fn line(name: &str, case: &Case) -> Result<Line, ReferenceError> {
    let filter = Filter::of(name, case)?;
    let fed = filter.fed_fraction(name)?;
    let Drive::Pressure(drop) = filter.drive else {
        return Err(ReferenceError(format!("`{name}` holds for a constant pressure")));
    };
    let resistance = drive_resistance(case, &filter, fed)?;
    Ok(Line {
        slope: filter.grain.viscosity * resistance / (2.0 * drop),
        intercept: filter.grain.viscosity * filter.medium_resistance / drop,
    })
}

/// α c [1/m²]: resistance of the cake per filtrate.
fn drive_resistance(case: &Case, filter: &Filter, fed: f64) -> Result<f64, ReferenceError> {
    let porosity = filter.porosity(case)?;
    let density = filter.grain.density;
    let suspended = filter.suspended(fed * filter.first_flux());
    let alpha = specific_resistance(porosity, filter.sauter_diameter(), density);
    Ok(alpha * solids_per_filtrate(density, porosity, fed, suspended))
}
