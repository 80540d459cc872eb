//! Longest stable time step of one grain that rests on a wall, under each integrator.
//!
//! ```text
//! ẍ + 2 ζ ω ẋ + ω² x = 0,   w = ω Δt
//! velocity Verlet, force from the velocity of the last half step:  w² + 4 ζ w < 4
//! Runge–Kutta:       |1 + z + z²/2 + z³/6 + z⁴/24| < 1,   z = w (−ζ + i √(1 − ζ²))
//! Gear:              all |eigenvalues| of (1 + c rᵀ) P < 1,   r = (−w²/2, −ζ w, −1, 0, …),  P Pascal's triangle
//! linear:            ω = √(k/m),   ζ = |ln e|/√(π² + ln² e)
//! Hertz at δ₀, where the force is the weight:  S = 2 E* √(R δ₀),  ω = √(S/m),
//!                    ζ = γ_n ω/2 (viscoelastic),  √(5/6) |ln e|/√(π² + ln² e) (Tsuji)
//! ```
//!
//! For small motions about rest. Without damping a Gear scheme is stable at no step. Sources: Gear (1971),
//! Numerical Initial Value Problems; Allen & Tildesley (1987), Computer Simulation of Liquids, app. E; the
//! test of a polynomial's roots after Schur (1918), J. reine angew. Math. 148, 122.

use std::f64::consts::PI;

use super::settings::Case;
use super::{Entry, Kind, ReferenceError, Solution};

const NAME: &str = "stable_step";

pub fn solution() -> Solution {
    Solution {
        entry: Entry {
            name: NAME,
            meaning: "longest stable time step of a grain that rests on a wall, by the scene's law and integrator",
            source: "eigenvalues of one step of each scheme for small oscillations about rest; schemes: \
                     Allen & Tildesley (1987), app. E",
        },
        unit: "s",
        kind: Kind::Scalar(solve),
    }
}

fn solve(case: &Case) -> Result<f64, ReferenceError> {
    case.only(NAME, "sedimentation")?;
    let scheme = match case.word("integrator") {
        Some("gear_5") => Scheme::Gear(&FIVE),
        Some("gear_6") => Scheme::Gear(&SIX),
        Some("runge_kutta_4") => Scheme::RungeKutta,
        _ => Scheme::VelocityVerlet,
    };
    let (frequency, damping) = oscillation(case)?;
    let limit = scheme.limit(damping);
    match limit > 0.0 {
        true => Ok(limit / frequency),
        false => Err(ReferenceError(format!(
            "`{NAME}`: this scheme is stable at no step"
        ))),
    }
}

/// ω [1/s] and ζ [-] of a grain on a wall.
fn oscillation(case: &Case) -> Result<(f64, f64), ReferenceError> {
    let (radius, mass) = {
        let diameter = case.number("grains.diameter")?;
        (
            0.5 * diameter,
            case.number("grains.density")? * PI / 6.0 * diameter.powi(3),
        )
    };
    let law = case.word("normal").unwrap_or_default();
    let field = |name: &str| case.number(&format!("normal.{law}.{name}"));
    let ratio = |restitution: f64| restitution.ln().abs() / restitution.ln().hypot(PI);
    if law == "linear_spring_dashpot" {
        let frequency = (field("stiffness")? / mass).sqrt();
        return Ok((frequency, ratio(field("restitution")?)));
    }
    let poisson = field("poisson_ratio")?;
    let modulus = field("young_modulus")? / (2.0 * (1.0 - poisson * poisson));
    let weight = mass * case.number("gravity")?;
    let overlap = (0.75 * weight / (modulus * radius.sqrt())).powf(2.0 / 3.0);
    let frequency = (2.0 * modulus * (radius * overlap).sqrt() / mass).sqrt();
    let damping = match law {
        "hertz_viscoelastic" => 0.5 * field("damping_time")? * frequency,
        "hertz_tsuji" => (5.0f64 / 6.0).sqrt() * ratio(field("restitution")?),
        _ => return Err(ReferenceError(format!("`{NAME}` does not know the law `{law}`"))),
    };
    Ok((frequency, damping))
}

/// Corrector coefficients for an equation of second order whose force depends on velocity.
const FIVE: [f64; 5] = [19.0 / 90.0, 3.0 / 4.0, 1.0, 1.0 / 2.0, 1.0 / 12.0];
const SIX: [f64; 6] = [3.0 / 16.0, 251.0 / 360.0, 1.0, 11.0 / 18.0, 1.0 / 6.0, 1.0 / 60.0];

/// A scheme of time integration.
#[derive(Clone, Copy, Debug)]
pub enum Scheme<'a> {
    VelocityVerlet,
    RungeKutta,
    /// With these corrector coefficients.
    Gear(&'a [f64]),
}

