//! Terminal velocity of an isolated sphere.
//!
//! ```text
//! f(Re) Re = Ar / 18,     v = Re μ / (ρ_f d)
//! ```
//!
//! f: drag over Stokes drag of the scene's law ([`DragLaw`]). Unbounded fluid at rest.
//! Source: force balance on a sphere; Raso (2014), eqs. 2.73–2.77 for the laws.

use super::drag_law::DragLaw;
use super::grain::Grain;
use super::root::rising_root;
use super::{Entry, Kind, Solution};

/// [m/s], positive downwards; zero for a grain as heavy as the fluid.
pub fn terminal_velocity(grain: &Grain, law: DragLaw) -> f64 {
    let balance = grain.archimedes() / 18.0;
    let reynolds = rising_root(|re| law.force(re) - balance, balance).unwrap_or(0.0);
    grain.settling_velocity(reynolds)
}

pub(super) fn solution() -> Solution {
    Solution {
        entry: Entry {
            name: "terminal_velocity",
            meaning: "terminal velocity of an isolated grain under the scene's drag law",
            source: "force balance on an isolated sphere, C_D Re² = 4/3 Ar; drag laws as in Raso (2014), eqs. 2.73–2.77",
        },
        unit: "m/s",
        kind: Kind::Scalar(|case| Ok(terminal_velocity(&case.grain()?, case.law()?))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::grain::tests::GLASS;
    use crate::reference::library::tests::{assert_printed, dataset};

    #[test]
    fn velocities_are_the_published_table() {
        let table = dataset("terminal_velocity_analytic.csv");
        let columns = [
            ("v_stokes_mm_s", DragLaw::Stokes),
            ("v_schiller_naumann_mm_s", DragLaw::SchillerNaumann),
            ("v_dallavalle_mm_s", DragLaw::Dallavalle),
            ("v_coulson_richardson_mm_s", DragLaw::CoulsonRichardson),
        ];
        for row in 0..table.rows() {
            let grain = Grain {
                diameter: 1e-6 * table.number("d_um", row),
                density: table.number("rho_p_kg_m3", row),
                fluid_density: table.number("rho_f_kg_m3", row),
                viscosity: table.number("mu_Pa_s", row),
                gravity: 9.81,
            };
            for (column, law) in columns {
                assert_printed(1e3 * terminal_velocity(&grain, law), table.text(column, row));
            }
            let speed = terminal_velocity(&grain, DragLaw::SchillerNaumann);
            assert_printed(grain.reynolds(speed), table.text("Re_schiller_naumann", row));
            assert_printed(grain.archimedes(), table.text("Ar", row));
        }
    }

    #[test]
    fn drag_and_buoyant_weight_cancel() {
        for law in [
            DragLaw::Dallavalle,
            DragLaw::SchillerNaumann,
            DragLaw::CoulsonRichardson,
        ] {
            for diameter in [1e-6, 1e-4, 1e-2] {
                let grain = Grain { diameter, ..GLASS };
                let speed = terminal_velocity(&grain, law);
                let area = std::f64::consts::PI / 4.0 * diameter * diameter;
                let pressure = 0.5 * grain.fluid_density * speed * speed;
                let drag = law.coefficient(grain.reynolds(speed)) * pressure * area;
                let balance = drag / grain.buoyant_weight();
                assert!((balance - 1.0).abs() < 1e-12, "{law:?}, {diameter} m: {balance}");
            }
        }
    }

    #[test]
    fn neutral_grains_stay_and_light_ones_rise() {
        let neutral = Grain {
            density: 1000.0,
            ..GLASS
        };
        assert_eq!(terminal_velocity(&neutral, DragLaw::SchillerNaumann), 0.0);
        let light = Grain {
            density: 900.0,
            ..GLASS
        };
        assert!(terminal_velocity(&light, DragLaw::Stokes) < 0.0);
    }
}
