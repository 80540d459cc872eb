//! Drag on a sphere as a multiple of Stokes drag at the same superficial slip.
//!
//! ```text
//! F = 3πμ d u_s f(Re) ε^−ξ,     f = C_D Re / 24,     Re = ρ_f d u_s / μ
//! Stokes               f = 1
//! Dallavalle           C_D = (0.63 + 4.8/√Re)²
//! Schiller–Naumann     C_D = 24/Re (1 + 0.15 Re^0.687), 0.44 from Re = 1000
//! Coulson–Richardson   C_D = 2 (1.84 Re^−0.31 + 0.293 Re^0.06)^3.45
//! Di Felice            Dallavalle with ξ = 3.7 − 0.65 exp(−(1.5 − log₁₀ Re)²/2); otherwise ξ = 0
//! Beetstra             f = [10φ/ε² + ε²(1 + 1.5√φ)] (1 + χ), the neighbours within, ξ = 0
//! Beetstra and Cello   β f with β = [1/f + ((3ε − 1)/2 − 1/f) y + ½ φ y²]/ε, f at Re/y, y = d/⟨d⟩
//! ```
//!
//! The pressure-gradient force is apart. Dallavalle is 4 % below Stokes at rest; the factor of
//! Coulson–Richardson diverges there (as Re^−0.07), its force does not.
//!
//! Sources: Schiller & Naumann (1935), Z. VDI 77, 318; Dallavalle (1948), Micromeritics; Coulson &
//! Richardson (2002), Chemical Engineering vol. 2, ch. 3; Di Felice (1994), Int. J. Multiphase Flow 20, 153;
//! Beetstra et al. (2007), AIChE J. 53, 489; Cello et al. (2010), Chem. Eng. Sci. 65, 3128; as used by Raso
//! (2014), eqs. 2.73–2.88.

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DragLaw {
    Stokes,
    Dallavalle,
    SchillerNaumann,
    CoulsonRichardson,
    /// Dallavalle with the Di Felice voidage function.
    DiFelice,
    /// Equal spheres; the neighbours are part of the law.
    Beetstra,
    /// The same shared out among several sizes.
    BeetstraCello,
}

impl DragLaw {
    /// The law of that name in a study file.
    pub fn named(name: &str) -> Option<DragLaw> {
        Some(match name {
            "stokes" => DragLaw::Stokes,
            "dallavalle" => DragLaw::Dallavalle,
            "schiller_naumann" => DragLaw::SchillerNaumann,
            "coulson_richardson" => DragLaw::CoulsonRichardson,
            "di_felice" => DragLaw::DiFelice,
            "beetstra" => DragLaw::Beetstra,
            "beetstra_cello" => DragLaw::BeetstraCello,
            _ => return None,
        })
    }

    /// f Re = C_D Re²/24 of an isolated sphere [-]: the drag force over 3πμ²/ρ_f, finite at rest.
    pub fn force(self, re: f64) -> f64 {
        if re <= 0.0 {
            return 0.0;
        }
        match self {
            DragLaw::Stokes => re,
            DragLaw::Dallavalle | DragLaw::DiFelice => re * (0.63 * re.sqrt() + 4.8).powi(2) / 24.0,
            DragLaw::SchillerNaumann if re < 1000.0 => re * (1.0 + 0.15 * re.powf(0.687)),
            DragLaw::SchillerNaumann => 0.44 * re * re / 24.0,
            DragLaw::CoulsonRichardson => {
                re * re / 12.0 * (1.84 * re.powf(-0.31) + 0.293 * re.powf(0.06)).powf(3.45)
            }
            DragLaw::Beetstra | DragLaw::BeetstraCello => re * beetstra(re, 1.0),
        }
    }

    /// Drag coefficient C_D of an isolated sphere [-], Re > 0.
    pub fn coefficient(self, re: f64) -> f64 {
        24.0 * self.force(re) / (re * re)
    }

    /// Exponent ξ of the voidage [-].
    pub fn voidage_exponent(self, re: f64) -> f64 {
        match self {
            DragLaw::DiFelice => {
                let distance = 1.5 - re.max(f64::MIN_POSITIVE).log10();
                3.7 - 0.65 * (-distance * distance / 2.0).exp()
            }
            _ => 0.0,
        }
    }

    /// f Re ε^−ξ at a porosity ε [-].
    pub fn hindered_force(self, re: f64, porosity: f64) -> f64 {
        match self {
            DragLaw::Beetstra | DragLaw::BeetstraCello if re > 0.0 => re * beetstra(re, porosity),
            _ => self.force(re) * porosity.powf(-self.voidage_exponent(re)),
        }
    }

    /// f Re ε^−ξ of a grain of relative diameter y = d/⟨d⟩ [-] among others, Re its own.
    pub fn sized_force(self, re: f64, porosity: f64, relative_diameter: f64) -> f64 {
        match self {
            DragLaw::BeetstraCello if re > 0.0 => {
                let (f, y) = (beetstra(re / relative_diameter, porosity), relative_diameter);
                let linear = (3.0 * porosity - 1.0) / 2.0 - 1.0 / f;
                let beta = (1.0 / f + linear * y + 0.5 * (1.0 - porosity) * y * y) / porosity;
                re * beta * f
            }
            _ => self.hindered_force(re, porosity),
        }
    }
}

