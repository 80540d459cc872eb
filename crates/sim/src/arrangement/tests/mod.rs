//! What several tests of arrangements need.

mod soundness;
mod structure;

use super::*;
use crate::math::{Random, Vec3};
use std::f64::consts::PI;

fn cube(side: f64, periodic: bool) -> Region {
    Region {
        width: side,
        depth: side,
        height: side,
        periodic: [periodic; 2],
        dimensions: Dimensions::Three,
    }
}

fn square(side: f64, periodic: bool) -> Region {
    Region {
        dimensions: Dimensions::Two,
        ..cube(side, periodic)
    }
}

/// Side of the cube or square that these grains fill to a solids fraction.
fn side(dimensions: Dimensions, radii: &[f64], fraction: f64) -> f64 {
    match dimensions {
        Dimensions::Two => (radii.iter().map(|r| PI * r * r).sum::<f64>() / fraction).sqrt(),
        Dimensions::Three => {
            (radii.iter().map(|r| 4.0 / 3.0 * PI * r.powi(3)).sum::<f64>() / fraction).cbrt()
        }
    }
}

/// Distance of two centres over all images beyond the sides.
fn distance(region: &Region, a: &Vec3, b: &Vec3) -> f64 {
    let difference = a - b;
    let (sideways, across) = match (region.periodic[0], region.dimensions) {
        (false, _) => (0, 0),
        (true, Dimensions::Two) => (1, 0),
        (true, Dimensions::Three) => (1, 1),
    };
    let mut nearest = f64::INFINITY;
    for x in -sideways..=sideways {
        for y in -across..=across {
            let image = Vec3::new(f64::from(x) * region.width, f64::from(y) * region.depth, 0.0);
            nearest = nearest.min((difference + image).norm_squared());
        }
    }
    nearest.sqrt()
}

/// Largest overlap of any pair [m], by brute force; negative where all keep apart.
fn largest_overlap(region: &Region, radii: &[f64], positions: &[Vec3]) -> f64 {
    let mut worst = f64::NEG_INFINITY;
    for i in 0..positions.len() {
        for j in 0..i {
            worst = worst.max(radii[i] + radii[j] - distance(region, &positions[i], &positions[j]));
        }
    }
    worst
}

/// Farthest that any grain reaches outside [m]; periodic sides hold its centre, walls its surface.
fn largest_escape(region: &Region, radii: &[f64], positions: &[Vec3]) -> f64 {
    let mut worst = f64::NEG_INFINITY;
    for (position, &radius) in positions.iter().zip(radii) {
        let margin = if region.periodic[0] { 0.0 } else { radius };
        let mut outside = |x: f64, length: f64, margin: f64| {
            assert!(x.is_finite());
            worst = worst.max(margin - x).max(x + margin - length);
        };
        outside(position.x, region.width, margin);
        outside(position.z, region.height, radius);
        match region.dimensions {
            Dimensions::Two => assert_eq!(position.y, 0.0),
            Dimensions::Three => outside(position.y, region.depth, margin),
        }
    }
    worst
}

fn assert_sound(region: &Region, radii: &[f64], positions: &[Vec3]) {
    assert_eq!(positions.len(), radii.len());
    let overlap = largest_overlap(region, radii, positions);
    assert!(overlap <= 0.0, "{region:?}: overlap {overlap:e}");
    let escape = largest_escape(region, radii, positions);
    // The centre of a grain exactly as wide as the box is rounded.
    assert!(
        escape <= 1e-15 * region.height.max(region.width),
        "{region:?}: escape {escape:e}"
    );
}

fn sizes(number: usize, smallest: f64, largest: f64) -> Vec<f64> {
    let mut random = Random::new(99);
    (0..number)
        .map(|_| spread(&mut random, smallest, largest))
        .collect()
}
