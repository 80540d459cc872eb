//! Hardly any grains, very unequal ones, and ones that are nowhere.

use kynch_sim::bed::{Listing, Wall};
use kynch_sim::contact::Body;
use kynch_sim::math::Vec3;
use kynch_sim::neighbours::Search;

use super::{Setup, all_laws, cube, gas, grain, normals, smooth, states};

const SIDE: f64 = 6e-4;

const LISTINGS: [Listing; 3] = [
    Listing::Skin(None),
    Listing::EveryStep(Search::Grid),
    Listing::EveryStep(Search::BruteForce),
];

#[test]
fn nothing_happens_to_no_grains() {
    for listing in LISTINGS {
        let mut setup = Setup::new(Vec::new(), all_laws()[0], 1e-6);
        setup.walls = cube(SIDE);
        setup.surroundings.gravity = 9.81;
        setup.listing = listing;
        let bed = setup.after(100);
        assert!(bed.grains.is_empty() && bed.contacts().pairs.is_empty());
        assert_eq!(bed.deepest, 0.0);
        assert!(bed.deepest_contact().is_none());
        assert_eq!(bed.momentum_error(), 0.0);
    }
}

#[test]
fn one_grain_flies_as_if_there_were_no_lists() {
    for period in [[0.0; 3], [SIDE; 3]] {
        for listing in LISTINGS {
            let mut setup = Setup::new(vec![grain(1e-4, 2500.0, Vec3::repeat(1e-4))], all_laws()[5], 1e-6);
            setup.grains[0].velocity = Vec3::new(0.5, -0.7, 1.0);
            setup.interaction.period = period;
            setup.listing = listing;
            let bed = setup.after(1000);
            let way = setup.grains[0].velocity * 1e-3;
            let error = bed.nearest(states(&bed)[0][0] - setup.grains[0].position - way);
            assert!(error.norm() < 1e-15, "{error}");
            assert_eq!(states(&bed)[0][1], setup.grains[0].velocity);
        }
    }
}

#[test]
fn walls_anywhere_leave_a_distant_grain_alone() {
    // The origin lies behind these walls.
    let far = Vec3::repeat(10.0);
    let mut setup = Setup::new(
        vec![grain(1e-4, 2500.0, far + Vec3::repeat(5.4e-5))],
        all_laws()[0],
        1e-6,
    );
    setup.walls = [Vec3::x(), Vec3::y(), Vec3::z()]
        .map(|normal| Wall { normal, point: far })
        .to_vec();
    let bed = setup.after(10);
    assert_eq!(bed.deepest, 0.0);
    assert_eq!(states(&bed)[0][1], Vec3::zeros());
}

#[test]
fn grains_of_a_tenth_of_the_size_settle_around_a_large_one() {
    let mut grains = vec![grain(2e-4, 2500.0, Vec3::repeat(3e-4))];
    for i in 0..80 {
        let cell = Vec3::new((i % 10) as f64, (i / 10 % 8) as f64, 0.0);
        grains.push(grain(
            2e-5,
            2500.0,
            Vec3::new(5e-5, 5e-5, 4.4e-4) + cell * 5e-5 + Vec3::z() * 1e-7 * i as f64,
        ));
    }
    let mut setup = Setup::new(grains, all_laws()[13], 5e-7);
    setup.walls = cube(SIDE);
    setup.surroundings.gravity = 200.0;
    let mut reference = None;
    for listing in LISTINGS {
        setup.listing = listing;
        let bed = setup.after(8000);
        let met = bed.deepest;
        assert!(met > 1e-4 && met < 0.05, "{met:e}");
        for state in states(&bed) {
            assert!(state[0].iter().all(|&x| x > 0.0 && x < SIDE), "{}", state[0]);
        }
        let found = states(&bed);
        let first = reference.get_or_insert_with(|| found.clone());
        let worst = found
            .iter()
            .zip(first.iter())
            .map(|(a, b)| (a[0] - b[0]).norm() / SIDE)
            .fold(0.0, f64::max);
        assert!(worst < 1e-6, "{worst:e}");
    }
}

#[test]
fn a_grain_without_a_place_is_named() {
    for listing in LISTINGS {
        for victim in [0, 17, 59] {
            for axis in 0..3 {
                for bad in [f64::NAN, f64::INFINITY] {
                    let mut setup = Setup::new(gas(60, SIDE, 3), all_laws()[31], 1e-6);
                    setup.grains[victim].position[axis] = bad;
                    setup.listing = listing;
                    let astray = setup.bed().advance(10).expect_err("no such place");
                    assert_eq!(astray.grain as usize, victim, "{astray:?}");
                    assert!(!astray.position[axis].is_finite());
                }
            }
        }
    }
}

#[test]
fn a_grain_that_crosses_others_in_a_step_is_named() {
    for victim in [0, 17, 59] {
        for bad in [f64::NAN, f64::INFINITY, 1e3, -1e200] {
            let mut setup = Setup::new(gas(60, SIDE, 3), smooth(normals()[0]), 1e-6);
            setup.grains[victim].velocity.y = bad;
            let astray = setup.bed().advance(10).expect_err("no such speed");
            assert_eq!(astray.grain as usize, victim, "{astray:?}");
        }
    }
}

#[test]
fn a_bed_that_blows_up_says_so_before_there_are_no_numbers() {
    // Two grains at nearly one place, in a step a hundred times too long.
    let mut setup = Setup::new(gas(60, SIDE, 3), smooth(normals()[1]), 1e-4);
    let first = setup.grains[0];
    setup.grains[1] = first;
    setup.grains[1].position.x += 1e-9;
    setup.grains[1].body = Body::sphere(2.0 * first.body.radius, 1e-3);
    let astray = setup.bed().advance(1000).expect_err("such an overlap has no end");
    assert!(astray.grain < 2, "{astray:?}");
    assert!(astray.velocity.norm() > 0.1);
}
