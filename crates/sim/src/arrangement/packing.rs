//! Grains at random, sparse or dense.

use super::insertion::insert;
use super::region::solids;
use super::relaxation::{Jam, Relaxation};
use super::shaking::shake;
use super::{Dimensions, Fault, Region};
use crate::math::{Random, Vec3, bisect};

/// Steps of relaxation before an excess of the radii is given up.
const STEPS: usize = 4000;
/// Monte Carlo moves per grain: enough to forget which pairs were pressed together, far too few to
/// crystallise.
const SWEEPS: usize = 40;
/// Moves between two stages of growth: few grains can afford many.
const MOVES: usize = 2_000_000;

/// What is missing of the radii while jammed grains grow back [-].
const SHRINKAGES: [f64; 12] = [
    0.08, 0.06, 0.05, 0.04, 0.03, 0.02, 0.015, 0.01, 0.006, 0.003, 0.001, 0.0,
];
/// Excess of the radii while they do [-].
const GROWTH_EXCESS: f64 = 1e-4;

/// The solids fraction [-] up to which grains are arranged at random: 0.60 for spheres, 0.80 for discs.
pub fn largest_solids_fraction(dimensions: Dimensions) -> f64 {
    match dimensions {
        Dimensions::Two => 0.80,
        Dimensions::Three => 0.60,
    }
}

/// Centres [m] of grains of these radii [m], at random over the whole box, without overlap.
///
/// Up to a solids fraction of 0.30 (0.50 in two dimensions) by random sequential addition, above it, or
/// where walls leave too little room for that, by a packing algorithm: shrunken grains are added at
/// random, grow to full size, push each other apart and are then shaken by Monte Carlo moves.
pub fn random(region: &Region, radii: &[f64], random: &mut Random) -> Result<Vec<Vec3>, Fault> {
    region.check(radii)?;
    if radii.is_empty() {
        return Ok(Vec::new());
    }
    let fraction = within_limit(region, radii)?;
    let sparse = match region.dimensions {
        Dimensions::Two => 0.50,
        Dimensions::Three => 0.30,
    };
    if fraction <= sparse
        && let Some(positions) = insert(region, radii, random)
    {
        return Ok(positions);
    }
    pack(region, radii, fraction, random)
}

/// Share of the box that the grains fill [-], where it can be filled at random so far.
pub(super) fn within_limit(region: &Region, radii: &[f64]) -> Result<f64, Fault> {
    let fraction = region.solids_fraction(radii);
    let limit = largest_solids_fraction(region.dimensions);
    // A box computed from the limit may miss it by rounding.
    if fraction > limit * (1.0 + 1e-9) {
        return Err(Fault::TooDense { fraction, limit });
    }
    Ok(fraction)
}

/// Centres [m] of a random packing without overlap that fills the box from the floor up to the height
/// at which its solids fraction [-] is the one asked for, at most 0.60 (0.80 in two dimensions).
///
/// The packing ends in a flat lid at that height.
pub fn packed(
    region: &Region,
    radii: &[f64],
    solids_fraction: f64,
    generator: &mut Random,
) -> Result<Vec<Vec3>, Fault> {
    let limit = largest_solids_fraction(region.dimensions);
    if !(solids_fraction > 0.0 && solids_fraction <= limit) {
        return Err(Fault::Fraction {
            fraction: solids_fraction,
            limit,
        });
    }
    region.check(radii)?;
    if radii.is_empty() {
        return Ok(Vec::new());
    }
    let floor = region.measure() / region.height;
    let height = solids(region.dimensions, radii) / (solids_fraction * floor);
    let diameter = 2.0 * radii.iter().copied().fold(0.0, f64::max);
    if height > region.height * (1.0 + 1e-9) {
        return Err(Fault::TooHigh {
            fraction: solids_fraction,
            needed: height,
            height: region.height,
        });
    }
    if height < diameter {
        return Err(Fault::TooLow {
            fraction: solids_fraction,
            needed: height,
            diameter,
        });
    }
    let filled = Region {
        height: height.min(region.height),
        ..*region
    };
    random(&filled, radii, generator)
}

fn pack(region: &Region, radii: &[f64], fraction: f64, random: &mut Random) -> Result<Vec<Vec3>, Fault> {
    let positions = start(region, radii, fraction, random);
    let mut positions = relaxed(region, radii, fraction, positions, random)?;
    shake(region, radii, &mut positions, SWEEPS, f64::INFINITY, random);
    Ok(positions)
}

/// Pushes grains that overlap apart.
pub(super) fn relaxed(
    region: &Region,
    radii: &[f64],
    fraction: f64,
    positions: Vec<Vec3>,
    random: &mut Random,
) -> Result<Vec<Vec3>, Fault> {
    // Radii somewhat too large leave room for rest.
    let excess = 0.3 * room(region.dimensions, fraction);
    let result = match Relaxation::new(region, radii, positions, excess).run(STEPS) {
        Ok(relaxed) => Ok(relaxed),
        Err((jammed, _)) => regrow(region, radii, jammed, random),
    };
    result.map_err(|overlap| Fault::Jammed { fraction, overlap })
}

/// Shrinks grains that jammed and lets them grow back by and by, shaken in between so that they find
/// denser places along walls; if that fails, once more with patience. Gives back the largest overlap
/// [-] where even that jams.
fn regrow(
    region: &Region,
    radii: &[f64],
    mut positions: Vec<Vec3>,
    random: &mut Random,
) -> Result<Vec<Vec3>, f64> {
    let patient = (MOVES / radii.len()).clamp(SWEEPS, 50 * SWEEPS);
    let mut overlap = 0.0;
    for sweeps in [SWEEPS, patient] {
        match grow(region, radii, positions, sweeps, random) {
            Ok(grown) => return Ok(grown),
            Err((jammed, worst)) => (positions, overlap) = (jammed, worst),
        }
    }
    Err(overlap)
}

fn grow(
    region: &Region,
    radii: &[f64],
    mut positions: Vec<Vec3>,
    sweeps: usize,
    random: &mut Random,
) -> Result<Vec<Vec3>, Jam> {
    for shrinkage in SHRINKAGES {
        let shrunken: Vec<f64> = radii.iter().map(|r| r * (1.0 - shrinkage)).collect();
        positions = Relaxation::new(region, &shrunken, positions, GROWTH_EXCESS).run(STEPS)?;
        shake(region, &shrunken, &mut positions, sweeps, f64::INFINITY, random);
    }
    Ok(positions)
}

/// How much grains of equal size could grow before they jam [-], at random close packing: 0.64 for
/// spheres (O'Hern et al. 2003), 0.84 for discs. First term of the root: a rough measure is enough.
fn room(dimensions: Dimensions, fraction: f64) -> f64 {
    let room = match dimensions {
        Dimensions::Two => (0.84 / fraction - 1.0) / 2.0,
        Dimensions::Three => (0.64 / fraction - 1.0) / 3.0,
    };
    room.min(0.3)
}

/// Shrunken grains without overlap, as large as is quickly inserted.
fn start(region: &Region, radii: &[f64], fraction: f64, random: &mut Random) -> Vec<Vec3> {
    let mut scale = match region.dimensions {
        Dimensions::Two => (0.35 / fraction).sqrt().min(0.9),
        // The cube root, the same on every machine.
        Dimensions::Three => bisect(0.0, 1.0, |scale| scale * scale * scale - 0.20 / fraction).min(0.9),
    };
    loop {
        let shrunken: Vec<f64> = radii.iter().map(|r| scale * r).collect();
        if let Some(positions) = insert(region, &shrunken, random) {
            return positions;
        }
        scale *= 0.8;
    }
}
