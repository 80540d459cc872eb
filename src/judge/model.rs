//! What a judgement looks like.

use serde::Serialize;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    Holds,
    Fails,
    NotDecidable,
}

/// The answer to one expectation. Errors are relative and dimensionless.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Verdict {
    /// Identifier of the expectation.
    pub id: String,
    /// The statement in words: "relative error of terminal_velocity against force_balance < 2 %".
    pub statement: String,
    pub quantity: String,
    pub unit: String,
    /// The reference value, where there is a single one (of the deciding run).
    pub expected: Option<f64>,
    /// The value found (of the deciding run: the worst one).
    pub computed: Option<f64>,
    /// Half width of the 95 % confidence interval of `computed` where it is a mean over seeds.
    pub half_width: Option<f64>,
    pub error: Option<f64>,
    /// The admitted band, in words: "< 0.02", "0.95 to 1.05".
    pub band: String,
    pub verdict: Outcome,
    /// Why, when it fails or cannot be decided; what to do.
    pub reason: Option<String>,
    /// Citation of the reference.
    pub source: String,
    pub claims: Vec<String>,
    /// Set when the expectation is informative and never gates.
    pub informative: Option<String>,
    pub points: Vec<PointVerdict>,
}

/// One run's share in a verdict.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PointVerdict {
    /// Point identifier.
    pub id: String,
    /// `scene=block spacing_over_diameter=2 porosity=0.9`.
    pub label: String,
    pub expected: Option<f64>,
    pub computed: Option<f64>,
    /// Half width of the 95 % confidence interval of `computed` where it is a mean over seeds.
    pub half_width: Option<f64>,
    pub error: Option<f64>,
    pub holds: Option<bool>,
}
