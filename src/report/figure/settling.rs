//! Settling velocities over the porosity, as means over seeds: shared by the figures that draw them.

use super::super::theme::{self, Style};
use super::{Material, lines};
use crate::judge::point_error::{Mean, mean_scalar};
use crate::judge::select::{Replicates, chains, gathered};
use crate::report::{ReportError, selection};

/// Means along the porosity, everything else fixed.
pub struct Suspension<'a> {
    pub label: String,
    pub style: Style,
    /// Porosity, velocity, runs; porosities rise.
    pub points: Vec<(f64, Mean, Replicates<'a>)>,
}

impl Suspension<'_> {
    pub fn porosities(&self) -> Vec<f64> {
        self.points.iter().map(|point| point.0).collect()
    }

    pub fn velocities(&self) -> Vec<f64> {
        self.points.iter().map(|point| point.1.value).collect()
    }

    pub fn unit(&self) -> &str {
        self.points.first().map_or("1", |point| &point.1.unit)
    }
}

/// One per value of what varies beside the porosity, and what the legend lists the values of.
pub fn suspensions<'a>(
    material: &Material<'a>,
    of: &str,
    over: &str,
    group: Option<&str>,
) -> Result<(Vec<Suspension<'a>>, Option<String>), ReportError> {
    let groups = gathered(material.study, material.runs.clone());
    let chains = chains(material.study, material.all, &groups, over);
    if chains.is_empty() {
        let message = format!("no run of this figure has a number `{over}`: name the axis of the porosity");
        return Err(ReportError(message));
    }
    let firsts: Vec<_> = chains.iter().map(|chain| chain.steps[0].1.first()).collect();
    let varying = selection::varying(&firsts, &[over]);
    let by = match (group, varying.as_slice()) {
        (Some(name), _) => Some(name.to_owned()),
        (None, [name]) => Some(name.clone()),
        _ => None,
    };
    let mut found = Vec::new();
    for (index, chain) in chains.into_iter().enumerate() {
        let first = chain.steps[0].1.first();
        let label = match &by {
            Some(name) => material.value(first, name),
            None => material.distinction(first, &varying),
        };
        let mut points = Vec::new();
        for (porosity, replicates) in chain.steps {
            let mean = mean_scalar(&replicates, of);
            let mean = mean.map_err(|why| ReportError(format!("{}: {why}", replicates.label())))?;
            points.push((porosity, mean, replicates));
        }
        let style = Style {
            dash: theme::SOLID,
            ..theme::style(index)
        };
        found.push(Suspension { label, style, points });
    }
    Ok((found, by.as_deref().and_then(selection::heading)))
}

/// Largest velocity, for a readable unit.
pub fn fastest(suspensions: &[Suspension]) -> f64 {
    let velocities: Vec<f64> = suspensions.iter().flat_map(Suspension::velocities).collect();
    lines::largest(&velocities)
}
