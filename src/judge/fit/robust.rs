//! Weights that keep single outliers from bending a fit.
//!
//! ```text
//! w(r) = min(1, k σ/|r|),   σ = 1.4826 median|r|,   k = 1.345
//! ```
//!
//! Source: Huber (1964), Ann. Math. Stat. 35, 73; k for 95 % efficiency on normal errors.

/// Where a residual begins to count less, over σ.
const TUNING: f64 = 1.345;
/// Median of |r| to standard deviation for normal errors.
const NORMAL: f64 = 1.4826;

/// Robust standard deviation about zero.
pub fn scatter(residuals: &[f64]) -> f64 {
    let mut sizes: Vec<f64> = residuals.iter().map(|residual| residual.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    match sizes.len() {
        0 => f64::NAN,
        count => NORMAL * (sizes[(count - 1) / 2] + sizes[count / 2]) / 2.0,
    }
}

/// Huber's weights, 1 throughout where the residuals have no scatter beyond `least`, which is rounding.
pub fn weights(residuals: &[f64], least: f64) -> Vec<f64> {
    let limit = TUNING * scatter(residuals);
    let weight = |residual: &f64| match residual.abs() {
        size if limit <= least || size <= limit => 1.0,
        size => limit / size,
    };
    residuals.iter().map(weight).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_lies_within_counts_in_full_and_beyond_as_much_as_at_the_limit() {
        let residuals = [0.1, -0.1, 0.1, -0.1, 0.1, 50.0];
        let weights = weights(&residuals, 0.0);
        assert_eq!(weights[..5], [1.0; 5]);
        assert!((weights[5] * 50.0 - TUNING * NORMAL * 0.1).abs() < 1e-12);
    }

    #[test]
    fn scatter_is_that_of_the_bulk() {
        // Quantiles of the normal distribution at 1/8, 3/8, 5/8, 7/8, and something absurd.
        assert!((scatter(&[-0.674_49, 0.674_49]) - 1.0).abs() < 1e-4);
        let bulk: Vec<f64> = (0..99).map(|index| f64::from(index % 11) - 5.0).collect();
        let mut spoiled = bulk.clone();
        spoiled.push(1e9);
        assert!((scatter(&spoiled) / scatter(&bulk) - 1.0).abs() < 0.4);
        assert_eq!(weights(&[0.0, 0.0, 1.0], 0.0), [1.0; 3]);
    }
}
