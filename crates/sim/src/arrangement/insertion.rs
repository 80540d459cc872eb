//! Random sequential addition: one grain after the other where there is room.
//!
//! Widom (1966), Random sequential addition of hard spheres to a volume, doi:10.1063/1.1726548.

use super::levels::Levels;
use super::{CLEARANCE, Region};
use crate::math::{Random, Vec3};

/// Places tried for one grain. Below the limits of [`super::random`] a try succeeds about once in a
/// thousand or more often, so that this many failures mean that there is no room.
const TRIES: usize = 50_000;

/// Centres [m] of grains of these radii [m] without overlap; `None` where one finds no room.
///
/// Large grains go first, as they would find no room among small ones; equal ones go in random order.
pub(super) fn insert(region: &Region, radii: &[f64], random: &mut Random) -> Option<Vec<Vec3>> {
    let mut order: Vec<usize> = (0..radii.len()).collect();
    random.shuffle(&mut order);
    order.sort_by(|&a, &b| radii[b].total_cmp(&radii[a]));
    let mut levels = Levels::new(region, radii, 0.0);
    let mut positions = vec![Vec3::zeros(); radii.len()];
    for &grain in &order {
        let radius = radii[grain];
        let position = (0..TRIES).find_map(|_| {
            let place = anywhere(region, radius, random);
            // Those already there are as large or larger.
            let taken = levels.any_as_large_near(grain, &place, radius, |other| {
                touches(region, &place, radius, &positions[other], radii[other])
            });
            (!taken).then_some(place)
        })?;
        levels.insert(grain, &position);
        positions[grain] = position;
    }
    Some(positions)
}

/// Whether two grains are nearer than they may be.
#[inline(always)]
pub(super) fn touches(region: &Region, a: &Vec3, radius_a: f64, b: &Vec3, radius_b: f64) -> bool {
    let contact = (radius_a + radius_b) * (1.0 + CLEARANCE);
    region.nearest(a - b).norm_squared() < contact * contact
}

fn anywhere(region: &Region, radius: f64, random: &mut Random) -> Vec3 {
    let coordinates = [0, 1, 2].map(|axis| {
        let (low, high) = region.bounds(axis, radius);
        let coordinate = random.between(low, high);
        region.confine(axis, radius, coordinate)
    });
    Vec3::from(coordinates)
}
