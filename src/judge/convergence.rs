//! Orders of convergence, Richardson extrapolation and the grid convergence index, with a flag that says
//! whether they mean anything.
//!
//! ```text
//! e = C x^p                                          x: spacing, time step; e: error
//! p = |ln|ε₃₂/ε₂₁| + q(p)| / ln r₂₁,   q(p) = ln((r₂₁^p − s)/(r₃₂^p − s)),   s = sign(ε₃₂/ε₂₁)
//! f_0 = f₁ + (f₁ − f₂)/(r₂₁^p − 1)
//! GCI₁ = F_s |(f₁ − f₂)/f₁| / (r₂₁^p − 1),           F_s = 1.25 with three grids, 3 with two
//! ```
//!
//! 1, 2, 3: finest, middle, coarsest; ε₂₁ = f₂ − f₁; r₂₁ = x₂/x₁.
//!
//! Sources: Roache (1994), J. Fluids Eng. 116, 405; Celik et al. (2008), J. Fluids Eng. 130, 078001.

/// Whether an order may be believed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Honesty {
    /// Differences keep their sign and shrink at one order.
    Monotone,
    /// Differences change sign.
    Oscillating,
    /// They do not shrink, or shrink at an order that still changes.
    NotAsymptotic,
    /// Fewer than three sizes.
    TooFew,
}

impl Honesty {
    /// In words, for captions.
    pub fn words(self) -> &'static str {
        match self {
            Honesty::Monotone => "monotone",
            Honesty::Oscillating => "oscillating",
            Honesty::NotAsymptotic => "not asymptotic",
            Honesty::TooFew => "too few sizes",
        }
    }
}

/// Observed order of errors against a known solution.
#[derive(Clone, Debug, PartialEq)]
pub struct Order {
    /// Least-squares slope of ln|e| over ln x; NaN with fewer than two usable sizes.
    pub order: f64,
    /// Factor of the fit: |e| = `coefficient` · x^`order`.
    pub coefficient: f64,
    /// Order between neighbouring sizes, finest pair first.
    pub pairwise: Vec<f64>,
    /// Share of each error in the slope: d order / d ln|e_i|, in the order the errors were given.
    pub weights: Vec<f64>,
    pub honesty: Honesty,
}

/// Neighbouring orders may differ by this share of the fitted one before it counts as not asymptotic.
const ORDER_DRIFT: f64 = 0.5;

/// Observed order of signed errors at sizes x > 0, both given from the finest up.
pub fn observed_order(sizes: &[f64], errors: &[f64]) -> Order {
    let logs = |values: &[f64]| -> Vec<f64> { values.iter().map(|value| value.abs().ln()).collect() };
    let (x, y) = (logs(sizes), logs(errors));
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let (x_mean, y_mean) = (mean(&x), mean(&y));
    let variance: f64 = x.iter().map(|x| (x - x_mean).powi(2)).sum();
    let weights: Vec<f64> = x.iter().map(|x| (x - x_mean) / variance).collect();
    let order = weights.iter().zip(&y).map(|(weight, y)| weight * y).sum::<f64>();
    let pairwise: Vec<f64> = (1..x.len())
        .map(|index| (y[index] - y[index - 1]) / (x[index] - x[index - 1]))
        .collect();
    let honesty = honesty_of_errors(errors, order, &pairwise);
    Order {
        order: if x.len() < 2 { f64::NAN } else { order },
        coefficient: (y_mean - order * x_mean).exp(),
        pairwise,
        weights,
        honesty,
    }
}

fn honesty_of_errors(errors: &[f64], order: f64, pairwise: &[f64]) -> Honesty {
    if errors.len() < 3 {
        return Honesty::TooFew;
    }
    if errors.windows(2).any(|pair| pair[0] * pair[1] < 0.0) {
        return Honesty::Oscillating;
    }
    let least = pairwise.iter().copied().fold(f64::INFINITY, f64::min);
    let greatest = pairwise.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let steady = least > 0.0 && greatest - least <= ORDER_DRIFT * order && order.is_finite();
    if steady {
        Honesty::Monotone
    } else {
        Honesty::NotAsymptotic
    }
}

/// Values on ever finer grids, extrapolated to size zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Extrapolation {
    /// Order p observed on the three finest grids, or assumed with two; `None` where there is none.
    pub order: Option<f64>,
    /// Value at size zero; the finest value where there is no order.
    pub value: f64,
    /// Grid convergence index of each grid but the coarsest, finest first, relative [-]; empty without an order.
    pub indices: Vec<f64>,
    /// GCI₂ / (r₂₁^p GCI₁): near 1 in the asymptotic range; `None` with two grids.
    pub asymptotic_ratio: Option<f64>,
    pub honesty: Honesty,
}

