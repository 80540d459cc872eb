//! Runs that end badly keep what they have, scenes that cannot run are refused, extreme ones run.

use std::cell::Cell;

use kynch_sim::outcome::{Control, Failure, FailureKind};
use kynch_sim::scene::{Column, Fluid, Scene, Scheme, SingleSphere, check, describe, run};

use crate::scenes::{GLASS, WATER, block, particles, run_block, run_sphere, scalar, series, sphere};

fn safe_step() -> f64 {
    let numbers = describe(&Scene::SingleSphere(sphere(particles(4.0, Scheme::default())))).numbers;
    let step = numbers.iter().find(|(name, ..)| name == "time step");
    step.expect("a scene of particles has a step").1
}

fn with_step(factor: f64, unsafe_time_step: bool) -> Scene {
    let scheme = Scheme {
        time_step: Some(factor * safe_step()),
        unsafe_time_step,
        ..Scheme::default()
    };
    Scene::SingleSphere(SingleSphere {
        duration: 0.5,
        ..sphere(particles(4.0, scheme))
    })
}

fn failed(scene: &Scene, control: &Control) -> Box<Failure> {
    run(scene, control).expect_err("the run must fail")
}

#[test]
fn a_step_far_beyond_its_limit_diverges_and_says_when() {
    for factor in [3.0, 10.0, 30.0] {
        let scene = with_step(factor, true);
        assert_eq!(check(&scene), [], "allowed on demand");
        let failure = failed(&scene, &Control::SILENT);
        assert_eq!(failure.kind, FailureKind::Diverged);
        assert!(
            failure.reason.contains("at t = ") && failure.reason.contains("(step "),
            "{}",
            failure.reason
        );
        // What was computed is kept: the start and every step, profiles, and the work done.
        let steps = failure.partial.counters.steps;
        assert_eq!(series(&failure.partial, "time").len() as u64, steps + 1);
        assert!(steps > 2 && failure.partial.tables.len() > 1);
    }
}

#[test]
fn a_step_beyond_its_limit_is_refused_unless_asked_for() {
    let faults = check(&with_step(1.5, false));
    assert_eq!(faults.len(), 1);
    assert_eq!(faults[0].path, "fluid.sph.scheme.time_step");
    assert_eq!(check(&with_step(0.9, false)), []);
}

#[test]
fn a_stopped_run_keeps_what_it_has() {
    for fluid in [Fluid::Still(WATER), particles(4.0, Scheme::default())] {
        let asked = Cell::new(0);
        let stop = || {
            asked.set(asked.get() + 1);
            asked.get() > 20
        };
        let scene = Scene::SingleSphere(sphere(fluid));
        let control = Control {
            stop: &stop,
            progress: &|_| {},
            split: &|_| {},
        };
        let failure = failed(&scene, &control);
        assert_eq!(failure.kind, FailureKind::Stopped);
        let (time, velocity) = (
            series(&failure.partial, "time"),
            series(&failure.partial, "velocity"),
        );
        assert!(time.len() > 4 && time.len() == velocity.len());
        assert!(velocity.is_sorted() && velocity[velocity.len() - 1] > 0.0);
    }
}

#[test]
fn progress_rises_towards_one() {
    let told = Cell::new((0.0, 0));
    let progress = |share: f64| {
        let (last, count) = told.get();
        assert!(share >= last && share <= 1.0);
        told.set((share, count + 1));
    };
    let control = Control {
        stop: &|| false,
        progress: &progress,
        split: &|_| {},
    };
    run(
        &Scene::SingleSphere(sphere(particles(4.0, Scheme::default()))),
        &control,
    )
    .expect("runs");
    assert!(told.get().0 > 0.9 && told.get().1 > 5);
}

#[test]
fn what_cannot_be_simulated_is_refused_at_the_field_at_fault() {
    type Change = fn(&mut SingleSphere);
    let cases: [(Change, &str); 8] = [
        (|s| s.grains.diameter = 0.0, "grains.diameter"),
        (|s| s.grains.density = -1.0, "grains.density"),
        (|s| s.grains.diameter = 5e-3, "grains.diameter"),
        (|s| s.column.width = 4.2e-3, "column.width"),
        (|s| s.column.height = 1e-3, "column.height"),
        (|s| s.release_height = 1.0, "release_height"),
        (|s| s.duration = f64::NAN, "duration"),
        (|s| s.gravity = f64::INFINITY, "gravity"),
    ];
    for (change, path) in cases {
        let mut scene = sphere(particles(4.0, Scheme::default()));
        change(&mut scene);
        let faults = check(&Scene::SingleSphere(scene));
        assert!(
            faults.iter().any(|fault| fault.path == path),
            "{path}: {faults:?}"
        );
    }
    let mut scene = block(Fluid::Column(WATER), 0.9, 4e-3);
    for (porosity, layers, path) in [(1.2, 13, "porosity"), (0.9, 0, "layers"), (0.9, 40, "thickness")] {
        (scene.porosity, scene.layers) = (porosity, layers);
        let faults = check(&Scene::ConstantPorosityBlock(scene.clone()));
        assert!(
            faults.iter().any(|fault| fault.path == path),
            "{path}: {faults:?}"
        );
    }
}

