//! A study after parsing: plain data. Past this point nothing knows that YAML exists.

use std::path::PathBuf;

use kynch_sim::scene::Scene;
use serde::{Deserialize, Serialize};

/// A study file, parsed and checked.
#[derive(Clone, Debug)]
pub struct Study {
    /// File stem; also the folder name below `reports/` and the store.
    pub name: String,
    pub path: PathBuf,
    /// The question the study answers, one sentence.
    pub question: String,
    /// Scenes by name; a study with one unnamed `scene` calls it `scene`.
    pub scenes: Vec<String>,
    pub axes: Vec<Axis>,
    pub seeds: Vec<u64>,
    /// Inputs that were fitted; empty where none was.
    pub calibrated: Vec<Calibrated>,
    /// Numbers made of the series of a run, each under a name of its own.
    pub derive: Vec<Derived>,
    /// Observables to keep, by name.
    pub observe: Vec<String>,
    pub expect: Vec<Expectation>,
    pub figures: Vec<Figure>,
    pub published_time: Option<PublishedTime>,
    pub plan: Plan,
}

/// What one point took elsewhere.
#[derive(Clone, Debug, PartialEq)]
pub struct PublishedTime {
    /// [s]
    pub seconds: f64,
    /// Where it is printed, and what machine it was.
    pub source: String,
}

/// A varied parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Short name: store column, figure label.
    pub name: String,
    /// SI unit, `1` when dimensionless, empty for words.
    pub unit: String,
    pub values: Vec<AxisValue>,
    /// Names of the scenes in which the axis binds.
    pub scenes: Vec<String>,
}

/// An input that was fitted until a scalar met a reference at some of the points.
#[derive(Clone, Debug, PartialEq)]
pub struct Calibrated {
    /// Name of the scene it belongs to.
    pub scene: String,
    /// Where it stands in that scene, from the kind of the scene downwards.
    pub path: Vec<String>,
    pub value: AxisValue,
    /// SI unit, `1` when dimensionless, empty for words.
    pub unit: String,
    /// The scalar that was fitted.
    pub of: String,
    /// The reference that it had to meet.
    pub against: String,
    /// The points that it was fitted on.
    pub on: Selection,
}

/// A number made of the time series of each run; a scalar everywhere after.
#[derive(Clone, Debug, PartialEq)]
pub struct Derived {
    pub name: String,
    /// SI unit, `1` when dimensionless.
    pub unit: String,
    pub how: Derivation,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Derivation {
    /// Slope of one segment of a series.
    Slope {
        of: String,
        /// The series in the place of time.
        over: Option<String>,
        line: Segment,
        /// Whether falling counts as positive.
        falling: bool,
    },
    /// Value at zero of the straight line through a series.
    Intercept {
        of: String,
        over: Option<String>,
        line: Segment,
    },
    /// Time at which a segment of a series joins the next.
    Breakpoint { of: String, line: Segment },
    /// Where the lines through two series meet.
    Crossing {
        of: [String; 2],
        line: Segment,
        take: Coordinate,
    },
    /// Value of a series at a time [s].
    Value { of: String, at: f64 },
    /// One number for a series in a window, start and end [s].
    Reduced {
        of: String,
        window: [Option<f64>; 2],
        to: Reduction,
    },
    /// Time at which a series first comes to a share of its first value.
    Passes { of: String, share: f64 },
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reduction {
    Mean,
    Smallest,
    Largest,
}

impl Derivation {
    /// The series that it is made of.
    pub fn sources(&self) -> Vec<&String> {
        match self {
            Derivation::Slope { of, over, .. } | Derivation::Intercept { of, over, .. } => {
                std::iter::once(of).chain(over).collect()
            }
            Derivation::Breakpoint { of, .. }
            | Derivation::Value { of, .. }
            | Derivation::Reduced { of, .. }
            | Derivation::Passes { of, .. } => vec![of],
            Derivation::Crossing { of, .. } => of.iter().collect(),
        }
    }
}

/// One of the straight segments by which a series is fitted over a window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// Start and end of the window [s]; those of the series where they are left out.
    pub window: [Option<f64>; 2],
    /// Segments over the window.
    pub segments: usize,
    /// Its number, from 1; of a breakpoint, that of the segment before.
    pub which: usize,
}

/// What is asked of a point in a plane of values over time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Coordinate {
    #[default]
    Time,
    Value,
}

