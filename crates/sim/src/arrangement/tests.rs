//! What any arrangement must be, and what random ones look like.

use super::*;
use crate::math::{Random, Vec3};
use proptest::prelude::*;
use std::f64::consts::PI;

fn cube(side: f64, periodic: bool) -> Region {
    Region {
        width: side,
        depth: side,
        height: side,
        periodic,
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
    let shifts = |periodic: bool, length: f64| match periodic {
        true => vec![-length, 0.0, length],
        false => vec![0.0],
    };
    let mut nearest = f64::INFINITY;
    for x in shifts(region.periodic, region.width) {
        for y in shifts(
            region.periodic && region.dimensions == Dimensions::Three,
            region.depth,
        ) {
            nearest = nearest.min((a - b + Vec3::new(x, y, 0.0)).norm());
        }
    }
    nearest
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
        let margin = if region.periodic { 0.0 } else { radius };
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

#[test]
fn random_grains_never_overlap_and_stay_inside() {
    for periodic in [false, true] {
        for radii in [vec![1e-4; 1500], sizes(1500, 1e-4, 1e-3)] {
            for fraction in [0.01, 0.25, 0.30, 0.45, 0.55] {
                let region = cube(side(Dimensions::Three, &radii, fraction), periodic);
                assert_sound(
                    &region,
                    &radii,
                    &random(&region, &radii, &mut Random::new(1)).unwrap(),
                );
            }
            for fraction in [0.01, 0.40, 0.50, 0.70, 0.80] {
                let region = square(side(Dimensions::Two, &radii, fraction), periodic);
                assert_sound(
                    &region,
                    &radii,
                    &random(&region, &radii, &mut Random::new(1)).unwrap(),
                );
            }
        }
    }
}

#[test]
fn reaches_the_largest_solids_fraction() {
    for (periodic, number) in [(true, 2000), (false, 5000)] {
        let radii = vec![0.5; number];
        let region = cube(side(Dimensions::Three, &radii, 0.60), periodic);
        let positions = random(&region, &radii, &mut Random::new(3)).unwrap();
        assert_sound(&region, &radii, &positions);
    }
}

#[test]
fn a_packing_fills_the_box_up_to_its_height_and_no_further() {
    for fraction in [0.2, 0.5, 0.58] {
        let radii = vec![0.5; 2000];
        let region = Region {
            height: 100.0,
            ..cube(12.0, true)
        };
        let positions = packed(&region, &radii, fraction, &mut Random::new(8)).unwrap();
        assert_sound(&region, &radii, &positions);
        let top = positions.iter().map(|p| p.z + 0.5).fold(0.0, f64::max);
        let reached = 2000.0 * PI / 6.0 / (144.0 * top);
        // The lid is touched to within a small part of a diameter.
        assert!(
            reached >= fraction && reached < 1.02 * fraction,
            "{reached} for {fraction}"
        );
    }
}

#[test]
fn the_seed_alone_decides() {
    let radii = sizes(600, 0.5, 2.0);
    let sparse = cube(side(Dimensions::Three, &radii, 0.2), true);
    let dense = cube(side(Dimensions::Three, &radii, 0.5), false);
    let place = |seed| {
        [
            random(&sparse, &radii, &mut Random::new(seed)).unwrap(),
            random(&dense, &radii, &mut Random::new(seed)).unwrap(),
            lattice(&sparse, &vec![0.1; 600], &mut Random::new(seed)).unwrap(),
        ]
    };
    let here = place(4);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build().unwrap();
    assert_eq!(here, pool.install(|| place(4)));
    for (one, other) in here.iter().zip(place(5)) {
        assert_ne!(*one, other);
    }
}

/// Standard deviation of the number of centres in `slices` equal slices, over the mean number.
fn unevenness(coordinates: impl Iterator<Item = f64>, low: f64, high: f64, slices: usize) -> f64 {
    let mut counts = vec![0.0; slices];
    for coordinate in coordinates.filter(|x| (low..high).contains(x)) {
        counts[((coordinate - low) / (high - low) * slices as f64) as usize] += 1.0;
    }
    let mean = counts.iter().sum::<f64>() / slices as f64;
    (counts.iter().map(|n| (n - mean) * (n - mean)).sum::<f64>() / slices as f64).sqrt() / mean
}

#[test]
fn grains_are_spread_evenly() {
    let radii = vec![0.5; 8000];
    for fraction in [0.05, 0.3, 0.4, 0.58] {
        let length = side(Dimensions::Three, &radii, fraction);
        let region = cube(length, true);
        let positions = random(&region, &radii, &mut Random::new(2)).unwrap();
        // Points independent of each other scatter by this much; grains that exclude each other less.
        let noise = (10.0f64 / 8000.0).sqrt();
        for axis in 0..2 {
            let scatter = unevenness(positions.iter().map(|p| p[axis]), 0.0, length, 10);
            assert!(
                scatter < 1.5 * noise,
                "{fraction} along {axis}: {scatter} for {noise}"
            );
        }
        // Layers along floor and lid are left out, and slices are as high as a few of them.
        let scatter = unevenness(positions.iter().map(|p| p.z), 2.0, length - 2.0, 6);
        assert!(scatter < 1.5 * noise, "{fraction} upwards: {scatter} for {noise}");
    }
}

#[test]
fn sizes_are_mixed_through_the_whole_box() {
    let radii: Vec<f64> = (0..6000)
        .map(|grain| if grain < 3000 { 0.5 } else { 0.8 })
        .collect();
    let region = cube(side(Dimensions::Three, &radii, 0.5), true);
    let positions = random(&region, &radii, &mut Random::new(6)).unwrap();
    let mean = |half: &[Vec3], axis: usize| half.iter().map(|p| p[axis]).sum::<f64>() / 3000.0;
    // Four standard deviations of the mean of 3000 uniform numbers.
    let noise = 4.0 * region.width / (12.0f64 * 3000.0).sqrt();
    for axis in 0..3 {
        for half in [&positions[..3000], &positions[3000..]] {
            assert!((mean(half, axis) - 0.5 * region.width).abs() < noise);
        }
    }
}

/// Pairs with r in [low, high) over those of independent points, away from floor and lid.
fn pair_correlation(region: &Region, positions: &[Vec3], low: f64, high: f64) -> f64 {
    let inner = |p: &&Vec3| p.z > 3.0 && p.z < region.height - 3.0;
    let (mut pairs, mut centres) = (0.0, 0.0);
    for (i, a) in positions.iter().enumerate().filter(|(_, p)| inner(p)) {
        centres += 1.0;
        let near = |(j, b): &(usize, &Vec3)| *j != i && (low..high).contains(&distance(region, a, b));
        pairs += positions.iter().enumerate().filter(near).count() as f64;
    }
    let density = centres / (region.width * region.depth * (region.height - 6.0));
    pairs / (centres * density * 4.0 / 3.0 * PI * (high.powi(3) - low.powi(3)))
}

#[test]
fn sparse_grains_see_each_other_as_hard_spheres_do() {
    let radii = vec![0.5; 6000];
    let region = cube(side(Dimensions::Three, &radii, 0.10), true);
    let positions = random(&region, &radii, &mut Random::new(12)).unwrap();
    assert_eq!(pair_correlation(&region, &positions, 0.5, 1.0), 0.0);
    // g(r) = 1 + φ (8 − 6r + r³/2) to first order in the fraction, mean over the shell; the second
    // order adds a few hundredths.
    let near = pair_correlation(&region, &positions, 1.0, 1.2);
    assert!((near - 1.20).abs() < 0.08, "{near}");
    let far = pair_correlation(&region, &positions, 2.2, 2.8);
    assert!((far - 1.0).abs() < 0.03, "{far}");
}

#[test]
fn dense_grains_are_ordered_nearby_but_not_crystalline() {
    let radii = vec![0.5; 4000];
    let region = cube(side(Dimensions::Three, &radii, 0.58), true);
    let positions = random(&region, &radii, &mut Random::new(12)).unwrap();
    let correlation = |low, high| pair_correlation(&region, &positions, low, high);
    // Many neighbours at contact, few behind them, a second shell of nearly two diameters.
    assert!(correlation(1.0, 1.05) > 3.5);
    assert!(correlation(1.35, 1.50) < 0.9);
    assert!(correlation(1.80, 2.05) > 1.05);
    assert!((correlation(3.5, 4.5) - 1.0).abs() < 0.03);
    // No shaking leaves grains pressed to each other with an empty gap behind.
    assert!(correlation(1.05, 1.10) > 1.5);
}

#[test]
fn a_lattice_is_regular_but_for_its_shaking() {
    let radii = vec![0.5; 1000];
    let region = cube(20.0, false);
    let positions = lattice(&region, &radii, &mut Random::new(1)).unwrap();
    assert_sound(&region, &radii, &positions);
    let offset = |x: f64| ((x - 1.0) / 2.0) - ((x - 1.0) / 2.0).round();
    let offsets: Vec<f64> = positions
        .iter()
        .flat_map(|p| [offset(p.x), offset(p.y), offset(p.z)])
        .collect();
    let largest = offsets.iter().fold(0.0f64, |a, b| a.max(b.abs()));
    assert!(largest <= 0.01 + 1e-12 && largest > 0.0099, "{largest}");
    assert!(offsets.iter().sum::<f64>().abs() < 4.0 * 0.01 * (3000.0f64 / 3.0).sqrt());
}

#[test]
fn a_lattice_takes_what_just_fits_and_refuses_what_does_not() {
    let region = square(10.0, true);
    // Pitch and diameter are both one: nothing is left to shake.
    let positions = lattice(&region, &vec![0.5 * (1.0 - 1e-8); 100], &mut Random::new(1)).unwrap();
    assert_sound(&region, &vec![0.5 * (1.0 - 1e-8); 100], &positions);
    let fault = lattice(&region, &vec![0.5; 101], &mut Random::new(1)).unwrap_err();
    assert!(
        matches!(fault, Fault::LatticeTooTight { grains: 101, .. }),
        "{fault}"
    );
}

#[test]
fn nobody_needs_no_place() {
    let region = cube(1.0, false);
    assert_eq!(random(&region, &[], &mut Random::new(1)), Ok(vec![]));
    assert_eq!(lattice(&region, &[], &mut Random::new(1)), Ok(vec![]));
    assert_eq!(packed(&region, &[], 0.5, &mut Random::new(1)), Ok(vec![]));
}

#[test]
fn a_grain_as_wide_as_the_box_lies_in_its_middle() {
    for periodic in [false, true] {
        let positions = random(&cube(1.0, periodic), &[0.5], &mut Random::new(1)).unwrap();
        assert_eq!(positions[0].z, 0.5);
        assert_sound(&cube(1.0, periodic), &[0.5], &positions);
    }
}

#[test]
fn says_what_cannot_be_arranged() {
    let region = cube(10.0, false);
    let place = |region: &Region, radii: &[f64]| random(region, radii, &mut Random::new(1)).unwrap_err();
    for length in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let broken = Region {
            depth: length,
            ..region
        };
        assert!(matches!(
            place(&broken, &[0.5]),
            Fault::Length { name: "depth", .. }
        ));
        assert!(matches!(
            place(&region, &[0.5, length]),
            Fault::Radius { grain: 1, .. }
        ));
    }
    assert!(matches!(
        place(&region, &[1.0, 6.0]),
        Fault::GrainTooLarge { grain: 1, .. }
    ));
    let dense = place(&region, &vec![0.5; 1500]);
    assert_eq!(
        dense.to_string(),
        "the grains would fill 0.7854 of the box, at most 0.60 can be arranged at random"
    );
    let pack =
        |fraction, number| packed(&region, &vec![0.5; number], fraction, &mut Random::new(1)).unwrap_err();
    for fraction in [0.0, -0.1, 0.7, f64::NAN] {
        assert!(matches!(pack(fraction, 10), Fault::Fraction { .. }));
    }
    assert!(matches!(pack(0.3, 1000), Fault::TooHigh { .. }));
    assert!(matches!(pack(0.5, 10), Fault::TooLow { .. }));
}

#[test]
fn walls_that_leave_no_room_are_named() {
    // Four grains side by side need 2 × 2 diameters; here is room for the volume, not for the shapes.
    let region = Region {
        height: 1.0,
        ..cube(1.95, false)
    };
    let fault = random(&region, &[0.5; 4], &mut Random::new(1)).unwrap_err();
    assert!(matches!(fault, Fault::Jammed { .. }), "{fault}");
    assert!(fault.help().contains("walls"));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn whatever_is_arranged_is_sound(
        (width, depth, height) in (1.0..8.0, 1.0..8.0, 1.0..8.0),
        (periodic, flat) in (any::<bool>(), any::<bool>()),
        (ratio, fraction) in (1.0..10.0, 0.01..0.5),
        seed in any::<u64>(),
    ) {
        let dimensions = if flat { Dimensions::Two } else { Dimensions::Three };
        let region = Region { width, depth, height, periodic, dimensions };
        let mut generator = Random::new(seed);
        let mut radii = Vec::new();
        while region.solids_fraction(&radii) < fraction && radii.len() < 400 {
            radii.push(spread(&mut generator, 0.4 / ratio, 0.4));
        }
        match random(&region, &radii, &mut generator) {
            Ok(positions) => assert_sound(&region, &radii, &positions),
            // Narrow boxes may be too tight, sparse ones never.
            Err(fault) => prop_assert!(fraction > 0.2, "{fault}"),
        }
        if let Ok(positions) = lattice(&region, &radii, &mut generator) {
            assert_sound(&region, &radii, &positions);
        }
    }
}