/// Extrapolates values at sizes x > 0, both given from the finest up.
///
/// Three or more grids: the order is observed on the three finest, F_s = 1.25, and a fourth grid's order
/// checks it. Two grids: `assumed` is taken for the order, F_s = 3, and the flag says too few.
pub fn extrapolate(sizes: &[f64], values: &[f64], assumed: f64) -> Extrapolation {
    let honesty = honesty_of_values(sizes, values);
    let (order, safety) = match sizes.len() {
        0 | 1 => (None, f64::NAN),
        2 => (Some(assumed), 3.0),
        _ if honesty == Honesty::Oscillating => (None, 1.25),
        _ => (triple_order(sizes, values), 1.25),
    };
    let finest = values.first().copied().unwrap_or(f64::NAN);
    let Some(p) = order.filter(|p| *p > 0.0) else {
        return Extrapolation {
            order: None,
            value: finest,
            indices: Vec::new(),
            asymptotic_ratio: None,
            honesty,
        };
    };
    let growth = |index: usize| (sizes[index + 1] / sizes[index]).powf(p);
    let indices: Vec<f64> = (0..sizes.len() - 1)
        .map(|index| {
            let change = (values[index] - values[index + 1]) / values[index];
            safety * change.abs() / (growth(index) - 1.0)
        })
        .collect();
    Extrapolation {
        order,
        value: finest + (finest - values[1]) / (growth(0) - 1.0),
        asymptotic_ratio: indices.get(1).map(|next| next / (growth(0) * indices[0])),
        indices,
        honesty,
    }
}

fn honesty_of_values(sizes: &[f64], values: &[f64]) -> Honesty {
    if values.len() < 3 {
        return Honesty::TooFew;
    }
    let changes: Vec<f64> = values.windows(2).map(|pair| pair[1] - pair[0]).collect();
    if changes.windows(2).any(|pair| pair[0] * pair[1] < 0.0) {
        return Honesty::Oscillating;
    }
    let orders: Option<Vec<f64>> = (0..values.len() - 2)
        .map(|start| triple_order(&sizes[start..], &values[start..]))
        .collect();
    let steady = orders.is_some_and(|orders| {
        let finest = orders[0];
        let checked = orders.get(1).copied().unwrap_or(finest);
        finest > 0.0 && (checked - finest).abs() <= ORDER_DRIFT * finest
    });
    if steady {
        Honesty::Monotone
    } else {
        Honesty::NotAsymptotic
    }
}

