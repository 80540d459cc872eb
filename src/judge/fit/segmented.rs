//! Robust regression of a time series by one, two or three straight segments that join.
//!
//! ```text
//! y = a + b t + Σ c_k (t − τ_k)₊                    slopes b, b + c_1, b + c_1 + c_2; joints τ_k
//! C = K² s² (JᵀJ)⁻¹,   s² = Σψ²/(n_eff − p) / (Σψ′/n)²,   K = 1 + (p/n)(1 − Σψ′/n)/(Σψ′/n)
//! ```
//!
//! The joints are searched for on a grid of all places; outliers count less by Huber's weights, anew until
//! nothing moves. J has a column for each joint, so that slopes know that the joints are uncertain. Intervals
//! take the autocorrelation of the series into account: its n samples are worth n_eff independent ones, and
//! Student's t has n_eff − p degrees of freedom.
//!
//! Sources: Huber (1981), Robust Statistics, §7.6; Feder (1975), Ann. Stat. 3, 49 (joints); effective number
//! of samples: see [`effective_count`].

use nalgebra::DMatrix;

use super::autocorrelation::effective_count;
use super::breakpoints::{self, Series};
use super::levenberg_marquardt::inverse_of_normal_matrix;
use super::{Estimate, FitError, robust};

/// Points that a segment needs at least.
const LEAST: usize = 5;
pub const MOST_SEGMENTS: usize = 3;
/// Rounds of weighting.
const MOST_ROUNDS: usize = 30;
/// Residuals below this share of the range of the values are rounding.
const ROUNDING: f64 = 1e-12;

/// A continuous line of straight segments.
#[derive(Clone, Debug)]
pub struct Segmented {
    /// One per segment, in the unit of the values over that of the times.
    pub slopes: Vec<Estimate>,
    /// Times at which segments join.
    pub joints: Vec<Estimate>,
    /// How many independent samples the series is worth.
    pub effective_count: f64,
    /// a, b, c_1, …
    coefficients: Vec<f64>,
    /// Of a, b, c_1, …, τ_1, …
    covariance: DMatrix<f64>,
    origin: f64,
}

/// The line through one segment: value at a time, and what they say of each other.
#[derive(Clone, Copy, Debug)]
pub struct Straight {
    pub slope: Estimate,
    pub origin: f64,
    /// Value at `origin`.
    pub intercept: f64,
    pub intercept_variance: f64,
    pub covariance: f64,
}

/// Fits `segments` segments to values at times that rise.
///
/// # Errors
/// Too few points, times that do not rise, values that are not finite, segments that cannot be told apart.
pub fn fit(times: &[f64], values: &[f64], segments: usize) -> Result<Segmented, FitError> {
    check(times, values, segments)?;
    let range = |values: &[f64]| {
        let (low, high) = values
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
                (low.min(*value), high.max(*value))
            });
        (high - low).max(f64::MIN_POSITIVE)
    };
    let rounding = ROUNDING * range(values);
    let mut weights = vec![1.0; times.len()];
    let mut found = weighted((times, values), &weights, segments, None)?;
    for round in 0..MOST_ROUNDS {
        weights = robust::weights(&found.residuals, rounding);
        // Outliers may have led the first search astray.
        let near = (round > 1).then_some(found.joints.as_slice());
        let next = weighted((times, values), &weights, segments, near)?;
        let moved = next.residuals.iter().zip(&found.residuals);
        let moved = moved.map(|(new, old)| (new - old).abs()).fold(0.0, f64::max);
        let still = moved <= 1e-6 * robust::scatter(&next.residuals) || moved <= rounding;
        found = next;
        if still {
            break;
        }
    }
    found.judged(&weights)
}

fn check(times: &[f64], values: &[f64], segments: usize) -> Result<(), FitError> {
    let needed = LEAST * segments;
    if times.len() < needed {
        let points = times.len();
        return Err(FitError(format!(
            "{points} samples for {segments} segments, {needed} are needed: widen `from` and `to`, or keep more samples"
        )));
    }
    if !times.iter().chain(values).all(|value| value.is_finite()) {
        return Err(FitError(
            "the series holds a value that is not finite".to_string(),
        ));
    }
    match times.windows(2).all(|pair| pair[1] > pair[0]) {
        true => Ok(()),
        false => Err(FitError("the times of the series do not rise".to_string())),
    }
}

