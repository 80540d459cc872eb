//! Numbers made of the series of a run, as a study file writes them.

use schemars::JsonSchema;
use serde::Deserialize;

use super::quantity::{Fraction, Time};

/// How a number is made of series.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DerivedSpec {
    /// Slope of a straight segment of a series, robust, with its interval.
    Slope(SlopeSpec),
    /// Where the straight line through a series begins: its value at zero.
    Intercept(InterceptSpec),
    /// Time at which two straight segments of a series join.
    Breakpoint(BreakpointSpec),
    /// Time, or value, at which the straight lines through two series meet.
    Crossing(CrossingSpec),
    /// Value of a series at a time, straight between its samples.
    Value(ValueAtSpec),
    /// Mean of a series over a window.
    Mean(OverWindowSpec),
    /// Smallest value of a series in a window.
    Smallest(OverWindowSpec),
    /// Largest value of a series in a window.
    Largest(OverWindowSpec),
    /// Time at which a series first comes to a share of its first value.
    Passes(PassesSpec),
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct SlopeSpec {
    /// The series.
    pub of: String,
    /// The series that takes the place of time; the window stays one of times.
    pub over: Option<String>,
    #[serde(flatten)]
    pub window: WindowSpec,
    /// Straight segments over the window, one to three; one if left out.
    pub segments: Option<u64>,
    /// The segment whose slope it is, from 1; the first if left out.
    pub which: Option<u64>,
    /// Whether rising or falling counts as positive; rising if left out.
    pub sign: Option<SignSpec>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SignSpec {
    Rising,
    Falling,
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct BreakpointSpec {
    /// The series.
    pub of: String,
    #[serde(flatten)]
    pub window: WindowSpec,
    /// Straight segments over the window: two or three.
    pub segments: u64,
    /// The segment that ends there, from 1; the first if left out.
    pub which: Option<u64>,
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct CrossingSpec {
    /// The one series.
    pub of: String,
    /// The other series.
    pub with: String,
    #[serde(flatten)]
    pub window: WindowSpec,
    /// Straight segments of each series over the window, one to three; one if left out.
    pub segments: Option<u64>,
    /// The segment whose lines meet, from 1; the first if left out.
    pub which: Option<u64>,
    /// What is taken of the point where they meet; the time if left out.
    pub take: Option<CoordinateSpec>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CoordinateSpec {
    Time,
    Value,
}

#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema)]
pub struct WindowSpec {
    /// Start of the window; that of the series if left out.
    pub from: Option<Time>,
    /// End of the window; that of the series if left out.
    pub to: Option<Time>,
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct InterceptSpec {
    /// The series.
    pub of: String,
    /// The series that takes the place of time; the window stays one of times.
    pub over: Option<String>,
    #[serde(flatten)]
    pub window: WindowSpec,
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct ValueAtSpec {
    /// The series.
    pub of: String,
    pub at: Time,
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct OverWindowSpec {
    /// The series.
    pub of: String,
    #[serde(flatten)]
    pub window: WindowSpec,
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct PassesSpec {
    /// The series.
    pub of: String,
    /// Of its first value; below it for 1 and less, above it for more.
    pub share: Fraction,
}
