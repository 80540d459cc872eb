//! The same bed told in another way does the same.

use kynch_sim::bed::{Grain, Laws, Listing};
use kynch_sim::math::{Random, Vec3};
use kynch_sim::neighbours::Search;

use super::{Setup, cube, gas, grain, normals, rolling, states, tangentials};

const SIDE: f64 = 6e-4;
const STEP: f64 = 2e-6;
const LISTINGS: [Listing; 6] = [
    Listing::Skin(None),
    Listing::Skin(Some(0.02)),
    Listing::Skin(Some(0.1)),
    Listing::Skin(Some(0.5)),
    Listing::EveryStep(Search::Grid),
    Listing::EveryStep(Search::BruteForce),
];

fn laws(tangential: usize) -> Laws {
    Laws {
        normal: normals()[1],
        tangential: tangentials(0.3)[tangential],
        rolling: rolling(0.02),
    }
}

/// Sixty unequal grains that fall onto the floor of a cube.
fn falling(tangential: usize) -> Setup {
    let mut setup = Setup::new(gas(60, SIDE, 2), laws(tangential), STEP);
    setup.walls = cube(SIDE);
    setup.surroundings.gravity = 200.0;
    setup
}

/// Greatest difference of position, of velocity and of the speed of surfaces between two states, over a
/// length and a speed.
fn difference(a: &[[Vec3; 3]], b: &[[Vec3; 3]], scales: [f64; 3]) -> f64 {
    a.iter()
        .zip(b)
        .flat_map(|(a, b)| (0..3).map(|i| (a[i] - b[i]).norm() / scales[i]))
        .fold(0.0, f64::max)
}

const SCALES: [f64; 3] = [SIDE, 0.1, 1e3];

#[test]
fn two_grains_with_friction_do_the_same_to_the_last_bit_however_they_are_listed() {
    for tangential in 0..4 {
        let mut grains = vec![
            grain(2e-4, 2500.0, Vec3::zeros()),
            grain(1e-4, 1500.0, Vec3::new(1.6e-4, 2e-5, 0.0)),
        ];
        grains[1].velocity = Vec3::new(-0.05, 0.03, 0.02);
        grains[0].angular_velocity = Vec3::new(100.0, -200.0, 300.0);
        let mut setup = Setup::new(grains, laws(tangential), STEP);
        let reference = states(&setup.after(300));
        for listing in LISTINGS {
            setup.listing = listing;
            assert_eq!(states(&setup.after(300)), reference, "{listing:?}");
        }
    }
}

#[test]
fn how_near_pairs_are_found_and_how_often_is_no_part_of_the_result() {
    // Later on collisions have multiplied the rounding of the sums a million times.
    for tangential in 0..4 {
        let mut setup = falling(tangential);
        let reference = setup.after(1000);
        assert!(reference.work.lists > 20 && reference.contacts().pairs.len() > 20);
        for listing in LISTINGS {
            setup.listing = listing;
            let bed = setup.after(1000);
            let worst = difference(&states(&bed), &states(&reference), SCALES);
            assert!(worst < 1e-9, "{worst:e} {listing:?}");
        }
    }
}

#[test]
fn the_order_in_which_grains_are_given_changes_no_bit() {
    for tangential in 0..4 {
        let setup = falling(tangential);
        let reference = states(&setup.after(1500));
        let mut order: Vec<usize> = (0..setup.grains.len()).collect();
        Random::new(17).shuffle(&mut order);
        let shuffled: Vec<Grain> = order.iter().map(|&i| setup.grains[i]).collect();
        let found = states(
            &Setup {
                grains: shuffled,
                ..setup
            }
            .after(1500),
        );
        for (place, &number) in order.iter().enumerate() {
            assert_eq!(found[place], reference[number]);
        }
    }
}

#[test]
fn a_common_drift_changes_nothing_among_grains_in_a_periodic_box() {
    const STEPS: u64 = 400;
    for tangential in 0..4 {
        let mut setup = Setup::new(gas(60, SIDE, 7), laws(tangential), STEP);
        setup.interaction.period = [SIDE; 3];
        let still = setup.after(STEPS);
        assert!(still.deepest > 1e-3);
        let drift = Vec3::new(0.7, -0.4, 1.1);
        for grain in &mut setup.grains {
            grain.velocity += drift;
        }
        let drifting = setup.after(STEPS);
        let way = drift * (STEPS as f64 * STEP);
        let mut worst = 0.0_f64;
        for (a, b) in states(&still).iter().zip(states(&drifting)) {
            let apart = still.nearest(b[0] - way - a[0]);
            let parts = [
                apart.norm() / SIDE,
                (b[1] - drift - a[1]).norm() / 0.1,
                (b[2] - a[2]).norm() / 1e3,
            ];
            worst = parts.into_iter().fold(worst, f64::max);
        }
        assert!(worst < 1e-8, "{worst:e}");
    }
}

#[test]
fn a_run_in_pieces_is_the_run_in_one() {
    let setup = falling(3);
    let whole = states(&setup.after(1000));
    let mut bed = setup.bed();
    for steps in [1, 2, 3, 94, 0, 400, 500] {
        bed.advance(steps).expect("no grain leaps");
    }
    let worst = difference(&states(&bed), &whole, SCALES);
    assert!(worst < 1e-7, "{worst:e}");
}