impl Scheme<'_> {
    /// Greatest stable ω Δt [-] at a damping ratio ζ [-] below 1; zero where no step is stable.
    pub fn limit(&self, damping: f64) -> f64 {
        const FIRST: f64 = 0.01;
        let (mut low, mut high) = (FIRST, FIRST);
        while self.is_stable(high, damping) {
            low = high;
            high *= 1.01;
        }
        if high == FIRST {
            return 0.0;
        }
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            match self.is_stable(middle, damping) {
                true => low = middle,
                false => high = middle,
            }
        }
        low
    }

    fn is_stable(&self, w: f64, damping: f64) -> bool {
        match self {
            Scheme::VelocityVerlet => w * w + 4.0 * damping * w < 4.0,
            Scheme::RungeKutta => runge_kutta(w, damping) < 1.0 + 1e-12,
            Scheme::Gear(corrector) => roots_inside(characteristic(&gear(corrector, w, damping))),
        }
    }
}

/// |1 + z + z²/2 + z³/6 + z⁴/24| of the stability polynomial.
fn runge_kutta(w: f64, damping: f64) -> f64 {
    let z = [-damping * w, (1.0 - damping * damping).max(0.0).sqrt() * w];
    let mut sum = [1.0, 0.0];
    // Horner's scheme: 1 + z (1 + z/2 (1 + z/3 (1 + z/4))).
    for divisor in [4.0, 3.0, 2.0, 1.0] {
        let product = [sum[0] * z[0] - sum[1] * z[1], sum[0] * z[1] + sum[1] * z[0]];
        sum = [1.0 + product[0] / divisor, product[1] / divisor];
    }
    sum[0].hypot(sum[1])
}

/// The matrix of one step.
fn gear(corrector: &[f64], w: f64, damping: f64) -> Vec<Vec<f64>> {
    let size = corrector.len();
    // Zero below the diagonal: one factor vanishes.
    let binomial = |row: usize, column: usize| -> f64 {
        (0..row)
            .map(|k| (column as f64 - k as f64) / (k + 1) as f64)
            .product()
    };
    let pascal: Vec<Vec<f64>> = (0..size)
        .map(|row| (0..size).map(|column| binomial(row, column)).collect())
        .collect();
    let gap: Vec<f64> = (0..size)
        .map(|column| -0.5 * w * w * pascal[0][column] - damping * w * pascal[1][column] - pascal[2][column])
        .collect();
    (0..size)
        .map(|row| {
            (0..size)
                .map(|column| pascal[row][column] + corrector[row] * gap[column])
                .collect()
        })
        .collect()
}

/// Coefficients of the characteristic polynomial, highest power first (Faddeev–LeVerrier).
fn characteristic(matrix: &[Vec<f64>]) -> Vec<f64> {
    let size = matrix.len();
    let mut coefficients = vec![1.0];
    let mut product = vec![vec![0.0; size]; size];
    for step in 1..=size {
        let last = coefficients[step - 1];
        for (place, row) in product.iter_mut().enumerate() {
            row[place] += last;
        }
        product = (0..size)
            .map(|row| {
                let entry = |column: usize| (0..size).map(|k| matrix[row][k] * product[k][column]).sum();
                (0..size).map(entry).collect()
            })
            .collect();
        let trace: f64 = (0..size).map(|place| product[place][place]).sum();
        coefficients.push(-trace / step as f64);
    }
    coefficients
}

/// Whether all roots lie inside of the unit circle (Schur).
fn roots_inside(mut polynomial: Vec<f64>) -> bool {
    while polynomial.len() > 1 {
        let (first, last) = (polynomial[0], polynomial[polynomial.len() - 1]);
        if last.abs() >= first.abs() {
            return false;
        }
        let count = polynomial.len();
        polynomial = (0..count - 1)
            .map(|place| polynomial[place] - last / first * polynomial[count - 1 - place])
            .collect();
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_limits_come_back() {
        for (scheme, damping, limit, tolerance) in [
            (Scheme::VelocityVerlet, 0.0, 2.0, 1e-9),
            (Scheme::RungeKutta, 0.0, 8f64.sqrt(), 1e-4),
            // On the negative real axis.
            (Scheme::RungeKutta, 1.0, 2.785_294, 1e-5),
            (Scheme::Gear(&FIVE), 0.3, 0.42, 0.01),
            (Scheme::Gear(&SIX), 0.3, 0.25, 0.01),
            (Scheme::Gear(&FIVE), 0.9, 0.165, 0.005),
            (Scheme::Gear(&SIX), 0.9, 0.09, 0.005),
        ] {
            let found = scheme.limit(damping);
            assert!(
                (found - limit).abs() < tolerance,
                "{scheme:?} at {damping}: {found} for {limit}"
            );
        }
    }

    #[test]
    fn without_damping_a_gear_scheme_is_stable_at_no_step() {
        assert_eq!(Scheme::Gear(&FIVE).limit(0.0), 0.0);
        assert_eq!(Scheme::Gear(&SIX).limit(0.0), 0.0);
    }

    #[test]
    fn roots_are_told_from_the_circle() {
        // (x − a)(x + b)(x² + c²)
        let product = |a: f64, b: f64, c: f64| {
            let [p, q] = [b - a, -a * b];
            vec![1.0, p, q + c * c, p * c * c, q * c * c]
        };
        assert!(roots_inside(product(0.99, 0.5, 0.9)));
        assert!(!roots_inside(product(1.01, 0.5, 0.9)));
        assert!(!roots_inside(product(0.5, 0.5, 1.01)));
        assert!(!roots_inside(product(0.5, 1.01, 0.1)));
    }
}
