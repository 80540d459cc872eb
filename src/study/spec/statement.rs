//! Expectations and figures as a study file writes them.

use schemars::JsonSchema;
use serde::Deserialize;

use super::Where;
use super::quantity::{AnyQuantity, Fraction, OneOrMore};

/// A statement that is expected to hold: its kind with its fields.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ExpectationSpec {
    /// A scalar lies in a band, in every selected run.
    Value(ValueSpec),
    /// The largest relative error against a reference is below a bound.
    Error(ErrorSpec),
    /// Observed order of the error over an axis.
    Order(OrderSpec),
    /// A scalar rises or falls along an axis.
    Monotone(MonotoneSpec),
}

/// What every expectation may carry.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
pub struct Common {
    /// Stable identifier.
    pub id: Option<String>,
    /// Which runs it is about.
    #[serde(default, rename = "where")]
    #[expect(dead_code, reason = "read from the tree, where values have positions")]
    pub selection: Where,
    /// Claims that it settles.
    #[serde(default)]
    pub claims: Vec<String>,
    /// The reason why it is shown but never gates.
    pub informative: Option<String>,
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct ValueSpec {
    pub of: String,
    /// The value expected, together with `within`.
    pub is: Option<AnyQuantity>,
    /// Relative half width of the band around `is`.
    pub within: Option<Fraction>,
    pub above: Option<AnyQuantity>,
    pub below: Option<AnyQuantity>,
    #[serde(flatten)]
    pub common: Common,
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct ErrorSpec {
    pub of: String,
    /// Name of the reference.
    pub against: String,
    /// Bound on the relative error.
    pub below: Fraction,
    /// How the deviations of a series become one number; the largest, if left out.
    pub norm: Option<NormSpec>,
    #[serde(flatten)]
    pub common: Common,
}

/// One number for the deviations of a series, over the largest value of the reference.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum NormSpec {
    Maximum,
    RootMeanSquare,
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct OrderSpec {
    pub of: String,
    /// Name of the reference.
    pub against: String,
    /// Axis along which the resolution changes.
    pub over: String,
    /// The order expected.
    pub is: Fraction,
    /// Largest difference from it.
    pub within: Fraction,
    #[serde(flatten)]
    pub common: Common,
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct MonotoneSpec {
    pub of: String,
    /// Axis along which it rises or falls.
    pub over: String,
    /// True for rising, false for falling.
    pub rising: bool,
    #[serde(flatten)]
    pub common: Common,
}

/// A figure: its kind with its fields.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FigureSpec {
    /// Series over time, one line per run.
    TimeSeries(TimeSeriesSpec),
    /// Relative error over an axis.
    ErrorAgainstResolution(ErrorAgainstResolutionSpec),
    /// Run time against error with the Pareto front.
    RunTimeAgainstError(RunTimeAgainstErrorSpec),
    /// A profile, one line per run.
    Profile(ProfileSpec),
}

/// What every figure may carry.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
pub struct Caption {
    /// Stable identifier, also the file stem.
    pub id: Option<String>,
    pub title: Option<String>,
    /// Which runs it shows.
    #[serde(default, rename = "where")]
    #[expect(dead_code, reason = "read from the tree, where values have positions")]
    pub selection: Where,
    /// Thesis figure it stands beside.
    pub thesis: Option<String>,
    /// One line style per value of it.
    pub group: Option<String>,
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct TimeSeriesSpec {
    pub of: OneOrMore<String>,
    /// Name of the reference curve.
    pub against: Option<String>,
    #[serde(flatten)]
    pub caption: Caption,
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct ErrorAgainstResolutionSpec {
    pub of: String,
    /// Name of the reference.
    pub against: String,
    /// Axis along which the resolution changes.
    pub over: String,
    #[serde(flatten)]
    pub caption: Caption,
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct RunTimeAgainstErrorSpec {
    pub of: String,
    /// Name of the reference.
    pub against: String,
    #[serde(flatten)]
    pub caption: Caption,
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct ProfileSpec {
    pub of: String,
    #[serde(flatten)]
    pub caption: Caption,
}