/// A value on an axis, in SI units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum AxisValue {
    Number(f64),
    Flag(bool),
    Word(String),
}

/// Every point of the study, in a stable order.
#[derive(Clone, Debug, Default)]
pub struct Plan {
    pub points: Vec<Point>,
}

/// One run: a scene with all its parameters and a seed.
#[derive(Clone, Debug)]
pub struct Point {
    /// Position in the plan.
    pub index: usize,
    /// Name of the scene inside the study.
    pub scene: String,
    /// Values of the axes that bind in this scene.
    pub axes: Vec<(String, AxisValue)>,
    pub seed: u64,
    /// Canonical settings of the scene: map form, SI numbers, defaults filled in, keys sorted.
    pub settings: serde_json::Value,
    /// The scene itself, ready to run.
    pub work: Work,
}

impl Point {
    /// Value of a parameter: `scene`, an axis, or the one settings field of that name.
    pub fn parameter(&self, name: &str) -> Option<AxisValue> {
        if name == "scene" {
            return Some(AxisValue::Word(self.scene.clone()));
        }
        let axis = self.axes.iter().find(|(axis, _)| axis == name);
        axis.map(|(_, value)| value.clone())
            .or_else(|| leaf(&self.settings, name))
    }

    /// `scene=block porosity=0.9`.
    pub fn label(&self) -> String {
        let axes = self.axes.iter().map(|(name, value)| format!(" {name}={value}"));
        format!("scene={}{}", self.scene, axes.collect::<String>())
    }
}

/// The first leaf called `name` in a tree of settings, depth first.
fn leaf(tree: &serde_json::Value, name: &str) -> Option<AxisValue> {
    let fields = tree.as_object()?;
    let here = fields
        .get(name)
        .and_then(|value| serde_json::from_value(value.clone()).ok());
    here.or_else(|| fields.values().find_map(|branch| leaf(branch, name)))
}

impl std::fmt::Display for AxisValue {
    fn fmt(&self, out: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self {
            // Past a few zeros nobody counts them.
            AxisValue::Number(number) if *number != 0.0 && !(1e-5..1e15).contains(&number.abs()) => {
                write!(out, "{number:e}")
            }
            AxisValue::Number(number) => write!(out, "{number}"),
            AxisValue::Flag(flag) => write!(out, "{flag}"),
            AxisValue::Word(word) => write!(out, "{word}"),
        }
    }
}

/// What a point runs.
#[derive(Clone, Debug, PartialEq)]
#[expect(
    clippy::large_enum_variant,
    reason = "rehearsals are few: a box would save nothing"
)]
pub enum Work {
    Simulation(Scene),
    Rehearsal(Rehearsal),
}

impl Work {
    /// The same work with another seed, where it has one.
    pub fn seeded(&self, seed: u64) -> Work {
        let mut work = self.clone();
        match &mut work {
            Work::Simulation(Scene::Sedimentation(scene)) => scene.seed = seed,
            Work::Simulation(Scene::Suspension(scene)) => scene.seed = seed,
            Work::Simulation(Scene::Filtration(scene)) => scene.bed.seed = seed,
            Work::Simulation(_) | Work::Rehearsal(_) => {}
        }
        work
    }

    /// Threads that it keeps busy.
    pub fn threads(&self) -> usize {
        match self {
            Work::Simulation(scene) => scene.threads() as usize,
            Work::Rehearsal(_) => 1,
        }
    }
}

