//! Flow along the medium.

use super::*;

fn channel(mean_velocity: f64) -> Filtration {
    let mut scene = over_grains(0.0, 1);
    scene.bed.container.sides = Sides::PeriodicAlongX;
    scene.bed.container.width = 10.0 * DIAMETER;
    scene.bed.container.height = 10.0 * DIAMETER;
    scene.crossflow = Some(Crossflow {
        mean_velocity,
        shear_lift: false,
    });
    scene
}

#[test]
fn grains_are_carried_along_and_come_in_again_at_the_other_end() {
    let mut scene = channel(0.05);
    // Light grains stay in the stream.
    scene.bed.classes[0].density = 1001.0;
    scene.bed.classes[0].number = 60;
    scene.feed = Feed::Rate {
        rate: 400.0,
        layers: 5.0,
    };
    scene.filtrate.initial_flux = Some(1e-4);
    scene.bed.duration = 0.3;
    scene.bed.snapshots = 4;
    let outcome = outcome(&scene);
    assert!(scalar(&outcome, "volume_error") < 1e-13);
    assert_eq!(scalar(&outcome, "fed"), 60.0);
    let kept = outcome
        .tables
        .iter()
        .find(|table| table.name == "snapshots")
        .unwrap();
    let x = &kept
        .columns
        .iter()
        .find(|column| column.name == "x")
        .unwrap()
        .values;
    assert!(x.iter().all(|x| *x >= 0.0 && *x <= scene.bed.container.width));
    // Fed into the upper half, they flow with about the mean velocity.
    let volume = scalar(&outcome, "fed") * std::f64::consts::PI / 6.0 * DIAMETER.powi(3);
    let fraction = volume / (scene.area() * scene.bed.container.height);
    let speed = scalar(&outcome, "grain_flux") / fraction;
    assert!(speed > 0.03 && speed < 0.075, "{speed}");
}

#[test]
fn a_fast_stream_leaves_a_thinner_and_looser_layer() {
    // As published: at 0.1 m/s against 0.01 m/s.
    let slow = outcome(&channel(0.01));
    let fast = outcome(&channel(0.1));
    assert!(scalar(&fast, "deposited") < 0.95 * scalar(&slow, "deposited"));
    assert!(scalar(&fast, "thickness_mean") < scalar(&slow, "thickness_mean"));
    assert!(scalar(&fast, "grain_flux") > 100.0 * scalar(&slow, "grain_flux").abs());
    let shear = |outcome| scalar(outcome, "wall_shear");
    assert!((shear(&fast) / shear(&slow) - 10.0).abs() < 1e-9);
    assert!((shear(&slow) - 1e-3 * 6.0 * 0.01 / (10.0 * DIAMETER)).abs() < 1e-12);
    assert!(scalar(&slow, "surface_shear") < shear(&slow));
}

#[test]
fn grains_that_fall_into_faster_fluid_lag_and_the_shear_draws_them_on() {
    let mut scene = channel(0.1);
    scene.bed.classes[0].number = 5;
    scene.bed.duration = 0.02;
    let height = |scene: &Filtration| {
        let outcome = outcome(scene);
        let heights = series(&outcome, "centre_of_mass");
        heights[heights.len() - 1]
    };
    let without = height(&scene);
    scene.crossflow = Some(Crossflow {
        mean_velocity: 0.1,
        shear_lift: true,
    });
    // In the upper half the fluid is faster below.
    let saffman = height(&scene);
    assert!(saffman < without - 1e-3 * DIAMETER, "{saffman}, {without}");
    scene.crossflow = channel(0.1).crossflow;
    scene.bed.lift = Lift::Magnus;
    let magnus = height(&scene);
    assert!((magnus - without).abs() > 1e-6 * DIAMETER, "{magnus}, {without}");
}
