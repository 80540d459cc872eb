//! A scene pays only for what it has: the work counters say so.

use kynch_sim::outcome::Counters;
use kynch_sim::scene::{Coupling, Fluid, Scene, Scheme, describe};

use crate::scenes::{WATER, block, particles, run_block, run_sphere, sphere};

#[test]
fn fluids_that_are_not_solved_cost_no_pairs() {
    for fluid in [Fluid::Still(WATER), Fluid::Column(WATER)] {
        for counters in [
            run_sphere(&sphere(fluid.clone())).counters,
            run_block(&block(fluid.clone(), 0.9, 4e-3)).counters,
        ] {
            let expected = Counters {
                steps: counters.steps,
                grain_steps: counters.steps,
                ..Counters::default()
            };
            assert_eq!(counters, expected);
            assert!(counters.steps > 0);
        }
    }
}

#[test]
fn a_sphere_pays_for_the_pairs_around_it_and_a_block_for_its_own() {
    let sphere = sphere(particles(4.0, Scheme::default()));
    let single = run_sphere(&sphere).counters;
    let around = single.coupling_pairs as f64 / single.steps as f64;
    // A sphere of two exchange lengths of 1.2 spacings holds 58 particles.
    assert!((40.0..75.0).contains(&around), "{around}");

    let mut block = block(particles(4.0, Scheme::default()), 0.9, 4e-3);
    block.duration = 8e-3;
    let many = run_block(&block).counters;
    // Its weights are refreshed at every eighth step at most.
    let grains = f64::from(block.layers * block.grains_per_side.pow(2));
    let refreshes = many.coupling_pairs as f64 / (around * grains);
    assert!(
        refreshes < 0.125 * many.steps as f64 + 3.0,
        "{refreshes} in {} steps",
        many.steps
    );
    assert_eq!(many.porosity_clips, 0);
    // One grain step per fluid step: no contact is near.
    assert_eq!(many.grain_steps, many.steps);
}

#[test]
fn steps_and_particles_are_those_announced() {
    let scene = sphere(particles(4.0, Scheme::default()));
    let announced = describe(&Scene::SingleSphere(scene.clone()));
    let outcome = run_sphere(&scene);
    assert_eq!(outcome.counters.steps, announced.steps);
    assert_eq!(announced.fluid_particles, 10 * 10 * 15);
    let per_particle =
        outcome.counters.fluid_pairs as f64 / (announced.fluid_particles * (announced.steps + 1)) as f64;
    // 113 neighbours inside, a few more by the skin, fewer at the top.
    assert!((95.0..135.0).contains(&per_particle), "{per_particle}");
}

#[test]
fn one_way_coupling_leaves_the_fluid_alone() {
    let mut scene = sphere(particles(4.0, Scheme::default()));
    scene.coupling = Coupling::OneWay;
    scene.duration = 10e-3;
    let words = describe(&Scene::SingleSphere(scene)).left_out.join("\n");
    assert!(
        words.contains("one-way coupling") && words.contains("self-induced"),
        "{words}"
    );
}
