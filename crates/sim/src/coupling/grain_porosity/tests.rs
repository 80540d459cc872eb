//! The porosity at grains by what it must be.

use super::*;

const DIAMETER: f64 = 1e-4;
const WIDTH: f64 = 2e-3;

fn size(diameter: f64) -> GrainSize {
    GrainSize {
        diameter,
        length: 3.0 * diameter,
    }
}

/// Scattered places in a column, the same every time (Roberts 2018).
fn scattered(count: usize, height: f64) -> Vec<Vec3> {
    const BASE: f64 = 1.220_744_084_605_759_5;
    let share = |i: usize, power: i32| (0.5 + i as f64 * BASE.powi(-power)).fract();
    (0..count)
        .map(|i| Vec3::new(WIDTH * share(i, 1), WIDTH * share(i, 2), height * share(i, 3)))
        .collect()
}

/// The sum as it is written down, over all copies within two widths.
fn summed(position: &[Vec3], sizes: &[GrainSize], sharpening: Sharpening, floor: bool) -> Vec<f64> {
    let term = |i: usize, j: usize| {
        let mut sum = 0.0;
        let size = &sizes[j];
        for (ix, iy) in (-2..=2).flat_map(|ix| (-2..=2).map(move |iy| (ix, iy))) {
            let moved = position[j] + Vec3::new(f64::from(ix), f64::from(iy), 0.0) * WIDTH;
            let mirrored = Vec3::new(moved.x, moved.y, -moved.z);
            let mut near = vec![moved];
            near.extend(floor.then_some(mirrored));
            for place in near {
                let q = (place - position[i]).norm() / size.length;
                sum += size.volume() / size.length.powi(3) * sharpening.value(q);
            }
        }
        sum
    };
    (0..position.len())
        .map(|i| 1.0 - (0..position.len()).map(|j| term(i, j)).sum::<f64>())
        .collect()
}

#[test]
fn the_sum_holds_every_neighbour_once() {
    let position = scattered(300, 1.5e-3);
    let sizes: Vec<GrainSize> = (0..300).map(|i| size([1e-4, 1.5e-4, 0.8e-4][i % 3])).collect();
    for (sharpening, floor_images) in [(Sharpening::NONE, true), (Sharpening::EDGE_NEUTRAL, false)] {
        let rules = PorosityRules {
            sharpening,
            arrangement: Arrangement::Lattice,
            floor_images,
        };
        let found = grain_porosity(&position, sizes.clone(), rules, WIDTH);
        for (found, expected) in found
            .iter()
            .zip(summed(&position, &sizes, sharpening, floor_images))
        {
            assert!((found - expected).abs() < 1e-13, "{found} {expected}");
        }
    }
}

#[test]
fn a_grain_alone_sees_clear_fluid_and_one_next_to_the_floor_only_its_image() {
    let rules = PorosityRules::FREE;
    let far = grain_porosity(&[Vec3::repeat(1e-3)], vec![size(DIAMETER)], rules, WIDTH)[0];
    // S_0 is not quite one at the grain's own solids fraction of a few per cent.
    assert!((far - 1.0).abs() < 0.01, "{far}");
    let near = grain_porosity(
        &[Vec3::new(1e-3, 1e-3, 0.5e-4)],
        vec![size(DIAMETER)],
        rules,
        WIDTH,
    )[0];
    assert!(near < far - 0.005 && near > 0.95, "{near}");
}

#[test]
fn a_periodic_lattice_has_its_own_porosity_inside() {
    let side = 12;
    let pitch = (size(DIAMETER).volume() / 0.1_f64).cbrt();
    let grains: Vec<Vec3> = (0..side * side * 25)
        .map(|i| {
            let (x, y, z) = (i % side, i / side % side, i / side / side);
            Vec3::new(x as f64 + 0.5, y as f64 + 0.5, z as f64) * pitch
        })
        .collect();
    let inside = side * side * 12;
    for (sharpening, tolerance) in [(Sharpening::NONE, 3e-4), (Sharpening::EDGE_NEUTRAL, 1e-3)] {
        let rules = PorosityRules {
            sharpening,
            ..PorosityRules::SHARP_LATTICE
        };
        let sizes = vec![size(DIAMETER); grains.len()];
        let porosity = grain_porosity(&grains, sizes, rules, side as f64 * pitch);
        assert!((porosity[inside] - 0.9).abs() < tolerance, "{}", porosity[inside]);
    }
}

#[test]
fn a_random_suspension_is_seen_at_its_own_porosity_down_to_the_floor() {
    // Points, not spheres: an ideal gas has no excluded volume, so its whole own term is one too many.
    let height = 3e-3;
    let count = (0.05 * WIDTH * WIDTH * height / size(DIAMETER).volume()) as usize;
    let position = scattered(count, height);
    let porosity = grain_porosity(&position, vec![size(DIAMETER); count], PorosityRules::FREE, WIDTH);
    let mean = |low: f64, high: f64| {
        let inside: Vec<f64> = (position.iter().zip(&porosity))
            .filter(|(x, _)| (low..high).contains(&x.z))
            .map(|(_, porosity)| *porosity)
            .collect();
        inside.iter().sum::<f64>() / inside.len() as f64
    };
    let (bottom, middle) = (mean(0.0, 2e-4), mean(1e-3, 2e-3));
    assert!((bottom - middle).abs() < 4e-3, "{bottom} {middle}");
}

#[test]
fn sums_are_kept_until_a_grain_has_gone_far_enough_to_tell() {
    let count = 400;
    let position = scattered(count, 1e-3);
    let mut kept = PorositySums::new(PorosityRules::FREE, vec![size(DIAMETER); count], WIDTH);
    kept.refresh(&position);
    let before = kept.porosity.clone();
    let fallen = |way: f64| -> Vec<Vec3> {
        let alternately = |(i, x): (usize, &Vec3)| x + Vec3::new(way * [1.0, -1.0][i % 2], 0.0, 0.0);
        position.iter().enumerate().map(alternately).collect()
    };
    let (near, far) = (fallen(0.9 * kept.slack), fallen(1.1 * kept.slack));
    kept.refresh(&near);
    assert_eq!(kept.porosity, before);
    let anew = grain_porosity(&near, vec![size(DIAMETER); count], PorosityRules::FREE, WIDTH);
    for (kept, anew) in kept.porosity.iter().zip(&anew) {
        assert!((kept - anew).abs() < 1e-3, "{kept} {anew}");
    }
    kept.refresh(&far);
    assert_ne!(kept.porosity, before);
}

#[test]
fn every_instruction_set_gives_the_same_bits() {
    let position = scattered(200, 1e-3);
    let mut sums = PorositySums::new(PorosityRules::FREE, vec![size(DIAMETER); 200], WIDTH);
    sums.refresh(&position);
    let dispatched = sums.solids.clone();
    let plain = StripSum {
        strips: &sums.strips,
        sharpening: Sharpening::NONE,
        solids: &mut sums.solids,
    };
    crate::neighbours::WideWork::run::<crate::neighbours::Plain>(plain);
    assert_eq!(sums.solids, dispatched);
}
