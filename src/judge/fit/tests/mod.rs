pub mod noise;
mod series;
mod strd;

use nalgebra::{DMatrix, DVector};

use super::levenberg_marquardt::{Residuals, fit};
use strd::{PROBLEMS, Problem};

impl Residuals for Problem {
    fn residuals(&self, parameters: &[f64]) -> DVector<f64> {
        let points = self.data.chunks_exact(2);
        let left: Vec<f64> = points
            .map(|point| (self.model)(parameters, point[1]) - point[0])
            .collect();
        DVector::from_vec(left)
    }
}

/// Digits in which two numbers agree.
fn digits(found: f64, expected: f64) -> f64 {
    -(found / expected - 1.0).abs().max(1e-16).log10()
}

#[test]
fn certified_parameters_and_standard_deviations_are_met_to_six_digits_from_both_starts() {
    for problem in &PROBLEMS {
        for start in problem.starts {
            let found =
                fit(problem, start).unwrap_or_else(|why| panic!("{} from {start:?}: {why}", problem.name));
            let squares = digits(found.sum_of_squares, problem.sum_of_squares);
            assert!(
                squares > 8.0,
                "{}: sum of squares to {squares:.1} digits",
                problem.name
            );
            for index in 0..start.len() {
                let value = digits(found.parameters[index], problem.certified[index]);
                let deviation = digits(found.standard_error(index), problem.standard_deviations[index]);
                assert!(
                    value > 6.0 && deviation > 6.0,
                    "{} from {start:?}: b{} to {value:.1} digits, its deviation to {deviation:.1}",
                    problem.name,
                    index + 1
                );
            }
        }
    }
}

/// Misra1a with its derivatives.
struct Analytic<'a>(&'a Problem);

impl Residuals for Analytic<'_> {
    fn residuals(&self, parameters: &[f64]) -> DVector<f64> {
        self.0.residuals(parameters)
    }

    fn jacobian(&self, b: &[f64]) -> DMatrix<f64> {
        let points = self.0.data.len() / 2;
        DMatrix::from_fn(points, 2, |row, column| {
            let x = self.0.data[2 * row + 1];
            match column {
                0 => -(-b[1] * x).exp_m1(),
                _ => b[0] * x * (-b[1] * x).exp(),
            }
        })
    }
}

#[test]
fn told_derivatives_lead_to_the_same_minimum() {
    let problem = &PROBLEMS[0];
    let numerical = fit(problem, problem.starts[0]).unwrap();
    let analytic = fit(&Analytic(problem), problem.starts[0]).unwrap();
    for index in 0..2 {
        assert!(digits(numerical.parameters[index], analytic.parameters[index]) > 8.0);
        assert!(digits(numerical.standard_error(index), analytic.standard_error(index)) > 8.0);
    }
}

struct Line<'a>(&'a [f64]);

impl Residuals for Line<'_> {
    fn residuals(&self, b: &[f64]) -> DVector<f64> {
        let line = |index| b[0] + b[1] * index as f64;
        DVector::from_iterator(
            self.0.len(),
            self.0.iter().enumerate().map(|(index, y)| line(index) - y),
        )
    }
}

#[test]
fn what_cannot_be_fitted_is_refused() {
    let message = |problem: &[f64], start: &[f64]| fit(&Line(problem), start).unwrap_err().0;
    assert!(message(&[1.0, 2.0], &[0.0, 0.0]).contains("2 points for 2 parameters"));
    assert!(message(&[1.0, f64::NAN, 2.0], &[0.0, 0.0]).contains("not finite"));
    // A third parameter on which nothing depends.
    assert!(message(&[1.0, 2.0, 4.0, 3.0], &[0.0, 0.0, 1.0]).contains("do not determine"));
}

#[test]
fn points_on_the_curve_leave_no_doubt() {
    let exact = fit(&Line(&[1.0, 3.0, 5.0, 7.0]), &[0.0, 0.0]).unwrap();
    assert!((exact.parameters[0] - 1.0).abs() < 1e-12 && (exact.parameters[1] - 2.0).abs() < 1e-12);
    assert!(exact.estimate(1).half_width() < 1e-10);
}

#[test]
fn the_interval_of_a_line_is_the_textbook_one() {
    // Slope 0.6 over x = 0…4, residual sum of squares 2.4: s² = 0.8, standard error √(0.8/10), t(3) = 3.182.
    let fitted = fit(&Line(&[2.0, 4.0, 5.0, 4.0, 5.0]), &[0.0, 0.0]).unwrap();
    let slope = fitted.estimate(1);
    assert!((slope.value - 0.6).abs() < 1e-9 && (fitted.sum_of_squares - 2.4).abs() < 1e-9);
    assert!((slope.half_width() - 3.182 * 0.08f64.sqrt()).abs() < 1e-6);
}
