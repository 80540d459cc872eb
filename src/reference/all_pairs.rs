//! Pairs among N grains.
//!
//! ```text
//! N (N − 1)/2
//! ```
//!
//! Source: Alvim (2016), eq. 43. Doubling N nearly quadruples it; the text below that equation says doubles.

use super::settings::Case;
use super::{Entry, Kind, ReferenceError, Solution};

const NAME: &str = "all_pairs";

pub fn solution() -> Solution {
    Solution {
        entry: Entry {
            name: NAME,
            meaning: "pairs among all grains of the scene, N(N − 1)/2: what a search without a grid looks at",
            source: "Alvim (2016), eq. 43",
        },
        unit: "1",
        kind: Kind::Scalar(solve),
    }
}

fn solve(case: &Case) -> Result<f64, ReferenceError> {
    case.only(NAME, "sedimentation")?;
    let number = case.number("grains.number")?;
    Ok(0.5 * number * (number - 1.0))
}
