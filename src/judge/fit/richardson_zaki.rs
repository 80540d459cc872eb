//! Hindered settling as a power of the porosity.
//!
//! ```text
//! v = v_∞ ε^n
//! ```
//!
//! Fitted as ln v = ln v_∞ + n ln ε unless told otherwise: settling speeds spread over a decade and are known
//! to a share of themselves, so that dense suspensions count as much as dilute ones, and the fit is a straight
//! line whose interval is exact. On the linear scale the fastest points decide nearly alone.
//!
//! Source: Richardson & Zaki (1954), Trans. Inst. Chem. Eng. 32, 35.

use nalgebra::{DMatrix, DVector};

use super::levenberg_marquardt::{self, Residuals};
use super::{Estimate, FitError};
use crate::judge::statistics::student;

/// In what the squares are summed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scale {
    /// ln v: relative deviations.
    #[default]
    Logarithmic,
    /// v: absolute deviations.
    Linear,
}

#[derive(Clone, Debug)]
pub struct RichardsonZaki {
    /// n [-]
    pub exponent: Estimate,
    /// v_∞, in the unit of the velocities.
    pub velocity: Estimate,
    /// Of ln v_∞ and n.
    covariance: DMatrix<f64>,
}

/// A line through ln v over ln ε.
struct Logarithms {
    across: Vec<f64>,
    up: Vec<f64>,
}

impl Residuals for Logarithms {
    fn residuals(&self, line: &[f64]) -> DVector<f64> {
        let points = self.across.iter().zip(&self.up);
        DVector::from_iterator(self.up.len(), points.map(|(x, y)| line[0] + line[1] * x - y))
    }

    fn jacobian(&self, _: &[f64]) -> DMatrix<f64> {
        DMatrix::from_fn(self.up.len(), 2, |row, column| match column {
            0 => 1.0,
            _ => self.across[row],
        })
    }
}

struct Powers<'a> {
    porosities: &'a [f64],
    velocities: &'a [f64],
}

impl Residuals for Powers<'_> {
    fn residuals(&self, law: &[f64]) -> DVector<f64> {
        let points = self.porosities.iter().zip(self.velocities);
        let left = points.map(|(porosity, velocity)| law[0] * porosity.powf(law[1]) - velocity);
        DVector::from_iterator(self.velocities.len(), left)
    }
}

/// Fits velocities at porosities; at least three points at two porosities or more.
///
/// # Errors
/// Too few points, a porosity outside of 0 to 1, or a velocity that is not above zero.
pub fn fit(porosities: &[f64], velocities: &[f64], scale: Scale) -> Result<RichardsonZaki, FitError> {
    let line = line(porosities, velocities)?;
    let fitted = levenberg_marquardt::fit(&line, &[0.0, 0.0])?;
    let (exponent, level) = (fitted.estimate(1), fitted.estimate(0));
    let velocity = level.value.exp();
    match scale {
        Scale::Logarithmic => Ok(RichardsonZaki {
            exponent,
            velocity: Estimate {
                value: velocity,
                standard_error: velocity * level.standard_error,
                ..level
            },
            covariance: fitted.covariance,
        }),
        Scale::Linear => {
            let powers = Powers {
                porosities,
                velocities,
            };
            let fitted = levenberg_marquardt::fit(&powers, &[velocity, exponent.value])?;
            let mut covariance = fitted.covariance.clone();
            let size = fitted.parameters[0];
            covariance[(0, 0)] /= size * size;
            covariance[(0, 1)] /= size;
            covariance[(1, 0)] /= size;
            Ok(RichardsonZaki {
                velocity: fitted.estimate(0),
                exponent: fitted.estimate(1),
                covariance,
            })
        }
    }
}

/// How far the law of found velocities lies from that of others.
#[derive(Clone, Copy, Debug)]
pub struct Difference {
    /// n less the other n [-].
    pub exponent: Estimate,
    /// ln of v_∞ over the other v_∞ [-].
    pub velocity: Estimate,
}

/// From the ratio of found velocities to others at the same porosities: a line through its logarithm. What both
/// bend away from a power alike widens its interval by nothing.
///
/// # Errors
/// As [`fit`], for either.
pub fn difference(porosities: &[f64], found: &[f64], others: &[f64]) -> Result<Difference, FitError> {
    let (found, others) = (line(porosities, found)?, line(porosities, others)?);
    let ratio = Logarithms {
        up: found
            .up
            .iter()
            .zip(&others.up)
            .map(|(one, other)| one - other)
            .collect(),
        across: found.across,
    };
    let fitted = levenberg_marquardt::fit(&ratio, &[0.0, 0.0])?;
    Ok(Difference {
        exponent: fitted.estimate(1),
        velocity: fitted.estimate(0),
    })
}

