//! How many independent values a time series is worth.
//!
//! ```text
//! n_eff = n/τ,   τ = max(1, 2 Σ_{m=0}^{M} Γ_m − 1),   Γ_m = ρ_{2m} + ρ_{2m+1} while Γ_m > 0
//! ```
//!
//! ρ: autocorrelation of what a fit leaves, at equal steps of the sample number. Neighbouring samples of a
//! simulation repeat each other; an interval that takes them for independent is far too narrow. What a
//! model does not follow is correlated over the whole window and counts as little as it should.
//!
//! Source: Geyer (1992), Stat. Sci. 7, 473 (initial positive sequence); Bayley & Hammersley (1946), J. R.
//! Stat. Soc. Suppl. 8, 184.

/// Between 1 and the number of values.
pub fn effective_count(residuals: &[f64]) -> f64 {
    let count = residuals.len();
    let variance: f64 = residuals.iter().map(|residual| residual * residual).sum();
    if count < 2 || variance == 0.0 {
        return count as f64;
    }
    let correlation = |lag: usize| -> f64 {
        let pairs = residuals.iter().zip(residuals.iter().skip(lag));
        pairs.map(|(one, other)| one * other).sum::<f64>() / variance
    };
    let mut time = -1.0;
    for lag in (0..count.saturating_sub(1)).step_by(2) {
        let pair = correlation(lag) + correlation(lag + 1);
        if pair <= 0.0 {
            break;
        }
        time += 2.0 * pair;
    }
    (count as f64 / time.max(1.0)).max(1.0)
}

#[cfg(test)]
mod tests {
    use super::super::tests::noise::Noise;
    use super::*;

    #[test]
    fn independent_values_count_in_full() {
        let values = Noise::new(1).independent(2000);
        let count = effective_count(&values);
        assert!(count > 1700.0 && count <= 2000.0, "{count}");
    }

    #[test]
    fn a_process_with_memory_is_worth_what_theory_says() {
        // First-order autoregression: τ = (1 + ρ)/(1 − ρ).
        for memory in [0.5, 0.8, 0.9] {
            let counts = (0..20).map(|seed| effective_count(&Noise::new(seed).with_memory(memory, 4000)));
            let mean = counts.sum::<f64>() / 20.0;
            let expected = 4000.0 * (1.0 - memory) / (1.0 + memory);
            assert!(
                (mean / expected - 1.0).abs() < 0.15,
                "{memory}: {mean} of {expected}"
            );
        }
    }

    #[test]
    fn a_slow_wave_is_worth_almost_nothing_and_an_alternating_one_not_more_than_it_has() {
        let wave: Vec<f64> = (0..1000)
            .map(|index| (f64::from(index) * 6.28e-3).sin())
            .collect();
        assert!(effective_count(&wave) < 10.0);
        let alternating: Vec<f64> = (0..1000).map(|index| f64::from(index % 2) - 0.5).collect();
        assert_eq!(effective_count(&alternating), 1000.0);
        assert_eq!(effective_count(&[0.0; 7]), 7.0);
    }
}