/// A scene without physics: it returns a known series, so that plans, stores, verdicts and reports
/// can be tried in milliseconds, failures included.
///
/// `value(t) = limit · (1 + error · scale^order) · (1 − exp(−t / time_constant))`, sampled at
/// `samples` instants up to `duration`; scalar `limit` is its limit, scalar `scale` its scale. With
/// `grains` it also keeps snapshots of grains that fall onto the floor of a box.
#[derive(Clone, Debug, PartialEq)]
pub struct Rehearsal {
    pub limit: f64,
    pub time_constant: f64,
    pub duration: f64,
    pub samples: u32,
    pub scale: f64,
    pub order: f64,
    pub error: f64,
    /// Grains in the table `snapshots`; none, no table.
    pub grains: u32,
    /// Real time to spend [s].
    pub delay: f64,
    /// How it ends.
    pub ending: RehearsalEnding,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RehearsalEnding {
    Completes,
    Diverges,
    Panics,
}

/// Which runs a statement is about: every given name must match.
/// `scene` matches the scene name; any other name is an axis with its admitted values.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Selection {
    pub scenes: Vec<String>,
    pub axes: Vec<(String, Vec<AxisValue>)>,
}

impl Selection {
    /// Whether a point is meant: every name given must match.
    pub fn admits(&self, point: &Point) -> bool {
        let scene = self.scenes.is_empty() || self.scenes.contains(&point.scene);
        let matches = |(name, values): &(String, Vec<AxisValue>)| {
            point.parameter(name).is_some_and(|value| values.contains(&value))
        };
        scene && self.axes.iter().all(matches)
    }
}

/// A statement that a study expects to hold.
#[derive(Clone, Debug, PartialEq)]
pub struct Expectation {
    /// Stable identifier: given by `id:` or made of kind and position.
    pub id: String,
    pub check: Check,
    pub selection: Selection,
    /// Claim identifiers it settles (`raso-fig5.4-c1`).
    pub claims: Vec<String>,
    /// Reported and shown, but never gates the exit code; with the reason.
    pub informative: Option<String>,
}

/// Bounds on a number; at least one is given.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Band {
    pub above: Option<f64>,
    pub below: Option<f64>,
}

/// How the deviations of a series become one number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Norm {
    #[default]
    Maximum,
    RootMeanSquare,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Check {
    /// A scalar lies in a band, in every selected run.
    Value { of: String, band: Band },
    /// Largest relative error of a quantity against a reference is below a bound, in every selected
    /// run. For a scalar: |x/x_ref − 1|; for a series: a norm of x − x_ref over max|x_ref|.
    Error {
        of: String,
        against: String,
        below: f64,
        norm: Norm,
    },
    /// Observed order of the error over an axis.
    Order {
        of: String,
        against: String,
        over: String,
        is: f64,
        within: f64,
    },
    /// A scalar rises (or falls) along an axis, everything else fixed.
    Monotone {
        of: String,
        over: String,
        rising: bool,
        /// A step against the trend below twice its standard error over seeds counts as flat.
        within_noise: bool,
    },
    /// A scalar of one selection of points beside that of another, everything else equal.
    Compare(Comparison),
    /// A scalar grows along an axis like a power of it, everything else fixed.
    Scaling {
        of: String,
        over: String,
        /// The exponent.
        is: f64,
        within: f64,
    },
    /// A parameter of a law fitted over an axis, everything else fixed.
    Fit(LawFit),
    /// Every selected run ends in one of these ways; divergence counts as an answer where it is named.
    Status { is: Vec<Ending> },
    /// Along an axis, a scalar leaves its band where the reference says; divergence counts as outside.
    Limit(Limit),
}

/// A parameter of a law that is fitted to a scalar over an axis.
#[derive(Clone, Debug, PartialEq)]
pub struct LawFit {
    pub law: FittedLaw,
    pub parameter: Parameter,
    pub target: FitTarget,
}

/// v = v_∞ ε^n.
#[derive(Clone, Debug, PartialEq)]
pub struct FittedLaw {
    /// The scalar v.
    pub of: String,
    /// Axis of the porosity ε.
    pub over: String,
    /// Whether absolute deviations are squared and not relative ones.
    pub linear: bool,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Parameter {
    /// n
    #[default]
    Exponent,
    /// v_∞
    Velocity,
}

/// What is expected of a fitted parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum FitTarget {
    /// The relative difference from the same fit to a reference at the same points is below a bound.
    Reference {
        against: String,
        below: f64,
    },
    Band(Band),
}

/// The end of a run that a study can ask for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    Completed,
    Diverged,
}