/// A fit under given weights.
struct Weighted {
    times: Vec<f64>,
    joints: Vec<f64>,
    coefficients: Vec<f64>,
    residuals: Vec<f64>,
    origin: f64,
}

fn weighted(
    (times, values): (&[f64], &[f64]),
    weights: &[f64],
    segments: usize,
    near: Option<&[f64]>,
) -> Result<Weighted, FitError> {
    let series = Series {
        times,
        values,
        weights,
    };
    let joints = match segments {
        1 => Vec::new(),
        _ => breakpoints::search(&series, segments - 1, LEAST, near)
            .ok_or_else(|| FitError(format!("the series cannot be parted into {segments} segments")))?,
    };
    let origin = times[0];
    let basis = basis(times, &joints, origin);
    let roots: Vec<f64> = weights.iter().map(|weight| weight.sqrt()).collect();
    let mut left = basis.clone();
    for (index, root) in roots.iter().enumerate() {
        left.row_mut(index).scale_mut(*root);
    }
    let mut right = nalgebra::DVector::from_fn(values.len(), |index, _| values[index] * roots[index]);
    let count = basis.ncols();
    let factors = left.qr();
    factors.q_tr_mul(&mut right);
    let coefficients = factors
        .unpack_r()
        .solve_upper_triangular(&right.rows(0, count).into_owned())
        .ok_or_else(|| FitError("the samples do not determine a line".to_string()))?;
    let fitted = &basis * &coefficients;
    Ok(Weighted {
        times: times.to_vec(),
        joints,
        coefficients: coefficients.as_slice().to_vec(),
        residuals: values
            .iter()
            .zip(fitted.iter())
            .map(|(value, line)| value - line)
            .collect(),
        origin,
    })
}

/// Columns 1, t, (t − τ_k)₊.
fn basis(times: &[f64], joints: &[f64], origin: f64) -> DMatrix<f64> {
    DMatrix::from_fn(times.len(), 2 + joints.len(), |row, column| match column {
        0 => 1.0,
        1 => times[row] - origin,
        column => (times[row] - joints[column - 2]).max(0.0),
    })
}

impl Weighted {
    /// With slopes, joints and their uncertainty.
    fn judged(self, weights: &[f64]) -> Result<Segmented, FitError> {
        let straight = basis(&self.times, &self.joints, self.origin);
        let (points, own) = straight.shape();
        let count = own + self.joints.len();
        let jacobian = DMatrix::from_fn(points, count, |row, column| match column.checked_sub(own) {
            None => straight[(row, column)],
            Some(joint) if self.times[row] > self.joints[joint] => -self.coefficients[2 + joint],
            Some(_) => 0.0,
        });
        // What Huber's weights leave of each residual.
        let kept: Vec<f64> = self
            .residuals
            .iter()
            .zip(weights)
            .map(|(left, weight)| left * weight)
            .collect();
        let effective_count = effective_count(&kept);
        let inside = weights.iter().filter(|weight| **weight == 1.0).count() as f64 / points as f64;
        let squares: f64 = kept.iter().map(|left| left * left).sum();
        let correction = 1.0 + count as f64 / points as f64 * (1.0 - inside) / inside;
        let freedom = (effective_count - count as f64).max(1.0);
        let variance = correction.powi(2) * squares / freedom / inside.powi(2);
        let covariance = inverse_of_normal_matrix(&jacobian)
            .map_err(|_| FitError("neighbouring segments have one slope: ask for fewer".to_string()))?
            * variance;
        let estimate = |value: f64, variance: f64| Estimate {
            value,
            standard_error: variance.max(0.0).sqrt(),
            freedom,
        };
        let slopes = (1..own).map(|last| {
            let indices = || 1..=last;
            let value: f64 = indices().map(|index| self.coefficients[index]).sum();
            let pairs = indices().flat_map(|row| indices().map(move |column| (row, column)));
            estimate(value, pairs.map(|pair| covariance[pair]).sum())
        });
        let joints = self.joints.iter().enumerate();
        let joints = joints.map(|(index, joint)| estimate(*joint, covariance[(own + index, own + index)]));
        Ok(Segmented {
            slopes: slopes.collect(),
            joints: joints.collect(),
            effective_count,
            coefficients: self.coefficients,
            covariance,
            origin: self.origin,
        })
    }
}

