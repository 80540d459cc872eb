//! Speed at which equal grains fall that are spread evenly over their box.
//!
//! ```text
//! f(Re) Re ε^−χ = (Ar/18) ε,     Re = ρ_f d u / μ
//! fluid at rest     v = u/ε
//! closed column     v = u
//! ```
//!
//! u: superficial slip; f: drag of an isolated grain over Stokes drag ([`DragLaw`]); χ: exponent of the
//! voidage function of Di Felice, 0 without one. Alvim (2016), eq. 55, as printed lacks ε², so that its
//! exponent is χ + 2. Equal grains, ε that of the whole box, no walls, nothing settled yet.
//! Source: force balance with buoyancy of the pure fluid and drag divided by ε; Di Felice (1994), Int. J.
//! Multiphase Flow 20, 153.

use super::drag_law::DragLaw;
use super::grain::Grain;
use super::root::rising_root;
use super::settings::Case;
use super::{Entry, Kind, ReferenceError, Solution};

/// What the voidage function adds to the drag of an isolated grain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Crowding {
    None,
    DiFelice,
    AlvimLiteral,
}

impl Crowding {
    /// The one that the settings name.
    pub fn of(case: &Case) -> Result<Crowding, ReferenceError> {
        match case.word("voidage") {
            Some("none") => Ok(Crowding::None),
            Some("di_felice") => Ok(Crowding::DiFelice),
            Some("alvim_literal") => Ok(Crowding::AlvimLiteral),
            other => {
                let word = other.unwrap_or_default();
                Err(ReferenceError(format!("no voidage function is called `{word}`")))
            }
        }
    }
}

/// Superficial slip [m/s], positive downwards, at a porosity [-].
pub fn superficial_slip(grain: &Grain, law: DragLaw, crowding: Crowding, porosity: f64) -> f64 {
    let exponent = |re: f64| match crowding {
        Crowding::None => 0.0,
        Crowding::DiFelice => DragLaw::DiFelice.voidage_exponent(re),
        Crowding::AlvimLiteral => DragLaw::DiFelice.voidage_exponent(re) + 2.0,
    };
    let balance = grain.archimedes() / 18.0 * porosity;
    let residual = |re: f64| law.force(re) * porosity.powf(-exponent(re)) - balance;
    grain.settling_velocity(rising_root(residual, balance).unwrap_or(0.0))
}

fn first_settling_speed(case: &Case) -> Result<f64, ReferenceError> {
    case.only("first_settling_speed", "sedimentation")?;
    let grain = case.grain()?;
    if case.number("grains.largest_diameter").is_ok() {
        let reason = "`first_settling_speed` holds for equal grains, not for a spread of diameters";
        return Err(ReferenceError(reason.to_string()));
    }
    let crowding = Crowding::of(case)?;
    let room = case.number("container.width")?
        * case.number("container.depth")?
        * case.number("container.height")?;
    let porosity = 1.0 - case.number("grains.number")? * grain.volume() / room;
    let slip = superficial_slip(&grain, case.law()?, crowding, porosity);
    Ok(match case.word("fluid") {
        Some("column") => slip,
        _ => slip / porosity,
    })
}

pub(super) fn solution() -> Solution {
    Solution {
        entry: Entry {
            name: "first_settling_speed",
            meaning: "speed of equal grains spread evenly over their box, before any has settled",
            source: "force balance on a grain with buoyancy of the pure fluid; Di Felice (1994), Int. J. Multiphase Flow 20, 153",
        },
        unit: "m/s",
        kind: Kind::Scalar(first_settling_speed),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use crate::reference::{Facts, scalar, terminal_velocity};

    const GLASS: Grain = Grain {
        diameter: 250e-6,
        density: 2460.0,
        fluid_density: 1000.0,
        viscosity: 1e-3,
        gravity: 9.81,
    };

    fn speed(fluid: &str, voidage: &str, number: u32) -> f64 {
        let settings = json!({"sedimentation": {
            "grains": {"diameter": 250e-6, "density": 2460.0, "number": number},
            "container": {"width": 2.5e-3, "depth": 2.5e-3, "height": 1e-2},
            "drag": "schiller_naumann", "voidage": voidage, "gravity": 9.81,
            "fluid": {fluid: {"density": 1000.0, "viscosity": 1e-3}}}});
        let facts = Facts {
            settings: &settings,
            scalars: &|_| None,
        };
        scalar("first_settling_speed", &facts).unwrap().values[0]
    }

    #[test]
    fn the_four_readings_of_the_printed_drag() {
        // mm/s, found independently for 1000 grains of 250 µm in 10 × 10 × 40 diameters.
        let known = [
            ("still", "di_felice", 21.9517),
            ("column", "di_felice", 19.0782),
            ("still", "alvim_literal", 17.2857),
            ("column", "alvim_literal", 15.023),
        ];
        for (fluid, voidage, expected) in known {
            let found = 1e3 * speed(fluid, voidage, 1000);
            assert!(
                (found - expected).abs() < 1e-3,
                "{fluid}, {voidage}: {found} mm/s"
            );
        }
    }

    #[test]
    fn few_grains_fall_as_one_alone_and_many_more_slowly() {
        let alone = terminal_velocity::terminal_velocity(&GLASS, DragLaw::SchillerNaumann);
        for voidage in ["none", "di_felice", "alvim_literal"] {
            assert!((speed("still", voidage, 0) / alone - 1.0).abs() < 1e-12);
        }
        let speeds = [0, 500, 1000, 2000].map(|number| speed("column", "di_felice", number));
        assert!(speeds.windows(2).all(|pair| pair[1] < pair[0]), "{speeds:?}");
    }

    #[test]
    fn other_scenes_and_spreads_of_size_are_refused() {
        let settings = json!({"single_sphere": {}});
        let facts = Facts {
            settings: &settings,
            scalars: &|_| None,
        };
        assert!(scalar("first_settling_speed", &facts).is_err());
    }
}
