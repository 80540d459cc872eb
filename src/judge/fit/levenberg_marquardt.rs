//! Nonlinear least squares.
//!
//! ```text
//! min |r(p)|²:   (JᵀJ + λ D²) δ = −Jᵀ r,   by QR of J stacked on √λ D,   D: largest column norms of J so far
//! C = s² (JᵀJ)⁻¹ = s² R⁻¹ R⁻ᵀ,   s² = |r|²/(m − n)
//! ```
//!
//! m residuals, n parameters. λ follows the ratio of the decrease found to the one predicted.
//!
//! Sources: Levenberg (1944), Q. Appl. Math. 2, 164; Marquardt (1963), J. SIAM 11, 431; scaling by
//! Moré (1978), Lecture Notes in Mathematics 630, 105; λ by Nielsen (1999), IMM-REP-1999-05.

use nalgebra::{DMatrix, DVector};

use super::{Estimate, FitError};

/// A least-squares problem.
pub trait Residuals {
    /// What the fit leaves at these parameters, one per point; not finite where the model is not defined.
    fn residuals(&self, parameters: &[f64]) -> DVector<f64>;

    /// Derivative of each residual (row) by each parameter (column); central differences unless told.
    fn jacobian(&self, parameters: &[f64]) -> DMatrix<f64> {
        central_differences(|parameters| self.residuals(parameters), parameters)
    }
}

/// Parameters at the least sum of squares.
#[derive(Clone, Debug)]
pub struct Fit {
    pub parameters: Vec<f64>,
    pub sum_of_squares: f64,
    /// Points beyond the number of parameters.
    pub freedom: usize,
    pub covariance: DMatrix<f64>,
}

impl Fit {
    pub fn standard_error(&self, index: usize) -> f64 {
        self.covariance[(index, index)].max(0.0).sqrt()
    }

    pub fn estimate(&self, index: usize) -> Estimate {
        Estimate {
            value: self.parameters[index],
            standard_error: self.standard_error(index),
            freedom: self.freedom as f64,
        }
    }
}

/// Steps before a fit is given up; the curved valley of MGH10 takes thousands from its far start.
const MOST_STEPS: usize = 20000;
/// Cosine between the residuals and the columns of the Jacobian at a minimum.
const ORTHOGONAL: f64 = 1e-13;
/// The same where rounding ends the search earlier.
const NEARLY_ORTHOGONAL: f64 = 1e-6;
/// Residuals this small beside the terms of the model are rounding.
const EXACT: f64 = 1e-14;
/// A step this small beside the parameters is none.
const STANDSTILL: f64 = 1e-14;
/// A step this many times the parameters goes where the linear model says nothing.
const REACH: f64 = 10.0;
const FIRST_DAMPING: f64 = 1e-3;

/// The minimum that is reached downhill from `start`.
///
/// # Errors
/// No more points than parameters, a start where the model is not finite, no minimum, or parameters that
/// the points do not determine.
pub fn fit(problem: &impl Residuals, start: &[f64]) -> Result<Fit, FitError> {
    let mut parameters = DVector::from_column_slice(start);
    let mut residuals = problem.residuals(start);
    let (points, count) = (residuals.len(), start.len());
    if points <= count {
        return Err(FitError(format!(
            "{points} points for {count} parameters: nothing is left to tell how certain they are"
        )));
    }
    if !residuals.norm_squared().is_finite() {
        return Err(FitError(
            "the model is not finite where the fit starts".to_string(),
        ));
    }
    let mut scale = DVector::zeros(count);
    let mut damping = Damping::new();
    for _ in 0..MOST_STEPS {
        let jacobian = problem.jacobian(parameters.as_slice());
        let norms = column_norms(&jacobian);
        scale = norms.zip_map(&scale, f64::max);
        let exact = residuals.norm() <= EXACT * norms.dot(&parameters.abs());
        if exact || obliquity(&jacobian, &norms, &residuals) <= ORTHOGONAL {
            return finished(jacobian, parameters, &residuals);
        }
        loop {
            let step = damped_step(&jacobian, &residuals, &scale, damping.factor)
                .ok_or_else(|| FitError("the points do not determine the parameters".to_string()))?;
            let moved = step.component_mul(&scale).norm();
            let size = parameters.component_mul(&scale).norm();
            if moved <= STANDSTILL * size {
                return match obliquity(&jacobian, &norms, &residuals) <= NEARLY_ORTHOGONAL {
                    true => finished(jacobian, parameters, &residuals),
                    false => Err(FitError("the fit finds no minimum from its start".to_string())),
                };
            }
            let trial = &parameters + &step;
            let left = problem.residuals(trial.as_slice());
            let gained = residuals.norm_squared() - left.norm_squared();
            let promised = residuals.norm_squared() - (&residuals + &jacobian * &step).norm_squared();
            if gained > 0.0 && (size == 0.0 || moved <= REACH * size) {
                damping.relax(gained / promised);
                (parameters, residuals) = (trial, left);
                break;
            }
            damping.tighten();
        }
    }
    Err(FitError(format!(
        "the fit does not end within {MOST_STEPS} steps"
    )))
}

