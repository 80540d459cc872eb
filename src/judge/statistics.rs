//! Means over seeds and how far they may be trusted.
//!
//! ```text
//! m = Σx/n,   s² = Σ(x − m)²/(n − 1),   e = s/√n,   half width = t(0.975, n − 1) e
//! ```
//!
//! Source: Student (1908), Biometrika 6, 1; for two means Welch (1947), Biometrika 34, 28.

/// Two-sided 95 % quantiles of Student's t for 1 to 30 degrees of freedom.
const STUDENT: [f64; 30] = [
    12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.160, 2.145, 2.131,
    2.120, 2.110, 2.101, 2.093, 2.086, 2.080, 2.074, 2.069, 2.064, 2.060, 2.056, 2.052, 2.048, 2.045, 2.042,
];

/// Two-sided 95 % quantile of the normal distribution.
const NORMAL: f64 = 1.960;

/// A mean over seeds in the unit of its values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    pub count: usize,
    pub mean: f64,
    /// Sample standard deviation; zero for one value.
    pub deviation: f64,
    /// Half width of the 95 % confidence interval that a single value comes with; zero for none.
    pub own: f64,
}

impl Sample {
    /// NaN throughout for no values.
    pub fn of(values: impl IntoIterator<Item = f64>) -> Sample {
        let values: Vec<f64> = values.into_iter().collect();
        let count = values.len();
        let mean = values.iter().sum::<f64>() / count as f64;
        let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
        let deviation = match count {
            0 => f64::NAN,
            1 => 0.0,
            _ => (squares / (count - 1) as f64).sqrt(),
        };
        Sample {
            count,
            mean,
            deviation,
            own: 0.0,
        }
    }

    /// One value that comes with an interval of its own. Over several seeds their scatter tells more.
    pub fn measured(value: f64, half_width: f64) -> Sample {
        Sample {
            own: half_width,
            ..Sample::of([value])
        }
    }

    /// Standard error of the mean; for one value, what its own interval says.
    pub fn standard_error(&self) -> f64 {
        if self.count == 1 {
            return self.own / NORMAL;
        }
        self.deviation / (self.count as f64).sqrt()
    }

    /// Half width of the 95 % confidence interval of the mean; for one value its own, zero where nothing is
    /// known of it.
    pub fn half_width(&self) -> f64 {
        match self.count {
            0 | 1 => self.own,
            count => student((count - 1) as f64) * self.standard_error(),
        }
    }

    /// Standard error of the difference of two means.
    pub fn standard_error_of_difference(&self, other: &Sample) -> f64 {
        self.standard_error().hypot(other.standard_error())
    }

    /// Half width of the 95 % confidence interval of the difference of two means (Welch).
    pub fn half_width_of_difference(&self, other: &Sample) -> f64 {
        let variances = [self, other].map(|sample| sample.standard_error().powi(2));
        let total = variances[0] + variances[1];
        if total == 0.0 {
            return 0.0;
        }
        let share = |variance: f64, sample: &Sample| match sample.count {
            0 | 1 => 0.0,
            count => variance.powi(2) / (count - 1) as f64,
        };
        let freedom = total.powi(2) / (share(variances[0], self) + share(variances[1], other));
        // Intervals of single values hold their quantile already.
        match freedom.is_finite() {
            true => student(freedom) * total.sqrt(),
            false => NORMAL * total.sqrt(),
        }
    }
}

/// The quantile for the whole degrees of freedom at or below; beyond 30 the first terms of its expansion.
pub(super) fn student(freedom: f64) -> f64 {
    let whole = (freedom + 1e-9).floor().max(1.0);
    match STUDENT.get(whole as usize - 1) {
        Some(quantile) => *quantile,
        None => NORMAL + 2.372 / freedom,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_interval_shrinks_with_seeds_and_vanishes_without_scatter() {
        let of = |count: usize| Sample::of((0..count).map(|index| [1.0, 3.0][index % 2]));
        let widths: Vec<f64> = [2, 4, 8, 16, 32, 64, 128]
            .map(|count| of(count).half_width())
            .to_vec();
        assert!(widths.windows(2).all(|pair| pair[1] < pair[0]), "{widths:?}");
        assert_eq!(Sample::of([5.0, 5.0, 5.0]).half_width(), 0.0);
        assert_eq!(Sample::of([5.0]).half_width(), 0.0);
        assert!(Sample::of([]).mean.is_nan());
    }

    #[test]
    fn the_interval_of_a_textbook_sample() {
        // Student (1908), sleep data, additional hours with drug 1: mean 0.75, 95 % interval −0.53 to 2.03.
        let hours = [0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0];
        let sample = Sample::of(hours);
        assert!((sample.mean - 0.75).abs() < 1e-12);
        assert!(
            (sample.half_width() - 1.28).abs() < 0.005,
            "{}",
            sample.half_width()
        );
    }

    #[test]
    fn two_means_of_the_same_scatter_are_less_certain_than_either_and_symmetric() {
        let (one, other) = (
            Sample::of([1.0, 2.0, 3.0, 4.0]),
            Sample::of([11.0, 12.0, 13.0, 14.0]),
        );
        let width = one.half_width_of_difference(&other);
        assert_eq!(width, other.half_width_of_difference(&one));
        // Six degrees of freedom: t = 2.447.
        assert!((width / one.standard_error_of_difference(&other) - 2.447).abs() < 1e-9);
        let certain = Sample::of([5.0]);
        assert!((one.half_width_of_difference(&certain) - one.half_width()).abs() < 1e-12);
        assert_eq!(certain.half_width_of_difference(&certain), 0.0);
    }

    #[test]
    fn quantiles_fall_towards_the_normal_one() {
        let quantiles: Vec<f64> = (1..200).map(|freedom| student(f64::from(freedom))).collect();
        assert!(quantiles.windows(2).all(|pair| pair[1] < pair[0]));
        assert!((quantiles[198] - 1.972).abs() < 1e-3);
    }
}