/// The order on the first three grids (Celik et al. 2008, eq. 3); `None` where none is positive.
///
/// Solved as (r₃₂^p − 1)/(1 − r₂₁^−p) = ε₃₂/ε₂₁, whose left side rises with p, so that the root is unique.
fn triple_order(sizes: &[f64], values: &[f64]) -> Option<f64> {
    let (r21, r32) = (sizes[1] / sizes[0], sizes[2] / sizes[1]);
    let ratio = (values[2] - values[1]) / (values[1] - values[0]);
    let rise = |p: f64| (r32.powf(p) - 1.0) / (1.0 - r21.powf(-p));
    let limit = r32.ln() / r21.ln();
    if !(ratio.is_finite() && ratio > limit) {
        return None;
    }
    let (mut low, mut high) = (0.0, 1.0);
    while rise(high) < ratio {
        high *= 2.0;
        if high > 64.0 {
            return None;
        }
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if rise(middle) < ratio {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some(0.5 * (low + high))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const SIZES: [f64; 5] = [1.5, 2.0, 3.0, 4.0, 6.0];

    fn near(value: f64, expected: f64, tolerance: f64) {
        assert!((value - expected).abs() < tolerance, "{value} for {expected}");
    }

    #[test]
    fn a_second_order_series_has_order_two() {
        let errors = SIZES.map(|x| -0.003 * x * x);
        let order = observed_order(&SIZES, &errors);
        near(order.order, 2.0, 1e-12);
        near(order.coefficient, 0.003, 1e-12);
        assert!(order.pairwise.iter().all(|p| (p - 2.0).abs() < 1e-12));
        assert_eq!(order.honesty, Honesty::Monotone);
    }

    #[test]
    fn the_weights_tell_how_the_slope_moves() {
        let errors = SIZES.map(|x| 0.01 * x);
        let order = observed_order(&SIZES, &errors);
        let mut moved = errors;
        moved[0] *= 1e-3f64.exp();
        let change = observed_order(&SIZES, &moved).order - order.order;
        near(change / 1e-3, order.weights[0], 1e-9);
    }

    #[test]
    fn dishonest_series_are_flagged() {
        let flag = |errors: &[f64]| observed_order(&SIZES[..errors.len()], errors).honesty;
        assert_eq!(flag(&[0.01, -0.02, 0.03]), Honesty::Oscillating);
        assert_eq!(flag(&[0.03, 0.02, 0.03]), Honesty::NotAsymptotic);
        assert_eq!(flag(&[0.03, 0.02, 0.01]), Honesty::NotAsymptotic);
        assert_eq!(flag(&[0.0, 0.02, 0.03]), Honesty::NotAsymptotic);
        assert_eq!(flag(&[0.010, 0.0101, 0.1]), Honesty::NotAsymptotic);
        assert_eq!(flag(&[0.01, 0.02]), Honesty::TooFew);
        assert_eq!(flag(&[]), Honesty::TooFew);
    }

    #[test]
    fn the_pressure_recovery_example_of_roache() {
        // Supersonic inlet, grids halved twice: p = 1.786, f_0 = 0.9713, GCI 0.103 % and 0.356 %.
        let found = extrapolate(&[1.0, 2.0, 4.0], &[0.97050, 0.96854, 0.96178], 2.0);
        near(found.order.unwrap(), 1.786170, 1e-6);
        near(found.value, 0.97130, 5e-6);
        near(found.indices[0], 0.00103083, 1e-8);
        near(found.indices[1], 0.00356249, 1e-7);
        near(found.asymptotic_ratio.unwrap(), 1.0, 0.01);
        assert_eq!(found.honesty, Honesty::Monotone);
    }

    #[test]
    fn the_unequal_ratio_example_of_celik() {
        // Table 1 of the 2008 guideline: r 1.5 and 1.333, p = 1.53, f_0 = 6.1685, GCI 2.2 %.
        let found = extrapolate(&[1.0, 1.5, 2.0], &[6.063, 5.972, 5.863], 2.0);
        near(found.order.unwrap(), 1.53, 0.01);
        near(found.value, 6.1685, 1e-3);
        near(found.indices[0], 0.022, 5e-4);
    }

    #[test]
    fn two_grids_take_the_assumed_order_and_a_larger_margin() {
        let found = extrapolate(&[1.0, 2.0], &[1.01, 1.04], 2.0);
        near(found.value, 1.0, 1e-12);
        near(found.indices[0], 3.0 * 0.01 / 1.01, 1e-12);
        assert_eq!((found.honesty, found.asymptotic_ratio), (Honesty::TooFew, None));
    }

    #[test]
    fn no_order_no_index() {
        for (values, honesty) in [
            (vec![1.0, 1.1, 1.0], Honesty::Oscillating),
            (vec![1.0, 1.2, 1.3], Honesty::NotAsymptotic),
            (vec![1.0, 1.0, 1.0], Honesty::NotAsymptotic),
            (vec![1.0], Honesty::TooFew),
        ] {
            let found = extrapolate(&[1.0, 2.0, 4.0][..values.len()], &values, 2.0);
            assert_eq!((found.honesty, found.order), (honesty, None), "{values:?}");
            assert_eq!(found.value, 1.0);
            assert!(found.indices.is_empty());
        }
    }

    #[test]
    fn a_fourth_grid_out_of_line_is_noticed() {
        let mut values = [1.0, 2.0, 4.0, 8.0].map(|x: f64| 1.0 + 0.01 * x * x);
        assert_eq!(
            extrapolate(&[1.0, 2.0, 4.0, 8.0], &values, 2.0).honesty,
            Honesty::Monotone
        );
        values[3] = 1.30;
        assert_eq!(
            extrapolate(&[1.0, 2.0, 4.0, 8.0], &values, 2.0).honesty,
            Honesty::NotAsymptotic
        );
    }

    proptest! {
        #[test]
        fn a_manufactured_order_comes_back(
            p in 0.5f64..4.0, limit in -5.0f64..5.0, factor in 0.01f64..1.0, r21 in 1.2f64..3.0, r32 in 1.2f64..3.0,
        ) {
            let sizes = [1.0, r21, r21 * r32];
            let values = sizes.map(|x| limit + factor * x.powf(p));
            let found = extrapolate(&sizes, &values, 2.0);
            prop_assert!((found.order.unwrap() - p).abs() < 1e-6 * p);
            prop_assert!((found.value - limit).abs() < 1e-5);
        }
    }
}
