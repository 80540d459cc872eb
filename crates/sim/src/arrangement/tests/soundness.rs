//! No overlap, nobody outside, the same every time, and a reason where that cannot be.

use super::super::*;
use super::*;
use proptest::prelude::*;

#[test]
fn random_grains_never_overlap_and_stay_inside() {
    for periodic in [false, true] {
        for radii in [vec![1e-4; 800], sizes(800, 1e-4, 1e-3)] {
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
    let radii = vec![0.5; 2000];
    let region = cube(side(Dimensions::Three, &radii, 0.60), true);
    assert_sound(
        &region,
        &radii,
        &random(&region, &radii, &mut Random::new(3)).unwrap(),
    );
}

#[test]
fn grains_that_jam_between_walls_grow_back_into_denser_places() {
    // Five and a half diameters wide: relaxation alone ends at 0.53.
    let radii = vec![0.5; 200];
    let region = cube(side(Dimensions::Three, &radii, 0.55), false);
    for seed in 1..4 {
        assert_sound(
            &region,
            &radii,
            &random(&region, &radii, &mut Random::new(seed)).unwrap(),
        );
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
        let region = Region { width, depth, height, periodic: [periodic; 2], dimensions };
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

#[test]
fn relaxation_brings_grains_inside_even_where_none_touch() {
    let region = cube(10.0, false);
    let outside = vec![Vec3::new(0.1, 5.0, 5.0), Vec3::new(5.0, 5.0, 9.9)];
    let relaxed = relaxation::Relaxation::new(&region, &[0.5, 0.7], outside, 0.01)
        .run(10)
        .unwrap();
    assert_sound(&region, &[0.5, 0.7], &relaxed);
}
