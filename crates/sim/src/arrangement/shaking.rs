//! Monte Carlo moves of hard grains, which wear off the traces of how they were placed.
//!
//! Metropolis, Rosenbluth, Rosenbluth, Teller and Teller (1953), doi:10.1063/1.1699114: a small random
//! move of one grain is kept unless it makes grains overlap.

use super::Region;
use super::insertion::touches;
use super::levels::Levels;
use crate::math::{Random, Vec3};

/// Moves grains that do not overlap about, so that they still do not; every grain `sweeps` times, none
/// farther than `reach` [m] from where it was.
pub(super) fn shake(
    region: &Region,
    radii: &[f64],
    positions: &mut [Vec3],
    sweeps: usize,
    reach: f64,
    random: &mut Random,
) {
    let mut levels = Levels::new(region, radii, 0.0);
    for (grain, position) in positions.iter().enumerate() {
        levels.insert(grain, position);
    }
    let anchors = positions.to_vec();
    let mut step = 0.1 * radii.iter().sum::<f64>() / radii.len() as f64;
    for _ in 0..sweeps {
        let mut kept = 0;
        for grain in 0..radii.len() {
            let place = beside(region, radii[grain], &positions[grain], step, random);
            let strayed = region.nearest(place - anchors[grain]).norm_squared() > reach * reach;
            let taken = strayed
                || levels.any_near(&place, radii[grain], |other| {
                    other != grain && touches(region, &place, radii[grain], &positions[other], radii[other])
                });
            if !taken {
                levels.displace(grain, &positions[grain], &place);
                positions[grain] = place;
                kept += 1;
            }
        }
        // About half of the moves should succeed.
        step *= if 2 * kept > radii.len() { 1.1 } else { 0.8 };
    }
}

fn beside(region: &Region, radius: f64, position: &Vec3, step: f64, random: &mut Random) -> Vec3 {
    let coordinates = [0, 1, 2].map(|axis| {
        let moved = position[axis] + random.between(-step, step);
        let (low, high) = region.bounds(axis, radius);
        match region.wraps(axis) || (low..=high).contains(&moved) {
            true => region.confine(axis, radius, moved),
            // A move through a wall is refused along this axis, not cut short at the wall.
            false => position[axis],
        }
    });
    Vec3::from(coordinates)
}