fn line(porosities: &[f64], velocities: &[f64]) -> Result<Logarithms, FitError> {
    if let Some(porosity) = porosities
        .iter()
        .find(|porosity| !(**porosity > 0.0 && **porosity <= 1.0))
    {
        return Err(FitError(format!(
            "{porosity} is no porosity: it must lie above 0 and not above 1"
        )));
    }
    if let Some(velocity) = velocities
        .iter()
        .find(|velocity| !(**velocity > 0.0 && velocity.is_finite()))
    {
        return Err(FitError(format!(
            "a power fits velocities above 0, one is {velocity}"
        )));
    }
    Ok(Logarithms {
        across: porosities.iter().map(|porosity| porosity.ln()).collect(),
        up: velocities.iter().map(|velocity| velocity.ln()).collect(),
    })
}

impl RichardsonZaki {
    /// Velocity at a porosity.
    pub fn at(&self, porosity: f64) -> f64 {
        self.velocity.value * porosity.powf(self.exponent.value)
    }

    /// Ends of the 95 % confidence band of the fitted line at a porosity.
    pub fn band(&self, porosity: f64) -> [f64; 2] {
        let across = porosity.ln();
        let variance = self.covariance[(0, 0)]
            + 2.0 * across * self.covariance[(0, 1)]
            + across * across * self.covariance[(1, 1)];
        let half_width = student(self.exponent.freedom) * variance.max(0.0).sqrt();
        [-1.0, 1.0].map(|side| self.at(porosity) * (side * half_width).exp())
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::noise::Noise;
    use super::*;

    const POROSITIES: [f64; 8] = [0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9, 0.95];

    fn power(exponent: f64) -> Vec<f64> {
        POROSITIES
            .iter()
            .map(|porosity| 8e-3 * porosity.powf(exponent))
            .collect()
    }

    #[test]
    fn an_exact_power_is_found_on_both_scales() {
        for scale in [Scale::Logarithmic, Scale::Linear] {
            let fitted = fit(&POROSITIES, &power(4.65), scale).unwrap();
            assert!((fitted.exponent.value - 4.65).abs() < 1e-9, "{scale:?}");
            assert!((fitted.velocity.value / 8e-3 - 1.0).abs() < 1e-9);
            assert!(fitted.exponent.half_width() < 1e-6);
            assert!((fitted.at(1.0) / 8e-3 - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn intervals_and_the_band_hold_the_truth_in_nineteen_of_twenty() {
        let mut held = [0, 0, 0];
        for seed in 0..400 {
            let noise = Noise::new(seed).independent(POROSITIES.len());
            let found: Vec<f64> = power(4.4)
                .iter()
                .zip(noise)
                .map(|(velocity, noise)| velocity * (0.02 * noise).exp())
                .collect();
            let fitted = fit(&POROSITIES, &found, Scale::Logarithmic).unwrap();
            let inside =
                |estimate: Estimate, truth: f64| (estimate.value - truth).abs() <= estimate.half_width();
            held[0] += usize::from(inside(fitted.exponent, 4.4));
            held[1] += usize::from(inside(fitted.velocity, 8e-3));
            let [low, high] = fitted.band(0.7);
            held[2] += usize::from((low..=high).contains(&(8e-3 * 0.7f64.powf(4.4))));
        }
        assert!(
            held.iter().all(|count| (368..=392).contains(count)),
            "{held:?} of 400"
        );
    }

    #[test]
    fn the_scales_weigh_dense_suspensions_differently() {
        let mut velocities = power(4.4);
        velocities[0] *= 1.2;
        let change = |scale| (fit(&POROSITIES, &velocities, scale).unwrap().exponent.value - 4.4).abs();
        assert!(change(Scale::Logarithmic) > 3.0 * change(Scale::Linear));
    }

    #[test]
    fn what_both_share_says_nothing_of_their_difference() {
        // Both bend alike; one is steeper by 0.1.
        let bent = |exponent: f64| -> Vec<f64> {
            let bend = |porosity: &f64| 8e-3 * porosity.powf(exponent) * (1.0 - porosity).exp();
            POROSITIES.iter().map(bend).collect()
        };
        let found = difference(&POROSITIES, &bent(4.5), &bent(4.4)).unwrap().exponent;
        assert!((found.value - 0.1).abs() < 1e-9 && found.half_width() < 1e-6);
        let alone = fit(&POROSITIES, &bent(4.5), Scale::Logarithmic).unwrap();
        assert!(alone.exponent.half_width() > 0.03);
    }

    #[test]
    fn what_is_no_suspension_is_refused() {
        let message = |porosities: &[f64], velocities: &[f64]| {
            fit(porosities, velocities, Scale::Logarithmic).unwrap_err().0
        };
        assert!(message(&[0.5, 1.2, 0.7], &[1.0; 3]).contains("1.2 is no porosity"));
        assert!(message(&[0.5, 0.6, 0.7], &[1.0, 0.0, 1.0]).contains("one is 0"));
        assert!(message(&[0.5, 0.6], &[1.0, 2.0]).contains("2 points"));
        assert!(message(&[0.5; 3], &[1.0, 2.0, 3.0]).contains("do not determine"));
    }
}
