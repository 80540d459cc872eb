//! Expectations and figures as a study file writes them.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Deserialize;

use super::Where;
use super::quantity::{AnyQuantity, Fraction, OneOrMore, Scalar, Time};

/// An input that was fitted to some of the points.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct CalibratedSpec {
    /// Where its value stands: `scene.cohesion.…`, or `scenes.NAME.cohesion.…` in one scene.
    pub path: String,
    /// The scalar that it was fitted to.
    pub of: String,
    /// Name of the reference that the scalar had to meet.
    pub against: String,
    /// The points that it was fitted on.
    #[expect(dead_code, reason = "read from the tree, where values have positions")]
    pub on: Where,
}

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
    /// A scalar of some points is greater than, less than or equal to that of others.
    Compare(CompareSpec),
    /// A scalar grows along an axis like a power of it.
    Scaling(ScalingSpec),
    /// A parameter of a law fitted to a scalar over an axis.
    Fit(FitSpec),
    /// Every selected run completes, or diverges.
    Status(StatusSpec),
    /// The place on an axis at which a scalar leaves a band lies where a reference says.
    Limit(LimitSpec),
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
    /// Lets a step against the trend pass that is smaller than twice its standard error over seeds.
    #[serde(default)]
    pub within_noise: bool,
    #[serde(flatten)]
    pub common: Common,
}

/// How the scalar of the first selection lies to that of the second, everything else equal.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct CompareSpec {
    pub of: String,
    /// Two selections, each written like `where`.
    #[expect(dead_code, reason = "read from the tree, where values have positions")]
    pub between: Vec<Where>,
    pub is: RelationSpec,
    /// Least difference of `greater` and `less`, as a share of the second value.
    pub by: Option<Fraction>,
    /// Largest difference of `equal`, as a share of the second value.
    pub within: Option<Fraction>,
    /// Lets `equal` differ by twice the standard error of the difference over seeds.
    #[serde(default)]
    pub within_noise: bool,
    #[serde(flatten)]
    pub common: Common,
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct ScalingSpec {
    pub of: String,
    /// Axis along which it grows.
    pub over: String,
    /// The exponent expected.
    pub is: Fraction,
    /// Largest difference from it.
    pub within: Fraction,
    #[serde(flatten)]
    pub common: Common,
}

