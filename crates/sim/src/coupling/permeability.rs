//! Permeability of a bed of spheres.

/// Kozeny–Carman: k = ε³ d² / (180 (1 − ε)²) [m²] at porosity ε [-] and Sauter diameter d [m].
///
/// For creeping flow through random beds, ε from 0.3 to 0.6. Infinite without solids.
/// Source: Carman (1937), Trans. Inst. Chem. Eng. 15, 150–166; Alvim (2016), eq. 93.
pub fn kozeny_carman(porosity: f64, sauter_diameter: f64) -> f64 {
    let per_diameter = porosity / (1.0 - porosity) * sauter_diameter;
    porosity * per_diameter * per_diameter / 180.0
}

/// Diameter [m] of equal spheres with as much surface per volume: Σ d³ / Σ d². Not a number for none.
pub fn sauter_diameter(diameters: impl Iterator<Item = f64>) -> f64 {
    let (volumes, surfaces) = diameters.fold((0.0, 0.0), |(volumes, surfaces), d| {
        (volumes + d * d * d, surfaces + d * d)
    });
    volumes / surfaces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cake_of_150_micrometres_at_porosity_0_39_lets_20_square_micrometres_through() {
        let permeability = kozeny_carman(0.39, 150e-6);
        assert!((permeability - 2.0e-11).abs() < 0.02e-11, "{permeability}");
    }

    #[test]
    fn the_ends_are_a_solid_and_an_open_space() {
        assert_eq!(kozeny_carman(0.0, 1e-4), 0.0);
        assert_eq!(kozeny_carman(1.0, 1e-4), f64::INFINITY);
    }

    #[test]
    fn the_sauter_diameter_lies_between_its_members_and_nearer_the_large_ones() {
        assert!((sauter_diameter([2e-4; 7].into_iter()) / 2e-4 - 1.0).abs() < 1e-14);
        let mixed = sauter_diameter([1e-4, 2e-4].into_iter());
        assert!((mixed - 1.8e-4).abs() < 1e-18);
    }
}
