//! The rehearsal scene's own exact values.
//!
//! ```text
//! value(t) = limit (1 − exp(−t / time_constant))
//! ```
//!
//! What the scene returns with its error term left out.

use super::{Entry, Kind, Solution};

const SOURCE: &str = "exact by construction of the rehearsal scene";

pub(super) fn limit() -> Solution {
    Solution {
        entry: Entry {
            name: "known_limit",
            meaning: "limit of the rehearsal scene's series",
            source: SOURCE,
        },
        unit: "m/s",
        kind: Kind::Scalar(|case| {
            case.only("known_limit", "rehearsal")?;
            case.number("limit")
        }),
    }
}

pub(super) fn series() -> Solution {
    Solution {
        entry: Entry {
            name: "known_series",
            meaning: "the rehearsal scene's series without its error",
            source: SOURCE,
        },
        unit: "m/s",
        kind: Kind::Series(|case, times| {
            case.only("known_series", "rehearsal")?;
            let limit = case.number("limit")?;
            let constant = case.number("time_constant")?;
            Ok(times
                .iter()
                .map(|time| -limit * (-time / constant).exp_m1())
                .collect())
        }),
    }
}
