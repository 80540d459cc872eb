//! Grain sizes drawn at random.

use crate::math::Random;

/// A radius between `smallest` and `largest`, all three in one unit, of the density
/// p(R) = R₁R₂/((R₂ − R₁)R²): Alvim (2016) eqs. 91 and 92, R = R₁R₂/(R₂ − Z(R₂ − R₁)) with Z uniform
/// in [0, 1). Small grains are the more frequent.
///
/// Valid for 0 < `smallest` ≤ `largest` < ∞; one number is drawn in any case.
pub fn spread(random: &mut Random, smallest: f64, largest: f64) -> f64 {
    // Divided by the largest so that no product can overflow.
    let ratio = smallest / largest;
    let radius = smallest / (1.0 - random.uniform() * (1.0 - ratio));
    radius.max(smallest).min(largest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_limits_give_exactly_that_radius() {
        assert_eq!(spread(&mut Random::new(1), 0.3, 0.3), 0.3);
    }

    #[test]
    fn the_share_below_a_radius_is_the_integral_of_the_density() {
        let (smallest, largest) = (1.0, 10.0);
        let mut random = Random::new(11);
        let radii: Vec<f64> = (0..100_000)
            .map(|_| spread(&mut random, smallest, largest))
            .collect();
        assert!(radii.iter().all(|r| (smallest..=largest).contains(r)));
        for limit in [1.2, 1.5, 2.0, 4.0, 8.0] {
            // ∫ R₁R₂/((R₂ − R₁)R²) dR from R₁ to the limit.
            let expected = largest / (largest - smallest) * (1.0 - smallest / limit);
            let share = radii.iter().filter(|r| **r < limit).count() as f64 / radii.len() as f64;
            assert!(
                (share - expected).abs() < 0.006,
                "{limit}: {share} for {expected}"
            );
        }
    }
}