/// Drag on one of many equal spheres over Stokes drag, Re > 0.
pub fn beetstra(re: f64, porosity: f64) -> f64 {
    let solid = 1.0 - porosity;
    let open = porosity.powi(2) * (1.0 + 1.5 * solid.sqrt());
    let slow = 10.0 * solid / porosity.powi(2) + open;
    let crowd = 1.0 / porosity + 3.0 * porosity * solid + 8.4 * re.powf(-0.343);
    let onset = 1.0 + 10f64.powf(3.0 * solid) * re.powf(-(1.0 + 4.0 * solid) / 2.0);
    let chi = 0.413 * re / (240.0 * solid + 24.0 * porosity.powi(2) * open) * crowd / onset;
    slow * (1.0 + chi)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::library::tests::{assert_printed, dataset};

    const LAWS: [DragLaw; 7] = [
        DragLaw::Stokes,
        DragLaw::Dallavalle,
        DragLaw::SchillerNaumann,
        DragLaw::CoulsonRichardson,
        DragLaw::DiFelice,
        DragLaw::Beetstra,
        DragLaw::BeetstraCello,
    ];

    #[test]
    fn coefficients_are_the_published_table() {
        let table = dataset("drag_single_sphere_analytic.csv");
        let columns = [
            ("Cd_stokes", DragLaw::Stokes),
            ("Cd_schiller_naumann", DragLaw::SchillerNaumann),
            ("Cd_dallavalle", DragLaw::Dallavalle),
            ("Cd_coulson_richardson", DragLaw::CoulsonRichardson),
        ];
        // The grid is ten to the quarter decades, printed with six digits.
        for row in 0..table.rows() {
            let re = 10f64.powf(-3.0 + row as f64 / 4.0);
            assert_printed(re, table.text("Re", row));
            for (column, law) in columns {
                assert_printed(law.coefficient(re), table.text(column, row));
            }
        }
    }

    #[test]
    fn hindered_forces_are_the_published_table() {
        let table = dataset("voidage_drag_analytic.csv");
        for row in 0..table.rows() {
            let re = table.number("Re_superficial", row);
            let porosity = table.number("porosity", row);
            let over_stokes = |law: DragLaw| law.hindered_force(re, porosity) / re;
            assert_printed(
                over_stokes(DragLaw::DiFelice),
                table.text("F_difelice_dallavalle", row),
            );
            assert_printed(over_stokes(DragLaw::Beetstra), table.text("F_bvk", row));
        }
    }

    #[test]
    fn sizes_matter_to_one_law_alone_and_not_among_equals() {
        for law in LAWS {
            let forces = [0.5, 1.0, 2.0].map(|y| law.sized_force(0.3, 0.8, y));
            assert!((forces[1] / law.hindered_force(0.3, 0.8) - 1.0).abs() < 1e-14);
            assert_eq!(
                law == DragLaw::BeetstraCello,
                forces[0] < forces[1] && forces[1] < forces[2]
            );
            assert_eq!(law != DragLaw::BeetstraCello, forces[0] == forces[2]);
        }
    }

    #[test]
    fn force_vanishes_at_rest_and_rises_with_speed() {
        for law in LAWS {
            assert_eq!(law.force(0.0), 0.0);
            let mut last = 0.0;
            for step in 0..400 {
                let force = law.force(10f64.powf(-8.0 + step as f64 / 30.0));
                assert!(force > last, "{law:?}");
                last = force;
            }
        }
    }

    #[test]
    fn slow_limits() {
        for law in [DragLaw::Stokes, DragLaw::SchillerNaumann] {
            assert!((law.force(1e-9) / 1e-9 - 1.0).abs() < 1e-6, "{law:?}");
        }
        assert!((DragLaw::Dallavalle.force(1e-12) / 1e-12 - 0.96).abs() < 1e-5);
    }

    #[test]
    fn newton_regime_joins_within_half_a_percent() {
        let law = DragLaw::SchillerNaumann;
        let jump = law.force(1000.0) / law.force(1000f64.next_down());
        assert!((jump - 1.0).abs() < 5e-3, "{jump}");
    }

    #[test]
    fn voidage_leaves_a_lone_sphere_alone_and_hinders_a_crowd() {
        for re in [0.01, 1.0, 30.0, 1000.0] {
            assert_eq!(
                DragLaw::DiFelice.hindered_force(re, 1.0),
                DragLaw::Dallavalle.force(re)
            );
            assert!(DragLaw::DiFelice.hindered_force(re, 0.6) > 4.0 * DragLaw::DiFelice.force(re));
            assert_eq!(DragLaw::Stokes.hindered_force(re, 0.6), re);
        }
    }

    #[test]
    fn voidage_exponent_runs_from_slow_to_fast_through_its_least() {
        let exponent = |re| DragLaw::DiFelice.voidage_exponent(re);
        assert!((exponent(0.0) - 3.7).abs() < 1e-12 && (exponent(1e9) - 3.7).abs() < 1e-6);
        assert!((exponent(10f64.powf(1.5)) - 3.05).abs() < 1e-12);
    }
}
