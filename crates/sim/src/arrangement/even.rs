//! Grains at random, but evenly: over lengths of many grains the concentration is the same everywhere.
//!
//! Grains begin at the points of an additive recurrence, which fill space evenly at every length, are pushed
//! apart where they overlap and then shaken by Monte Carlo moves that keep each of them near its point. The
//! order between neighbours is lost this way, and that over long ways stays. The recurrence is that of
//! Roberts (2018), The unreasonable effectiveness of quasirandom sequences, with four coordinates: three
//! are the place, and the fourth says which grain of the list stands there, so that every part of the list,
//! such as a class, is spread evenly by itself.

use super::packing::{relaxed, within_limit};
use super::shaking::shake;
use super::{Dimensions, Fault, Region};
use crate::math::{Random, Vec3};

/// Root of x⁵ = x + 1: the recurrence advances by its inverse powers.
const GENERALISED_GOLDEN_RATIO: f64 = 1.167_303_978_261_418_7;
/// Monte Carlo moves per grain.
const SWEEPS: usize = 40;
/// Farthest that a grain gets from its point over the mean distance of grains [-].
const REACH: f64 = 0.7;

/// Centres [m] of grains of these radii [m], at random but evenly over the whole box, without overlap.
///
/// The box is filled evenly up to its floor and lid: what would reach through them lies at them.
pub fn even(region: &Region, radii: &[f64], random: &mut Random) -> Result<Vec<Vec3>, Fault> {
    region.check(radii)?;
    if radii.is_empty() {
        return Ok(Vec::new());
    }
    let fraction = within_limit(region, radii)?;
    let mut positions = relaxed(
        region,
        radii,
        fraction,
        points(region, radii.len(), random),
        random,
    )?;
    let share = region.measure() / radii.len() as f64;
    let distance = match region.dimensions {
        Dimensions::Two => share.sqrt(),
        Dimensions::Three => share.cbrt(),
    };
    shake(region, radii, &mut positions, SWEEPS, REACH * distance, random);
    Ok(positions)
}

/// Points of the recurrence, in the order of their fourth coordinate.
fn points(region: &Region, count: usize, random: &mut Random) -> Vec<Vec3> {
    let lengths = region.lengths();
    let mut step = 1.0;
    let coordinates = [0; 4].map(|_| {
        step /= GENERALISED_GOLDEN_RATIO;
        (random.uniform(), step)
    });
    let mut points: Vec<[f64; 4]> = (0..count)
        .map(|index| {
            coordinates.map(|(start, step)| {
                let along = start + index as f64 * step;
                along - along.floor()
            })
        })
        .collect();
    points.sort_by(|one, other| one[3].total_cmp(&other[3]));
    let place = |point: [f64; 4]| Vec3::from([0, 1, 2].map(|axis| point[axis] * lengths[axis]));
    points.into_iter().map(place).collect()
}