impl Segmented {
    /// Value of the line at a time.
    pub fn at(&self, time: f64) -> f64 {
        let ramps = self.joints.iter().map(|joint| (time - joint.value).max(0.0));
        let basis = [1.0, time - self.origin].into_iter().chain(ramps);
        self.coefficients
            .iter()
            .zip(basis)
            .map(|(factor, term)| factor * term)
            .sum()
    }

    /// The line through a segment, prolonged to both sides; segments count from zero.
    pub fn straight(&self, segment: usize) -> Straight {
        let origin = self.origin;
        let count = self.coefficients.len();
        // Intercept: a − Σ c_k τ_k over the joints before; gradients by a, b, c and τ.
        let size = self.covariance.nrows();
        let mut by = vec![0.0; size];
        let mut slope_by = vec![0.0; size];
        by[0] = 1.0;
        slope_by[1] = 1.0;
        let mut intercept = self.coefficients[0];
        for joint in 0..segment {
            let (change, at) = (self.coefficients[2 + joint], self.joints[joint].value - origin);
            intercept -= change * at;
            by[2 + joint] = -at;
            by[count + joint] = -change;
            slope_by[2 + joint] = 1.0;
        }
        let product = |one: &[f64], other: &[f64]| -> f64 {
            let pairs = (0..size).flat_map(|row| (0..size).map(move |column| (row, column)));
            pairs
                .map(|(row, column)| one[row] * self.covariance[(row, column)] * other[column])
                .sum()
        };
        Straight {
            slope: self.slopes[segment],
            origin,
            intercept,
            intercept_variance: product(&by, &by),
            covariance: product(&by, &slope_by),
        }
    }
}

impl Straight {
    /// Value of the line at a time.
    pub fn at(&self, time: f64) -> Estimate {
        Estimate {
            value: self.intercept + self.slope.value * (time - self.origin),
            standard_error: self.variance_at(time).max(0.0).sqrt(),
            freedom: self.slope.freedom,
        }
    }

    fn variance_at(&self, time: f64) -> f64 {
        let distance = time - self.origin;
        self.intercept_variance
            + 2.0 * distance * self.covariance
            + (distance * self.slope.standard_error).powi(2)
    }
}

/// Where two lines meet: time and value.
///
/// # Errors
/// Lines that are parallel.
pub fn meeting(one: &Straight, other: &Straight) -> Result<[Estimate; 2], FitError> {
    let difference = one.slope.value - other.slope.value;
    let from = one.origin;
    let shifted = other.intercept + other.slope.value * (from - other.origin);
    let span = (shifted - one.intercept) / difference;
    let certain = one.slope.standard_error.hypot(other.slope.standard_error);
    if !span.is_finite() || difference.abs() <= certain {
        return Err(FitError(
            "the two lines run alongside each other and do not meet".to_string(),
        ));
    }
    let (first, second) = (one.variance_at(from + span), other.variance_at(from + span));
    let freedom = one.slope.freedom.min(other.slope.freedom);
    let estimate = |value: f64, variance: f64| Estimate {
        value,
        standard_error: variance.max(0.0).sqrt(),
        freedom,
    };
    // The value lies on both lines: y = (b₁ y₂ − b₂ y₁)/(b₁ − b₂) in what moves each of them.
    let share = [other.slope.value, one.slope.value].map(|slope| (slope / difference).powi(2));
    Ok([
        estimate(from + span, (first + second) / difference.powi(2)),
        estimate(
            one.intercept + one.slope.value * span,
            share[0] * first + share[1] * second,
        ),
    ])
}
