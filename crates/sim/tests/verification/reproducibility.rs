//! The same scene gives the same bits, wherever and whenever it runs; places that are alike, the same.

use std::thread;

use kynch_sim::outcome::Outcome;
use kynch_sim::scene::{Fluid, Scene, Scheme};

use crate::coupled::{SPACING, WIDTH, fallen_speed, lattice};
use crate::scenes::{WATER, block, particles, run, sphere};

/// Every number of an outcome as bits: −0 is not 0, and NaN equals itself.
fn bits(outcome: &Outcome) -> Vec<u64> {
    let scalars = outcome.scalars.iter().map(|scalar| scalar.value);
    let columns = outcome.tables.iter().flat_map(|table| &table.columns);
    let values = columns.flat_map(|column| column.values.iter().copied());
    scalars.chain(values).map(f64::to_bits).collect()
}

#[test]
fn runs_repeat_bit_for_bit_one_after_another_and_side_by_side() {
    let mut falling = block(particles(4.0, Scheme::default()), 0.9, 4e-3);
    falling.duration = 10e-3;
    for scene in [
        Scene::SingleSphere(sphere(particles(4.0, Scheme::default()))),
        Scene::SingleSphere(sphere(Fluid::Still(WATER))),
        Scene::ConstantPorosityBlock(falling),
    ] {
        let first = run(&scene);
        let side_by_side = thread::scope(|scope| {
            [(); 2]
                .map(|()| scope.spawn(|| run(&scene)))
                .map(|running| running.join().expect("runs"))
        });
        for other in side_by_side {
            assert_eq!(bits(&other), bits(&first));
            assert_eq!(other.counters, first.counters);
        }
    }
}

#[test]
fn grains_a_whole_spacing_aside_fall_alike() {
    let here = fallen_speed(lattice(0.0), 100);
    let there = fallen_speed(lattice(SPACING), 100);
    let across = fallen_speed(lattice(WIDTH), 100);
    assert!(here > 3e-3, "{here:e}");
    assert!((there / here - 1.0).abs() < 1e-9, "{here:e} and {there:e}");
    assert!((across / here - 1.0).abs() < 1e-9, "{here:e} and {across:e}");
}