/// The place on an axis at which a scalar leaves a band, from small values of the axis up.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    pub of: String,
    pub band: Band,
    pub over: String,
    /// Reference for the place.
    pub against: String,
    /// Relative distance from the reference that the two neighbouring values of the axis may have.
    pub within: f64,
}

impl Check {
    /// Whether a run that diverges is an answer to it.
    pub fn asks_divergence(&self) -> bool {
        match self {
            Check::Status { is } => is.contains(&Ending::Diverged),
            Check::Limit(_) => true,
            _ => false,
        }
    }
}

impl Study {
    /// Whether an expectation about this point takes a divergence for an answer.
    pub fn asks_divergence(&self, point: &Point) -> bool {
        let mut about = self
            .expect
            .iter()
            .filter(|expectation| expectation.selection.admits(point));
        about.any(|expectation| expectation.check.asks_divergence())
    }
}

/// How a scalar of a first selection lies to that of a second.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    pub of: String,
    pub between: [Selection; 2],
    pub is: Relation,
    /// Relative to the value of the second: the least difference of `greater` and `less`, the largest of
    /// `equal`.
    pub margin: f64,
    /// Twice the standard error of the difference over seeds is allowed on top of `margin`.
    pub within_noise: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    Greater,
    Less,
    Equal,
}

/// A figure to draw.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Stable identifier: given by `id:` or made of kind and position; also the file stem.
    pub id: String,
    pub title: Option<String>,
    pub kind: FigureKind,
    pub selection: Selection,
    /// Thesis figure it stands beside (`raso-fig5.18`).
    pub thesis: Option<String>,
}

#[derive(Clone, Debug, PartialEq)]
pub enum FigureKind {
    /// Series over time, one line per run, with the reference where one is named.
    TimeSeries {
        of: Vec<String>,
        /// The series in the place of time.
        over: Option<String>,
        against: Option<String>,
        group: Option<String>,
    },
    /// Relative error over an axis, log–log, slope triangle, GCI bars.
    ErrorAgainstResolution {
        of: String,
        against: String,
        over: String,
        group: Option<String>,
    },
    /// Run time, or another measure of work, against error with the Pareto front.
    RunTimeAgainstError {
        of: String,
        against: String,
        /// `timings.wall` unless given.
        work: Option<String>,
        group: Option<String>,
    },
    /// A profile table, one line per run: first column upwards, `of` along.
    Profile { of: String, group: Option<String> },
    /// A scalar over an axis: mean over seeds with error bars, references beside.
    Response {
        of: String,
        over: String,
        group: Option<String>,
        against: Vec<Beside>,
    },
    /// The place on an axis at which a scalar leaves a band, over another axis, beside the reference.
    Limit {
        limit: Limit,
        across: String,
        group: Option<String>,
    },
    /// A profile table over time and height as a picture, curves on top.
    Map {
        of: String,
        curves: Vec<String>,
        against: Vec<String>,
    },
    /// A settling velocity over the porosity with its fitted law, correlations beside.
    RichardsonZaki {
        law: FittedLaw,
        against: Option<String>,
        group: Option<String>,
    },
    /// Flux of solids over their fraction, with the chords of shocks.
    Flux {
        of: String,
        over: String,
        /// Reference for the settling velocity at any porosity.
        against: String,
        /// Scalar that holds the fraction of the deposit.
        deposit: Option<String>,
        group: Option<String>,
    },
    /// Pictures of the grains of one point at the kept times nearest to these [s].
    Snapshots { times: Vec<f64> },
}

/// What a response is drawn beside.
#[derive(Clone, Debug, PartialEq)]
pub enum Beside {
    /// A reference by name, at each point's own settings.
    Reference(String),
    Data(DataSeries),
}

/// Two columns of a published table.
#[derive(Clone, Debug, PartialEq)]
pub struct DataSeries {
    /// File name in the folder `references`.
    pub file: String,
    pub x: String,
    pub y: String,
    /// What turns the columns into SI units.
    pub factors: (f64, f64),
    /// Rows to take: columns with the text they hold; all rows when empty.
    pub rows: Vec<(String, String)>,
    /// Its name in the legend.
    pub label: Option<String>,
}
