//! Grains at random, but evenly: over lengths of many grains the concentration is the same everywhere.
//!
//! The box is divided into as many cells of equal volume as there are grains, each grain begins anywhere in
//! its cell (stratified sampling, Neyman 1934), is pushed off those it overlaps and then shaken by Monte Carlo
//! moves that keep it near. The order between neighbours is lost this way, and that over long ways stays.
//! Which grain of the list begins in which cell follows an additive recurrence over the cells, Roberts
//! (2018), The unreasonable effectiveness of quasirandom sequences: so every part of the list, such as a
//! class, is spread evenly by itself.

use super::packing::{relaxed, within_limit};
use super::shaking::shake;
use super::{Dimensions, Fault, Region};
use crate::math::{Random, Vec3};

/// Root of x⁴ = x + 1: the recurrence advances by its inverse powers.
const GENERALISED_GOLDEN_RATIO: f64 = 1.220_744_084_605_759_5;
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
    let share = region.measure() / radii.len() as f64;
    let distance = match region.dimensions {
        Dimensions::Two => share.sqrt(),
        Dimensions::Three => share.cbrt(),
    };
    let points = points(region, radii.len(), distance, random);
    let mut positions = relaxed(region, radii, fraction, points, random)?;
    shake(region, radii, &mut positions, SWEEPS, REACH * distance, random);
    Ok(positions)
}

/// A point in every cell, in the order of the recurrence.
fn points(region: &Region, count: usize, distance: f64, random: &mut Random) -> Vec<Vec3> {
    let [width, depth, height] = region.lengths();
    let steps = [1, 2, 3].map(|power| GENERALISED_GOLDEN_RATIO.powi(-power));
    let start = random.uniform();
    let mut points = Vec::with_capacity(count);
    for (layer, [bottom, layer_height], in_layer) in slices(count, height, distance) {
        for (row, [front, row_depth], in_row) in slices(in_layer, depth, distance) {
            let cell = width / in_row as f64;
            for column in 0..in_row {
                let along =
                    start + column as f64 * steps[0] + row as f64 * steps[1] + layer as f64 * steps[2];
                let place = Vec3::new(
                    (column as f64 + random.uniform()) * cell,
                    front + random.uniform() * row_depth,
                    bottom + random.uniform() * layer_height,
                );
                points.push((along - along.floor(), place));
            }
        }
    }
    points.sort_by(|one, other| one.0.total_cmp(&other.0));
    points.into_iter().map(|(_, place)| place).collect()
}

/// Slices of a length, about as thick as the mean distance of grains, each with its share of `count` grains:
/// the number of the slice, where it begins and how thick it is [m], and its grains.
fn slices(count: usize, length: f64, distance: f64) -> impl Iterator<Item = (usize, [f64; 2], usize)> {
    let slices = ((length / distance).round() as usize).clamp(1, count.max(1));
    let until = move |slice: usize| slice * count / slices;
    (0..slices).map(move |slice| {
        let (first, last) = (until(slice), until(slice + 1));
        let thickness = (last - first) as f64 / count as f64 * length;
        (
            slice,
            [first as f64 / count as f64 * length, thickness],
            last - first,
        )
    })
}
