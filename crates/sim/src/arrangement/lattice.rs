//! Grains on a lattice.

use super::{CLEARANCE, Dimensions, Fault, Region};
use crate::math::{Random, Vec3};

/// Largest displacement from a site over the pitch, along each axis [-].
const SHAKE: f64 = 0.01;

/// Centres [m] on a cubic lattice over the whole box (square in two dimensions), each shaken by up to a
/// hundredth of the pitch, less where grains would touch. Grains take sites at random, so kinds are mixed.
///
/// The numbers of sites along the axes are those of the widest cubic lattice with a site for every grain;
/// the pitch is then stretched along each axis to fill the box. Sites left over stay empty, at random.
pub fn lattice(region: &Region, radii: &[f64], random: &mut Random) -> Result<Vec<Vec3>, Fault> {
    region.check(radii)?;
    if radii.is_empty() {
        return Ok(Vec::new());
    }
    let counts = counts(region, radii.len());
    let lengths = region.lengths();
    let pitch = [0, 1, 2].map(|axis| lengths[axis] / counts[axis] as f64);
    let smallest_pitch = (0..3)
        .filter(|&axis| pitch[axis] > 0.0)
        .map(|axis| pitch[axis])
        .fold(f64::INFINITY, f64::min);
    let diameter = 2.0 * radii.iter().copied().fold(0.0, f64::max) * (1.0 + CLEARANCE);
    if diameter > smallest_pitch {
        return Err(Fault::LatticeTooTight {
            grains: radii.len(),
            pitch: smallest_pitch,
            diameter,
        });
    }
    let shake = (SHAKE * smallest_pitch).min(0.5 * (smallest_pitch - diameter));
    let mut sites: Vec<usize> = (0..counts.iter().product()).collect();
    random.shuffle(&mut sites);
    let mut places = Vec::with_capacity(radii.len());
    for &site in &sites[..radii.len()] {
        let index = [
            site % counts[0],
            site / counts[0] % counts[1],
            site / (counts[0] * counts[1]),
        ];
        let coordinates = [0, 1, 2].map(|axis| match pitch[axis] {
            0.0 => 0.0,
            pitch => (index[axis] as f64 + 0.5) * pitch + random.between(-shake, shake),
        });
        places.push(Vec3::from(coordinates));
    }
    Ok(places)
}

/// Sites along each axis: as many cubes as fit at the widest pitch that has `grains` of them.
fn counts(region: &Region, grains: usize) -> [usize; 3] {
    let lengths = region.lengths();
    let at = |pitch: f64| {
        [0, 1, 2].map(|axis| match (axis, region.dimensions) {
            (1, Dimensions::Two) => 1,
            _ => ((lengths[axis] / pitch) as usize).max(1),
        })
    };
    let enough = |pitch: f64| at(pitch).iter().map(|&n| n as f64).product::<f64>() >= grains as f64;
    let (mut narrow, mut wide) = (0.0, lengths.iter().copied().fold(0.0, f64::max));
    if enough(wide) {
        return at(wide);
    }
    // The number of sites falls with the pitch; sixty halvings leave nothing but rounding.
    for _ in 0..60 {
        let middle = 0.5 * (narrow + wide);
        if enough(middle) {
            narrow = middle;
        } else {
            wide = middle;
        }
    }
    at(narrow)
}
