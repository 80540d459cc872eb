//! What a run gives back: scalars, time series, profiles and work counters.

/// A named number with its unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Scalar {
    pub name: &'static str,
    pub unit: &'static str,
    pub value: f64,
}

/// One column of a [`Table`].
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    pub name: &'static str,
    pub unit: &'static str,
    pub values: Vec<f64>,
}

/// Columns of equal length. The first is the independent variable (time, height).
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// `time_series`, or the name of a profile such as `porosity_profile`.
    pub name: &'static str,
    pub columns: Vec<Column>,
}

/// Work done by a run, independent of the machine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Fluid steps (grain steps where no fluid is solved).
    pub steps: u64,
    /// Grain steps, all sub-steps counted once per step, not per grain.
    pub grain_steps: u64,
    /// Fluid–fluid pairs evaluated.
    pub fluid_pairs: u64,
    /// Fluid–grain pairs evaluated.
    pub coupling_pairs: u64,
    /// Grain–grain pairs evaluated.
    pub grain_pairs: u64,
    /// Grain–grain pairs looked at in search of near ones.
    pub searched_pairs: u64,
    /// Neighbour list rebuilds.
    pub list_rebuilds: u64,
    /// Porosities clipped to their floor.
    pub porosity_clips: u64,
}

/// Everything a run computed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outcome {
    pub scalars: Vec<Scalar>,
    pub tables: Vec<Table>,
    pub counters: Counters,
}

/// Why a run did not reach its end. What was computed so far is kept.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    pub kind: FailureKind,
    /// In words: what, when, where, which particle.
    pub reason: String,
    pub partial: Outcome,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FailureKind {
    /// Not finite, too much overlap, or energy out of nowhere.
    Diverged,
    /// Stopped from outside through [`Control::stop`].
    Stopped,
}

/// What a run spent its time on [s], by name.
pub type SplitOfTime = [(&'static str, f64)];

/// How a running simulation talks to whoever started it.
pub struct Control<'a> {
    /// Asked once per step; true ends the run with [`FailureKind::Stopped`].
    pub stop: &'a dyn Fn() -> bool,
    /// Told the finished fraction, 0 to 1, from time to time.
    pub progress: &'a dyn Fn(f64),
    /// Told at the end what the run spent its time on [s], by name, where the scene keeps count.
    pub split: &'a dyn Fn(&SplitOfTime),
}

impl Control<'_> {
    /// Never stops, tells nobody.
    pub const SILENT: Control<'static> = Control {
        stop: &|| false,
        progress: &|_| {},
        split: &|_| {},
    };
}