#[test]
fn the_smallest_column_carries_a_sphere_to_its_speed() {
    let mut scene = sphere(particles(4.0, Scheme::default()));
    scene.column = Column {
        width: 2.4e-3,
        height: 2.4e-3,
    };
    assert_eq!(check(&Scene::SingleSphere(scene.clone())), []);
    let outcome = run_sphere(&scene);
    let speeds = series(&outcome, "velocity");
    let terminal = crate::scenes::stokes_speed(&GLASS, &WATER);
    assert!((speeds[100] / terminal - 1.0).abs() < 0.02, "{}", speeds[100]);
}

#[test]
fn a_heavy_grain_hits_the_floor_softly_and_stays_above_it() {
    let mut scene = sphere(particles(4.0, Scheme::default()));
    scene.grains.density = 8000.0;
    scene.release_height = 0.05;
    scene.duration = 0.1;
    let outcome = run_sphere(&scene);
    let overlap = scalar(&outcome, "overlap");
    assert!(overlap > 0.0 && overlap < 0.05, "{overlap}");
    let lowest = series(&outcome, "height").iter().copied().fold(1.0, f64::min);
    assert!(lowest > 0.95 * 0.5 * GLASS.diameter, "{lowest:e}");
}

#[test]
fn a_grain_on_the_floor_comes_to_rest_at_the_overlap_that_carries_it() {
    let mut scene = sphere(particles(4.0, Scheme::default()));
    scene.release_height = 0.05;
    scene.duration = 0.08;
    let outcome = run_sphere(&scene);
    let error = scalar(&outcome, "momentum_error");
    assert!(error < 1e-11, "contacts are part of the momentum: {error:e}");
    let last = |name| *series(&outcome, name).last().expect("rows");
    assert!(last("velocity").abs() < 1e-6, "{:e}", last("velocity"));
    // The spring stops the grain from its terminal speed v within 0.003 d: m v² = k (0.003 d)².
    let speed = crate::scenes::stokes_speed(&GLASS, &WATER);
    let excess = scene.gravity * (1.0 - WATER.density / GLASS.density);
    let expected = excess * (0.003 * GLASS.diameter / speed).powi(2);
    let overlap = 0.5 * GLASS.diameter - last("height");
    assert!(
        (overlap / expected - 1.0).abs() < 0.02,
        "{overlap:e} against {expected:e}"
    );
}

#[test]
fn a_block_lands_on_the_floor_and_rests() {
    let mut scene = block(particles(4.0, Scheme::default()), 0.9, 2.4e-3);
    scene.column.height = 3.2e-3;
    (scene.layers, scene.duration) = (8, 0.45);
    let outcome = run_block(&scene);
    let (heights, speeds) = (series(&outcome, "height"), series(&outcome, "velocity"));
    let (height, speed) = (heights[heights.len() - 1], speeds[speeds.len() - 1]);
    assert!((height / (0.5 * GLASS.diameter) - 1.0).abs() < 0.01, "{height:e}");
    assert!(speed.abs() < 1e-6, "{speed:e}");
    let overlap = scalar(&outcome, "overlap");
    assert!(overlap > 0.0 && overlap < 0.05, "{overlap}");
}

#[test]
fn a_light_grain_rises_and_one_without_excess_weight_stays() {
    let mut scene = sphere(particles(4.0, Scheme::default()));
    scene.duration = 0.04;
    scene.release_height = 0.5;
    for density in [900.0, 1000.0] {
        scene.grains.density = density;
        let outcome = run_sphere(&scene);
        let expected = crate::scenes::stokes_speed(&scene.grains, &WATER);
        let speed = *series(&outcome, "velocity").last().expect("rows");
        assert!(
            (speed - expected).abs() <= 0.02 * expected.abs(),
            "{density}: {speed:e} {expected:e}"
        );
    }
}
