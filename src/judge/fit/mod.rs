//! Fits: from points to parameters with their 95 % confidence intervals.

pub mod autocorrelation;
mod breakpoints;
pub mod levenberg_marquardt;
pub mod richardson_zaki;
pub mod robust;
pub mod segmented;
#[cfg(test)]
mod tests;

use super::statistics::student;

/// A parameter and how far it may be trusted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    pub value: f64,
    pub standard_error: f64,
    /// Degrees of freedom behind the standard error; at least 1.
    pub freedom: f64,
}

impl Estimate {
    /// Half width of the 95 % confidence interval, by Student's t.
    pub fn half_width(&self) -> f64 {
        student(self.freedom) * self.standard_error
    }
}

/// Why there is no fit; what to do.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct FitError(pub String);