/// Beside the same fit to a reference (`against`, `below`), or in a band.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct FitSpec {
    /// v = v_∞ ε^n.
    pub richardson_zaki: RichardsonZakiSpec,
    /// The parameter judged; the exponent if left out.
    pub parameter: Option<ParameterSpec>,
    /// Name of the reference that the same law is fitted to, at the same points.
    pub against: Option<String>,
    /// The value expected, together with `within`.
    pub is: Option<AnyQuantity>,
    /// Relative half width of the band around `is`.
    pub within: Option<Fraction>,
    pub above: Option<AnyQuantity>,
    /// Bound on the relative difference beside `against`, upper end of the band otherwise.
    pub below: Option<AnyQuantity>,
    #[serde(flatten)]
    pub common: Common,
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct RichardsonZakiSpec {
    /// The settling velocity.
    pub of: String,
    /// Axis of the porosity.
    pub over: String,
    /// In what the deviations are squared: `logarithmic` for relative ones, if left out.
    pub scale: Option<ScaleSpec>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ScaleSpec {
    Logarithmic,
    Linear,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ParameterSpec {
    Exponent,
    Velocity,
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct StatusSpec {
    /// The ends admitted. A run that diverges where it may is no failure.
    pub is: OneOrMore<EndingSpec>,
    #[serde(flatten)]
    pub common: Common,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum EndingSpec {
    Completed,
    Diverged,
}

/// A run that diverges is outside of the band, and no failure.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct LimitSpec {
    pub of: String,
    pub above: Option<AnyQuantity>,
    pub below: Option<AnyQuantity>,
    /// Axis along which it leaves the band.
    pub over: String,
    /// Name of the reference for the place.
    pub against: String,
    /// Relative distance that the values of the axis on both sides may have from the reference.
    pub within: Fraction,
    #[serde(flatten)]
    pub common: Common,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum RelationSpec {
    Greater,
    Less,
    Equal,
}

/// A figure: its kind with its fields.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FigureSpec {
    /// Series over time or over another series, one line per run.
    TimeSeries(TimeSeriesSpec),
    /// Relative error over an axis.
    ErrorAgainstResolution(ErrorAgainstResolutionSpec),
    /// Run time against error with the Pareto front.
    RunTimeAgainstError(RunTimeAgainstErrorSpec),
    /// A profile, one line per run.
    Profile(ProfileSpec),
    /// A scalar over an axis, mean over seeds, references beside.
    Response(ResponseSpec),
    /// The place on an axis at which a scalar leaves a band, over another axis, reference beside.
    Limit(LimitFigureSpec),
    /// A profile over time and height as a picture, curves on top.
    Map(MapSpec),
    /// A settling velocity over the porosity with its fitted law, correlations beside.
    RichardsonZaki(RichardsonZakiFigureSpec),
    /// Flux of solids over their fraction after Kynch, with the chords of shocks.
    Flux(FluxSpec),
    /// Pictures of the grains of one point, coloured by speed.
    Snapshots(SnapshotsSpec),
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
    /// The series in the place of time.
    pub over: Option<String>,
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
    /// `counters.NAME`, the same on every machine, or `timings.cpu` in place of the run time.
    pub work: Option<String>,
    #[serde(flatten)]
    pub caption: Caption,
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct ProfileSpec {
    pub of: String,
    #[serde(flatten)]
    pub caption: Caption,
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct ResponseSpec {
    pub of: String,
    /// Axis along which it is drawn.
    pub over: String,
    /// References and published data to draw beside.
    #[serde(default)]
    pub against: Vec<BesideSpec>,
    #[serde(flatten)]
    pub caption: Caption,
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct LimitFigureSpec {
    pub of: String,
    pub above: Option<AnyQuantity>,
    pub below: Option<AnyQuantity>,
    /// Axis along which it leaves the band.
    pub over: String,
    /// Name of the reference for the place.
    pub against: String,
    /// Axis over which the place is drawn.
    pub across: String,
    #[serde(flatten)]
    pub caption: Caption,
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum BesideSpec {
    /// A reference by name, at each point's own settings.
    Reference(ReferenceSpec),
    /// Two columns of a table in the folder `references`.
    Data(DataSpec),
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct ReferenceSpec {
    pub name: String,
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct DataSpec {
    /// Name of a file in the folder `references`.
    pub file: String,
    /// Column of the axis.
    pub x: String,
    /// Column of the scalar.
    pub y: String,
    /// Unit of the column, where it is not in SI units.
    pub x_unit: Option<String>,
    /// Unit of the column, where it is not in SI units.
    pub y_unit: Option<String>,
    /// Rows to take: columns with the text they hold.
    #[serde(default)]
    pub rows: BTreeMap<String, Scalar>,
    /// Its name in the legend.
    pub label: Option<String>,
}

/// One point's picture.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct MapSpec {
    /// Profile table of time, height and what is shown.
    pub of: String,
    /// Series of heights to draw on top.
    pub curves: Option<OneOrMore<String>>,
    /// References to draw on top.
    pub against: Option<OneOrMore<String>>,
    #[serde(flatten)]
    pub caption: Caption,
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct RichardsonZakiFigureSpec {
    /// The settling velocity.
    pub of: String,
    /// Axis of the porosity.
    pub over: String,
    /// In what the deviations are squared: `logarithmic` for relative ones, if left out.
    pub scale: Option<ScaleSpec>,
    /// Name of a reference to draw beside.
    pub against: Option<String>,
    #[serde(flatten)]
    pub caption: Caption,
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct FluxSpec {
    /// The settling velocity.
    pub of: String,
    /// Axis of the porosity.
    pub over: String,
    /// Name of the reference for the settling velocity, drawn at every porosity.
    pub against: String,
    /// Scalar that holds the solids fraction of the deposit; no chords without it.
    pub deposit: Option<String>,
    #[serde(flatten)]
    pub caption: Caption,
}

#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct SnapshotsSpec {
    /// One panel each: the kept instant nearest to it.
    pub times: OneOrMore<Time>,
    #[serde(flatten)]
    pub caption: Caption,
}
