//! Exponent n of hindered settling, v = v_∞ ε^n (Richardson & Zaki 1954), by four correlations.
//!
//! ```text
//! Wallis                  n = 4.7 (1 + 0.15 Re^0.687)/(1 + 0.253 Re^0.687)
//! Garside and Al-Dibouni  (5.1 − n)/(n − 2.7) = 0.1 Re^0.9
//! Rowe                    n = 2.35 (2 + 0.175 Re^0.75)/(1 + 0.175 Re^0.75)
//! Khan and Richardson     (4.8 − n)/(n − 2.4) = 0.043 Ar^0.57
//! ```
//!
//! Re of the isolated grain at its terminal velocity v_∞; no walls near. v is the speed in a closed vessel,
//! the superficial slip. Slow limits 4.7, 5.1, 4.7, 4.8; fast limits 2.79, 2.7, 2.35, 2.4.
//! Sources: Wallis (1969), One-Dimensional Two-Phase Flow; Garside & Al-Dibouni (1977), Ind. Eng. Chem.
//! Process Des. Dev. 16, 206; Rowe (1987), Chem. Eng. Sci. 42, 2795; Khan & Richardson (1989), Chem. Eng.
//! Commun. 78, 111, without the wall term.

use super::settings::Case;
use super::terminal_velocity::terminal_velocity;
use super::{Entry, Kind, ReferenceError, Solution};

/// n [-] at the terminal Reynolds number [-].
pub fn wallis(re: f64) -> f64 {
    let power = re.powf(0.687);
    4.7 * (1.0 + 0.15 * power) / (1.0 + 0.253 * power)
}

/// n [-] at the terminal Reynolds number [-].
pub fn garside_al_dibouni(re: f64) -> f64 {
    between(5.1, 2.7, 0.1 * re.powf(0.9))
}

/// n [-] at the terminal Reynolds number [-].
pub fn rowe(re: f64) -> f64 {
    let power = 0.175 * re.powf(0.75);
    2.35 * (2.0 + power) / (1.0 + power)
}

/// n [-] at the Archimedes number [-].
pub fn khan_richardson(archimedes: f64) -> f64 {
    between(4.8, 2.4, 0.043 * archimedes.powf(0.57))
}

/// n of (slow − n)/(n − fast) = ratio.
fn between(slow: f64, fast: f64, ratio: f64) -> f64 {
    (slow + ratio * fast) / (1.0 + ratio)
}

pub(super) fn solutions() -> [Solution; 4] {
    let solution = |name, meaning, source, solve| Solution {
        entry: Entry {
            name,
            meaning,
            source,
        },
        unit: "1",
        kind: Kind::Scalar(solve),
    };
    [
        solution(
            "wallis",
            "exponent n of hindered settling at the grain's terminal Reynolds number",
            "Wallis (1969), One-Dimensional Two-Phase Flow",
            |case| Ok(wallis(terminal_reynolds(case)?)),
        ),
        solution(
            "garside_al_dibouni",
            "exponent n of hindered settling at the grain's terminal Reynolds number",
            "Garside & Al-Dibouni (1977), Ind. Eng. Chem. Process Des. Dev. 16, 206",
            |case| Ok(garside_al_dibouni(terminal_reynolds(case)?)),
        ),
        solution(
            "rowe",
            "exponent n of hindered settling at the grain's terminal Reynolds number",
            "Rowe (1987), Chem. Eng. Sci. 42, 2795",
            |case| Ok(rowe(terminal_reynolds(case)?)),
        ),
        solution(
            "khan_richardson",
            "exponent n of hindered settling at the grain's Archimedes number, without walls",
            "Khan & Richardson (1989), Chem. Eng. Commun. 78, 111, without the wall term",
            |case| Ok(khan_richardson(case.grain()?.archimedes())),
        ),
    ]
}

fn terminal_reynolds(case: &Case) -> Result<f64, ReferenceError> {
    let grain = case.grain()?;
    Ok(grain.reynolds(terminal_velocity(&grain, case.law()?)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::library::tests::{assert_printed, dataset};

    #[test]
    fn exponents_are_the_published_tables() {
        let table = dataset("richardson_zaki_analytic.csv");
        // Ten to the quarter decades, printed with six digits.
        for row in 0..table.rows() {
            let re = 10f64.powf(-3.0 + row as f64 / 4.0);
            assert_printed(re, table.text("Re_terminal", row));
            assert_printed(wallis(re), table.text("n_wallis", row));
            assert_printed(garside_al_dibouni(re), table.text("n_garside_aldibouni", row));
            assert_printed(rowe(re), table.text("n_rowe", row));
        }
        let table = dataset("khan_richardson_analytic.csv");
        for row in 0..table.rows() {
            let n = khan_richardson(table.number("Ar", row));
            assert!((n - table.number("n_khan_richardson", row)).abs() < 2e-5);
        }
    }

    #[test]
    fn slow_and_fast_limits() {
        type Correlation = fn(f64) -> f64;
        let limits: [(Correlation, f64, f64); 4] = [
            (wallis, 4.7, 4.7 * 0.15 / 0.253),
            (garside_al_dibouni, 5.1, 2.7),
            (rowe, 4.7, 2.35),
            (khan_richardson, 4.8, 2.4),
        ];
        for (correlation, slow, fast) in limits {
            assert!((correlation(1e-12) - slow).abs() < 1e-4);
            assert!((correlation(1e14) - fast).abs() < 1e-4);
            assert!((0..60).all(|step| {
                let at = |step: i32| correlation(10f64.powf(f64::from(step) / 5.0 - 6.0));
                at(step + 1) < at(step)
            }));
        }
    }
}
