//! Where the report gets its judged numbers and reference curves: from the judge and the references,
//! never from formulas of its own.

use crate::judge;
use crate::judge::convergence::{Honesty, extrapolate, observed_order};
use crate::reference::{self, Facts};
use crate::store::model::Run;
use crate::study::model::Norm;

/// A quantity of one run beside its reference, in SI units; the error is relative.
#[derive(Clone, Debug, PartialEq)]
pub struct PointError {
    pub computed: Option<f64>,
    pub expected: Option<f64>,
    /// Not negative, dimensionless.
    pub error: f64,
    /// With its sign, for orders.
    pub signed: f64,
    /// Citation of the reference.
    pub source: String,
}

/// What a sweep of resolutions says about its own convergence.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Convergence {
    /// Slope of the error over the resolution, both logarithmic.
    pub order: Option<f64>,
    /// Grid convergence index of the finest point as a relative uncertainty; only where the sweep
    /// is monotone and close to asymptotic.
    pub index: Option<f64>,
    /// Why there is no order.
    pub no_order: Option<String>,
    /// Why there is no index.
    pub no_index: Option<String>,
}

impl Convergence {
    /// What is not shown of a sweep, and why.
    pub fn doubts(&self) -> Option<String> {
        match (&self.no_order, &self.no_index) {
            (None, None) => None,
            (Some(why), None) => Some(format!("no observed order, because {why}")),
            (None, Some(why)) => Some(format!("no grid convergence index, because {why}")),
            (Some(order), Some(index)) if order == index => Some(format!(
                "no observed order and no grid convergence index, because {order}"
            )),
            (Some(order), Some(index)) => Some(format!(
                "no observed order, because {order}; no grid convergence index, because {index}"
            )),
        }
    }
}

/// A reference curve, one value per abscissa, SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    pub values: Vec<f64>,
    pub source: String,
}

/// A measured curve with its own times, SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    pub times: Vec<f64>,
    pub values: Vec<f64>,
    pub source: String,
}

/// One resolution of a sweep; a mean over replicates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolved {
    pub resolution: f64,
    /// Value of the quantity, where it is a single one.
    pub value: Option<f64>,
    /// Relative error with its sign.
    pub error: f64,
}

pub type ErrorOf<'a> = dyn Fn(&Run, &str, &str) -> Result<PointError, String> + 'a;
pub type ConvergenceOf<'a> = dyn Fn(&[Resolved]) -> Convergence + 'a;
pub type FrontOf<'a> = dyn Fn(&[(f64, f64)]) -> Vec<usize> + 'a;
pub type CurveOf<'a> = dyn Fn(&Run, &str, &[f64]) -> Result<Curve, String> + 'a;
pub type PointsOf<'a> = dyn Fn(&Run, &str) -> Result<Option<Measured>, String> + 'a;

/// The functions a report calls for its numbers.
#[derive(Clone, Copy)]
pub struct Numbers<'a> {
    pub error: &'a ErrorOf<'a>,
    pub convergence: &'a ConvergenceOf<'a>,
    /// Indices of the pairs (cost, error) that no other pair beats in both.
    pub front: &'a FrontOf<'a>,
    pub curve: &'a CurveOf<'a>,
    /// A reference that has times of its own.
    pub points: &'a PointsOf<'a>,
}

impl Numbers<'static> {
    /// The judge's numbers and the references' curves.
    pub const JUDGED: Numbers<'static> = Numbers {
        error: &point_error,
        convergence: &convergence,
        front: &judge::pareto::front,
        curve: &curve,
        points: &points,
    };
}

/// Resolutions that the documentation recommends, by axis; marked in run time against error.
pub const RECOMMENDED: &[(&str, f64)] = &[("spacing_over_diameter", 2.0)];

fn point_error(run: &Run, of: &str, against: &str) -> Result<PointError, String> {
    let found = judge::point_error::point_error(run, of, against, Norm::Maximum)
        .map_err(|error| error.to_string())?;
    Ok(PointError {
        computed: Some(found.computed),
        expected: Some(found.expected),
        error: found.error,
        signed: found.signed,
        source: found.source,
    })
}

/// An order or an index is given only where the judge calls the sweep monotone.
fn convergence(sweep: &[Resolved]) -> Convergence {
    let sizes: Vec<f64> = sweep.iter().map(|point| point.resolution).collect();
    let errors: Vec<f64> = sweep.iter().map(|point| point.error).collect();
    let observed = observed_order(&sizes, &errors);
    let values: Option<Vec<f64>> = sweep.iter().map(|point| point.value).collect();
    let extrapolated = values.map(|values| extrapolate(&sizes, &values, observed.order));
    let no_index = match &extrapolated {
        Some(extrapolated) => doubt_of_values(extrapolated.honesty),
        None => Some("a series has no single value"),
    };
    let index = extrapolated
        .filter(|_| no_index.is_none())
        .and_then(|extrapolated| extrapolated.indices.first().copied());
    Convergence {
        order: (observed.honesty == Honesty::Monotone).then_some(observed.order),
        index,
        no_order: doubt_of_errors(observed.honesty).map(str::to_owned),
        no_index: no_index.map(str::to_owned),
    }
}

fn doubt_of_errors(honesty: Honesty) -> Option<&'static str> {
    match honesty {
        Honesty::Monotone => None,
        Honesty::Oscillating => Some("the error changes its sign along the sweep"),
        Honesty::NotAsymptotic => Some("the error does not fall at one steady order"),
        Honesty::TooFew => Some("there are fewer than three resolutions"),
    }
}

fn doubt_of_values(honesty: Honesty) -> Option<&'static str> {
    match honesty {
        Honesty::Monotone => None,
        Honesty::Oscillating => Some("the values rise and fall along the sweep"),
        Honesty::NotAsymptotic => Some("the values do not converge at one steady order"),
        Honesty::TooFew => Some("there are fewer than three resolutions"),
    }
}

fn points(run: &Run, name: &str) -> Result<Option<Measured>, String> {
    let scalars = |name: &str| run.scalar(name).map(|scalar| scalar.value);
    let facts = Facts {
        settings: &run.settings,
        scalars: &scalars,
    };
    let points = reference::points(name, &facts).map_err(|error| error.to_string())?;
    Ok(points.map(|points| Measured {
        times: points.times,
        values: points.values,
        source: points.source,
    }))
}

fn curve(run: &Run, name: &str, times: &[f64]) -> Result<Curve, String> {
    let scalars = |name: &str| run.scalar(name).map(|scalar| scalar.value);
    let facts = Facts {
        settings: &run.settings,
        scalars: &scalars,
    };
    let expected = reference::series(name, &facts, times).map_err(|error| error.to_string())?;
    Ok(Curve {
        values: expected.values,
        source: expected.source,
    })
}