/// λ: small where the linear model is right, large where it is not.
struct Damping {
    factor: f64,
    growth: f64,
}

impl Damping {
    fn new() -> Damping {
        Damping {
            factor: FIRST_DAMPING,
            growth: 2.0,
        }
    }

    fn relax(&mut self, ratio: f64) {
        self.factor *= (1.0 - (2.0 * ratio - 1.0).powi(3)).clamp(1.0 / 3.0, 2.0);
        self.growth = 2.0;
    }

    fn tighten(&mut self) {
        self.factor *= self.growth;
        self.growth *= 2.0;
    }
}

/// Largest cosine between the residuals and a column of the Jacobian; zero where nothing is left over.
fn obliquity(jacobian: &DMatrix<f64>, norms: &DVector<f64>, residuals: &DVector<f64>) -> f64 {
    let gradient = jacobian.tr_mul(residuals);
    let length = residuals.norm();
    let cosine = |(slope, norm): (&f64, &f64)| match norm * length {
        0.0 => 0.0,
        product => slope.abs() / product,
    };
    gradient.iter().zip(norms.iter()).map(cosine).fold(0.0, f64::max)
}

fn column_norms(jacobian: &DMatrix<f64>) -> DVector<f64> {
    DVector::from_iterator(
        jacobian.ncols(),
        jacobian.column_iter().map(|column| column.norm()),
    )
}

fn damped_step(
    jacobian: &DMatrix<f64>,
    residuals: &DVector<f64>,
    scale: &DVector<f64>,
    damping: f64,
) -> Option<DVector<f64>> {
    let (points, count) = jacobian.shape();
    let mut stacked = jacobian.clone().resize_vertically(points + count, 0.0);
    for (index, scale) in scale.iter().enumerate() {
        stacked[(points + index, index)] = damping.sqrt() * scale;
    }
    let mut target = (-residuals).resize_vertically(points + count, 0.0);
    let factors = stacked.qr();
    factors.q_tr_mul(&mut target);
    let step = factors
        .unpack_r()
        .solve_upper_triangular(&target.rows(0, count).into_owned())?;
    step.iter().all(|part| part.is_finite()).then_some(step)
}

fn finished(
    jacobian: DMatrix<f64>,
    parameters: DVector<f64>,
    residuals: &DVector<f64>,
) -> Result<Fit, FitError> {
    let freedom = residuals.len() - parameters.len();
    let sum_of_squares = residuals.norm_squared();
    let inverse = inverse_of_normal_matrix(&jacobian)?;
    Ok(Fit {
        parameters: parameters.as_slice().to_vec(),
        covariance: inverse * (sum_of_squares / freedom as f64),
        sum_of_squares,
        freedom,
    })
}

/// (JᵀJ)⁻¹ by QR of the columns brought to length one.
///
/// # Errors
/// Columns that depend on each other.
pub fn inverse_of_normal_matrix(jacobian: &DMatrix<f64>) -> Result<DMatrix<f64>, FitError> {
    let undetermined = || FitError("the points do not determine the parameters".to_string());
    let count = jacobian.ncols();
    let norms = column_norms(jacobian);
    let mut scaled = jacobian.clone();
    for (mut column, norm) in scaled.column_iter_mut().zip(norms.iter()) {
        column /= *norm;
    }
    let upper = scaled.qr().unpack_r();
    if !upper.diagonal().iter().all(|edge| edge.abs() > 1e-14) {
        return Err(undetermined());
    }
    let inverse = upper
        .solve_upper_triangular(&DMatrix::identity(count, count))
        .ok_or_else(undetermined)?;
    let mut product = &inverse * inverse.transpose();
    for row in 0..count {
        for column in 0..count {
            product[(row, column)] /= norms[row] * norms[column];
        }
    }
    Ok(product)
}

/// Derivatives of a vector by each parameter, to about ten digits.
fn central_differences(function: impl Fn(&[f64]) -> DVector<f64>, parameters: &[f64]) -> DMatrix<f64> {
    let columns: Vec<DVector<f64>> = (0..parameters.len())
        .map(|index| {
            let at = |step: f64| {
                let mut moved = parameters.to_vec();
                moved[index] += step;
                (moved[index], function(&moved))
            };
            let size = match parameters[index] {
                0.0 => 1.0,
                value => value.abs(),
            };
            let step = f64::EPSILON.cbrt() * size;
            let ((above, high), (below, low)) = (at(step), at(-step));
            (high - low) / (above - below)
        })
        .collect();
    DMatrix::from_columns(&columns)
}
